# Steady flow through layers of different conductivity, from the bottom of the box to its top (MOOSE):
#   moose-opt -i moose.i
# Names are those of the element blocks and side sets of tetrahedra.exo.
[Mesh]
  [model]
    type = FileMeshGenerator
    file = model/tetrahedra.exo
  []
[]
[Variables]
  [head]
  []
[]
[Kernels]
  [flow]
    type = MatDiffusion
    variable = head
    diffusivity = conductivity
  []
[]
[Materials]
  [low]
    type = GenericConstantMaterial
    block = 'below_base_west_of_fault below_base_east_of_fault'
    prop_names = conductivity
    prop_values = 1e-6
  []
  [middle]
    type = GenericConstantMaterial
    block = 'below_top_above_base_west_of_fault below_top_above_base_east_of_fault'
    prop_names = conductivity
    prop_values = 1e-9
  []
  [high]
    type = GenericConstantMaterial
    block = 'above_top_west_of_fault above_top_east_of_fault'
    prop_names = conductivity
    prop_values = 1e-5
  []
[]
[BCs]
  [top]
    type = DirichletBC
    variable = head
    boundary = boundary_top
    value = 0
  []
  [bottom]
    type = DirichletBC
    variable = head
    boundary = boundary_bottom
    value = 10
  []
[]
[Postprocessors]
  [discharge] # 3.329559832e-5 m3/s
    type = SideDiffusiveFluxIntegral
    variable = head
    boundary = boundary_top
    diffusivity = conductivity
  []
[]
[Executioner]
  type = Steady
  solve_type = NEWTON
  petsc_options_iname = '-pc_type'
  petsc_options_value = 'lu'
[]
[Outputs]
  csv = true
  exodus = true
[]
