#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Calls each function of the Python package with each argument at values that make no sense, and at one that does.

    PYTHONPATH=build/release/python tests/arguments/python_arguments.py [--share S] [--seconds S] [--seed N] [--only NAME]

(1) python_cases.py knows each public function, method and argument, and no others.
(2) A value that makes no sense is an error that says so, or changes the result: none is ignored. No call crashes, or ends
    with an internal error or with one of Python's own that no caller can read.
(3) A value that makes sense changes the result; where it needs another argument, it is an error without that one.

--share tries such a share of the values, drawn by --seed, and always an object of no known type. --seconds goes on with random combinations for so long.
"""

import hashlib
import inspect
import math
import os
import pathlib
import random
import shutil
import sys
import tempfile

import numpy as np

import terrane
from python_cases import FUNCTIONS, HOW, METHODS, RETURNED, Fixtures
from trials import conclude, make_calls, parse, supervise

sys.setrecursionlimit(3000)


def nested(depth):
    """Return a list in a list in a list."""
    value = []
    for _ in range(depth):
        value = [value]
    return value


NONSENSE = {
    "None": None, "object": object(), "text": "nonsense", "empty text": "", "NUL": "a\0b", "surrogate": "\udc80", "bytes": b"x",
    "true": True, "minus": -1, "minus huge": -10**30, "zero": 0, "huge": 10**30, "nan": math.nan, "inf": math.inf,
    "minus inf": -math.inf, "large": 1e300, "half": 0.5, "complex": 1j, "list": [], "texts": ["nonsense"], "nans": [math.nan] * 3,
    "rows of nan": [[math.nan] * 3], "rows of inf": [[math.inf] * 3], "ragged": [[1.0], [1.0, 2.0]], "nested": nested(2000),
    "dict": {}, "dict of nonsense": {"nonsense": -1}, "dict of objects": {object(): object()}, "dict of nan": {"top": math.nan},
    "array of objects": np.array([object()]), "array": np.zeros((2, 2, 2)), "strings": np.array(["a"]), "function": print,
    "type": int, "infinite": (math.inf, -math.inf), "set": {1}, "path": pathlib.Path("/dev/null/nothing"),
    "own": terrane.IndexLists([0, 1], [0])}
#: Values that have a meaning, with which the fixtures happen to give the same.
SAME = {"zero": {"max_rounds"}, "set": {"holes", "blocks"}, "true": {"isotropic", "bridge_faults", "keep_unverified"}}
#: Limits that such a large number does not reach.
LIMITS = {"extend", "time", "memory", "tolerance", "min_volume", "distance", "max_move", "max_area", "max_deviation", "max_change", "time_limit", "max_triangles", "max_volume_change", "growth",
          "crease_angle", "curve_angle", "max_edge", "max_volume", "retries", "quality", "turn", "mesh_size", "rings",
          "layers_in_gaps", "thickness_share", "curve_length", "smallest", "gap_slope", "least_quality"}
LARGE = {"huge", "large", "inf", "half"}
#: Names of anything, which have no meaning that could be wrong, and how an ensemble is computed, which changes no result.
NAMES = {"engine", "retries", "keep", "place", "name", "code", "sentence", "default", "helper", "gmsh_helper"}
REFUSALS = (terrane.Error, TypeError, ValueError, OverflowError, KeyError, IndexError, OSError, ImportError,
            RecursionError)  # by Python's own repr of lists in lists


def parameters(call):
    """Names of the arguments of a function, and whether it takes others by name."""
    found = inspect.signature(call).parameters.values()
    return ([p.name for p in found if p.kind in (p.POSITIONAL_OR_KEYWORD, p.KEYWORD_ONLY) and p.name != "self"],
            any(p.kind == p.VAR_KEYWORD for p in found))


def default_of(call, name):
    found = inspect.signature(call).parameters.get(name)
    return None if found is None or found.default is inspect.Parameter.empty else found.default


def methods_of(kind):
    """Public methods of a class that take arguments, by name; "" is the constructor."""
    found = {name: method for name, method in inspect.getmembers(kind, callable)
             if not name.startswith("_") and name not in ("plot", "with_traceback", "add_note")}
    if kind.__name__ not in RETURNED:
        found[""] = kind
    return {n: m for n, m in found.items() if parameters(m)[0] or parameters(m)[1]}


def is_record(value):
    return inspect.isclass(value) and issubclass(value, tuple)


def unknown():
    """What the cases do not know, or know in vain."""
    flaws, fixtures = [], Fixtures()

    def compare(place, call, case):
        names, others = parameters(call)
        known = {*case[0](fixtures), *case[1]}
        flaws.extend(f"{place}: nobody knows how to try its argument {n}" for n in sorted({*names} - known - HOW))
        flaws.extend(f"{place}: it has no argument {n}" for n in sorted(known - {*names}) if not others)

    for name in terrane.__all__:
        value = getattr(terrane, name)
        if inspect.isfunction(value):
            if name not in FUNCTIONS:
                flaws.append(f"{name}: nobody knows how to try it")
            else:
                compare(name, value, FUNCTIONS[name])
        elif inspect.isclass(value) and not is_record(value):
            known = METHODS.get(name, (None, {}))[1]
            found = methods_of(value)
            flaws += [f"{name}.{m}: nobody knows how to try it" for m in sorted(found.keys() - known.keys())]
            for method in known.keys() & found.keys():
                compare(f"{name}.{method}", found[method], known[method])
    gone = (FUNCTIONS.keys() | METHODS.keys()) - {*terrane.__all__}
    from terrane._quality import _OPTIONS
    flaws += [f"improve: nobody knows how to try its option {n}" for n in sorted({*_OPTIONS} - {*FUNCTIONS["improve"][1]} - {"resolution"})]
    return flaws + [f"{name}: it is gone" for name in sorted(gone)]


def print_of(value, depth=0):
    """A text that differs where results do."""
    if isinstance(value, np.ndarray):
        return f"{value.dtype}{value.shape}{hashlib.sha256(np.ascontiguousarray(value)).hexdigest()}"
    if isinstance(value, dict):
        return "{" + ",".join(f"{print_of(k, depth)}:{print_of(v, depth)}" for k, v in value.items()) + "}"
    if isinstance(value, (list, tuple)):
        return "[" + ",".join(print_of(v, depth) for v in value) + "]"
    kind = type(value)
    if not kind.__module__.startswith("terrane") or depth > 2:
        return kind.__name__ if kind.__module__.startswith("terrane") else repr(value)
    names = [n for n in dir(kind) if not n.startswith("_") and not callable(getattr(kind, n))]
    return (repr(value) if kind.__repr__ is not object.__repr__ else kind.__name__) + print_of({n: getattr(value, n) for n in names if n != "model"}, depth + 1)


def files_here(kept):
    """Names and contents of the files that a call has made, which are removed."""
    made = []
    for path in sorted(pathlib.Path(".").iterdir()):
        if path.name in kept:
            continue
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.is_file():
                made.append(f"{file} {hashlib.sha256(file.read_bytes()).hexdigest()}")
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    return made


class Trial:
    """Calls of one function or method."""

    def __init__(self, place, fixtures):
        self.place, self.fixtures = place, fixtures
        name, _, method = place.partition(".")
        if "." in place:
            make, known = METHODS[name]
            case = known[method]
            self.call = getattr(make(fixtures), method) if method else getattr(terrane, name)
        else:
            case, self.call = FUNCTIONS[name], getattr(terrane, name)
        self.required = case[0](fixtures)
        self.optional = {n: v(fixtures) if callable(v) else v for n, v in case[1].items()}
        names, self.takes_others = parameters(self.call)
        self.names = [*dict.fromkeys([*self.required, *self.optional, *(n for n in names if n in HOW)])]
        self._results = {}

    def run(self, given):
        """What a call returns and writes, as a text; or its exception."""
        before = {p.name for p in pathlib.Path(".").iterdir()}
        try:
            return print_of(self.call(**given)) + "".join(files_here(before))
        except BaseException as error:  # whatever it is
            files_here(before)
            return error

    def plain(self, more=()):
        """What the required arguments give, with a few others."""
        more = dict(more)
        key = repr(sorted(more))
        if key not in self._results:
            self._results[key] = self.run({**self.required, **more})
        return self._results[key]

    def flaw(self, given, name, label):
        """What is wrong about a call in which the argument `name` has the value of this label."""
        found = self.run(given)
        if isinstance(found, BaseException):
            return flaw_of(found)
        base = self.plain({n: v for n, v in given.items() if n != name and n not in self.required})
        if found != base or isinstance(base, BaseException):
            return None
        usual = default_of(self.call, name) if name not in self.required else self.required[name]
        value = given.get(name)
        if label == "true" and name not in inspect.signature(self.call).parameters:  # as it is by default
            return None
        if name == "progress" and callable(value):  # print is told of it
            return None
        if (not_given(value) and not_given(usual)) or (name in LIMITS and label in LARGE) or name in NAMES or name in SAME.get(label, ()):
            return None
        try:
            if type(value) is type(usual) and bool(value == usual) or bool(value) == usual:
                return None
        except Exception:
            pass
        return "it is ignored"


def not_given(value):
    """Whether a value may stand for none."""
    return value is None or not isinstance(value, (np.ndarray, terrane.IndexLists)) and not value


def flaw_of(error):
    """What is wrong about an exception that a caller gets."""
    text = f"{type(error).__name__}: {str(error)[:200]}"
    if not isinstance(error, REFUSALS) or getattr(error, "code", "") == "internal":
        return text
    if any(words in str(error) for words in ("incompatible function arguments", "Unable to convert", "Unable to cast",
                                             "another type than it must have")):  # pybind11's, not ours
        return text
    return None if str(error) else f"{text}: it says nothing"


def places():
    return [*FUNCTIONS, *(f"{kind}.{method}" for kind, (_, methods) in METHODS.items() for method in methods)]


def work_list(seed, share, only):
    """(place, argument, label): each nonsense of each argument, a value that makes sense, and an argument that there is not."""
    draw = random.Random(seed)
    found = []
    for place in places():
        if only and not place.startswith(only):
            continue
        kind, _, method = place.partition(".")
        case = METHODS[kind][1][method] if "." in place else FUNCTIONS[place]
        target = getattr(terrane, kind)
        call = target if "." not in place or not method else getattr(target, method)
        names, others = parameters(call)
        names = [*dict.fromkeys([*names, *case[1]])]
        found += [(place, n, label) for n in names for label in NONSENSE if draw.random() < share or label == "object"]
        found += [(place, n, "sense") for n in names if case[1].get(n) is not None]
        found.append((place, "nonsense", "none such"))
    return found


def try_one(trial, name, label, draw=None):
    """What is wrong about one call."""
    if label == "none such":
        found = trial.run({**trial.required, "nonsense": 1})
        return None if isinstance(found, TypeError) else f"an argument that there is not: {str(found)[:80]}"
    if label == "random":
        given = dict(trial.required)
        for n in trial.names:
            chance = draw.random()
            if chance < 0.3:
                given[n] = NONSENSE[draw.choice([*NONSENSE])]
            elif chance < 0.6 and trial.optional.get(n) is not None:
                good = trial.optional[n]
                given[n] = good[0] if isinstance(good, tuple) and isinstance(good[-1], dict) else good
        found = trial.run(given)
        return flaw_of(found) and f"{flaw_of(found)} of {given!r:.300}" if isinstance(found, BaseException) else None
    if label != "sense":
        return trial.flaw({**trial.required, name: NONSENSE[label]}, name, label)
    good, needs = trial.optional[name], {}
    if isinstance(good, tuple) and isinstance(good[-1], dict):
        good, needs = good
    found = trial.run({**trial.required, **needs, name: good})
    if isinstance(found, BaseException):
        return f"it is refused: {type(found).__name__}: {found}"
    if found == trial.plain(needs):
        return "it changes nothing"
    return trial.flaw({**trial.required, name: good}, name, label) if needs else None


def child(options):
    """Make the calls."""
    fixtures, trials = Fixtures(), {}
    draw = random.Random(options.seed + options.begin)
    fixtures.files  # before files are looked for

    def trial(place, name, label):
        if place not in trials:
            trials[place] = Trial(place, fixtures)
        return try_one(trials[place], name, label, draw)

    work = work_list(options.seed, options.share, options.only)
    return make_calls(options, work, lambda: (draw.choice(places()), "", "random"), trial)


def main():
    options = parse(__doc__, 0.1).parse_args()
    if options.begin >= 0:
        return child(options)
    tried, flaws = supervise(__file__, options)
    if not options.only:
        os.chdir(tempfile.mkdtemp())
        missing = unknown()
        flaws += missing
        print("\n".join(missing), end="\n" if missing else "")
    return conclude(tried, flaws)


if __name__ == "__main__":
    sys.exit(main())
