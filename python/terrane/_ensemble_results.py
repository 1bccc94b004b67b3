# SPDX-License-Identifier: LGPL-3.0-or-later
"""Adds up the blocks, failures, contacts and maps of the realisations of an ensemble."""

from __future__ import annotations

from typing import Any, Dict, List, NamedTuple, Sequence, Tuple

import numpy as np

from ._arrays import Float64Array
from ._ensemble_blocks import STATES, match, names_of_values, percentiles
from ._ensemble_form import checked
from ._ensemble_work import Record, Task
from ._results import Result


class Failure(NamedTuple):
    """A realisation that could not be built: its number, the code and the reason of the error.

    Examples
    --------
    >>> made = ...
    >>> made.failures
    []
    """

    number: int
    code: str
    reason: str


class Juxtaposed(NamedTuple):
    """Two blocks that touch across a surface: in what share of realisations, and the area where they do.

    Examples
    --------
    >>> made = ...
    >>> touching = made.juxtaposed[0]
    >>> touching.surface, touching.blocks, touching.probability
    ('top', ('above top', 'below top'), 1.0)
    """

    surface: str
    blocks: Tuple[str, str]
    probability: float
    area: Dict[str, float]


class BlockOutcome(NamedTuple):
    """The outcome of a block: in how many realisations it is whole, split, vanished or merged, and its measures.

    ``measures`` has, by name, a dict with ``p90``, ``p50``, ``p10``, ``mean``, ``sd``, ``least``, ``largest`` and
    ``count``; P90 is exceeded with a probability of 90 %. Realisations in which the block is merged with another one
    do not count; one in which it has vanished counts with the volume 0.

    Examples
    --------
    >>> made = ...
    >>> made.blocks["below top"].states
    {'whole': 3, 'split': 0, 'vanished': 0, 'merged': 0}
    """

    name: str
    states: Dict[str, int]
    measures: Dict[str, Dict[str, float]]


class Outcomes(Result):
    """The numbers of an `Ensemble`; a class of its own, as its files and its report show no more."""

    __slots__ = ("_task", "_records", "_model", "seed", "count", "blocks", "failures", "new", "juxtaposed", "table",
                 "realisations", "probability", "depth_mean", "depth_sd", "frame", "model_record", "interfaces")

    def __init__(self, task: Task, model: bytes, files: Sequence[bytes]) -> None:
        self._task, self._model, self._records = task, model, tuple(files)
        self.seed, self.count, self.frame = task.seed, len(files), task.frame
        self.model_record: Dict[str, Any] = checked(model, task, 0).values
        self.failures: List[Failure] = []
        self.new: Dict[str, int] = {}
        self.realisations: List[Dict[str, Any]] = []
        self.interfaces: List[Tuple[int, str, str, str, float]] = []
        self._add_up()

    def _add_up(self) -> None:
        model = self.model_record["blocks"]
        names = [b["name"] for b in model]
        rows: List[Tuple[Any, ...]] = []
        maps = _Maps([s for s in self.model_record["surfaces"]], names, (self._task.cells[1], self._task.cells[0]))
        for number, data in enumerate(self._records, 1):
            record = checked(data, self._task, number)
            values = record.values
            if values["status"] == "failed":
                self.failures.append(Failure(values["number"], values["code"], values["reason"]))
                self.realisations.append({"realisation": values["number"], "status": "failed",
                                          "reason": values["reason"]})
                continue
            found = match(model, values["blocks"], self._task.contacts)
            for name in found.new:
                self.new[name] = self.new.get(name, 0) + 1
            for name, block in zip(names, found.blocks):
                rows.append((values["number"], name, block.state, len(block.pieces), *block.values.values()))
            self._note(values, found.owner, names, len(found.new))
            maps.add(record, found.owner)
        heads = ["realisation", "block", "state", "pieces", *names_of_values(self._task.contacts)]
        columns = list(zip(*rows)) if rows else [()] * len(heads)
        kinds = {"realisation": np.int64, "block": np.str_, "state": np.str_, "pieces": np.int64}
        self.table: Dict[str, Any] = {h: np.array(c, dtype=kinds.get(h, np.float64)) for h, c in zip(heads, columns)}
        self.probability, self.depth_mean, self.depth_sd = maps.results()
        self.blocks: Dict[str, BlockOutcome] = {n: self._outcome(n) for n in names}
        self.juxtaposed: List[Juxtaposed] = self._juxtaposed()

    def _note(self, values: Dict[str, Any], owner: List[int], names: List[str], new: int) -> None:
        blocks, quality, verdict = values["blocks"], values["quality"], values["verdict"]
        areas = {f"area of {name}": area for name, area in sorted(values["areas"].items())}
        self.realisations.append({
            "realisation": values["number"], "status": "done", "reason": "", "blocks": len(blocks), "new": new,
            **verdict, **quality, **areas})
        called = [names[o] if o >= 0 else b["name"] for o, b in zip(owner, blocks)] + ["outside"]
        areas_of: Dict[Tuple[str, str, str], float] = {}
        for surface, low, high, area in values["interfaces"]:
            pair = sorted((called[low], called[high]))
            key = (surface, pair[0], pair[1])
            areas_of[key] = areas_of.get(key, 0.0) + area
        self.interfaces += [(values["number"], *key, area) for key, area in sorted(areas_of.items())]

    def _outcome(self, name: str) -> BlockOutcome:
        rows = self.table["block"] == name
        states = self.table["state"][rows].tolist()
        measures = {m: percentiles(self.table[m][rows]) for m in names_of_values(self._task.contacts)}
        return BlockOutcome(name, {s: states.count(s) for s in STATES}, measures)

    def _juxtaposed(self) -> List[Juxtaposed]:
        areas: Dict[Tuple[str, str, str], List[float]] = {}
        for _, surface, low, high, area in self.interfaces:
            if "outside" not in (low, high):
                areas.setdefault((surface, low, high), []).append(area)
        built_ones = max(1, self.count - len(self.failures))
        return [Juxtaposed(k[0], (k[1], k[2]), len(a) / built_ones, percentiles(a)) for k, a in sorted(areas.items())]

    @property
    def contacts(self) -> Tuple[float, ...]:
        """The depths of the contacts, as z."""
        return self._task.contacts


class _Maps:
    """Adds up maps in the order of realisations, so that sums do not depend on who came first."""

    def __init__(self, surfaces: List[str], blocks: List[str], shape: Tuple[int, int]) -> None:
        self._blocks, self._surfaces = blocks, surfaces
        self._hits = np.zeros((len(blocks), *shape), dtype=np.int64)
        self._count = np.zeros((len(surfaces), *shape), dtype=np.int64)
        self._mean = np.zeros((len(surfaces), *shape))
        self._squares = np.zeros((len(surfaces), *shape))
        self._done = 0

    def add(self, record: Record, owner: List[int]) -> None:
        """Add a realisation. Mean and squares by Welford's recurrence."""
        self._done += 1
        for i in range(len(self._blocks)):
            pieces = [p for p, o in enumerate(owner) if o == i]
            if pieces:
                self._hits[i] += record.present[pieces].any(axis=0)
        for i, name in enumerate(self._surfaces):
            if name not in record.values["surfaces"]:
                continue
            z = record.heights[record.values["surfaces"].index(name)]
            there = np.isfinite(z)
            self._count[i] += there
            step = np.where(there, z - self._mean[i], 0.0)
            self._mean[i] += step / np.maximum(self._count[i], 1)
            self._squares[i] += step * np.where(there, z - self._mean[i], 0.0)

    def results(self) -> Tuple[Dict[str, Float64Array], Dict[str, Float64Array], Dict[str, Float64Array]]:
        """Return probabilities, mean depths and standard deviations by name."""
        share = self._hits / max(1, self._done)
        enough = self._count > 1
        mean = np.where(enough, self._mean, np.nan)
        sd = np.sqrt(np.where(enough, self._squares / np.maximum(self._count - 1, 1), np.nan))
        return (dict(zip(self._blocks, share)), dict(zip(self._surfaces, mean)), dict(zip(self._surfaces, sd)))
