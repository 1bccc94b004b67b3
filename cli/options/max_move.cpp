// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/options/max_move.hpp>

#include <cmath>

namespace terrane::cli {

void add_positive_length(CLI::App& command, const std::string& name, std::optional<double>& value,
                         const std::string& help) {
    command
        .add_option_function<double>(
            name,
            [&value, name](double length) {
                if (!(length > 0) || !std::isfinite(length))
                    throw CLI::ValidationError(name, "needs a positive length");
                value = length;
            },
            help)
        ->type_name("LENGTH");
}

void add_max_move(CLI::App& command, std::optional<double>& max_move) {
    add_positive_length(
        command, "--max-move", max_move,
        "No surface moves farther while exact points become doubles, except for slivers that "
        "vanish; pairs that then still meet improperly are named and refused; in the unit of "
        "the files (default: 1024 spacings of the doubles at the largest coordinate)");
}

} // namespace terrane::cli
