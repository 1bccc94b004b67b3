// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/pillar_grid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/cells/base_below.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/io/grids/cell_text.hpp>
#include <terrane/io/grids/detail/keyword_text.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane {
namespace {

constexpr double most_pillar_cells = 1e8;

Status check_lines(const std::vector<double>& lines) {
    bool good = lines.size() >= 2;
    for (std::size_t i = 0; i < lines.size(); ++i)
        good = good && std::isfinite(lines[i]) && (i == 0 || lines[i] > lines[i - 1]);
    if (!good)
        return Error{ErrorCode::bad_option,
                     "the lines of pillars are not ascending, or fewer than 2", "lines"};
    return Done{};
}

/// Returns the number of layers in each unit.
Result<std::vector<std::uint32_t>> layers_of(const PillarOptions& options, std::size_t units) {
    std::vector<std::uint32_t> layers = options.layers;
    if (layers.size() == 1) layers.assign(units, layers[0]);
    if (layers.size() != units || std::ranges::count(layers, 0U) > 0)
        return Error{ErrorCode::bad_option,
                     fmt::format("one number of layers from 1 on, or {}, is needed", units),
                     "layers"};
    const double cells = double(options.x.size() - 1) * double(options.y.size() - 1) *
                         std::accumulate(layers.begin(), layers.end(), 0.0);
    if (cells > most_pillar_cells)
        return Error{ErrorCode::bad_option, "the grid has more than 10^8 cells", "layers"};
    return layers;
}

class PillarMaker {
public:
    PillarMaker(std::span<const Surface> horizons, const PillarOptions& options,
                std::vector<std::uint32_t> layers) :
        options_(options),
        layers_(std::move(layers)), horizons_(horizons.begin(), horizons.end()) {
        CornerPointGrid& grid = made_.grid;
        grid.nx = static_cast<std::uint32_t>(options.x.size() - 1);
        grid.ny = static_cast<std::uint32_t>(options.y.size() - 1);
        for (std::uint32_t u = 0; u < layers_.size(); ++u)
            made_.units.insert(made_.units.end(), layers_[u], u + 1);
        grid.nz = static_cast<std::uint32_t>(made_.units.size());
        const std::size_t cells = std::size_t{grid.nx} * grid.ny * grid.nz;
        grid.depths.resize(8 * cells);
        grid.active.assign(cells, 0);
    }

    Result<PillarGrid> make(const Run& run) {
        for (std::uint32_t j = 0; j < made_.grid.ny; ++j)
            for (std::uint32_t i = 0; i < made_.grid.nx; ++i) {
                if (run.stop.stop_requested())
                    return Error{ErrorCode::interrupted, "stopped on request", ""};
                add_column(i, j);
            }
        if (made_.active == 0) return Error{ErrorCode::nothing_to_do, "no cell is active", "grid"};
        const double top = -highest_, base = -lowest_;
        for (const double y : options_.y)
            for (const double x : options_.x)
                made_.grid.pillars.push_back({x, y, top + 0.0, x, y, base + 0.0});
        return std::move(made_);
    }

private:
    /// Heights of a column: per horizon, at the pillars (i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1); NaN: missing.
    using Heights = std::vector<std::array<double, 4>>;

    [[nodiscard]] Heights heights_in(std::uint32_t i, std::uint32_t j) const {
        const auto pillar = [&](unsigned k) {
            return Point3{options_.x[i + k % 2], options_.y[j + k / 2], 0};
        };
        Heights heights;
        for (const cells::BaseBelow& horizon : horizons_) {
            auto& at = heights.emplace_back();
            for (unsigned k = 0; k < 4; ++k) { // the other two span the column with it
                const Point3 p = pillar(k);
                const auto triangle = horizon.at(p, pillar(k ^ 1U), pillar(k ^ 2U));
                at[k] = triangle ? cells::height_on(*triangle, p)
                                 : std::numeric_limits<double>::quiet_NaN();
            }
        }
        return heights;
    }

    void add_column(std::uint32_t i, std::uint32_t j) {
        const Heights heights = heights_in(i, j);
        const auto is_missing = [](const std::array<double, 4>& at) {
            return std::ranges::any_of(at, [](double z) { return std::isnan(z); });
        };
        const auto missing = std::ranges::find_if(heights, is_missing);
        if (missing != heights.end()) {
            made_.gaps.push_back(
                {i, j, static_cast<std::uint32_t>(missing - heights.begin()), false});
            return; // all depths stay 0
        }
        bool is_told = false;
        std::uint32_t layer = 0;
        for (std::uint32_t u = 0; u < layers_.size(); ++u) {
            const auto &above = heights[u], &below = heights[u + 1];
            bool is_crossed = false, is_thick = false;
            for (unsigned k = 0; k < 4; ++k) {
                is_crossed = is_crossed || below[k] > above[k];
                is_thick = is_thick || below[k] < above[k];
                highest_ = std::max({highest_, above[k], below[k]});
                lowest_ = std::min({lowest_, above[k], below[k]});
            }
            if (is_crossed && !std::exchange(is_told, true)) made_.gaps.push_back({i, j, u, true});
            for (std::uint32_t n = 0; n < layers_[u]; ++n, ++layer)
                add_cell({i, j, layer}, {above, below}, double(n) / layers_[u],
                         double(n + 1) / layers_[u], is_thick && !is_crossed);
        }
    }

    void add_cell(const std::array<std::uint32_t, 3>& cell,
                  const std::array<std::array<double, 4>, 2>& between, double from, double to,
                  bool active) {
        const auto [i, j, k] = cell;
        CornerPointGrid& grid = made_.grid;
        for (unsigned corner = 0; corner < 4; ++corner)
            for (unsigned c = 0; c < 2; ++c) {
                const std::size_t at =
                    ((2 * std::size_t{k} + c) * 2 * grid.ny + 2 * j + corner / 2) * 2 * grid.nx +
                    2 * i + corner % 2;
                const double z =
                    std::lerp(between[0][corner], between[1][corner], c == 0 ? from : to);
                grid.depths[at] = z == 0 ? 0 : -z;
            }
        grid.active[(std::size_t{k} * grid.ny + j) * grid.nx + i] = active ? 1 : 0;
        made_.active += active ? 1 : 0;
    }

    const PillarOptions& options_;
    std::vector<std::uint32_t> layers_;
    std::vector<cells::BaseBelow> horizons_;
    PillarGrid made_;
    double highest_ = -std::numeric_limits<double>::infinity();
    double lowest_ = std::numeric_limits<double>::infinity();
};

} // namespace

Result<PillarGrid> make_pillar_grid(std::span<const Surface> horizons, const PillarOptions& options,
                                    const Run& run) {
    return guarded("for the grid", "grid", [&]() -> Result<PillarGrid> {
        if (horizons.size() < 2)
            return Error{ErrorCode::bad_option,
                         "two horizons at least are needed, from the top down", "horizons"};
        for (const auto* lines : {&options.x, &options.y})
            if (const auto status = check_lines(*lines); !status) return status.error();
        auto layers = layers_of(options, horizons.size() - 1);
        if (!layers) return layers.error();
        if (const auto status = validate(horizons, run); !status) return status.error();
        for (const Surface& horizon : horizons)
            if (const auto status = cells::check_folds(horizon, run); !status)
                return status.error();
        auto made = PillarMaker(horizons, options, std::move(*layers)).make(run);
        if (made) made->grid.frame = horizons[0].frame;
        return made;
    });
}

std::string to_grdecl(const PillarGrid& made, std::span<const Surface> horizons) {
    using grids::detail::append_keyword;
    std::string out = to_grdecl(made.grid, "A grid between horizons, on vertical pillars");
    out += "\n-- FIPNUM is the number of the unit:\n";
    for (std::size_t u = 0; u + 1 < horizons.size(); ++u)
        out += fmt::format("-- {} below {}, above {}\n", u + 1, detail::one_line(horizons[u].name),
                           detail::one_line(horizons[u + 1].name));
    append_keyword(out, "ACTNUM", made.grid.active, [](char a) { return a == 0 ? 0 : 1; });
    out += '\n';
    std::vector<std::uint32_t> units;
    const std::size_t columns = std::size_t{made.grid.nx} * made.grid.ny;
    for (const std::uint32_t unit : made.units) units.insert(units.end(), columns, unit);
    append_keyword(out, "FIPNUM", units, [](std::uint32_t unit) { return unit; });
    return out;
}

} // namespace terrane
