// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Uses the component without anything else of Terrane.
#include <cstdio>

#include <terrane/fuzzing/mutate.hpp>

int main() {
    namespace fuzzing = terrane::fuzzing;
    const auto found = fuzzing::find_flaw(
        [](fuzzing::Bytes& bytes) { return fuzzing::any_mesh(bytes, 20); },
        [](const fuzzing::Soup& soup) {
            return std::string(triangle_count(soup) > 15 ? "many triangles" : "");
        },
        10'000, 1);
    std::puts(found.flaw.c_str());
    return found.flaw.empty() ? 1 : 0;
}
