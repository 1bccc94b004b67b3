# SPDX-License-Identifier: LGPL-3.0-or-later
"""Blocks of realisations, matched with those of the model as it was given, and statistics over them.

A block is what bounds it: the sides of surfaces that have at least a hundredth of its boundary. A block of a
realisation is that block of the model with which it shares most sides: at least two thirds of those that the two have
together, and no surface on opposite sides. Among equals the nearest counts.
"""

from __future__ import annotations

from typing import Any, Dict, FrozenSet, List, NamedTuple, Optional, Sequence, Tuple

import numpy as np

#: Share of common sides from which on blocks are the same.
LEAST_COMMON = 2 / 3
#: The outcomes of a block: there in one piece, in several, gone, or one with another block.
STATES = ("whole", "split", "vanished", "merged")
#: P90 is exceeded with a probability of 90 %.
PERCENTILES = (("p90", 10.0), ("p50", 50.0), ("p10", 90.0))


class Matched(NamedTuple):
    """A block of the model in one realisation.

    `pieces` are indices of blocks of the realisation; `values` are NaN where the block is merged with another one.
    """

    state: str
    pieces: Tuple[int, ...]
    values: Dict[str, float]


class Match(NamedTuple):
    """The blocks of one realisation: one `Matched` per block of the model, and the names of new ones."""

    blocks: List[Matched]
    owner: List[int]
    new: List[str]


def _sides(block: Dict[str, Any]) -> FrozenSet[str]:
    return frozenset(block["sides"])


def _opposite(a: FrozenSet[str], b: FrozenSet[str]) -> bool:
    """Return whether a surface bounds the one by one side, and the other by the other."""
    for side in a - b:
        other = side[:-1] + ("-" if side[-1] == "+" else "+")
        if other in b and side not in b and other not in a:
            return True
    return False


def _common(a: FrozenSet[str], b: FrozenSet[str]) -> float:
    """Return the share of common sides; 0 for blocks on opposite sides of a surface."""
    if not a and not b:
        return 1.0
    return 0.0 if _opposite(a, b) else len(a & b) / len(a | b)


def _distance(a: Dict[str, Any], b: Dict[str, Any]) -> float:
    return float(np.linalg.norm(np.subtract(a["middle"], b["middle"])))


def names_of_values(contacts: Sequence[float]) -> List[str]:
    """Return the names of what is measured of each block."""
    names = ["volume", "area", "low", "high", "thickness", "thickness_least", "thickness_largest"]
    for i in range(len(contacts)):
        suffix = "" if len(contacts) == 1 else f"_{i + 1}"
        names += [f"volume_above{suffix}", f"column{suffix}"]
    return names


def _values(pieces: List[Dict[str, Any]], contacts: Sequence[float]) -> Dict[str, float]:
    """Return the measures of all pieces together; a block that has vanished has the volume 0."""
    nan = float("nan")
    names = names_of_values(contacts)
    if not pieces:
        return {n: 0.0 if n in ("volume", "area") or n.startswith(("volume_above", "column")) else nan for n in names}
    thick = [p["thickness"] for p in pieces if p["thickness"]]
    volume = sum(p["volume"] for p in pieces)
    weights = [p["volume"] for p in pieces if p["thickness"]]
    mean = float(np.average([t[0] for t in thick], weights=weights)) if thick and sum(weights) > 0 else nan
    values = [volume, sum(p["area"] for p in pieces), min(p["low"] for p in pieces), max(p["high"] for p in pieces),
              mean, min((t[1] for t in thick), default=nan), max((t[2] for t in thick), default=nan)]
    for i in range(len(contacts)):
        values += [sum(p["above"][i] for p in pieces), max(p["height"][i] for p in pieces)]
    return dict(zip(names, map(float, values)))


def match(model: List[Dict[str, Any]], blocks: List[Dict[str, Any]], contacts: Sequence[float]) -> Match:
    """Match the blocks of a realisation with those of the model."""
    wanted = [_sides(b) for b in model]
    owner = []
    for block in blocks:
        sides = _sides(block)
        best: Optional[Tuple[float, float, int]] = None
        for i, other in enumerate(wanted):
            share = _common(sides, other)
            if share >= LEAST_COMMON:
                rank = (-share, _distance(block, model[i]), i)
                best = rank if best is None or rank < best else best
        owner.append(-1 if best is None else best[2])
    swallowed = {i: _swallowed(i, wanted, blocks, owner) for i in range(len(wanted)) if i not in owner}
    merging = {owner[b] for b in swallowed.values() if b is not None}  # their blocks are more than themselves
    matched = []
    for i in range(len(wanted)):
        pieces = tuple(b for b, o in enumerate(owner) if o == i)
        if i in merging or swallowed.get(i) is not None:
            state = "merged"
        elif pieces:
            state = "whole" if len(pieces) == 1 else "split"
        else:
            state = "vanished"
        values = _values([blocks[p] for p in pieces], contacts)
        if state == "merged":
            values = dict.fromkeys(values, float("nan"))
        matched.append(Matched(state, pieces, values))
    return Match(matched, owner, [blocks[b]["name"] for b, o in enumerate(owner) if o < 0])


def _swallowed(missing: int, wanted: List[FrozenSet[str]], blocks: List[Dict[str, Any]],
               owner: List[int]) -> Optional[int]:
    """Return the block of the realisation that has the sides of the missing one besides its own; None: there is none."""
    sides = wanted[missing]
    for number, (block, own) in enumerate(zip(blocks, owner)):
        more = _sides(block) - (wanted[own] if own >= 0 else frozenset())
        if sides & more and len(_sides(block) & sides) >= LEAST_COMMON * len(sides):
            return number
    return None


def percentiles(values: Sequence[float]) -> Dict[str, float]:
    """Return P90, P50, P10, mean and standard deviation, least and largest of the values that are there.

    Percentiles are interpolated linearly between the values in order (type 7 of Hyndman and Fan).
    """
    there = np.asarray([v for v in values if v == v], dtype=np.float64)
    if there.size == 0:
        return {**{name: float("nan") for name, _ in PERCENTILES}, "mean": float("nan"), "sd": float("nan"),
                "least": float("nan"), "largest": float("nan"), "count": 0}
    found = {name: float(np.percentile(there, share)) for name, share in PERCENTILES}
    return {**found, "mean": float(there.mean()), "sd": float(there.std(ddof=1)) if there.size > 1 else 0.0,
            "least": float(there.min()), "largest": float(there.max()), "count": int(there.size)}
