# SPDX-License-Identifier: LGPL-3.0-or-later
"""One realisation of an ensemble: what a worker does, and what is kept of it.

A realisation becomes the bytes of an NPZ file that depend on the project, the options and the number alone: not on
the worker, the order, or the time.
"""

from __future__ import annotations

import io
import json
import time
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Tuple

import numpy as np

from . import _core
from ._arrays import Float64Array
from ._errors import Error
from ._model import Model
from ._project import Built
from ._run import how

#: Share of the boundary of a block that a side of a surface must have to count among what bounds it.
LEAST_SHARE = 0.01
#: Errors that another try may not have.
_PASSING = ("out_of_memory", "interrupted")


class Task(NamedTuple):
    """The task that all realisations of an ensemble share; small, as it goes to every worker."""

    text: bytes
    base: str
    source: str
    seed: int
    contacts: Tuple[float, ...]
    frame: Tuple[float, float, float, float]
    cells: Tuple[int, int]
    threads: int
    key: str
    version: str


class Record(NamedTuple):
    """A realisation as it was kept: its values, and its maps.

    ``heights`` has the depth map of each name in ``surfaces``, ``present`` whether each block is below a cell.
    """

    values: Dict[str, Any]
    heights: Float64Array
    present: Any


class Outcome(NamedTuple):
    """The outcome of a realisation: its file, and the processor time that it took; or why it was not made."""

    number: int
    data: Optional[bytes]
    seconds: float
    failure: Optional[Tuple[str, str]]  #: code and reason


_prepared: Dict[str, _core.Ensemble] = {}


def prepared(task: Task) -> _core.Ensemble:
    """Return the project with its surfaces, which a process reads once."""
    if task.version != str(_core.version):
        raise Error("unsupported", f"this worker has terrane {_core.version}, the ensemble was started by "
                    f"{task.version}; all need the same version")
    if task.key not in _prepared:
        _prepared.clear()
        _prepared[task.key] = _core.Ensemble(task.text, task.base, task.source, how(task.threads, None))
    return _prepared[task.key]


def built(task: Task, number: int) -> Built:
    """Build a realisation; 0 is the model as it was given."""
    return Built(prepared(task).build(task.seed, number, how(task.threads, None)), (built, task, number))


def run_one(task: Task, number: int) -> Tuple[bytes, float]:
    """Return the file of a realisation, and the processor time that it took."""
    begin = time.process_time()
    prepared(task)
    return file_of(task, number, lambda: built(task, number).model), time.process_time() - begin


def outcome_of(task: Task, number: int, retries: int) -> Outcome:
    """Compute a realisation, and try again so often after an error that another try may not have."""
    for left in range(retries, -1, -1):
        try:
            return Outcome(number, *run_one(task, number), None)
        except Exception as error:
            code, reason = reason_of(error)
            if code == "interrupted":
                raise
            if left == 0:
                return Outcome(number, None, 0.0, (code, reason))
    raise AssertionError


def file_of(task: Task, number: int, build: Callable[[], Model]) -> bytes:
    """Return the file of a realisation, whose model ``build`` returns."""
    try:
        values, heights, present = _measured(build(), task)
    except Error as error:
        if error.code in _PASSING:
            raise
        values, heights, present = failure(error.code, error.sentence, error.place)
    values["number"] = number
    return packed(Record(values, heights, present))


def failure(code: str, sentence: str, place: str) -> Tuple[Dict[str, Any], Float64Array, Any]:
    """Return what is kept of a realisation that could not be built."""
    values = {"status": "failed", "code": code, "reason": f"{place}: {sentence}" if place else sentence,
              "blocks": [], "interfaces": [], "surfaces": [], "boundaries": []}
    return values, np.zeros((0, 1, 1)), np.zeros((0, 1, 1), dtype=bool)


def packed(record: Record) -> bytes:
    """Return a record as an NPZ file."""
    file = io.BytesIO()
    text = json.dumps(record.values, sort_keys=True, allow_nan=True).encode()
    np.savez_compressed(file, values=np.frombuffer(text, dtype=np.uint8), heights=record.heights,
                        present=np.packbits(record.present, axis=-1),
                        columns=np.array(record.present.shape[-1:], dtype=np.int64))
    return file.getvalue()


def _measured(model: Model, task: Task) -> Tuple[Dict[str, Any], Float64Array, Any]:
    surfaces = model.mesh.surfaces
    heights, thicknesses = _core.column_maps(model._core, list(task.frame), list(task.cells), how(task.threads, None))
    names = sorted({s.name for s in surfaces if s.role != "boundary"})
    merged = [_highest([heights[i] for i, s in enumerate(surfaces) if s.name == name and s.role != "boundary"])
              for name in names]
    kept = [b for b in range(1, len(model.structure.blocks)) if model.structure.blocks[b].interfaces]
    numbers = {b: i for i, b in enumerate(kept)}
    values: Dict[str, Any] = {
        "status": "done",
        "surfaces": names,
        "boundaries": sorted({s.name for s in surfaces if s.role == "boundary"}),
        "faults": sorted({s.name for s in surfaces if s.role == "fault"}),
        "areas": _areas(model, names),
        "blocks": _blocks(model, kept, thicknesses, task.contacts),
        "interfaces": _interfaces(model, numbers),
        "quality": _quality(model),
        "verdict": _verdict(model),
    }
    shape = (task.cells[1], task.cells[0])
    present = thicknesses[kept] > 0 if kept else np.zeros((0, *shape), dtype=bool)
    return values, np.array(merged) if merged else np.zeros((0, *shape)), present


def _highest(maps: List[Float64Array]) -> Float64Array:
    """Return the highest of several surfaces in each cell; NaN where there is none."""
    top = maps[0]
    for other in maps[1:]:
        top = np.fmax(top, other)
    return np.asarray(top)


def _areas(model: Model, names: List[str]) -> Dict[str, float]:
    areas = dict.fromkeys(names, 0.0)
    for interface in model.structure.interfaces:
        for name in sorted({model.mesh.surfaces[s].name for s in interface.surfaces}):
            if name in areas:
                areas[name] += interface.area
    return areas


def _sides(model: Model, block: int) -> Dict[str, float]:
    """Return the areas of the sides of surfaces at a block: "F1+" is the side to which the normals of F1 point."""
    sides: Dict[str, float] = {}
    for number in model.structure.blocks[block].interfaces:
        interface = model.structure.interfaces[number]
        front = int(model._core.volumes.of_sides[interface.triangles[0], 0])
        sign = "+" if front == block else "-"
        for s in sorted(set(interface.surfaces)):
            if model.mesh.surfaces[s].role != "boundary":
                side = model.mesh.surfaces[s].name + sign
                sides[side] = sides.get(side, 0.0) + interface.area
    for number in model.structure.blocks[block].inner_interfaces:  # the block is on both sides
        interface = model.structure.interfaces[number]
        for s in sorted(set(interface.surfaces)):
            for side in (model.mesh.surfaces[s].name + "+", model.mesh.surfaces[s].name + "-"):
                sides[side] = sides.get(side, 0.0) + interface.area
    return sides


def _blocks(model: Model, kept: List[int], thicknesses: Float64Array, contacts: Tuple[float, ...]) -> List[Any]:
    measures = _core.measure_blocks(model._core, list(contacts))
    blocks = []
    for number in kept:
        parts = model.structure.blocks[number]
        low, high, middle, above = measures[number]
        map_of = thicknesses[number]
        inside = map_of[map_of > 0]
        sides = {k: a for k, a in _sides(model, number).items() if a >= LEAST_SHARE * parts.area}
        blocks.append({
            "name": parts.name, "key": model.blocks[number].key, "volume": float(model._core.exact_volumes[number])
            if number < len(model._core.exact_volumes) else parts.volume,
            "area": parts.area, "sides": sides, "middle": list(middle), "low": low, "high": high,
            "thickness": [float(inside.mean()), float(inside.min()), float(inside.max())] if inside.size else None,
            "above": [volume for volume, _, _ in above], "height": [column for _, _, column in above]})
    return blocks


def _interfaces(model: Model, numbers: Dict[int, int]) -> List[Any]:
    """Return [surface, block, block, area] for each surface between two blocks; the outside is -1."""
    areas: Dict[Tuple[str, int, int], float] = {}
    for interface in model.structure.interfaces:
        low, high = interface.volumes
        if low == high:
            continue
        pair = tuple(sorted(numbers.get(v, -1) for v in (low, high)))
        for name in sorted({model.mesh.surfaces[s].name for s in interface.surfaces}):
            key = (name, pair[0], pair[1])
            areas[key] = areas.get(key, 0.0) + interface.area
    return [[*key, area] for key, area in sorted(areas.items())]


def _quality(model: Model) -> Dict[str, float]:
    """Return the least angle of the triangles, its mean over them, and their number."""
    p = model.mesh.vertices[model.mesh.triangles].astype(np.float64)
    edges = np.stack([np.linalg.norm(p[:, i] - p[:, j], axis=1) for i, j in ((1, 2), (0, 2), (0, 1))], 1)
    edges.sort(axis=1)
    a, b, c = edges.T
    with np.errstate(all="ignore"):
        angles = np.degrees(np.arccos(np.clip((b * b + c * c - a * a) / (2 * b * c), -1, 1)))
    return {"triangles": len(p), "least_angle": float(angles.min()), "mean_angle": float(angles.mean())}


def _verdict(model: Model) -> Dict[str, Any]:
    rounding = model.rounding
    return {"leaks": len(model.leaks), "lost": model._core.lost, "made": model._core.made,
            "max_move": None if rounding is None else rounding.max_move}


def bounds_of(model: Model) -> Tuple[float, float, float, float]:
    """Return x, y, width and height of the map of a model."""
    used = model.mesh.vertices[np.unique(model.mesh.triangles)]
    low, high = used[:, :2].min(axis=0), used[:, :2].max(axis=0)
    size = np.maximum(high - low, np.finfo(float).tiny)
    return float(low[0]), float(low[1]), float(size[0]), float(size[1])


def reason_of(error: BaseException) -> Tuple[str, str]:
    """Return the code and the sentence of what kept a realisation from being made."""
    if isinstance(error, Error):
        return error.code, str(error)
    text: Optional[str] = str(error).strip().splitlines()[0] if str(error).strip() else None
    return "internal", f"{type(error).__name__}: {text}" if text else type(error).__name__
