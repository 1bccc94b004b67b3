// SPDX-License-Identifier: LGPL-3.0-or-later
//
// check_files IN...: counts what is wrong with the triangles of all files, exactly, by kind.
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include <terrane/terrane.hpp>

int main(int argc, char** argv) {
    std::vector<terrane::Surface> surfaces;
    for (int i = 1; i < argc; ++i) {
        const auto read = terrane::read_surfaces(argv[i]);
        if (!read) {
            std::fprintf(stderr, "%s\n", read.error().message().c_str());
            return 2;
        }
        surfaces.insert(surfaces.end(), read->begin(), read->end());
    }
    const auto report = terrane::check(surfaces);
    if (!report) {
        std::fprintf(stderr, "%s\n", report.error().message().c_str());
        return 2;
    }
    std::map<std::string, std::size_t> by_kind;
    for (const terrane::ImproperContact& c : report->contacts)
        ++by_kind[std::string(name_of(c.kind))];
    for (const auto& [kind, count] : by_kind) std::printf("%s: %zu\n", kind.c_str(), count);
    std::printf("without area: %zu, repeated: %zu\n", report->degenerate.size(),
                report->repeated.size());
    return report->clean() ? 0 : 1;
}
