# SPDX-License-Identifier: LGPL-3.0-or-later
"""Many realisations of a model whose surfaces are uncertain."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
from typing import Any, Callable, Dict, Mapping, Optional, Tuple, Union

import numpy as np

from . import _core
from ._arrays import Path, as_count, as_number
from ._ensemble_engine import engine_of, outcomes, pool_of
from ._ensemble_kept import Kept
from ._ensemble_output import save, write_project
from ._ensemble_results import Outcomes
from ._ensemble_work import Record, Task, bounds_of, built, failure, file_of, packed, prepared
from ._errors import Error
from ._project import Built, project_text
from ._results import counted
from ._run import cores
from ._run import how as how_to_run

_LARGEST = 2 ** 63 - 1


class Ensemble(Outcomes):
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
    >>> made = ...
    >>> made.count, sorted(made.blocks)
    (3, ['above top', 'below top'])
    >>> volume = made.blocks["below top"].measures["volume"]
    >>> volume["p90"] <= volume["p50"] <= volume["p10"]
    True
    """

    __slots__ = ()

    def realisation(self, number: int) -> Built:
        """Build a realisation again; 0 is the model as it was given.

        Examples
        --------
        >>> made = ...
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
        >>> made = ...
        >>> made.save("run", report=False)
        >>> import pathlib
        >>> pathlib.Path("run", "blocks.csv").is_file()
        True
        """
        save(self, os.fspath(folder), report=report)

    def write_project(self, number: int, folder: Path) -> None:
        """Write the moved surfaces of a realisation, and a project that builds them, into a folder.

        Examples
        --------
        >>> made = ...
        >>> made.write_project(2, "two")
        >>> terrane.build("two/project.json").model == made.realisation(2).model
        True
        """
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
    """Build the model as it was given, with this number of threads, and lay the map over it."""
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
