// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/stages/kept_stages.hpp>

#include <algorithm>
#include <array>
#include <system_error>

#include <fmt/format.h>

#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/cli/session/console.hpp>
#include <terrane/cli/stages/opened_file.hpp>
#include <terrane/io/atomic/atomic_file.hpp>

namespace terrane::cli {

namespace fs = std::filesystem;

namespace {

/// The stages whose results are kept.
constexpr std::array kept_stages{BuildStage::improve, BuildStage::tetrahedra};

/// The longest first line that a file of kept bytes may have.
constexpr std::size_t longest_line = 512;
constexpr std::size_t code_length = 64;

/// Returns the part of the first line that names the result.
std::string name_in_line(BuildStage stage, const std::string& key) {
    return fmt::format("terrane-stage 2, terrane {}, {} {} ", TERRANE_VERSION, name_of(stage), key);
}

/// Returns the part of the first line that describes the bytes.
std::string summary_of(std::string_view bytes) {
    return fmt::format("{} {} ", bytes.size(), hexadecimal(sha256(bytes)));
}

} // namespace

fs::path stages_folder(const fs::path& results) {
    fs::path folder = results.has_filename() ? results : results.parent_path();
    folder += ".stages";
    return folder;
}

std::optional<KeptStages> KeptStages::beside(const fs::path& results) {
    const auto key = UserKey::read_or_make();
    if (key) return KeptStages(stages_folder(results), *key);
    warn(key.error().message() + "; --resume neither keeps stages nor takes any");
    return std::nullopt;
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
    const auto refuse = [&](std::string_view why) {
        warn(fmt::format("{}: {}; the stage is run again", path.string(), why));
        return std::nullopt;
    };
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(path, ignored))) return std::nullopt;
    const auto file = OpenedFile::file(path);
    if (!file) return refuse(file.error().sentence);
    // Nothing is believed, not even a size, before the code of the line is right.
    const std::string start = file->bytes(0, longest_line);
    const std::size_t end = std::min(start.find('\n'), start.size());
    if (end < code_length || end == start.size()) return refuse("damaged");
    const std::string_view line(start.data(), end - code_length);
    if (!key_.is_code_of(std::string_view(start).substr(line.size(), code_length), line))
        return refuse("damaged, or not kept by this user on this machine");
    const std::string name = name_in_line(stage, key);
    if (!line.starts_with(name))
        return refuse("made from other surfaces or options, or by another version");
    const std::string_view stated = line.substr(name.size());
    const std::size_t count = file->size() - (end + 1);
    if (!stated.starts_with(fmt::format("{} ", count))) return refuse("damaged");
    std::string bytes = file->bytes(end + 1, count);
    if (summary_of(bytes) != stated) return refuse("damaged");
    return bytes;
}

void KeptStages::keep(BuildStage stage, const std::string& key, const std::string& bytes) const {
    const fs::path path = file_of(stage);
    std::error_code failed;
    fs::create_directory(folder_, failed);
    if (failed) return warn(folder_.string() + ": cannot be made: " + failed.message());
    // A link would lead to another file, and a pipe would wait for its reader.
    if (!fs::is_regular_file(fs::symlink_status(path, failed))) fs::remove(path, failed);
    const std::string line = name_in_line(stage, key) + summary_of(bytes);
    if (auto done = write_file_at_once(path, line + key_.code_of(line) + "\n" + bytes); !done)
        warn("the result of a stage is not kept: " + done.error().message());
}

} // namespace terrane::cli
