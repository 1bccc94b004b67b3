// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Property: the reader of .pvtp files joins pieces if and only if each number occurs as documented, all
// coordinates are finite and all pieces name the same surfaces. Other code joins the same pieces, and
// both meshes are equal. For any other files, the reader returns a mesh that can be written, or an
// error with a sentence and a place.
// If the first byte is odd, the others are files, separated by the byte 30: the .pvtp file, then the
// pieces 0.vtp, 1.vtp, ...; if it is even, they are numbers, of which the target makes pieces.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/io/files.hpp>
#include <terrane/io/meshes/pvtp.hpp>

#include "bytes.hpp"
#include "report.hpp"
#include "support/files.hpp"

using namespace terrane;
using fuzz::require;

namespace {

namespace fs = std::filesystem;
using tiles::TilePiece;

void write(const fs::path& path, std::string_view contents) {
    std::ofstream(path, std::ios::binary) << contents;
}

/// Reads the files in a folder, which is made once.
Result<Mesh> joined(const std::string& names, const std::vector<std::string>& pieces) {
    static const test_support::TemporaryFolder folder;
    write(folder.path() / "m.pvtp", names);
    for (std::size_t k = 0; k < pieces.size(); ++k)
        write(folder.path() / (std::to_string(k) + ".vtp"), pieces[k]);
    auto mesh = read_pvtp(folder.path() / "m.pvtp");
    for (std::size_t k = 0; k < pieces.size(); ++k)
        fs::remove(folder.path() / (std::to_string(k) + ".vtp"));
    return mesh;
}

bool is_finite(const Point3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

void check_error(const Error& error) {
    require(!error.sentence.empty(), "an error without a sentence");
    require(!error.place.empty(), "an error without a place");
    require(error.code != ErrorCode::internal, "an internal error");
}

/// Checks that no stage after the reader can be surprised.
void check_sound(const Mesh& mesh) {
    const std::size_t n = mesh.triangles.size();
    require(std::ranges::all_of(mesh.vertices, is_finite), "a coordinate that is not finite");
    for (const Triangle& t : mesh.triangles)
        for (const auto v : t) require(v < mesh.vertices.size(), "a corner that does not exist");
    for (const auto* lists : {&mesh.surfaces_of, &mesh.regions_of, &mesh.parents_of})
        require(lists->size() == n, "a list without a triangle, or the reverse");
    for (const auto s : mesh.surfaces_of.values)
        require(s < mesh.surfaces.size(), "a triangle of a surface that does not exist");
    const auto text = format_mesh(mesh, Format::vtp);
    require(text.has_value(), "what was read can't be written");
    if (n == 0) return; // no surface, as readers see it
    const auto again = parse_surfaces(*text, "m", Format::vtp);
    if (!again) fuzz::fail("what was written can't be read: " + again.error().message());
}

void check_files(std::string_view contents) {
    std::vector<std::string> parts(1);
    for (const char c : contents)
        if (c == 30 && parts.size() < 5)
            parts.emplace_back();
        else
            parts.back() += c;
    const auto mesh = joined(parts[0], {parts.begin() + 1, parts.end()});
    if (mesh)
        check_sound(*mesh);
    else
        check_error(mesh.error());
}

/// Pieces that are mostly right, from a few bytes each.
std::vector<TilePiece> pieces_of(fuzz::Bytes& bytes) {
    std::vector<TilePiece> pieces(1 + bytes.below(3));
    for (TilePiece& piece : pieces) {
        Mesh& mesh = piece.mesh;
        const unsigned surfaces = bytes.below(8) == 7 ? bytes.below(4) : 2;
        for (unsigned s = 0; s < surfaces; ++s)
            mesh.surfaces.push_back({s == 0 ? "top" : "fault " + std::to_string(s),
                                     bytes.below(16) == 15 ? Role::fault : Role::horizon});
        for (unsigned v = bytes.below(7); v > 0; --v) {
            const std::uint32_t id = bytes.below(8);
            piece.vertex_ids.push_back(id);
            mesh.vertices.push_back({double(id), 0.1 * (id * id), 7.0 - id});
            const unsigned change = bytes.below(32);
            if (change == 31) mesh.vertices.back().y = bytes.any_double();
            if (change == 30) mesh.vertices.back().x += 1;
        }
        for (unsigned t = bytes.below(5); t > 0; --t) {
            const auto corners =
                static_cast<unsigned>(mesh.vertices.size() + (bytes.below(32) == 31));
            piece.triangle_ids.push_back(bytes.below(8));
            Triangle& corner = mesh.triangles.emplace_back();
            for (auto& v : corner) v = corners == 0 ? bytes.below(2) : bytes.below(corners);
            for (auto* lists : {&mesh.surfaces_of, &mesh.regions_of, &mesh.parents_of}) {
                const unsigned kind = bytes.below(32);
                if (kind < 31) lists->values.push_back(kind % 2);
                if (kind == 30) lists->values.push_back(bytes.below(4));
                lists->close();
            }
        }
    }
    return pieces;
}

/// Returns the mesh that the pieces are, or none. Of regions and parents files keep the first.
std::optional<Mesh> expected_of(const std::vector<TilePiece>& pieces) {
    std::map<std::uint32_t, Point3> vertices;
    std::map<std::uint32_t, std::pair<const TilePiece*, std::size_t>> triangles;
    for (const TilePiece& piece : pieces) {
        const Mesh& m = piece.mesh;
        if (m.surfaces.empty() || m.surfaces != pieces[0].mesh.surfaces) return std::nullopt;
        for (std::size_t v = 0; v < m.vertices.size(); ++v) {
            if (!is_finite(m.vertices[v])) return std::nullopt;
            if (vertices.try_emplace(piece.vertex_ids[v], m.vertices[v]).first->second !=
                m.vertices[v])
                return std::nullopt;
        }
        for (std::size_t t = 0; t < m.triangles.size(); ++t)
            if (!triangles.try_emplace(piece.triangle_ids[t], &piece, t).second)
                return std::nullopt;
    }
    Mesh mesh;
    mesh.surfaces = pieces[0].mesh.surfaces;
    for (const auto& [id, place] : vertices) {
        if (id != mesh.vertices.size()) return std::nullopt;
        mesh.vertices.push_back(place);
    }
    for (const auto& [id, where] : triangles) {
        const auto& [piece, t] = where;
        const Mesh& m = piece->mesh;
        if (id != mesh.triangles.size()) return std::nullopt;
        Triangle& corners = mesh.triangles.emplace_back();
        for (unsigned i = 0; i < 3; ++i) {
            if (m.triangles[t][i] >= m.vertices.size()) return std::nullopt;
            corners[i] = piece->vertex_ids[m.triangles[t][i]];
        }
        if (m.surfaces_of[t].empty() || m.regions_of[t].empty() || m.parents_of[t].empty())
            return std::nullopt;
        for (const auto s : m.surfaces_of[t])
            if (s >= m.surfaces.size()) return std::nullopt;
        mesh.surfaces_of.push_back(m.surfaces_of[t]);
        mesh.regions_of.push_back(std::vector{m.regions_of[t][0]});
        mesh.parents_of.push_back(std::vector{m.parents_of[t][0]});
    }
    return mesh;
}

void check_pieces(fuzz::Bytes& bytes) {
    const auto pieces = pieces_of(bytes);
    std::vector<std::string> texts, names;
    for (const TilePiece& piece : pieces) {
        names.push_back(std::to_string(texts.size()) + ".vtp");
        texts.push_back(to_vtp_piece(piece));
    }
    const auto mesh = joined(to_pvtp(names), texts);
    const auto expected = expected_of(pieces);
    if (!mesh) {
        check_error(mesh.error());
        if (expected) fuzz::fail("sound pieces are refused: " + mesh.error().message());
        return;
    }
    require(expected.has_value(), "pieces that do not fit are joined");
    require(mesh->vertices == expected->vertices, "vertices are not as their numbers say");
    require(mesh->triangles == expected->triangles, "triangles are not as their numbers say");
    require(mesh->surfaces == expected->surfaces, "other surfaces");
    require(mesh->surfaces_of == expected->surfaces_of, "triangles have other surfaces");
    require(mesh->regions_of == expected->regions_of, "triangles have other regions");
    require(mesh->parents_of == expected->parents_of, "triangles have other parents");
    check_sound(*mesh);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    if (data[0] % 2 == 1) {
        check_files({reinterpret_cast<const char*>(data) + 1, size - 1});
        return 0;
    }
    fuzz::Bytes bytes(data + 1, size - 1);
    check_pieces(bytes);
    return 0;
}
