// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Readers accept any bytes: they return surfaces that keep their guarantees, or an error with a
// sentence.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>
#include <string>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/gocad/gocad.hpp>
#include <terrane/io/surfaces/obj.hpp>
#include <terrane/io/surfaces/off.hpp>
#include <terrane/io/surfaces/ply.hpp>
#include <terrane/io/surfaces/stl.hpp>

#include "support/paths.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;

namespace {

constexpr Format readable[] = {
    Format::gocad,  Format::obj,  Format::off,    Format::stl,    Format::ply,  Format::irap,
    Format::zmap,   Format::cps3, Format::esri,   Format::xyz,    Format::vset, Format::vtp,
    Format::msh,    Format::vtk,  Format::dxf,    Format::grdecl, Format::vtu,  Format::sticks,
    Format::surfer, Format::vts,  Format::landxml};

bool keeps_its_promises(const std::vector<Surface>& surfaces) {
    bool any = false;
    for (const auto& surface : surfaces) {
        for (const auto& p : surface.vertices)
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return false;
        for (const auto& triangle : surface.triangles)
            for (const auto v : triangle)
                if (v >= surface.vertices.size()) return false;
        any = any || !surface.triangles.empty();
    }
    return any;
}

void check_total(std::string_view bytes) {
    for (const auto format : readable) {
        const auto result = parse_surfaces(bytes, "a", format);
        if (result ? !keeps_its_promises(result.value())
                   : result.error().sentence.empty() || result.error().place.empty()) {
            INFO(bytes);
            CHECK(false);
        }
    }
    (void)read_gocad_model(bytes, "a", "a");
}

/// Makes one to four random edits: changes a byte, cuts, moves a piece, or inserts a provoking
/// token.
std::string mutated(std::string text, std::mt19937& random) {
    static const char* const tokens[] = {" 4294967296 ", "-1 ",  "\n",   "{",     "}",
                                         "1e999 ",       "nan ", "\\\n", "END\n", "GOCAD TSurf 1\n",
                                         " 0 ",          "/"};
    for (auto edits = 1 + random() % 4; edits > 0 && !text.empty(); --edits) {
        const auto at = random() % text.size();
        const auto length = random() % std::min<std::size_t>(text.size() - at, 40);
        switch (random() % 5) {
        case 0:
            text[at] = static_cast<char>(random());
            break;
        case 1:
            text.erase(at, length);
            break;
        case 2:
            text.insert(random() % text.size(), text.substr(at, length));
            break;
        case 3:
            text.insert(at, tokens[random() % std::size(tokens)]);
            break;
        default:
            text.resize(at);
            break;
        }
    }
    return text;
}

} // namespace

TEST_CASE("readers are total", "[io][files]") {
    const auto mesh = float_mesh();
    std::vector<std::string> seeds{to_gocad(mesh), to_obj(mesh),       to_off(mesh),
                                   to_ply(mesh),   to_stl_ascii(mesh), to_stl(mesh).value()};
    seeds.push_back(read_file(test_data() + "/ringmesh/split_cube.ml").value());
    for (const std::string format : {"irap", "zmap", "cps3", "asc", "xyz", "vs", "vtp", "vtk",
                                     "msh", "dxf", "grdecl", "vtu", "sticks"})
        for (const auto& seed :
             std::filesystem::directory_iterator(source_dir() + "/fuzz/corpus/read_" + format))
            seeds.push_back(read_file(seed.path()).value());
    std::sort(seeds.begin(), seeds.end()); // folders are listed in no particular order
    std::mt19937 random(20240501);
    check_total("");
    for (const auto& seed : seeds) {
        check_total(seed);
        for (int i = 0; i < 500; ++i) check_total(mutated(seed, random));
    }
}
