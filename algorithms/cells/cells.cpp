// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/sections/sections.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include <terrane/algorithms/cells/detail/cell_column.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/stage_timer.hpp>
#include <terrane/algorithms/mesh/validation.hpp>

namespace terrane {

using namespace cells::detail;

namespace {

constexpr double most_cells = 1e9;

/// Returns the least box around a mesh.
CellBox box_around(const Mesh& mesh) {
    constexpr double far = std::numeric_limits<double>::infinity();
    CellBox box{{far, far, far}, {-far, -far, -far}};
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t v : triangle)
            for (std::size_t a = 0; a < 3; ++a) {
                const double x = along(mesh.vertices[v], a);
                along(box.low, a) = std::min(along(box.low, a), x);
                along(box.high, a) = std::max(along(box.high, a), x);
            }
    return box;
}

std::vector<double>& planes_across(RectilinearGrid& grid, std::size_t axis) {
    return axis == 0 ? grid.x : axis == 1 ? grid.y : grid.z;
}

Error too_many_cells() {
    return {ErrorCode::bad_option, "the grid has more than 10^9 cells", "grid"};
}

Status check_planes(const std::vector<double>& planes, const char* axis) {
    const std::string name(axis);
    if (planes.size() < 2)
        return Error{ErrorCode::bad_option, "the grid has no cell along " + name, "grid"};
    for (std::size_t i = 0; i < planes.size(); ++i)
        if (!std::isfinite(planes[i]) || (i > 0 && !(planes[i] > planes[i - 1])))
            return Error{ErrorCode::bad_option,
                         "the planes of the grid across " + name + " are not ascending", "grid"};
    return Done{};
}

Status check_cells(const RectilinearGrid& grid) {
    for (const auto& [planes, axis] : {std::pair{&grid.x, "x"}, {&grid.y, "y"}, {&grid.z, "z"}})
        if (const auto status = check_planes(*planes, axis); !status) return status.error();
    const auto [nx, ny, nz] = grid.counts();
    if (double(nx) * double(ny) * double(nz) > most_cells) return too_many_cells();
    return Done{};
}

/// Returns the first piece of each column, and one more: the number of pieces.
std::vector<std::size_t> first_in_columns(const std::vector<CellPiece>& pieces,
                                          const PlacesOfPieces& places) {
    std::vector<std::size_t> first(places.nx * places.ny + 1);
    for (const CellPiece& piece : pieces) ++first[places.column_of(piece.place) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    return first;
}

/// Fills the cells of a grid, column by column.
class CellFiller {
public:
    CellFiller(const Mesh& mesh, const Volumes& volumes, const RectilinearGrid& grid,
               const Run& run) :
        mesh_(mesh),
        volumes_(volumes), grid_(grid), run_(run), places_(grid),
        pieces_(find_pieces(mesh, volumes, grid, run)), first_(first_in_columns(pieces_, places_)) {
    }

    Result<BlocksInCells> fill() {
        if (const auto status = locate(); !status) return status.error();
        found_.block_of.resize(grid_.size());
        auto parts = parts_of_ranges<std::vector<CellShare>>(
            columns(), run_,
            [&](std::size_t first, std::size_t last) { return shares_in(first, last); });
        if (run_.stop.stop_requested())
            return Error{ErrorCode::interrupted, "stopped on request", ""};
        gather(parts);
        return std::move(found_);
    }

private:
    struct CellShare {
        std::uint32_t cell = 0;
        BlockShare share{};
    };

    [[nodiscard]] std::size_t columns() const { return first_.size() - 1; }
    [[nodiscard]] std::size_t cell(std::size_t column, std::uint64_t layer) const {
        return layer * columns() + column;
    }
    [[nodiscard]] std::span<const CellPiece> pieces_in(std::size_t column) const {
        return std::span(pieces_).subspan(first_[column], first_[column + 1] - first_[column]);
    }

    /// Locates the centres of cells, where the cell above does not say their block.
    Status locate() {
        const CellColumn walker(mesh_, volumes_, grid_);
        std::vector<Point3> centres;
        first_located_.assign(1, 0);
        for (std::size_t c = 0; c < columns(); ++c) {
            walker.for_located(c, pieces_in(c), [&](std::uint64_t layer) {
                centres.push_back(grid_.centre(cell(c, layer)));
            });
            first_located_.push_back(centres.size());
        }
        auto located = locate_points(centres, mesh_, volumes_, run_);
        if (!located) return located.error();
        located_ = std::move(*located);
        return Done{};
    }

    std::vector<CellShare> shares_in(std::size_t first, std::size_t last) {
        std::vector<CellShare> shares;
        std::vector<LayerShare> of_column;
        CellColumn walker(mesh_, volumes_, grid_);
        for (std::size_t c = first; c < last; ++c) {
            if (run_.stop.stop_requested()) break;
            of_column.clear();
            const auto located = std::span(located_).subspan(
                first_located_[c], first_located_[c + 1] - first_located_[c]);
            walker(c, pieces_in(c), located, of_column,
                   [&](std::uint64_t layer, std::uint32_t block) {
                       found_.block_of[cell(c, layer)] = BlockId(block);
                   });
            for (const LayerShare& s : of_column)
                shares.push_back({static_cast<std::uint32_t>(cell(c, s.layer)), s.share});
        }
        return shares;
    }

    void gather(std::vector<std::vector<CellShare>>& parts) {
        auto& first = found_.first;
        first.assign(grid_.size() + 1, 0);
        for (const auto& part : parts)
            for (const CellShare& s : part) ++first[s.cell + 1];
        std::partial_sum(first.begin(), first.end(), first.begin());
        found_.shares.resize(first.back());
        auto next = first;
        for (auto& part : parts) {
            for (const CellShare& s : part) found_.shares[next[s.cell]++] = s.share;
            part = {};
        }
    }

    const Mesh& mesh_;
    const Volumes& volumes_;
    const RectilinearGrid& grid_;
    const Run& run_;
    PlacesOfPieces places_;
    std::vector<CellPiece> pieces_;
    std::vector<std::size_t> first_;         ///< per column: its first piece
    std::vector<std::size_t> first_located_; ///< per column: its first located centre
    std::vector<std::uint32_t> located_;     ///< blocks of centres
    BlocksInCells found_;
};

/// Returns the shares of cells of unit thickness in the whole, along an axis.
std::vector<double> widths_of(const std::vector<double>& planes) {
    std::vector<double> widths;
    const double all = planes.back() / 2 - planes.front() / 2; // no overflow
    for (std::size_t i = 0; i + 1 < planes.size(); ++i)
        widths.push_back((planes[i + 1] / 2 - planes[i] / 2) / all);
    return widths;
}

/// Returns the sum of the fractions of each block, times the sizes of the cells in units of the grid.
std::vector<double> sums_of_blocks(const BlocksInCells& found, const RectilinearGrid& grid,
                                   std::size_t blocks) {
    const auto x = widths_of(grid.x), y = widths_of(grid.y), z = widths_of(grid.z);
    std::vector<long double> sums(blocks);
    std::size_t cell = 0;
    for (const double dz : z)
        for (const double dy : y)
            for (const double dx : x) {
                for (std::size_t s = found.first[cell]; s < found.first[cell + 1]; ++s)
                    sums[found.shares[s].block] += found.shares[s].fraction * (dx * dy * dz);
                ++cell;
            }
    return {sums.begin(), sums.end()};
}

bool is_within(const CellBox& box, const RectilinearGrid& grid) {
    return box.low.x >= grid.x.front() && box.high.x <= grid.x.back() &&
           box.low.y >= grid.y.front() && box.high.y <= grid.y.back() &&
           box.low.z >= grid.z.front() && box.high.z <= grid.z.back();
}

/// Throws unless the fractions of each block add up to its volume. Rounding changes a sum by less than the share.
void require_sums(const BlocksInCells& found, const Mesh& mesh, const Volumes& volumes,
                  const RectilinearGrid& grid) {
    constexpr double share = 1e-13, least = 1e-290;
    const auto differ = [](double a, double b) {
        return std::max(a, b) > least && std::fabs(a - b) > share * std::max(a, b);
    };
    if (std::min({grid.x.back() - grid.x.front(), grid.y.back() - grid.y.front(),
                  grid.z.back() - grid.z.front()}) < least)
        return; // doubles can't tell
    const auto& whole = found.fractions;
    const auto sums = sums_of_blocks(found, grid, whole.size());
    const double size = (grid.x.back() - grid.x.front()) * (grid.y.back() - grid.y.front()) *
                        (grid.z.back() - grid.z.front());
    const bool has_all = is_within(box_around(mesh), grid) && std::isnormal(size);
    for (std::size_t b = 0; b < whole.size(); ++b) {
        if (differ(sums[b], whole[b]))
            throw std::logic_error("the fractions of a block do not add up to its volume");
        if (b > 0 && has_all && differ(whole[b] * size, volumes.measures[b]))
            throw std::logic_error("the volume of a block in the grid is not its measure");
    }
}

Result<BlocksInCells> filled(const Mesh& mesh, const Volumes& volumes, const RectilinearGrid& grid,
                             const Run& run) {
    auto found = CellFiller(mesh, volumes, grid, run).fill();
    if (!found) return found;
    const RectilinearGrid whole{{grid.x.front(), grid.x.back()},
                                {grid.y.front(), grid.y.back()},
                                {grid.z.front(), grid.z.back()}};
    const auto in_whole = CellFiller(mesh, volumes, whole, run).fill();
    if (!in_whole) return in_whole.error();
    found->fractions.resize(volumes.measures.size());
    for (const BlockShare& s : in_whole->shares) found->fractions.at(s.block) = s.fraction;
    require_sums(*found, mesh, volumes, grid);
    return found;
}

} // namespace

Point3 RectilinearGrid::centre(std::size_t cell) const {
    const auto [nx, ny, nz] = counts();
    const auto middle = [](const std::vector<double>& planes, std::size_t i) {
        return std::midpoint(planes[i], planes[i + 1]);
    };
    return {middle(x, cell % nx), middle(y, cell / nx % ny), middle(z, cell / nx / ny)};
}

double BlocksInCells::fraction(std::size_t cell, BlockId block) const {
    for (std::size_t s = first[cell]; s < first[cell + 1]; ++s)
        if (shares[s].block == block) return shares[s].fraction;
    return 0;
}

Result<RectilinearGrid> cells_with_steps(const Mesh& mesh, const std::array<double, 3>& steps) {
    return guarded("for the grid", "grid", [&]() -> Result<RectilinearGrid> {
        if (mesh.triangles.empty())
            return Error{ErrorCode::nothing_to_do, "there is no triangle", "grid"};
        const CellBox box = box_around(mesh);
        RectilinearGrid grid;
        std::array<double, 3> first{}, count{};
        for (std::size_t a = 0; a < 3; ++a) {
            if (!(steps[a] > 0) || !std::isfinite(steps[a]))
                return Error{ErrorCode::bad_option, "a step of the grid is not positive", "grid"};
            first[a] = std::floor(along(box.low, a) / steps[a]);
            count[a] = std::max(std::ceil(along(box.high, a) / steps[a]) - first[a], 1.0);
        }
        if (!(count[0] * count[1] * count[2] <= most_cells)) return too_many_cells();
        for (std::size_t a = 0; a < 3; ++a)
            for (double n = 0; n <= count[a]; ++n)
                planes_across(grid, a).push_back((first[a] + n) * steps[a]);
        if (const auto status = check_cells(grid); !status) return status.error();
        return grid;
    });
}

Result<RectilinearGrid> cells_by_count(const Mesh& mesh,
                                       const std::array<std::uint32_t, 3>& counts) {
    return guarded("for the grid", "grid", [&]() -> Result<RectilinearGrid> {
        if (mesh.triangles.empty())
            return Error{ErrorCode::nothing_to_do, "there is no triangle", "grid"};
        if (double(counts[0]) * counts[1] * counts[2] > most_cells) return too_many_cells();
        const CellBox box = box_around(mesh);
        RectilinearGrid grid;
        for (std::size_t a = 0; a < 3; ++a) {
            const double low = along(box.low, a), high = along(box.high, a);
            auto& planes = planes_across(grid, a);
            for (std::uint32_t n = 0; n < counts[a]; ++n)
                planes.push_back(std::lerp(low, high, double(n) / counts[a]));
            planes.push_back(high);
        }
        if (const auto status = check_cells(grid); !status) return status.error();
        return grid;
    });
}

Result<BlocksInCells> blocks_in_cells(const Mesh& mesh, const Volumes& volumes,
                                      const RectilinearGrid& grid, const Run& run) {
    return guarded("for the cells", "grid", [&]() -> Result<BlocksInCells> {
        const StageTimer timer(run, "cells");
        if (const auto status = check_cells(grid); !status) return status.error();
        if (const auto status = validate_mesh(mesh, run); !status) return status.error();
        if (volumes.of_sides.size() != mesh.triangles.size())
            return Error{ErrorCode::internal, "the volumes are not those of the mesh", "grid"};
        return filled(mesh, volumes, grid, run);
    });
}

} // namespace terrane
