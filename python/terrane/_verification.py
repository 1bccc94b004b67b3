# SPDX-License-Identifier: LGPL-3.0-or-later
"""The independent verifier."""

from __future__ import annotations

import os
from typing import Any, Dict, List, NamedTuple, Optional, Sequence, Tuple, Union

from . import _core
from ._arrangement import Arrangement, _inputs
from ._arrays import as_number
from ._mesh import Mesh
from ._results import counted
from ._run import how
from ._surface import parts_of_surfaces


class RuleViolation(NamedTuple):
    """A rule that is broken, by which elements, and a sentence.

    Examples
    --------
    >>> flat, wall = ...
    >>> found = terrane.verify(terrane.mesh([flat, wall]))
    >>> found.violations[0].rule
    'R5'
    """

    rule: str
    elements: Tuple[int, ...]
    sentence: str


class VerifiedFile(NamedTuple):
    """An output file of a certificate: "every byte", "inflated", "float32", "hash only", or "missing: ...".

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> terrane.verify(terrane.arrange([flat])).outputs  # an arrangement that is in no file
    []
    >>> terrane.VerifiedFile("model.obj", "every byte", []).check
    'every byte'
    """

    path: str
    check: str
    violations: List[RuleViolation]


class Verdict(NamedTuple):
    """The findings of the verifier. It is true if all is verified.

    ``outputs`` are the files that a certificate names; ``deviation`` is the verifier's own bound of the distance of
    the doubles from the exact result, unit of the input; ``digest`` is that of the arrangement.

    Examples
    --------
    >>> flat, wall = ...
    >>> verdict = terrane.verify(terrane.arrange([flat, wall]))
    >>> bool(verdict), verdict.violations
    (True, [])
    """

    violations: List[RuleViolation]
    outputs: List[VerifiedFile]
    deviation: Optional[float]
    digest: str

    @property
    def verified(self) -> bool:
        """Whether nothing is refuted, and each output file was compared byte for byte."""
        return not self.violations and all(
            not f.violations and f.check in ("every byte", "inflated", "float32") for f in self.outputs)

    def __bool__(self) -> bool:
        return self.verified

    def __repr__(self) -> str:
        if self.violations:
            return f"<Verdict: refuted, {counted(len(self.violations), 'violation')}>"
        word = "verified" if self.verified else "not verified"
        return f"<Verdict: {word}, {counted(len(self.outputs), 'output file')}>"


def verify(result: Any, inputs: Sequence[Any] = (), *, max_deviation: Optional[float] = None,
           max_change: Optional[float] = None, folder: Union[None, str, "os.PathLike[str]"] = None,
           time: float = 3600, memory: float = 16e9, threads: Optional[int] = None, progress: Any = None) -> Verdict:
    """Verify a result by code that shares nothing with what made it, in rational numbers.

    Parameters
    ----------
    result : path, Arrangement or Mesh
        A certificate, which is judged with its files as ``terrane verify`` does; an arrangement, judged against its
        input surfaces by rules R1 to R8; or a mesh, judged to be conforming.
    inputs : list of paths, optional
        The input files of a certificate, where they are not next to it. Of a certificate alone, as are the next two: an
        arrangement has its inputs and is exact, and of a mesh nothing is known but itself.
    max_deviation, max_change : float, optional
        The largest that are accepted, unit of the input.
    folder : path, optional
        The folder that has the files which the certificate names; otherwise its own, without links.
    time, memory : float, optional
        Processor time in seconds and memory in bytes that judging a certificate may take; beyond that an error is raised.

    Examples
    --------
    >>> import terrane
    >>> flat = terrane.Surface([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]], "top")
    >>> wall = terrane.Surface([[1, 1, -1], [1, 1, 1], [1, 9, 0]], [[0, 1, 2]], "F1", "fault")
    >>> bool(terrane.verify(terrane.arrange([flat, wall])))
    True
    """
    if not isinstance(result, (str, os.PathLike)):
        given = {"inputs": None if inputs in ((), []) else inputs, "max_deviation": max_deviation, "max_change": max_change, "folder": folder}
        return _verify_made(result, given, how(threads, progress))
    if isinstance(inputs, (str, bytes, os.PathLike)):
        raise TypeError("inputs is a list of paths, not one")
    bounds = [None if b is None else as_number(b, n, least=0)
              for b, n in ((max_deviation, "max_deviation"), (max_change, "max_change"))]
    judged = _core.verify_file(os.fspath(result), [os.fspath(p) for p in inputs], bounds[0], bounds[1],
                               None if folder is None else os.fspath(folder), as_number(time, "time", positive=True),
                               as_number(memory, "memory", positive=True),
                               how(threads, progress))
    outputs = [VerifiedFile(path, check, [RuleViolation(*v) for v in violations])
               for path, check, violations in judged["outputs"]]
    return Verdict([RuleViolation(*v) for v in judged["violations"]], outputs, judged["deviation"],
                   judged["digest"])


def _verify_made(result: Any, of_certificates: Dict[str, Any], run: _core.HowToRun) -> Verdict:
    """Verify an arrangement or a mesh."""
    mesh = None if isinstance(result, Arrangement) else result if isinstance(result, Mesh) else getattr(result, "mesh", None)
    if not isinstance(result, Arrangement) and not isinstance(mesh, Mesh):
        raise TypeError(f"result is a certificate, an arrangement or a mesh, not {type(result).__name__}")
    for name, value in of_certificates.items():
        if value is not None:
            raise TypeError(f"{name} is for certificates, not for {type(result).__name__}")
    if isinstance(mesh, Mesh):
        found = _core.verify_mesh(mesh._core, run)
    else:
        found = _core.verify_arrangement(parts_of_surfaces(_inputs(result)), result._core, run)
    return Verdict([RuleViolation(*v) for v in found], [], None, "")
