// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/cells/prisms.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <terrane/algorithms/cells/base_below.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/kernel/nearest.hpp>
#include <terrane/kernel/predicates.hpp>

namespace terrane {

using namespace cells;

namespace {

constexpr std::uint32_t most_layers = 10000;
constexpr double most_prisms = 1e9;

Status check_options(const PrismOptions& options, const Surface& top) {
    const auto bad = [](const char* sentence, const char* place) {
        return Error{ErrorCode::bad_option, sentence, place};
    };
    if (options.layers < 1 || options.layers > most_layers)
        return bad("the number of layers is not from 1 to 10000", "layers");
    const bool is_even = options.follow == PrismLayers::proportional;
    if (is_even && options.thickness != 0)
        return bad("is for layers that follow the top or the base", "thickness");
    if (!is_even && (!(options.thickness > 0) || !std::isfinite(options.thickness)))
        return bad("layers that follow a surface need a thickness above 0", "thickness");
    if (double(top.triangles.size()) * options.layers > most_prisms)
        return bad("makes more than 10^9 prisms", "layers");
    return Done{};
}

/// A vertical between the surfaces: its nodes from the top down, where layers without thickness repeat one.
using Column = std::vector<std::uint32_t>;

class PrismMaker {
public:
    PrismMaker(const Surface& top, const Surface& base, const PrismOptions& options) :
        top_(top), base_(base), options_(options) {}

    /// Adds the cells below a triangle of the top.
    void add(std::uint32_t number) {
        Triangle t = top_.triangles[number];
        const auto at = [&](std::size_t k) -> const Point3& { return top_.vertices[t[k % 3]]; };
        const Sign turn = orient2d(Axis::z, at(0), at(1), at(2));
        if (turn == Sign::Zero) return;
        std::array<double, 3> base{};
        for (std::uint32_t k = 0; k < 3; ++k) {
            const auto below = base_.at(at(k), at(k + 1), at(k + 2));
            const bool is_crossed =
                below && orient3d((*below)[0], (*below)[1], (*below)[2], at(k)) == Sign::Negative;
            if (!below || is_crossed) return mesh_.gaps.push_back({number, k, is_crossed});
            base[k] = height_on(*below, at(k));
        }
        if (turn == Sign::Negative) {
            std::swap(t[1], t[2]);
            std::swap(base[1], base[2]);
        }
        std::array<const Column*, 3> columns{};
        for (std::size_t k = 0; k < 3; ++k) columns[k] = &column(at(k), base[k]);
        for (std::uint32_t layer = 0; layer < options_.layers; ++layer)
            add_cell(columns, layer, number);
        add_volume({at(0), at(1), at(2)}, base);
    }

    PrismMesh finish() {
        mesh_.volume = nearest_quotient(six_volumes_, Exact(6.0));
        return std::move(mesh_);
    }

private:
    /// Returns the height between a layer and the next one, from 0 at the top.
    [[nodiscard]] double level(double top, double base, std::uint32_t n) const {
        if (n == 0) return top;
        if (n == options_.layers) return base;
        switch (options_.follow) {
        case PrismLayers::top:
            return std::max(top - n * options_.thickness, base);
        case PrismLayers::base:
            return std::min(base + (options_.layers - n) * options_.thickness, top);
        default:
            return std::lerp(top, base, double(n) / options_.layers);
        }
    }

    const Column& column(const Point3& top, double base) {
        const auto [found, is_new] = columns_.try_emplace({top, base + 0.0});
        if (!is_new) return found->second;
        for (std::uint32_t n = 0; n <= options_.layers; ++n)
            found->second.push_back(node({top.x, top.y, level(top.z, base, n) + 0.0}));
        return found->second;
    }

    std::uint32_t node(const Point3& place) {
        const auto [found, is_new] =
            nodes_.try_emplace(place, static_cast<std::uint32_t>(mesh_.vertices.size()));
        if (is_new) mesh_.vertices.push_back(place);
        return found->second;
    }

    void add_cell(const std::array<const Column*, 3>& columns, std::uint32_t layer,
                  std::uint32_t triangle) {
        std::array<std::uint32_t, 3> upper{}, lower{};
        std::size_t first_thick = 3, first_thin = 3, thick = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            upper[k] = (*columns[k])[layer];
            lower[k] = (*columns[k])[layer + 1];
            const bool is_thick = upper[k] != lower[k];
            thick += is_thick ? 1 : 0;
            auto& first = is_thick ? first_thick : first_thin;
            first = std::min(first, k);
        }
        PrismCell cell{{}, 6, layer, triangle};
        if (thick == 3) {
            cell.nodes = {lower[0], lower[1], lower[2], upper[0], upper[1], upper[2]};
        } else if (thick == 2) {
            const std::size_t a = (first_thin + 1) % 3, b = (first_thin + 2) % 3;
            cell.nodes = {lower[a], upper[a], upper[b], lower[b], lower[first_thin]};
            cell.size = 5;
        } else if (thick == 1) {
            const std::size_t a = (first_thick + 1) % 3, b = (first_thick + 2) % 3;
            cell.nodes = {lower[first_thick], lower[a], lower[b], upper[first_thick]};
            cell.size = 4;
        } else {
            return;
        }
        mesh_.cells.push_back(cell);
    }

    void add_volume(const std::array<Point3, 3>& t, const std::array<double, 3>& base) {
        const auto off = [](double a, double b) { return Exact(a) - Exact(b); };
        const Exact area =
            off(t[1].x, t[0].x) * off(t[2].y, t[0].y) - off(t[1].y, t[0].y) * off(t[2].x, t[0].x);
        six_volumes_ = six_volumes_ +
                       area * (off(t[0].z, base[0]) + off(t[1].z, base[1]) + off(t[2].z, base[2]));
    }

    const Surface& top_;
    BaseBelow base_;
    const PrismOptions& options_;
    PrismMesh mesh_;
    std::map<std::pair<Point3, double>, Column> columns_; ///< by their ends
    std::map<Point3, std::uint32_t> nodes_;
    Exact six_volumes_;
};

} // namespace

Result<PrismMesh> make_prisms(const Surface& top, const Surface& base, const PrismOptions& options,
                              const Run& run) {
    return guarded("for the prisms", "prisms", [&]() -> Result<PrismMesh> {
        if (const auto status = check_options(options, top); !status) return status.error();
        for (const Surface* surface : {&top, &base}) {
            if (const auto status = validate(std::span(surface, 1), run); !status)
                return status.error();
            if (const auto status = check_folds(*surface, run); !status) return status.error();
        }
        PrismMaker maker(top, base, options);
        for (std::uint32_t t = 0; t < top.triangles.size(); ++t) {
            if (run.stop.stop_requested())
                return Error{ErrorCode::interrupted, "stopped on request", ""};
            maker.add(t);
        }
        PrismMesh made = maker.finish();
        if (made.cells.empty())
            return Error{ErrorCode::nothing_to_do, "there is no space between the surfaces",
                         "prisms"};
        return made;
    });
}

} // namespace terrane
