// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Keeps results of finished stages of `build --resume` in a folder next to that of the results,
// until a run has ended well.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/cli/stages/user_key.hpp>

namespace terrane::cli {

/// Returns where results of stages are kept: "RESULTS.stages" next to the folder of results.
std::filesystem::path stages_folder(const std::filesystem::path& results);

/// The folder of kept results. It is made when the first stage is kept. Each file has a line with the
/// format, the version of the program, the stage, the key of the result, the number and the hash of its
/// bytes, and the code of all this by the user's key; then these bytes. A file without such a line,
/// or with that of another stage, is not taken.
class KeptStages {
public:
    /// Keeps them next to the folder `results`. None, after a warning, if the user has no key.
    static std::optional<KeptStages> beside(const std::filesystem::path& results);

    /// Returns callbacks for build(); this object must outlive them.
    [[nodiscard]] StageStore store();
    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
    /// Tells whether a result is there.
    [[nodiscard]] bool any() const;
    /// Removes the results, and the folder unless somebody put other files there.
    void remove() const;

private:
    KeptStages(std::filesystem::path folder, const UserKey& key) :
        folder_(std::move(folder)), key_(key) {}

    [[nodiscard]] std::filesystem::path file_of(BuildStage stage) const;
    [[nodiscard]] std::optional<std::string> find(BuildStage stage, const std::string& key) const;
    void keep(BuildStage stage, const std::string& key, const std::string& bytes) const;

    std::filesystem::path folder_;
    UserKey key_;
};

} // namespace terrane::cli
