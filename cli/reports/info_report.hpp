// SPDX-License-Identifier: LGPL-3.0-or-later
//
// What files contain, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include <terrane/algorithms/check/check.hpp>
#include <terrane/cli/options/files.hpp>
#include <terrane/cli/options/statistics.hpp>

namespace terrane::cli {

/// A file, and what was found of its surfaces.
struct FileInfo {
    std::string file;
    std::string format; ///< as people call it
    std::vector<CheckReport> surfaces;
};

/// Describes the files, their surfaces and, by `together`, how these meet.
std::string text_of(const std::vector<FileInfo>& files, const CheckReport& together,
                    const Inputs& inputs);
Json json_of(const std::vector<FileInfo>& files, const CheckReport& together, const Inputs& inputs);

} // namespace terrane::cli
