# SPDX-License-Identifier: LGPL-3.0-or-later
"""Pickles that were changed, and copies of all public classes."""

import copy
import inspect
import pathlib
import pickle

import numpy as np
import pytest

import terrane
from conftest import BOX, HAS_TETGEN, SANITIZED, run_python, sheet, stack
from test_results import MAKE, holed, project

# Each state is changed in all of its arrays and numbers, restored, and used by whatever takes it.
BATTERY = """
import random, signal, sys, warnings
sys.path.insert(0, sys.argv[1])
import numpy as np
import terrane
from conftest import BOX, stack
from test_results import MAKE
warnings.simplefilter("ignore")

def leaves(value, path=()):
    if isinstance(value, np.ndarray) or isinstance(value, (int, float)) and not isinstance(value, bool):
        yield path, value
    elif isinstance(value, (tuple, list)):
        for i, item in enumerate(value):
            yield from leaves(item, path + (i,))
    elif isinstance(value, dict):
        for key, item in value.items():
            yield from leaves(item, path + (key,))

def changed(value, path, new):
    if not path:
        return new
    if isinstance(value, dict):
        return {**value, path[0]: changed(value[path[0]], path[1:], new)}
    items = [changed(item, path[1:], new) if i == path[0] else item for i, item in enumerate(value)]
    if hasattr(value, "_fields"):
        return type(value)(*items)
    return type(value)(items)

def variants(value, draw):
    if not isinstance(value, np.ndarray):
        yield from (-1, 0, 2**31 - 2, 2**32 - 1, 2**64, float("nan"), None, "x")
        return
    if value.size == 0:
        yield np.zeros(7, dtype=value.dtype)
        yield np.zeros((1,) + value.shape[1:], dtype=value.dtype)
        return
    whole = value.dtype.kind in "iu"
    for number in (2**31 - 2, 2**32 - 1, 0) if whole else (np.nan, np.inf, 1e308, -1e308, 5e-324):
        for at in (0, value.size - 1, draw.randrange(value.size)):
            other = value.copy()
            other.flat[at] = number
            yield other
    yield value[:-1]
    yield value[:0]
    yield value[::-1]
    yield np.concatenate([value, value])
    yield value.reshape(-1)
    yield value.astype(np.int64 if whole else np.float32)
    yield value.astype(np.float64) if whole else value.astype(object)
    yield value.byteswap().view(value.dtype.newbyteorder())
    other = value.copy().reshape(-1)
    draw.shuffle(other)
    yield other.reshape(value.shape)

def uses(r):
    two = [[0.5, 0.5, 0.5], [2.0, 2.0, 0.0]]
    return [lambda: repr(r), lambda: r._repr_html_(), lambda: r == r, lambda: r.__reduce__(), lambda: r.save("s.vtp"),
            lambda: r.save("s.obj"), lambda: r.save("s.ts"), lambda: r.save("s.msh"), lambda: r.save("s.stl", ascii=True),
            lambda: r.save("s.vtu"), lambda: r.save("s.vtu", order=2), lambda: r.save("s.exo"), lambda: r.save("s.inp"),
            lambda: r.save("s", format="ogs"), lambda: r.save("s", format="pylith"), lambda: r.save("s", format="geos"),
            lambda: r.save("s.ugi"), lambda: r.save("s.mesh"), lambda: r.quality(threads=1), lambda: r.split(),
            lambda: r.shape(), lambda: r.of_block(1), lambda: r.locate(two, threads=1), lambda: r.points(threads=1),
            lambda: r.exact(threads=1), lambda: r.digest(threads=1), lambda: r.coordinates(0), lambda: r.construction(0),
            lambda: r.blocks, lambda: r.leaks, lambda: r.interfaces[0].mesh, lambda: r.blocks[1].mesh,
            lambda: r.block_of(two, threads=1), lambda: terrane.round(r, threads=1), lambda: terrane.verify(r),
            lambda: terrane.check(r, threads=1), lambda: terrane.regions(r, threads=1),
            lambda: terrane.volumes(r, threads=1), lambda: terrane.structure(r, threads=1),
            lambda: terrane.improve(r, 2, passes=1, threads=1), lambda: terrane.structure(r._source, r, threads=1),
            lambda: terrane.structure(r.mesh, r.volumes, threads=1), lambda: r.report("s.html", threads=1),
            lambda: r.volumes.locate(two, threads=1)]

kind, seed = sys.argv[2], int(sys.argv[3])
draw = random.Random(seed)
value = MAKE[kind]()
function, (cls, state) = value.__reduce__() if kind != "IndexLists" else (None, (type(value), (value.offsets, value.values)))
made = function or (lambda cls, state: cls(*state))
counts = {"refused": 0, "restored": 0}
work = [(path, new) for path, old in leaves(state) for new in variants(old, draw)]
most = int(sys.argv[4])
for path, new in work if len(work) <= most else draw.sample(work, most):
    print(kind, path, str(type(new)), str(new)[:60].replace("\\n", " "), flush=True)
    try:
        restored = made(cls, changed(state, path, new))
    except (terrane.Error, ValueError, TypeError, KeyError, IndexError, OverflowError, AttributeError):
        counts["refused"] += 1
        continue
    counts["restored"] += 1
    for i, use in enumerate(uses(restored)):
        print("use", i, flush=True)
        try:
            use()
        except Exception:
            pass
print("done", counts)
"""


@pytest.mark.skipif(SANITIZED, reason="slow")
@pytest.mark.parametrize("kind", MAKE)
def test_changed_pickles_never_crash(kind):
    done = run_python(BATTERY, str(pathlib.Path(__file__).parent), kind, 1, 30, check=False)
    tail = "\n".join(done.stdout.splitlines()[-3:])
    assert done.returncode == 0, f"{tail}\n{done.stderr[-2000:]}"


def states(value):
    """Return the class of a result and its state."""
    _, (cls, state) = value.__reduce__()
    return cls, list(state)


@pytest.mark.parametrize("index, change", [
    (1, lambda a: a * np.nan), (2, lambda a: a + 2**31), (2, lambda a: a[:-1]), (1, lambda a: a[:0]),
    (3, lambda a: (a[0][::-1].copy(), a[1])), (3, lambda a: (a[0], a[1] + 9)), (3, lambda a: (a[0][:0], a[1])),
    (3, lambda a: (a[0], a[1][:-1])), (4, lambda a: (a[0], a[1] + 2**31)), (5, lambda a: (a[0][:-1], a[1])),
    (6, lambda a: a + 2**31), (6, lambda a: a[:, ::-1].copy())])
def test_the_state_of_a_mesh_is_judged(index, change):
    cls, state = states(terrane.round(terrane.arrange(stack())).mesh)
    assert cls._from_state(*state).split()
    state[index] = change(state[index])
    with pytest.raises(terrane.Error) as raised:
        cls._from_state(*state)
    assert raised.value.code in ("bad_index", "bad_number")


@pytest.mark.tetgen
@pytest.mark.parametrize("index, change", [
    (1, lambda a: a / 0.0), (2, lambda a: a + 2**31), (3, lambda a: a[:-1]), (3, lambda a: a + 9), (4, lambda a: a + 2**31),
    (5, lambda a: a[:-1]), (6, lambda a: (a[0], a[1] + 9)), (7, lambda a: np.array([[0, 2**31]], dtype=np.uint32)),
    (8, lambda a: 2**32 - 1), (10, lambda a: [])])
def test_the_state_of_tetrahedra_is_judged(index, change):
    cls, state = states(MAKE["Tetrahedra"]())
    assert cls._from_state(*state).shape()
    with np.errstate(all="ignore"):
        state[index] = change(state[index])
    with pytest.raises(terrane.Error) as raised:
        cls._from_state(*state)
    assert raised.value.code in ("bad_index", "bad_number")


def test_the_state_of_volumes_is_judged():
    cls, (sides, measures, total, source) = states(MAKE["Volumes"]())
    for bad in ((sides + 9, measures, total), (sides, measures[:0], total)):
        with pytest.raises(terrane.Error) as raised:
            cls._from_state(*bad, source)
        assert raised.value.code == "bad_index"
    short = cls._from_state(sides[:-1], measures, total, source)
    for use in (short.exact, short.points, lambda: short.locate([[0, 0, 0]]), lambda: terrane.structure(source, short)):
        with pytest.raises(terrane.Error, match="the volumes are those of"):
            use()


# --- Copies


def instances():
    """Return values of all public classes by the names of these."""
    made = {name: make() for name, make in MAKE.items()}
    found = {type(value).__name__: value for value in made.values()}
    found.update({"Surface": stack()[0], "Frame": terrane.Frame("m", "ft", "x", 2, True), "Block": made["Model"].blocks[1],
                  "Interface": made["Model"].interfaces[0], "Blocks": made["Model"].blocks,
                  "RoundingReport": made["Model"].rounding, "SurfaceInfo": made["Mesh"].surfaces[0],
                  "Contact": made["CheckReport"].contacts[0], "Region": made["Regions"].regions[0],
                  "BorderLoop": made["Filled"].holes[0].border, "FilledHole": made["Filled"].holes[0],
                  "FillReport": made["Filled"].holes[0].report, "LayerReport": made["Layered"].reports[0],
                  "SelectedPiece": made["Selected"].pieces[0],
                  "WellPath": terrane.WellPath("A", [(0.0, 0.0, 1.0), (0.0, 0.0, 0.0)], [0.0, 1.0]),
                  "WellInterval": made["WellLog"].intervals[0], "WellMarker": made["WellLog"].markers[0],
                  "SectionPolygon": made["Section"].polygons[0],
                  "SectionLine": made["Section"].lines[0], "PartAbove": made["Model"].blocks[1].above_contact(0),
                  "Leak": terrane.Leak("a", "b", 1.0, 2.0, 3.0, (0.0, 1.0, 2.0), "wide"), "Relation": made["Model"].relations[0],
                  "Juxtaposition": made["Model"].juxtapositions[0], "SurfaceCut": made["VolumeOfInterest"].surfaces[0],
                  "SealAdvice": terrane.suggest_seal(stack()),
                  "Verdict": terrane.verify(made["Mesh"]), "Error": terrane.Error("bad_option", "no", "x"),
                  "OutOfMemory": terrane.OutOfMemory("out_of_memory", "none"),
                  "Doubt": terrane.Doubt("no_base", ["top"], "the model is open", "no block is closed", "add a base")})
    s = made["Structure"]
    found.update({"Corner": s.corners[0], "Line": s.lines[0], "Patch": s.patches[0], "InterfaceParts": s.interfaces[0],
                  "BlockParts": s.blocks[0], "SealTrial": found["SealAdvice"].trials[0]})
    if HAS_TETGEN:
        found["BlockVolume"] = made["Tetrahedra"].volumes[1]
    # Plain named tuples of which these inputs give none.
    point = (0.5, 1.0, 2.0)
    for cls, values in ((terrane.SealChange, ("extended", 0, 1.0, 2.0, point, 3)), (terrane.ClosedGap, (0, 1, 1.0, 2.0, point)),
                        (terrane.OpenBorder, (0, 1.0, point)), (terrane.OpenGap, (0, 1, "wide", 2, 1.0, 2.0, point)), (terrane.OutOfOrder, (0, 1, (2, 3), point, 1.0)),
                        (terrane.Violation, ("open_face", 1, "x")), (terrane.PropertyFlaw, ("x", point, (1,), 0.5)),
                        (terrane.JudgedProperty, ("curves", "fails", "x", 1, 0.0, [])), (terrane.MeshJudgement, ([],)), (terrane.RuleViolation, ("R5", (0, 1), "x")),
                        (terrane.VerifiedFile, ("a", "every byte", [])), (terrane.Failure, (1, "x", "y"))):
        found[cls.__name__] = cls(*values)
    return found


# A handle of running or finished work, and its tables.
OF_ENSEMBLES = {"Ensemble", "BlockOutcome", "Juxtaposed"}


@pytest.fixture(scope="module")
def values(tmp_path_factory):
    """Values of all public classes."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(tmp_path_factory.mktemp("values"))
        project()
        yield instances()


PUBLIC = sorted(name for name in terrane.__all__ if inspect.isclass(getattr(terrane, name)))


@pytest.mark.parametrize("name", [n for n in PUBLIC if n not in OF_ENSEMBLES])
def test_copies_equal_their_originals(values, name):
    if name in ("Tetrahedra", "BlockVolume") and not HAS_TETGEN:
        pytest.skip("no terrane-tetgen")
    if name == "Built":
        project()  # a pickle of a project has names of files
    value = values[name]
    for other in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
        assert type(other) is type(value)
        if isinstance(value, Exception):  # which are equal to themselves alone
            assert other.args == value.args and vars(other) == vars(value)
            continue
        assert other == value and not other != value
        try:
            assert hash(other) == hash(value)
        except TypeError:
            with pytest.raises(TypeError):
                hash(value)


def test_properties_that_are_made_anew_are_equal(values):
    model = values["Model"]
    again = pickle.loads(pickle.dumps(model))
    for name in ("rounding", "blocks", "interfaces", "leaks", "relations", "juxtapositions", "volumes", "structure", "mesh"):
        assert getattr(model, name) == getattr(model, name) == getattr(again, name), name
    assert model.blocks[1] != model.blocks[2] and model.interfaces[0] != model.interfaces[1]
    assert len({model.blocks[1], again.blocks[1], model.blocks[2]}) == 2
    other = terrane.model([sheet(z=0.5, wave=0.1)], box=BOX)
    assert model.blocks[1] != other.blocks[1] and model.blocks != other.blocks
    assert model.blocks[1] != "a block"


def test_reports_with_nan_equal_their_copies():
    report = terrane.fill(holed(), method="rbf").holes[0].report
    report = report._replace(expected_error=float("nan"))
    assert pickle.loads(pickle.dumps(report)) == report and report != report._replace(area=1.0)
