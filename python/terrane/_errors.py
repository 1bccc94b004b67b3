# SPDX-License-Identifier: LGPL-3.0-or-later
"""Errors of the library as exceptions."""

from __future__ import annotations

from typing import Any, List, Sequence, Tuple

#: The codes of `Error.code`, in the order of the library's ``ErrorCode``.
ERROR_CODES: Tuple[str, ...] = (
    "cannot_open", "bad_syntax", "bad_number", "bad_index", "unknown_format", "unsupported",
    "nothing_to_do", "write_failed", "bad_option", "improper_contact", "not_closed",
    "out_of_memory", "interrupted", "timed_out", "internal",
)


class Error(Exception):
    """An error caused by data.

    Attributes
    ----------
    code : str
        One of `ERROR_CODES`; docs/reference/errors.md explains them.
    sentence : str
        What is wrong, as the program ``terrane`` says it.
    place : str
        Where: ``"basin.ts:1204"``, ``"triangle 812"``, the name of an argument, or empty.

    Examples
    --------
    >>> import terrane
    >>> try:
    ...     terrane.read("missing.ts")
    ... except terrane.Error as error:
    ...     print(error.code, "at", error.place)
    cannot_open at missing.ts
    """

    def __init__(self, code: str, sentence: str, place: str = "") -> None:
        super().__init__(code, sentence, place)
        self.code = code
        self.sentence = sentence
        self.place = place

    def __str__(self) -> str:
        return f"{self.place}: {self.sentence}" if self.place else self.sentence


class OutOfMemory(Error, MemoryError):
    """Not enough memory: a `MemoryError` that is a `terrane.Error` as well.

    Examples
    --------
    >>> import terrane
    >>> issubclass(terrane.OutOfMemory, MemoryError)
    True
    """


class Doubt(UserWarning):
    """A likely mistake in what was passed; nothing was changed.

    `model`, `arrange`, `select` and `map_surface` warn of it, and `Model.doubts` lists it.
    ``warnings.simplefilter("error", terrane.Doubt)`` stops at the first, as ``--strict`` of the program does.

    Attributes
    ----------
    about : str
        The kind: ``"heights_mixed"``, ``"no_base"``, ...; docs/explanation/plausibility.md lists them.
    surfaces : list of str
        The labels of the surfaces concerned.
    seen, why, answer : str
        The finding, what follows if it is a mistake, and what to do.

    Examples
    --------
    >>> import terrane
    >>> terrane.Doubt("no_base", ["top"], "the model is open at its base", "no block is closed", "add a base").about
    'no_base'
    """

    def __init__(self, about: str, surfaces: List[str], seen: str, why: str, answer: str) -> None:
        super().__init__(about, surfaces, seen, why, answer)
        self.about = about
        self.surfaces = surfaces
        self.seen = seen
        self.why = why
        self.answer = answer

    def __str__(self) -> str:
        return f"{self.seen}. {self.why}. {self.answer}"


def doubts_of(rows: List[Any], labels: Sequence[str]) -> List[Doubt]:
    """Return the doubts in rows of the library, with the labels of surfaces in place of their numbers."""
    return [Doubt(about, [labels[s] for s in surfaces], *texts) for about, surfaces, *texts in rows]


def exception_of(code: int, sentence: str, place: str) -> Error:
    """Return the exception for an error of the library."""
    name = ERROR_CODES[code]
    kind = OutOfMemory if name == "out_of_memory" else Error
    return kind(name, sentence or "stopped on request", place)


def bad_option(sentence: str, place: str) -> Error:
    """Return the error for an argument whose value makes no sense."""
    return Error("bad_option", sentence, place)
