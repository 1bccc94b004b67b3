// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: results of stages that somebody changed, who has the key under which they were kept, lead to a
// sound model of the same surfaces or to an error. The input names a project and changes of what it keeps.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <terrane/algorithms/pipeline/build.hpp>

#include "bytes.hpp"
#include "report.hpp"
#include "support/work_count.hpp"

using namespace terrane;
using fuzz::require;

namespace {

using Kept = std::map<BuildStage, std::string>;

Project project_of(unsigned kind) {
    Project project;
    project.improve = ProjectImprove{};
    project.improve->options.edge_length = 5;
    if (kind == 1) project.improve->resolution.length = 1;
#ifdef TERRANE_HAS_TETGEN
    if (kind > 0) project.outputs.tetrahedra = {"vtu"};
    if (kind == 2) project.tetrahedra.refine_bad = 1;
    if (kind == 3) project.tetrahedra.move_vertices = false;
#endif
    return project;
}

/// Returns a box in four sectors, or, to be simplified, in two.
std::vector<Surface> surfaces_of(const Project& project) {
    auto surfaces = test_support::sectors();
    surfaces.resize(project.improve->resolution.length > 0 ? 2 : 3);
    return surfaces;
}

/// Builds a project from what was kept, whatever the keys; keeps nothing if `made` is null.
Result<Built> built(const Project& project, const Kept& kept, Kept* made) {
    const StageStore store{
        .find = [&](BuildStage stage, const std::string&) -> std::optional<std::string> {
            const auto at = kept.find(stage);
            if (at == kept.end()) return std::nullopt;
            return at->second;
        },
        .keep =
            [&](BuildStage stage, const std::string&, const std::string& bytes) {
                if (made != nullptr) made->try_emplace(stage, bytes);
            }};
    return build(project, {.surfaces = surfaces_of(project)}, {}, {}, store);
}

/// Returns what a project keeps; it is built once.
const Kept& kept_by(unsigned kind) {
    static std::array<Kept, 4> all;
    Kept& kept = all.at(kind);
    if (kept.empty())
        require(bool(built(project_of(kind), {}, &kept)), "the project itself can't be built");
    return kept;
}

std::size_t place_in(const std::string& text, fuzz::Bytes& bytes) {
    const std::size_t at = bytes.byte() << 16U | bytes.byte() << 8U | bytes.byte();
    return text.empty() ? 0 : at % text.size();
}

void set(std::string& text, std::size_t at, const void* value, std::size_t size) {
    if (at + size <= text.size()) std::memcpy(text.data() + at, value, size);
}

void change(std::string& text, fuzz::Bytes& bytes) {
    constexpr std::array<std::uint64_t, 8> lengths{0,         1,          2,           1U << 16U,
                                                   1U << 31U, UINT32_MAX, 1ULL << 40U, UINT64_MAX};
    const unsigned how = bytes.below(8);
    const std::size_t at = place_in(text, bytes);
    if (text.empty()) return;
    if (how == 0) text[at] = static_cast<char>(text[at] ^ 1U << bytes.below(8));
    if (how == 1) text[at] = static_cast<char>(bytes.byte());
    if (how == 2) {
        const std::uint32_t number = bytes.flag() ? bytes.byte() : UINT32_MAX - bytes.byte();
        set(text, at / 4 * 4, &number, sizeof number);
    }
    if (how == 3) set(text, at / 4 * 4, &lengths.at(bytes.below(8)), 8);
    if (how == 4) {
        const double number = bytes.any_double();
        set(text, at / 4 * 4, &number, sizeof number);
    }
    if (how == 5) text.resize(at);
    if (how == 6) text.insert(at, text.substr(place_in(text, bytes), 4 * bytes.byte()));
    if (how == 7) {
        const std::string part = text.substr(place_in(text, bytes), 4 * bytes.byte());
        set(text, at, part.data(), part.size());
    }
}

void check_sound(const Built& built) {
    require(built.improved && built.improved->improved.conforming, "no conforming mesh");
    require(built.model->mesh->surfaces == built.arranged.rounded.conforming->mesh()->surfaces,
            "other surfaces");
    if (built.filled) require(built.filled->report.violations.empty(), "unsound tetrahedra");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    const unsigned kind = bytes.below(4);
    Kept kept = kept_by(kind);
    if (bytes.flag()) kept = kept_by(bytes.below(4)); // of another project
    const unsigned stages = bytes.below(3);
    for (unsigned left = bytes.below(6); left > 0; --left)
        for (auto& [stage, text] : kept)
            if (stages == 2 || (stage == BuildStage::improve) == (stages == 0)) change(text, bytes);
    const auto again = built(project_of(kind), kept, nullptr);
    if (again)
        check_sound(*again);
    else
        require(!again.error().sentence.empty(), "an error without a sentence");
    return 0;
}
