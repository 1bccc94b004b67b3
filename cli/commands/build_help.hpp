// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace terrane::cli {

/// What `terrane build --help` says below the options.
inline constexpr auto build_footer =
    R"(The whole chain from one file: surfaces are read, on request their holes filled as `terrane fill`
does and horizons put in order as `terrane layer` does, cut by the boundary of the volume of interest
where there is one, arranged and rounded as `terrane arrange` does, made better on request as `terrane
improve` does, their blocks found as `terrane volume` does and filled as `terrane tetrahedralize`
does. All results go to one new folder:

  surfaces.vtp, ...      the conforming mesh, in the formats that outputs.surfaces names
  tetrahedra.vtu, ...    likewise, outputs.tetrahedra
  model/                 blocks, interfaces and model.json, with outputs.blocks
  model.ml               the model for GOCAD and RINGMesh, with outputs.gocad
  invented.csv           points that fill made up, with expected errors
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
