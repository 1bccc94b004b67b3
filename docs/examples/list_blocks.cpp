// SPDX-License-Identifier: LGPL-3.0-or-later
//
// list_blocks IN...: makes a model of the surfaces in a box and lists its blocks.
#include <cstddef>
#include <cstdio>

#include <terrane/terrane.hpp>

int main(int argc, char** argv) {
    terrane::Project project;
    for (int i = 1; i < argc; ++i) project.surfaces.push_back({argv[i]});
    project.volume = terrane::ProjectBox{{0, 0, -1700}, {2000, 1500, -700}};
    const auto built = terrane::build_model(project);
    if (!built) {
        std::fprintf(stderr, "%s\n", built.error().message().c_str());
        return 2;
    }
    const auto& blocks = built->model->structure.blocks;
    for (std::size_t b = 1; b < blocks.size(); ++b) // 0 is the outside
        std::printf("block %zu, %s: volume %.6g, %zu neighbours\n", b, blocks[b].name.c_str(),
                    blocks[b].volume, blocks[b].neighbours.size());
    return 0;
}
