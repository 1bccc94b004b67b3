# SPDX-License-Identifier: LGPL-3.0-or-later
"""The folder of an ensemble: tables, percentiles, maps, failures, and a report."""

from __future__ import annotations

import contextlib
import csv
import importlib
import io
import json
import math
import os
import re
import secrets
import shutil
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Sequence, Set

import numpy as np

from ._ensemble_blocks import PERCENTILES
from ._ensemble_report import page
from ._ensemble_results import Outcomes
from ._ensemble_work import Task, prepared
from ._errors import Error
from ._surface import surface_of_parts

_STATISTICS = [*(name for name, _ in PERCENTILES), "mean", "sd", "least", "largest", "count"]
_unfinished: Set[str] = set()  # temporary folders


def new_folder(folder: str) -> str:
    """Return a temporary folder next to one that must not exist, or be empty."""
    if os.path.exists(folder) and (not os.path.isdir(folder) or os.listdir(folder)):
        raise Error("cannot_open", "is there already, and is no empty folder", folder)
    made = f"{os.path.abspath(folder)}.part{secrets.token_hex(8)}"
    _unfinished.add(made)  # before mkdir: discard_all() then finds it after an interrupt
    try:
        os.makedirs(os.path.dirname(made), exist_ok=True)
        os.mkdir(made)
    except OSError as error:
        _unfinished.discard(made)
        raise Error("cannot_open", f"cannot be made: {error.strerror}", folder) from None
    return made


def discard(made: str) -> None:
    """Remove a temporary folder, if it is there."""
    for _ in range(10):  # another thread may add files meanwhile
        shutil.rmtree(made, ignore_errors=True)
        if not os.path.lexists(made):
            break
    _unfinished.discard(made)


def discard_all() -> None:
    """Remove all temporary folders: the process is about to end."""
    for made in list(_unfinished):
        discard(made)


@contextlib.contextmanager
def _new(folder: str, before_last_step: Callable[[], None]) -> Iterator[str]:
    """Make a temporary folder; at the end of the block it gets the name `folder`, or is removed after an error."""
    made = new_folder(folder)
    try:
        yield made
        before_last_step()
        if os.path.isdir(folder):
            os.rmdir(folder)
        os.rename(made, folder)
    except OSError as error:
        raise Error("write_failed", f"cannot be written: {error.strerror}", error.filename or folder) from None
    finally:
        discard(made)


def save(made: Outcomes, folder: str, *, report: bool,
         before_last_step: Callable[[], None] = lambda: None) -> List[str]:
    """Write everything; return the names of what is in the folder.

    It calls `before_last_step` when all files are written, just before the folder gets its name.
    """
    with _new(folder, before_last_step) as to:
        return _write_all(made, to, report)


def _write_all(made: Outcomes, to: str, report: bool) -> List[str]:
    _table(os.path.join(to, "blocks.csv"), list(made.table), zip(*made.table.values()))
    heads = sorted({k for row in made.realisations for k in row}, key=_order_of(made.realisations))
    _table(os.path.join(to, "realisations.csv"), heads, ([r.get(h, "") for h in heads] for r in made.realisations))
    _table(os.path.join(to, "interfaces.csv"), ["realisation", "surface", "block", "other", "area"], made.interfaces)
    _table(os.path.join(to, "percentiles.csv"), ["block", "measure", *_STATISTICS], (
        [name, measure, *(values[s] for s in _STATISTICS)]
        for name, block in made.blocks.items() for measure, values in block.measures.items()))
    _table(os.path.join(to, "juxtaposition.csv"), ["surface", "block", "other", "probability", *_STATISTICS], (
        [j.surface, *j.blocks, j.probability, *(j.area[s] for s in _STATISTICS)] for j in made.juxtaposed))
    names = ["blocks.csv", "realisations.csv", "interfaces.csv", "percentiles.csv", "juxtaposition.csv"]
    with open(os.path.join(to, "ensemble.json"), "w", encoding="utf-8") as file:
        json.dump(_plain(summary(made)), file, indent=2, ensure_ascii=False)
        file.write("\n")
    names.append("ensemble.json")
    os.mkdir(os.path.join(to, "maps"))
    _write_maps(made, os.path.join(to, "maps"))
    names.append("maps/")
    if _write_hdf5(made, os.path.join(to, "ensemble.h5")):
        names.append("ensemble.h5")
    if made.failures:
        for failure in made.failures:
            inner = os.path.join(to, "failures", f"{failure.number:06d}")
            os.makedirs(inner)
            _write_project(made._task, failure.number, inner, failure.reason)
        names.append("failures/")
    if report:
        with open(os.path.join(to, "report.html"), "w", encoding="utf-8") as file:
            file.write(page(made))
        names.append("report.html")
    return names


def _order_of(rows: Sequence[Mapping[str, Any]]) -> Any:
    first: Dict[str, int] = {}
    for row in sorted(rows, key=len, reverse=True):
        for name in row:
            first.setdefault(name, len(first))
    return first.__getitem__


def _text_of(value: Any) -> str:
    if isinstance(value, (float, np.floating)):
        return "" if math.isnan(value) else repr(float(value))
    return "" if value is None else str(value)


def _table(path: str, heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(heads)
        writer.writerows([_text_of(v) for v in row] for row in rows)


def _plain(value: Any) -> Any:
    """Return a value that JSON has: NaN becomes null."""
    if isinstance(value, dict):
        return {k: _plain(v) for k, v in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def summary(made: Outcomes) -> Dict[str, Any]:
    """Return what ensemble.json states."""
    return {
        "format": "terrane-ensemble 1",
        "version": made._task.version,
        "project": made._task.source,
        "seed": made.seed,
        "realisations": made.count,
        "failed": [f._asdict() for f in made.failures],
        "percentiles": "P90 is exceeded with a probability of 90 %; linear interpolation between ordered values",
        "contacts": list(made.contacts),
        "map": {"x": made.frame[0], "y": made.frame[1], "width": made.frame[2], "height": made.frame[3],
                "columns": made._task.cells[0], "rows": made._task.cells[1]},
        "blocks": {name: {**b.states, **b.measures} for name, b in made.blocks.items()},
        "model": {b["name"]: {"volume": b["volume"], "area": b["area"]} for b in made.model_record["blocks"]},
        "new_blocks": made.new,
        "juxtaposition": [j._asdict() for j in made.juxtaposed],
    }


def file_name(text: str) -> str:
    """Return a name for a file: letters, digits, and _ for all else."""
    return re.sub(r"[^A-Za-z0-9.-]+", "_", text).strip("_.") or "block"


def _write_maps(made: Outcomes, to: str) -> None:
    used: Dict[str, int] = {}
    for start, maps in (("probability", made.probability), ("depth_mean", made.depth_mean),
                        ("depth_sd", made.depth_sd)):
        for name, values in maps.items():
            stem = f"{start}_{file_name(name)}"
            used[stem] = used.get(stem, 0) + 1
            stem += "" if used[stem] == 1 else f"_{used[stem]}"
            _write_grid(made, values, os.path.join(to, stem + ".csv"))


def _write_grid(made: Outcomes, values: Any, path: str) -> None:
    """Write a map as x, y and value of the centres of cells; cells without a value are left out."""
    x, y, width, height = made.frame
    rows, columns = np.nonzero(np.isfinite(values))
    _table(path, ["x", "y", "value"], zip(x + (columns + 0.5) * width, y + (rows + 0.5) * height,
                                          values[rows, columns]))


def _write_hdf5(made: Outcomes, path: str) -> bool:
    """Write the tables and maps as HDF5; return False without h5py."""
    try:
        h5py = importlib.import_module("h5py")
    except ImportError:
        return False
    text = h5py.string_dtype()
    contents = io.BytesIO()  # HDF5 itself crashes where the disk is full
    with h5py.File(contents, "w") as file:
        file.attrs["format"] = "terrane-ensemble 1"
        file.attrs["seed"] = made.seed
        file.attrs["realisations"] = made.count
        file.attrs["contacts"] = np.array(made.contacts, dtype=np.float64)
        file.attrs["summary"] = json.dumps(_plain(summary(made)))
        table = file.create_group("blocks")
        for name, values in made.table.items():
            kind = text if values.dtype.kind == "U" else None
            table.create_dataset(name, data=values.astype(object) if kind else values, dtype=kind)
        faces = file.create_group("interfaces")
        for i, name in enumerate(("realisation", "surface", "block", "other", "area")):
            column = [row[i] for row in made.interfaces]
            kind = text if name in ("surface", "block", "other") else None
            faces.create_dataset(name, data=np.array(column, dtype=object if kind else None), dtype=kind)
        maps = file.create_group("maps")
        maps.attrs["frame"] = np.array(made.frame)
        for start, of in (("probability", made.probability), ("depth_mean", made.depth_mean),
                          ("depth_sd", made.depth_sd)):
            group = maps.create_group(start)
            for i, (name, values) in enumerate(of.items()):
                group.create_dataset(f"{i:03d}", data=values).attrs["name"] = name
    with open(path, "wb") as out:
        out.write(contents.getbuffer())
    return True


def write_project(task: Task, number: int, folder: str, before_last_step: Callable[[], None] = lambda: None) -> None:
    """Write a realisation as a project of its own; as `save` does."""
    with _new(folder, before_last_step) as to:
        _write_project(task, number, to, "")


def _write_project(task: Task, number: int, to: str, reason: str) -> None:
    project = json.loads(task.text)
    surfaces = []
    for i, parts in enumerate(prepared(task).surfaces(task.seed, number)):
        surface = surface_of_parts(parts)
        name = f"{i + 1:03d}_{file_name(surface.name)}.ts"
        surface.save(os.path.join(to, name))
        entry = {"file": name}
        if surface.name:
            entry["name"] = surface.name
        if surface.role != "unknown":
            entry["role"] = surface.role
        surfaces.append(entry)
    for key in ("uncertainty", "fill", "unit"):  # that is done
        project.pop(key, None)
    project["surfaces"] = surfaces
    project["folder"] = "model"
    within = project.get("volume_of_interest", {}).get("within")
    if within:
        project["volume_of_interest"]["within"] = [os.path.abspath(os.path.join(task.base, f)) for f in within]
    with open(os.path.join(to, "project.json"), "w", encoding="utf-8") as file:
        json.dump(project, file, indent=2, ensure_ascii=False)
        file.write("\n")
    if reason:
        with open(os.path.join(to, "reason.txt"), "w", encoding="utf-8") as file:
            file.write(reason + "\n")


