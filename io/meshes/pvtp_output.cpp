// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/pvtp_output.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/meshes/pvtp.hpp>

namespace terrane {

namespace fs = std::filesystem;
using namespace tiles;

namespace {

/// Gives the folder and the file their names, the folder first.
Status publish(NewFolder& folder, const fs::path& path, std::size_t pieces, bool has_volumes) {
    std::optional<FileSet> together;
    if (!FileSet::current()) together.emplace();
    if (auto done = folder.publish(); !done) return done;
    std::vector<std::string> names;
    for (std::size_t k = 0; k < pieces; ++k)
        names.push_back((folder_of_pieces(path).filename() / name_of_piece(path, k)).string());
    if (auto done = write_file(path, to_pvtp(names, has_volumes)); !done) return done;
    return together ? together->publish() : Status(Done{});
}

} // namespace

Status check_pvtp(const fs::path& path) {
    return check_new_folder(folder_of_pieces(path));
}

Status write_pvtp(Supersteps& tiles, const fs::path& path, bool has_volumes,
                  const TilePiece* whole) {
    // In the process of the last tile, whose turn is the last in a process: nothing can fail after it.
    std::optional<NewFolder> folder;
    const auto is_last = [&](const Tile& b) { return b.index + 1 == tiles.tiles(); };
    auto done = tiles.step("write", [&](Tile& b, Inbox&, Outbox& out) -> Status {
        if (!is_last(b)) return Done{};
        auto made = NewFolder::create(folder_of_pieces(path));
        if (!made) return made.error();
        folder = std::move(*made);
        const std::string name = folder->temporary().string();
        for (std::size_t to = 0; to < out.tiles(); ++to) out.put_text(to, 0, name);
        return Done{};
    });
    if (!done) return done;
    done = tiles.step("write", [&](Tile& b, Inbox& in, Outbox&) -> Status {
        const auto name = in.all<char>(0);
        const fs::path file =
            fs::path(std::string(name.begin(), name.end())) / name_of_piece(path, b.index);
        if (!whole) return write_file(file, to_vtp_piece(piece_of(b), has_volumes));
        TilePiece empty;
        empty.mesh.surfaces = piece_of(b).mesh.surfaces;
        return write_file(file, to_vtp_piece(b.index == 0 ? *whole : empty, has_volumes));
    });
    if (!done) return done;
    return tiles.step("write", [&](Tile& b, Inbox&, Outbox&) -> Status {
        return is_last(b) ? publish(*folder, path, tiles.tiles(), has_volumes) : Status(Done{});
    });
}

} // namespace terrane
