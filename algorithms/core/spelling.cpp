// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/core/spelling.hpp>

#include <algorithm>
#include <vector>

namespace terrane {
namespace {

/// Returns the number of changes that make one word of the other (restricted Damerau-Levenshtein).
std::size_t changes_between(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> least(a.size() + 1,
                                                std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i)
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                least[i][j] = i + j;
                continue;
            }
            least[i][j] = std::min({least[i - 1][j] + 1, least[i][j - 1] + 1,
                                    least[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (exchanged) least[i][j] = std::min(least[i][j], least[i - 2][j - 2] + 1);
        }
    return least[a.size()][b.size()];
}

} // namespace

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names) {
    const std::size_t most = std::min<std::size_t>(2, word.size() / 3);
    std::optional<std::string> nearest;
    std::size_t least = most + 1;
    for (const std::string& name : names) {
        const auto changes = changes_between(word, name);
        if (changes >= least) continue;
        least = changes;
        nearest = name;
    }
    return nearest;
}

} // namespace terrane
