// SPDX-License-Identifier: LGPL-3.0-or-later
//
// README.md shows the lines between the marks and what they print; a test compares both.
#include <cstddef>
#include <cstdio>

#include <terrane/terrane.hpp>

namespace {

int fail(const terrane::Error& error) {
    std::fprintf(stderr, "%s\n", error.message().c_str());
    return 2;
}

int list_blocks() {
    // [readme]
    terrane::Project project;
    project.surfaces = {{"top.ts"}, {"base.ts"}, {"fault.ts"}};
    project.volume = terrane::ProjectBox{{0, 0, -1700}, {2000, 1500, -700}};
    project.seal = 20;
    const auto built = terrane::build_model(project);
    if (!built) return fail(built.error());
    const auto& blocks = built->model->structure.blocks;
    for (std::size_t b = 1; b < blocks.size(); ++b) // 0 is the outside
        std::printf("%s: %.6f km3\n", blocks[b].name.c_str(), blocks[b].volume / 1e9);
    // [readme]
    return 0;
}

} // namespace

int main() {
    return list_blocks();
}
