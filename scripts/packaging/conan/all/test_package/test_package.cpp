// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>
#include <vector>

#include <terrane/algorithms/arrangement/arrangement.hpp>

int main() {
    const std::vector<terrane::Surface> surfaces{
        {"a", terrane::Role::unknown, {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}, {}},
        {"b", terrane::Role::unknown, {{1, 1, -1}, {1, 1, 1}, {3, 3, 0}}, {{0, 1, 2}}, {}}};
    const auto arranged = terrane::arrange(surfaces);
    if (!arranged || arranged->intersection_edges.empty()) return 1;
    std::printf("%zu triangles\n", arranged->triangles.size());
    return 0;
}
