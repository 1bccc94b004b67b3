# SPDX-License-Identifier: LGPL-3.0-or-later
"""Many realisations of a model whose surfaces are uncertain."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Optional, Sequence, Tuple, Union

import numpy as np

from . import _core
from ._arrays import Float64Array, as_count, as_number
from ._ensemble_blocks import match, names_of_values, percentiles
from ._ensemble_engine import engine_of, outcomes, pool_of
from ._ensemble_form import checked
from ._ensemble_kept import Kept
from ._ensemble_work import Record, Task, bounds_of, built, failure, file_of, packed, prepared
from ._errors import Error
from ._mesh import Path
from ._project import Built, project_text
from ._results import Result, counted
from ._run import cores
from ._run import how as how_to_run

_LARGEST = 2 ** 63 - 1


class Failure(NamedTuple):
    """A realisation that could not be built: its number, the code and the reason of the error.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
    >>> flat.save("top.ts")
    >>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
    ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
    ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
    >>> made = terrane.ensemble(project, realisations=3, engine="serial")
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
    >>> import terrane
    >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
    >>> flat.save("top.ts")
    >>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
    ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
    ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
    >>> made = terrane.ensemble(project, realisations=3, engine="serial")
    >>> touching = made.juxtaposed[0]
    >>> touching.surface, touching.blocks, touching.probability
    ('top', ('above top', 'below top'), 1.0)
    """

    surface: str
    blocks: Tuple[str, str]
    probability: float
    area: Dict[str, float]


class BlockOutcome(NamedTuple):
    """What became of a block: in how many realisations it is whole, split, vanished or merged, and its measures.

    ``measures`` has, by name, a dict with ``p90``, ``p50``, ``p10``, ``mean``, ``sd``, ``least``, ``largest`` and
    ``count``; P90 is exceeded with a probability of 90 %. Realisations in which the block is merged with another one
    do not count; one in which it has vanished counts with the volume 0.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
    >>> flat.save("top.ts")
    >>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
    ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
    ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
    >>> made = terrane.ensemble(project, realisations=3, engine="serial")
    >>> made.blocks["below top"].states
    {'whole': 3, 'split': 0, 'vanished': 0, 'merged': 0}
    """

    name: str
    states: Dict[str, int]
    measures: Dict[str, Dict[str, float]]


class Ensemble(Result):
    """Realisations of a model, block by block.

    Attributes
    ----------
    seed : int
    count : int
        Number of realisations, with those that failed.
    blocks : dict of BlockOutcome
        By the names of the blocks of the model as it was given.
    failures : list of Failure
    new : dict of int
        In how many realisations there is a block that the model has not, by name.
    juxtaposed : list of Juxtaposed
        Which blocks touch across which surface.
    table : dict of arrays
        One row per realisation and block: ``realisation``, ``block``, ``state``, ``pieces`` and the measures.
    realisations : list of dict
        Per realisation its status, blocks, leaks, and the quality of its triangles.
    probability : dict of ndarray, shape (rows, columns)
        Per block: in what share of realisations it is below the centre of a cell of the map.
    depth_mean, depth_sd : dict of ndarray, shape (rows, columns)
        Per surface: mean and standard deviation of z; NaN where fewer than two realisations have it.
    frame : tuple
        x, y, width and height of a cell.
    model_record : dict
        The measures of the model as it was given.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
    >>> flat.save("top.ts")
    >>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
    ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
    ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
    >>> made = terrane.ensemble(project, realisations=3, engine="serial")
    >>> made.count, sorted(made.blocks)
    (3, ['above top', 'below top'])
    >>> volume = made.blocks["below top"].measures["volume"]
    >>> volume["p90"] <= volume["p50"] <= volume["p10"]
    True
    """

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
        from ._ensemble_blocks import STATES
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

    def realisation(self, number: int) -> Built:
        """Build a realisation again; 0 is the model as it was given.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
        >>> flat.save("top.ts")
        >>> made = terrane.ensemble({"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
        ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
        ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}, realisations=3, engine="serial")
        >>> again = made.realisation(2)
        >>> row = made.table["block"] == "below top"
        >>> bool(again.model.blocks["below top"].volume == made.table["volume"][row][1])
        True
        """
        return built(self._task, as_count(number, "number", 0, self.count))

    def save(self, folder: Path, *, report: bool = True) -> None:
        """Write tables, percentiles, maps, failures and a report into a new folder, which appears complete.

        HDF5 needs h5py; without it that file is left out. docs/how-to/ensemble.md lists the files.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
        >>> flat.save("top.ts")
        >>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
        ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
        ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
        >>> made = terrane.ensemble(project, realisations=3, engine="serial")
        >>> made.save("run", report=False)
        >>> import pathlib
        >>> pathlib.Path("run", "blocks.csv").is_file()
        True
        """
        from ._ensemble_output import save
        save(self, os.fspath(folder), report=report)

    def write_project(self, number: int, folder: Path) -> None:
        """Write the moved surfaces of a realisation, and a project that builds them, into a folder.

        Examples
        --------
        >>> import terrane
        >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
        >>> flat.save("top.ts")
        >>> project = {"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
        ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
        ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}
        >>> made = terrane.ensemble(project, realisations=3, engine="serial")
        >>> made.write_project(2, "two")
        >>> terrane.build("two/project.json").model == made.realisation(2).model
        True
        """
        from ._ensemble_output import write_project
        write_project(self._task, as_count(number, "number", 0, self.count), os.fspath(folder))

    def _state(self) -> Tuple[Any, ...]:
        return self._task, self._model, self._records

    @classmethod
    def _from_state(cls, *state: Any) -> "Ensemble":
        return cls(Task(*state[0]), state[1], state[2])

    def _line(self) -> str:
        return (f"{counted(self.count, 'realisation')}, {counted(len(self.blocks), 'block')}, "
                f"{len(self.failures)} failed")

    def _numbers(self) -> Dict[str, Any]:
        return {"realisations": self.count, "blocks": len(self.blocks), "failed": len(self.failures)}


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


def _key_of(text: bytes, base: str, rest: Dict[str, Any]) -> str:
    """Return a hash of all that decides a realisation: the project with the contents of its files, and options."""
    state = hashlib.sha256(json.dumps([str(_core.version), rest], sort_keys=True).encode())
    try:
        values = json.loads(text)
        values = {k: v for k, v in values.items() if k not in ("folder", "threads", "outputs")}
        state.update(json.dumps(values, sort_keys=True).encode())
    except (ValueError, AttributeError):
        return state.hexdigest()  # reading the project says what is wrong

    def feed(value: Any) -> None:
        if isinstance(value, dict):
            for name, inner in value.items():
                files = inner if name == "within" else [inner] if name in ("file", "map") else []
                for file in files if isinstance(files, list) else []:
                    if isinstance(file, str):
                        with open(os.path.join(base, file), "rb") as opened:
                            for block in iter(lambda: opened.read(1 << 20), b""):
                                state.update(block)
                feed(inner)
        elif isinstance(value, list):
            for inner in value:
                feed(inner)

    try:
        feed(values)
    except OSError:
        pass  # reading the surfaces says what is wrong
    return state.hexdigest()


def _depths(contacts: Any) -> Tuple[float, ...]:
    values = [contacts] if np.isscalar(contacts) else list(contacts)
    return tuple(as_number(v, "contacts") for v in values)


def ensemble(project: Union[Path, Mapping[str, Any]], folder: Optional[Path] = None, *, realisations: int = 500,
             seed: int = 1, contacts: Any = (), grid: int = 50, engine: Optional[str] = None,
             workers: Optional[int] = None, scheduler: Optional[str] = None, retries: int = 2, threads: int = 1,
             keep: Optional[Path] = None, progress: Any = None) -> Ensemble:
    """Build many realisations of a project whose surfaces are uncertain, and state what they have in common.

    The key ``uncertainty`` of the project says how surfaces move; docs/reference/project.md lists its keys. A realisation
    depends on the project, the seed and its number alone: not on workers, their number, order or threads.

    Parameters
    ----------
    project : path or dict
        As for `build`. Tetrahedra are not made.
    folder : path, optional
        Of a dict: the folder of its files; the current one unless given.
    realisations : int, optional
        How many; the model as it was given is built besides.
    seed : int, optional
        Other seeds give other realisations.
    contacts : float or list of floats, optional
        Values of z, above which the volume of each block and the height of its column are measured.
    grid : int, optional
        Cells of maps along the longer side.
    engine : str, optional
        "processes" of this machine, which is the default; "mpi", in a program that mpirun has started; or "serial": in
        this process.
    workers : int, optional
        How many processes; one per core unless given.
    scheduler : str, optional
        Address of a Dask scheduler whose workers compute instead, "tls://cluster:8786"; they need the same files at the
        same paths. Whoever reaches a scheduler without TLS runs programs as you.
    retries : int, optional
        How often a realisation is tried again after a worker was lost or ran out of memory.
    keep : path, optional
        A folder in which finished realisations are kept and looked for, so that an interrupted call can go on.
    progress : callable, optional
        Called as progress("ensemble", share).

    Returns
    -------
    Ensemble

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[-1, -1, 0], [9, -1, 0], [-1, 9, 0]], [[0, 1, 2]], "top", "horizon")
    >>> flat.save("top.ts")
    >>> made = terrane.ensemble({"format": "terrane-project 1", "surfaces": [{"file": "top.ts"}],
    ...     "volume_of_interest": {"box": {"low": [0, 0, -1], "high": [2, 2, 1]}}, "outputs": {"blocks": "vtp"},
    ...     "uncertainty": [{"surface": "top", "shift": 0.1}]}, realisations=20, engine="serial")
    >>> made
    <Ensemble: 20 realisations, 2 blocks, 0 failed>
    >>> volume = made.blocks["below top"].measures["volume"]
    >>> volume["p90"] < volume["p50"] < volume["p10"]
    True
    """
    count = as_count(realisations, "realisations", 1)
    how = engine_of(engine, workers, scheduler, retries)
    how_to_run(threads, progress)  # they are refused before anything begins
    with pool_of(how) as pool:
        task = task_of(project, folder, seed, contacts, grid, threads)
        alone = min(how.workers, cores())  # no worker computes yet
        task, model = _with_frame(task, as_count(grid, "grid", 1, 10000), max(task.threads, alone))
        kept = Kept(keep, task)
        files = dict(kept.found(count))
        missing = [n for n in range(1, count + 1) if n not in files]
        tell = _teller(progress, count)
        tell(len(files))
        with contextlib.closing(outcomes(how, pool, task, missing)) as found:
            for number, data, seconds, lacking in found:
                if data is None:
                    assert lacking is not None
                    data = _failed(number, *lacking)
                else:
                    kept.add(number, data, seconds)
                files[number] = data
                tell(len(files))
    return Ensemble(task, model, [files[n] for n in range(1, count + 1)])


def task_of(project: Union[Path, Mapping[str, Any]], folder: Optional[Path], seed: int, contacts: Any, grid: int,
            threads: int) -> Task:
    """Return what the realisations of a project have in common, without the frame of its map."""
    text, base, source = project_text(project, folder)
    depths = _depths(contacts)
    first = as_count(seed, "seed", 0, _LARGEST)
    key = _key_of(text, base, {"seed": first, "contacts": depths, "grid": grid})
    return Task(text, os.path.abspath(base), source, first, depths, (0.0, 0.0, 1.0, 1.0), (1, 1),
                as_count(threads, "threads", 1, 1024), key, str(_core.version))


def _with_frame(task: Task, grid: int, threads: int) -> Tuple[Task, bytes]:
    """Build the model as it was given, with so many threads, and lay the map over it."""
    if prepared(task).moved == 0:
        raise Error("bad_option", "is missing: it says how the surfaces move", f"{task.source}: uncertainty")
    model = built(task._replace(threads=threads), 0).model
    x, y, width, height = bounds_of(model)
    size = max(width, height) / grid  # of a cell
    cells = (max(1, round(width / size)), max(1, round(height / size)))
    task = task._replace(frame=(x, y, width / cells[0], height / cells[1]), cells=cells)
    return task, file_of(task, 0, lambda: model)


def _failed(number: int, code: str, reason: str) -> bytes:
    values, heights, present = failure(code, reason, "")
    return packed(Record({**values, "number": number}, heights, present))


def _teller(progress: Any, count: int) -> Callable[[int], None]:
    def tell(done: int) -> None:
        if callable(progress) and not hasattr(progress, "update"):
            progress("ensemble", done / count)
        elif progress is not None:
            progress.total = count
            progress.update(done - progress.n)
    return tell
