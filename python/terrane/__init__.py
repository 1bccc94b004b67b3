# SPDX-License-Identifier: LGPL-3.0-or-later
"""Exact geometry of the subsurface: conforming meshes, blocks and tetrahedra of geological surfaces.

NumPy arrays in, NumPy arrays out::

    import terrane
    model = terrane.model([top, base, fault], box=((0, 0, -3000), (10000, 10000, 500)), seal=5)
    for name, block in model.blocks.items():
        print(name, block.volume)

Stages are functions; results are values with array attributes, ``save()``, ``to_pyvista()`` and ``to_meshio()``. All
stages take ``threads=`` and ``progress=``, run without the GIL, and stop at a KeyboardInterrupt. Errors are
`terrane.Error`. Coordinates, lengths, areas and volumes are in the unit of the input.
"""

import os as _os

from . import _core
from ._arrangement import Arrangement, RoundedMesh, arrange, check, regions, round
from ._arrays import IndexLists, SurfaceInfo
from ._blocks import (NO_INDEX, BlockParts, Corner, InterfaceParts, Line, Patch, Structure, Volumes,
                      structure, volumes)
from ._cells import BlocksInCells
from ._ensemble import Ensemble, ensemble
from ._ensemble_results import BlockOutcome, Failure, Juxtaposed
from ._errors import ERROR_CODES, Doubt, Error, OutOfMemory
from ._examples import complete as _complete
from ._files import read, save
from ._holes import BorderLoop, Filled, FilledHole, FillReport, fill, holes
from ._judgement import JudgedProperty, MeshJudgement, PropertyFlaw, judge
from ._layers import Layered, LayerReport, OutOfOrder, layers
from ._maps import Map, map_surface
from ._memory import keep_freed_memory
from ._mesh import CheckReport, Contact, Mesh, Region, Regions, mesh
from ._model import Model, model
from ._parts import Block, Blocks, Interface, PartAbove
from ._project import Built, build
from ._quality import Improved, distance, improve
from ._relations import Juxtaposition, Leak, Relation
from ._report import HAS_REPORTS
from ._rounding import RoundingReport
from ._sealing import (ClosedGap, OpenGap, SealAdvice, SealChange, Sealed, SealTrial, seal,
                       suggest_seal)
from ._section import Section, SectionLine, SectionPolygon, section
from ._selection import Selected, SelectedPiece, select
from ._surface import ROLES, Frame, Surface, as_surface, as_surfaces
from ._wells import WellInterval, WellLog, WellMarker, WellPath, log_well, read_wells
from ._tetrahedra import BlockVolume, Tetrahedra, Violation, tetrahedralize
from ._verification import RuleViolation, Verdict, VerifiedFile, verify
from ._volume_of_interest import (OpenBorder, SurfaceCut, VolumeOfInterest, box, closed, extend, polygon,
                                  rotated_box, volume_of_interest)

# Programs that make tetrahedra and came with the package; the environment goes first.
for _name in ("tetgen", "gmsh"):
    _helper = _os.path.join(_os.path.dirname(__file__), "_libexec", "terrane-" + _name)
    if _os.path.exists(_helper):
        _os.environ.setdefault("TERRANE_" + _name.upper(), _helper)

__version__: str = _core.version

__all__ = [
    "Arrangement", "Block", "BlockOutcome", "BlockParts", "BlockVolume", "Blocks", "BlocksInCells", "BorderLoop", "Built", "CheckReport", "ClosedGap",
    "Contact", "Corner", "Doubt", "ERROR_CODES", "Ensemble", "Error", "Failure", "FillReport", "Filled", "FilledHole", "Frame",
    "HAS_REPORTS", "Improved", "IndexLists", "Interface", "InterfaceParts", "JudgedProperty", "Juxtaposed", "Juxtaposition", "LayerReport", "Layered",
    "Leak", "Line", "Map", "Mesh", "MeshJudgement", "Model", "NO_INDEX", "OpenBorder", "OpenGap", "OutOfMemory", "OutOfOrder",
    "PartAbove", "Patch", "PropertyFlaw", "ROLES", "Region", "Regions", "Relation", "RoundedMesh", "RoundingReport",
    "RuleViolation", "SealAdvice", "SealChange", "SealTrial", "Sealed", "Section", "SectionLine", "SectionPolygon", "Selected", "SelectedPiece", "Structure", "Surface",
    "SurfaceCut", "SurfaceInfo", "Tetrahedra", "Verdict", "VerifiedFile", "Violation",
    "VolumeOfInterest", "Volumes", "WellInterval", "WellLog", "WellMarker", "WellPath", "arrange", "as_surface", "as_surfaces", "box", "build", "check",
    "closed", "distance", "ensemble", "extend", "fill", "holes", "improve", "judge", "keep_freed_memory", "layers", "log_well", "map_surface", "mesh", "model", "polygon",
    "read", "read_wells", "regions", "rotated_box", "round", "save", "seal", "section", "select", "structure", "suggest_seal",
    "tetrahedralize", "verify", "volume_of_interest", "volumes",
]

_complete(globals()[_name] for _name in __all__)
