// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The reader of .pvtp files joins pieces that fit together, and names the file of a piece that does
// not. The fuzz target `pieces` makes random pieces and joins them by other code.
#include "support/files.hpp"

#include <terrane/io/meshes/pvtp.hpp>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace terrane;
using tiles::TilePiece;

/// A piece with one triangle, whose corners have the numbers first, first + 1 and first + 2.
TilePiece triangle_from(std::uint32_t first, std::uint32_t number) {
    TilePiece piece;
    piece.mesh.surfaces = {{"top", Role::horizon}, {"fault", Role::fault}};
    for (std::uint32_t v = first; v < first + 3; ++v) {
        piece.vertex_ids.push_back(v);
        piece.mesh.vertices.push_back({double(v), 0.1 * (v % 2), double(v * v)});
    }
    piece.mesh.triangles = {{0, 1, 2}};
    piece.triangle_ids = {number};
    for (auto* lists : {&piece.mesh.surfaces_of, &piece.mesh.regions_of, &piece.mesh.parents_of}) {
        lists->values = {number};
        lists->close();
    }
    return piece;
}

class Pieces {
public:
    Pieces() : pieces{triangle_from(0, 1), triangle_from(2, 0)} {}

    [[nodiscard]] Result<Mesh> joined(const std::vector<std::string>& names = {"0.vtp",
                                                                               "1.vtp"}) const {
        for (std::size_t k = 0; k < pieces.size(); ++k)
            std::ofstream(folder / (std::to_string(k) + ".vtp")) << to_vtp_piece(pieces[k]);
        std::ofstream(folder / "m.pvtp") << to_pvtp(names);
        return read_pvtp(folder / "m.pvtp");
    }
    void check_refused(const std::string& sentence, const std::string& file) const {
        const auto mesh = joined();
        REQUIRE_FALSE(mesh);
        INFO(mesh.error().message());
        CHECK(mesh.error().sentence.find(sentence) != std::string::npos);
        CHECK(std::filesystem::path(mesh.error().place).filename() == file);
    }

    test_support::TemporaryFolder folder;
    std::vector<TilePiece> pieces;
};

} // namespace

TEST_CASE("PVTP: pieces are joined by their numbers") {
    const auto mesh = Pieces().joined();
    REQUIRE(mesh);
    REQUIRE(mesh->vertices.size() == 5);
    CHECK(mesh->vertices[3] == Point3{3, 0.1, 9});
    CHECK(mesh->triangles == std::vector<Triangle>{{2, 3, 4}, {0, 1, 2}});
    CHECK(mesh->surfaces_of[1][0] == 1);
    CHECK(mesh->surfaces[1].name == "fault");
}

TEST_CASE("PVTP: pieces that name different surfaces are refused") {
    Pieces more;
    more.pieces[1].mesh.surfaces.push_back({"added", Role::fault});
    more.pieces[1].mesh.surfaces_of.values[0] = 2; // the first piece has no such surface
    more.check_refused("different surfaces", "1.vtp");
    Pieces other;
    other.pieces[1].mesh.surfaces[1].name = "F2";
    other.check_refused("different surfaces", "1.vtp");
}

TEST_CASE("PVTP: numbers that are not finite are refused") {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Pieces some;
        some.pieces[1].mesh.vertices[2].y = bad;
        some.check_refused("a coordinate is not finite", "1.vtp");
    }
}

TEST_CASE("PVTP: a piece is named once, and is in the folder of the file") {
    const Pieces some;
    const auto twice = some.joined({"0.vtp", "1.vtp", "./0.vtp"});
    REQUIRE_FALSE(twice);
    CHECK(twice.error().sentence.find("named twice") != std::string::npos);
    for (const char* const outside : {"../0.vtp", "/tmp/0.vtp", ""}) {
        const auto refused = some.joined({outside});
        REQUIRE_FALSE(refused);
        CHECK(refused.error().code == ErrorCode::unsupported);
    }
    std::filesystem::create_symlink("/etc/passwd", some.folder / "link.vtp");
    const auto linked = some.joined({"link.vtp"});
    REQUIRE_FALSE(linked);
    CHECK(linked.error().code == ErrorCode::unsupported);
}
