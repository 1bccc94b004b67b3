// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/kept_stages.hpp>

#include <array>
#include <system_error>

#include <fmt/format.h>

#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

/// The stages whose results are kept.
constexpr std::array kept_stages{BuildStage::improve, BuildStage::tetrahedra};

/// Returns the first line of a file of kept bytes.
std::string line_for(const std::string& key, std::string_view bytes) {
    return fmt::format("terrane-stage 1, terrane {}, {} {}\n", TERRANE_VERSION, key,
                       hexadecimal(sha256(bytes)));
}

fs::path without_slash(const fs::path& path) {
    return path.has_filename() ? path : path.parent_path();
}

} // namespace

std::string_view name_of(BuildStage stage) {
    static constexpr std::array<std::string_view, 5> names{"mend", "arrange", "improve", "blocks",
                                                           "tetrahedra"};
    return names.at(static_cast<std::size_t>(stage));
}

KeptStages::KeptStages(const fs::path& results) : folder_(without_slash(results)) {
    folder_ += ".stages";
}

StageStore KeptStages::store() {
    return {.find = [this](BuildStage stage, const std::string& key) { return find(stage, key); },
            .keep = [this](BuildStage stage, const std::string& key,
                           const std::string& bytes) { keep(stage, key, bytes); }};
}

bool KeptStages::any() const {
    std::error_code ignored;
    for (const BuildStage stage : kept_stages)
        if (fs::exists(file_of(stage), ignored)) return true;
    return false;
}

void KeptStages::remove() const {
    std::error_code ignored;
    for (const BuildStage stage : kept_stages) fs::remove(file_of(stage), ignored);
    fs::remove(folder_, ignored); // not if it has other files
}

fs::path KeptStages::file_of(BuildStage stage) const {
    return folder_ / name_of(stage);
}

std::optional<std::string> KeptStages::find(BuildStage stage, const std::string& key) const {
    const fs::path path = file_of(stage);
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return std::nullopt;
    const auto file = read_file(path);
    if (!file) {
        warn(file.error().message() + "; the stage is run again");
        return std::nullopt;
    }
    const std::size_t end = file->find('\n');
    const std::string_view all = *file, line = all.substr(0, end == all.npos ? 0 : end + 1);
    const std::string bytes(all.substr(line.size()));
    if (line == line_for(key, bytes)) return bytes;
    const bool whole =
        line.size() > 65 && line.substr(line.size() - 65, 64) == hexadecimal(sha256(bytes));
    warn(path.string() +
         (whole ? ": made from other surfaces or options, or by another version; the stage is run "
                  "again"
                : ": damaged; the stage is run again"));
    return std::nullopt;
}

void KeptStages::keep(BuildStage stage, const std::string& key, const std::string& bytes) const {
    std::error_code failed;
    fs::create_directory(folder_, failed);
    if (failed) return warn(folder_.string() + ": cannot be made: " + failed.message());
    if (auto done = write_file_at_once(file_of(stage), line_for(key, bytes) + bytes); !done)
        warn("the result of a stage is not kept: " + done.error().message());
}

} // namespace terrane::cli
