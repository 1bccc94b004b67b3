# SPDX-License-Identifier: LGPL-3.0-or-later
"""Steady flow through layers of different conductivity with FEniCSx (DOLFINx 0.5), from the bottom of the box to its top.

usage: fenicsx.py model/tetrahedra.msh

Gmsh's physical groups become cell tags and facet tags with their numbers; their names are asked of Gmsh.
"""
import sys

import gmsh
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import LinearProblem
from dolfinx.io import gmshio
from mpi4py import MPI
from petsc4py import PETSc

CONDUCTIVITY = {"below base": 1e-6, "below top, above base": 1e-9, "above top": 1e-5}  # m/s


def layer_of(block):
    """The layer of "block 2: below top, above base, west of fault"."""
    return block.split(": ", 1)[1].rsplit(", ", 1)[0]


gmsh.initialize()
gmsh.option.setNumber("General.Terminal", 0)
gmsh.open(sys.argv[1])
number = {gmsh.model.getPhysicalName(*group): group[1] for group in gmsh.model.getPhysicalGroups()}
mesh, cell_tags, facet_tags = gmshio.model_to_mesh(gmsh.model, MPI.COMM_SELF, 0, gdim=3)
gmsh.finalize()

conductivity = fem.Function(fem.FunctionSpace(mesh, ("DG", 0)))
for name, tag in number.items():
    if name.startswith("block"):
        conductivity.x.array[cell_tags.find(tag)] = CONDUCTIVITY[layer_of(name)]

space = fem.FunctionSpace(mesh, ("Lagrange", 1))


def fixed(name, head):
    dofs = fem.locate_dofs_topological(space, 2, facet_tags.find(number[name]))
    return fem.dirichletbc(PETSc.ScalarType(head), dofs, space)


h, v = ufl.TrialFunction(space), ufl.TestFunction(space)
zero = fem.Constant(mesh, PETSc.ScalarType(0))
problem = LinearProblem(conductivity * ufl.dot(ufl.grad(h), ufl.grad(v)) * ufl.dx, zero * v * ufl.dx,
                        [fixed("boundary top", 0), fixed("boundary bottom", 10)],
                        petsc_options={"ksp_type": "preonly", "pc_type": "lu"})
head = problem.solve()
at_top = ufl.Measure("ds", mesh, subdomain_data=facet_tags)(number["boundary top"])
flux = -conductivity * ufl.dot(ufl.grad(head), ufl.FacetNormal(mesh))
print("discharge", fem.assemble_scalar(fem.form(flux * at_top)))
for name, tag in sorted(number.items()):
    if name.startswith("block"):
        cells = ufl.Measure("dx", mesh, subdomain_data=cell_tags)(tag)
        one = fem.Constant(mesh, PETSc.ScalarType(1))
        print("volume", fem.assemble_scalar(fem.form(one * cells)), name)
