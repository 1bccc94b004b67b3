// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Files for stages that read or write them.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "stage.hpp"
#include "support/files.hpp"

namespace failing {

/// The folder in which files are read and written; it lives as long as the program.
inline const test_support::TemporaryFolder& scratch() {
    static const test_support::TemporaryFolder folder;
    return folder;
}

inline std::string contents_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Writes a file of the scratch folder and returns its path.
inline std::filesystem::path written(std::string_view name, const std::string& text) {
    const auto path = scratch() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

/// Describes a folder: the names of all that is in it, and the contents of files.
inline std::string left(const std::filesystem::path& folder) {
    std::set<std::string> entries;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        entries.insert(entry.path().lexically_relative(folder).string() + ": " +
                       (entry.is_directory() ? "a folder" : contents_of(entry.path())) + "\n");
    std::string text;
    for (const std::string& entry : entries) text += entry;
    return text;
}

/// Makes a stage of work(path, prepare()), which writes to `name` in a folder of its own, where an old file stands
/// if `has_old`. A failure must leave the folder as it was before.
template <class Prepare, class Work>
Stage writing_stage(const std::string& stage_name, const std::string& name, bool has_old,
                    const Prepare& prepare, const Work& work) {
    namespace fs = std::filesystem;
    static int number = 0;
    const fs::path folder = scratch() / ("written " + std::to_string(++number));
    const auto anew = [folder, name, has_old, prepare] {
        fs::remove_all(folder);
        fs::create_directory(folder);
        if (has_old) std::ofstream(folder / name) << "old";
        return std::pair(folder / name, prepare());
    };
    using Argument = std::invoke_result_t<decltype(anew)>;
    Stage made = stage_of(
        stage_name, anew,
        [work](Argument argument) { return work(argument.first, std::move(argument.second)); },
        [folder](const auto&) { return left(folder); });
    anew();
    made.call = [call = made.call, folder, before = left(folder)](long n, Mode mode) {
        Answer answer = call(n, mode);
        if ((!answer.error && !answer.threw) || left(folder) == before) return answer;
        answer.threw = false;
        answer.error =
            terrane::Error{terrane::ErrorCode::internal, "something was written", left(folder)};
        return answer;
    };
    return made;
}

/// Does the same with work(path).
template <class Work>
Stage writing_stage(const std::string& stage_name, const std::string& name, bool has_old,
                    const Work& work) {
    return writing_stage(
        stage_name, name, has_old, [] { return 0; },
        [work](const std::filesystem::path& path, int) { return work(path); });
}

} // namespace failing
