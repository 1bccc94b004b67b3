// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/session/stage_seconds.hpp>

#include <algorithm>
#include <array>

namespace terrane::cli {
namespace {

/// Steps that count for another one, or for the stage that they are part of.
constexpr std::array<std::pair<std::string_view, std::string_view>, 8> joined{
    {{"assemble", "stitch"},
     {"shells", "volumes"},
     {"nesting", "volumes"},
     {"numbers", "volumes"},
     {"measures", "volumes"},
     {"glue", "simplify"},
     {"blocks", "volumes"}, // stages of a project
     {"tetrahedra", "tetrahedralize"}}};

/// Returns the key of statistics: the last name of the path.
std::string key_of(std::string_view path) {
    std::string_view name = path.substr(path.rfind('/') + 1); // npos + 1 is 0
    const auto* const found =
        std::ranges::find(joined, name, [](const auto& j) { return j.first; });
    if (found != joined.end()) name = found->second;
    std::string key(name);
    std::ranges::replace(key, ' ', '_');
    return key;
}

} // namespace

void StageSeconds::end(std::string_view path, double seconds, Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    const auto length = [](double s) {
        return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(s));
    };
    const Clock::time_point begin = now - length(seconds);
    double own = seconds;
    // Begins are computed, so a stage is within this one if most of it is.
    while (!ended_.empty() && ended_.back().begin + length(ended_.back().seconds / 2) > begin) {
        own -= ended_.back().seconds;
        ended_.pop_back();
    }
    ended_.push_back({begin, seconds});
    const std::string key = key_of(path);
    auto entry = std::ranges::find(seconds_, key, &std::pair<std::string, double>::first);
    if (entry == seconds_.end()) entry = seconds_.insert(entry, {key, 0});
    entry->second += std::max(own, 0.0);
}

std::vector<std::pair<std::string, double>> StageSeconds::all() const {
    const std::lock_guard lock(mutex_);
    return seconds_;
}

} // namespace terrane::cli
