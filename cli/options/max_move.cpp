// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/max_move.hpp>

#include <cmath>

namespace terrane::cli {

void add_max_move(CLI::App& command, std::optional<double>& max_move) {
    command
        .add_option_function<double>(
            "--max-move",
            [&max_move](double length) {
                if (!(length > 0) || !std::isfinite(length))
                    throw CLI::ValidationError("--max-move", "needs a positive length");
                max_move = length;
            },
            "No surface moves farther while exact points become doubles, except for slivers that "
            "vanish; pairs that then still meet improperly are named and refused; in the unit of "
            "the files (default: 1024 spacings of the doubles at the largest coordinate)")
        ->type_name("LENGTH");
}

} // namespace terrane::cli
