// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace terrane::cli {

/// The text of `terrane build --help` below the options.
inline constexpr auto build_footer =
    R"(One command runs the whole chain from one file. It reads the surfaces; where the project asks for
it, it fills holes as `terrane fill` does and puts horizons in order as `terrane layer` does. It cuts
all surfaces by the boundary of the volume of interest, if there is one, arranges and rounds them as
`terrane arrange` does, and improves their triangles on request as `terrane improve` does. It finds
the blocks as `terrane volume` does and fills them with tetrahedra as `terrane tetrahedralize` does.
All results go to one new folder:

  surfaces.vtp, ...      the conforming mesh, in the formats that outputs.surfaces names
  tetrahedra.vtu, ...    likewise, outputs.tetrahedra
  model/                 blocks, interfaces and model.json, with outputs.blocks
  model.ml               the model for GOCAD and RINGMesh, with outputs.gocad
  interpolated.csv       points that fill made up, with expected errors
  filled.svg             surfaces before and after it
  certificate.json, ...  for `terrane verify`, with outputs.certificate; certificate_blocks.json of
                         model/ and certificate_tetrahedra.json of the tetrahedra
  statistics.json        counts, times and memory, as --stats of the other commands
  log.txt                what was said, with times

The keys of PROJECT.json are in io/project.schema.json, which editors can use; docs/reference/project.md
explains them. A small one:

  {
    "format": "terrane-project 1",
    "folder": "run",
    "surfaces": [
      {"file": "horizons.ml", "role": "horizon"},
      {"file": "faults.ts", "objects": ["F1", "F2"], "role": "fault"}
    ],
    "volume_of_interest": {"box": {"low": [0, 0, -3000], "high": [9000, 9000, 500]}},
    "tetrahedra": {"edge_length": 400, "size_of": {"F1": 100}, "split": ["fault"]},
    "outputs": {"tetrahedra": ["vtu", "msh"], "blocks": "vtp"}
  }

Examples:
  terrane build project.json
  terrane build project.json -o another_run --threads 4
  terrane build project.json --resume)";

} // namespace terrane::cli
