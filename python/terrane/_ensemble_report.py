# SPDX-License-Identifier: LGPL-3.0-or-later
"""The report of an ensemble: one HTML file that every browser opens, without scripts or other files."""

from __future__ import annotations

import html
from typing import List

import numpy as np

from . import _core
from ._ensemble_blocks import STATES
from ._ensemble_plots import colour_map, histogram, table
from ._ensemble_results import Outcomes
from ._results import counted

_STYLE = """
:root{color-scheme:light dark;--line:#8886;--bar:#5b8bbd;--mark:#c2410c}
body{font:15px/1.5 system-ui,sans-serif;max-width:1180px;margin:2em auto;padding:0 1em}
h1{font-size:1.5em}h2{font-size:1.15em;margin-top:2em;border-bottom:1px solid var(--line)}
table{border-collapse:collapse}td,th{padding:.2em .7em;border-bottom:1px solid var(--line);text-align:left}
td.n{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}.wide{overflow-x:auto}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(330px,1fr));gap:1.2em}
svg{width:100%;height:auto}svg text{font-size:11px;fill:currentColor}.bar{fill:var(--bar)}
.curve{fill:none;stroke:currentColor;stroke-width:1.5}.mark{stroke:var(--mark);stroke-dasharray:4 3}
.given{stroke:currentColor;stroke-width:2}.axis{stroke:currentColor}
figure{margin:0}.map{image-rendering:pixelated;background:repeating-linear-gradient(45deg,#8883 0 4px,#0000 4px 8px)}
.scale img{width:9em;height:.8em;vertical-align:-1px}figcaption{font-size:.9em}
.good{color:#15803d}.bad{color:var(--mark)}
"""


def page(made: Outcomes) -> str:
    """Return the page."""
    title = f"Ensemble of {counted(made.count, 'realisation')}"
    body = [f"<h1>{title}</h1>", _verdict(made), _volumes(made), _histograms(made), _states(made), _contacts(made),
            _maps(made), _juxtaposition(made), _failures(made), _method(made)]
    return (f'<!DOCTYPE html><html lang="en"><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" '
            f'content="{_core.content_policy("", _STYLE)}"><title>{title}</title>'
            f'<meta name="viewport" content="width=device-width,initial-scale=1"><style>{_STYLE}</style>'
            f'<body>{"".join(body)}</body></html>\n')


def _verdict(made: Outcomes) -> str:
    failed = len(made.failures)
    changed = sum(1 for b in made.blocks.values() if b.states["whole"] < made.count - failed)
    text = (f"All {made.count} realisations were built." if not failed else
            f"{made.count - failed} of {made.count} realisations were built; {failed} failed, see below.")
    more = (" Every block is there, in one piece, in each of them." if not changed else
            f" {counted(changed, 'block')} of {len(made.blocks)} split, merge or vanish in some of them.")
    new = sum(made.new.values())
    extra = f" There are {counted(new, 'block')} in all that the model has not." if new else ""
    return f'<p class="{"bad" if failed else "good"}">{html.escape(text + more + extra)}</p>'


def _row(name: str, values: "dict[str, float]", given: float) -> List[object]:
    return [name, given, *(values[s] for s in ("p90", "p50", "p10", "mean", "sd"))]


def _volumes(made: Outcomes) -> str:
    given = {b["name"]: b["volume"] for b in made.model_record["blocks"]}
    rows = [_row(n, b.measures["volume"], given[n]) for n, b in made.blocks.items()]
    return ("<h2>Volumes</h2><p>P90 is exceeded with a probability of 90 %. Volumes are in the cubic unit of the "
            "surfaces; “model” is the model as it was given.</p>"
            + table(["Block", "Model", "P90", "P50", "P10", "Mean", "Standard deviation"], rows))


def _histograms(made: Outcomes) -> str:
    given = {b["name"]: b["volume"] for b in made.model_record["blocks"]}
    plots = []
    for name, block in made.blocks.items():
        values = made.table["volume"][made.table["block"] == name]
        marks = {p: block.measures["volume"][p] for p in ("p90", "p50", "p10")}
        plots.append("<div>" + histogram(values, marks, given[name], f"{name}: volume") + "</div>")
    return ('<p>Bars count realisations; the curve is the share of them that exceeds a volume; the short line is '
            'the model.</p><div class="grid">' + "".join(plots) + "</div>")


def _states(made: Outcomes) -> str:
    rows = [[n, *(b.states[s] for s in STATES)] for n, b in made.blocks.items()]
    new = [[n, c] for n, c in sorted(made.new.items())]
    return ("<h2>What became of the blocks</h2><p>In how many realisations a block is whole, split into several, "
            "gone, or one with another block.</p>" + table(["Block", *(s.capitalize() for s in STATES)], rows)
            + ("<p>Blocks that the model has not:</p>" + table(["Block", "Realisations"], new) if new else ""))


def _contacts(made: Outcomes) -> str:
    if not made.contacts:
        return ""
    parts = []
    for i, contact in enumerate(made.contacts):
        suffix = "" if len(made.contacts) == 1 else f"_{i + 1}"
        rows = []
        for name, block in made.blocks.items():
            for measure, called in (("volume_above", "volume above"), ("column", "column")):
                values = block.measures[measure + suffix]
                rows.append([name, called, *(values[s] for s in ("p90", "p50", "p10", "mean", "sd"))])
        parts.append(f"<h2>Above z = {_core.figure(contact)}</h2>"
                     + table(["Block", "Measure", "P90", "P50", "P10", "Mean", "Standard deviation"], rows))
    return "".join(parts)


def _maps(made: Outcomes) -> str:
    deviations = [colour_map(v, 0.0, float(np.nanmax(v)), f"{n}: standard deviation of z", made.frame)
                  for n, v in made.depth_sd.items() if np.isfinite(v).any()]
    shares = [colour_map(np.where(v > 0, v, np.nan), 0.0, 1.0, f"{n}: probability", made.frame)
              for n, v in made.probability.items()]
    return ('<h2>Where the surfaces are uncertain</h2><div class="grid">' + "".join(deviations)
            + '</div><h2>Where the blocks are</h2><p>The share of realisations in which a block is below a '
            'place.</p><div class="grid">' + "".join(shares) + "</div>")


def _juxtaposition(made: Outcomes) -> str:
    faults = set(made.model_record.get("faults", []))
    rows = [[j.surface, j.blocks[0], j.blocks[1], j.probability, *(j.area[s] for s in ("p90", "p50", "p10"))]
            for j in made.juxtaposed if j.surface in faults]
    if not rows:
        return ""
    return ("<h2>What touches across faults</h2><p>The share of realisations in which two blocks face each other "
            "across a fault, and the area where they do.</p>"
            + table(["Fault", "Block", "Other block", "Probability", "Area P90", "P50", "P10"], rows))


def _failures(made: Outcomes) -> str:
    if not made.failures:
        return ""
    return ("<h2>Failures</h2><p>The folder failures has the surfaces of each and a project that reproduces it.</p>"
            + table(["Realisation", "Code", "Reason"], [list(f) for f in made.failures]))


def _method(made: Outcomes) -> str:
    return (f"<h2>How it was made</h2><p>Terrane {html.escape(made._task.version)}, project "
            f"{html.escape(made._task.source)}, seed {made.seed}. Blocks are matched by the sides of surfaces that bound "
            "them. A realisation in which a block has vanished counts with the volume 0; one in which it is merged "
            "does not count.</p>")
