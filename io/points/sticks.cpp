// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/sticks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/triangulation/point_surface.hpp>
#include <terrane/io/points/detail/heading.hpp>
#include <terrane/io/points/detail/point_lines.hpp>

namespace terrane {

using namespace detail;
using namespace points::detail;

namespace {

struct Stick {
    std::vector<std::uint32_t> points; ///< indices of vertices
};

struct Fault {
    Surface surface;
    std::vector<Stick> sticks;
    std::map<std::string, std::size_t, std::less<>> stick_of; ///< index by its number in the file
};

/// The parts of a line with a point.
struct Columns {
    std::array<std::string_view, 3> xyz;
    std::string fault;      ///< empty: not stated
    std::string_view stick; ///< empty: not stated
};

class StickReader {
public:
    StickReader(std::string_view contents, std::string_view source) : in_(contents, source) {}

    MaybeError read(std::vector<Fault>& faults) {
        while (in_.next()) {
            const auto line = trimmed(in_.line());
            if (line.empty() || is_comment(line)) continue;
            if (ends_points(line)) break;
            if (auto trouble = read_line(line, faults)) return trouble;
        }
        if (faults.empty()) return in_.file_error(ErrorCode::nothing_to_do, "there is no point");
        return std::nullopt;
    }

private:
    MaybeError read_line(std::string_view line, std::vector<Fault>& faults) {
        const auto cells = heading_ && heading_->delimiter != ' '
                               ? cells_of(line, heading_->delimiter)
                               : columns_of(line);
        const bool words = std::ranges::count_if(cells, is_number) < 3;
        if (words && faults.empty()) {
            take_heading(line);
            return std::nullopt;
        }
        Columns columns;
        if (auto trouble = heading_ ? choose_by_heading(cells, columns) : choose(cells, columns))
            return trouble;
        Point3 p;
        for (const auto& [token, value] :
             {std::pair(columns.xyz[0], &p.x), std::pair(columns.xyz[1], &p.y),
              std::pair(columns.xyz[2], &p.z)})
            if (auto trouble = in_.read_number(token, *value)) return trouble;
        if (p == Point3{999, 999, 999}) {
            ++line_breaks_;
            return std::nullopt;
        }
        if (!is_no_height(p.z)) add(p, columns, faults);
        return std::nullopt;
    }

    void take_heading(std::string_view line) {
        auto heading = read_heading(line);
        if (!heading) return;
        const auto cells =
            heading->delimiter == ' ' ? columns_of(line) : cells_of(line, heading->delimiter);
        stick_column_.reset();
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (lower(cells[i]).starts_with("stick")) stick_column_ = i;
        heading_ = std::move(heading);
    }

    MaybeError choose_by_heading(const std::vector<std::string_view>& cells,
                                 Columns& columns) const {
        if (cells.size() < heading_->columns)
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("the heading has {} columns, this line {}",
                                         heading_->columns, cells.size()));
        for (std::size_t k = 0; k < 3; ++k) columns.xyz.at(k) = cells[heading_->xyz.at(k)];
        if (heading_->name) columns.fault = cells[*heading_->name];
        if (stick_column_) columns.stick = cells[*stick_column_];
        return std::nullopt;
    }

    /// Chooses columns of a line by where its numbers are.
    MaybeError choose(std::vector<std::string_view> cells, Columns& columns) const {
        const auto first = std::ranges::find_if(cells, is_number);
        const bool survey = first != cells.begin() && cells.front().ends_with('-');
        if (first != cells.begin() && !survey) columns.fault = cells.front();
        cells.erase(cells.begin(), first);
        if (survey)
            cells.erase(cells.begin(),
                        cells.begin() + std::min<std::ptrdiff_t>(2, std::ssize(cells)));
        if (cells.size() < 3)
            return in_.error(ErrorCode::bad_syntax,
                             survey ? "a point needs inline, crossline, x, y and z"
                                    : "a point needs 3 numbers");
        for (std::size_t k = 0; k < 3; ++k) columns.xyz.at(k) = cells[k];
        if (cells.size() > 3 && (cells.size() > 4 || is_number(cells[3]) || !columns.fault.empty()))
            columns.stick = cells.back();
        const auto names_end = cells.size() - (columns.stick.empty() ? 0 : 1);
        for (std::size_t k = 3; k < names_end; ++k)
            columns.fault += (columns.fault.empty() ? "" : " ") + std::string(cells[k]);
        return std::nullopt;
    }

    void add(const Point3& p, const Columns& columns, std::vector<Fault>& faults) {
        const auto [at, added] = fault_of_.try_emplace(columns.fault, faults.size());
        if (added) {
            faults.emplace_back().surface.name = columns.fault;
            if (heading_) faults.back().surface.frame = heading_->frame;
        }
        Fault& fault = faults[at->second];
        const auto key = fmt::format("{} {}", columns.stick, line_breaks_);
        const auto [stick, begins] = fault.stick_of.try_emplace(key, fault.sticks.size());
        if (begins) fault.sticks.emplace_back();
        fault.sticks[stick->second].points.push_back(
            static_cast<std::uint32_t>(fault.surface.vertices.size()));
        fault.surface.vertices.push_back(p);
    }

    LineParser in_;
    std::optional<Heading> heading_;
    std::optional<std::size_t> stick_column_;
    std::size_t line_breaks_ = 0;
    std::map<std::string, std::size_t> fault_of_; ///< index by name
};

double square_of_distance(const Point3& a, const Point3& b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z);
}

/// Takes the sticks of a fault that end where they begin.
std::vector<Stick> take_closed(Fault& fault) {
    std::vector<Stick> open, closed;
    for (Stick& stick : fault.sticks) {
        const auto& v = fault.surface.vertices;
        const bool ends =
            stick.points.size() > 3 && v[stick.points.front()] == v[stick.points.back()];
        (ends ? closed : open).push_back(std::move(stick));
    }
    fault.sticks = std::move(open);
    return closed;
}

/// Fills closed lines, and leaves out the vertices that no triangle uses.
MaybeError fill(const std::vector<Stick>& lines, Surface& surface, std::string_view source) {
    for (std::size_t l = 0; l < lines.size(); ++l) {
        std::vector<std::uint32_t> corners;
        std::vector<Point3> places;
        for (std::size_t i = 0; i + 1 < lines[l].points.size(); ++i) {
            const Point3& p = surface.vertices[lines[l].points[i]];
            if (!places.empty() && places.back() == p) continue;
            corners.push_back(lines[l].points[i]);
            places.push_back(p);
        }
        const auto triangles = fill_closed_line(places);
        if (!triangles)
            return Error{triangles.error().code,
                         fmt::format("closed line {} of {}: {}", l + 1, shown(surface.name),
                                     triangles.error().sentence),
                         std::string(source)};
        for (const auto& [a, b, c] : *triangles)
            surface.triangles.push_back({corners[a], corners[b], corners[c]});
    }
    if (!lines.empty()) surface.vertices = Submesh(surface.vertices).cut(surface.triangles);
    return std::nullopt;
}

/// Connects the sticks of a fault.
class StickSurface {
public:
    explicit StickSurface(Fault& fault) : surface_(fault.surface), sticks_(fault.sticks) {}

    void connect() {
        for (std::size_t s = 1; s < sticks_.size(); ++s) {
            turn(sticks_[s - 1].points, sticks_[s].points);
            add_strip(sticks_[s - 1].points, sticks_[s].points);
        }
    }

private:
    using Points = std::vector<std::uint32_t>;

    [[nodiscard]] double square(std::uint32_t a, std::uint32_t b) const {
        return square_of_distance(surface_.vertices[a], surface_.vertices[b]);
    }

    void turn(const Points& before, Points& points) const {
        const double kept =
            square(before.front(), points.front()) + square(before.back(), points.back());
        const double turned =
            square(before.front(), points.back()) + square(before.back(), points.front());
        if (turned < kept) std::ranges::reverse(points);
    }

    /// Returns which share of a stick's length lies before each of its points.
    [[nodiscard]] std::vector<double> shares(const Points& points) const {
        std::vector<double> shares{0};
        for (std::size_t i = 1; i < points.size(); ++i)
            shares.push_back(shares.back() + std::sqrt(square(points[i - 1], points[i])));
        const double length = shares.back();
        for (double& share : shares) share = length > 0 ? share / length : 0;
        return shares;
    }

    void add_strip(const Points& a, const Points& b) {
        const auto share_a = shares(a), share_b = shares(b);
        std::size_t i = 0, j = 0;
        while (i + 1 < a.size() || j + 1 < b.size()) {
            const bool along_a =
                j + 1 == b.size() || (i + 1 < a.size() && share_a[i + 1] <= share_b[j + 1]);
            surface_.triangles.push_back({a[i], b[j], along_a ? a[i + 1] : b[j + 1]});
            ++(along_a ? i : j);
        }
    }

    Surface& surface_;
    std::vector<Stick>& sticks_;
};

void turn_depths_over(Surface& surface) {
    for (Point3& p : surface.vertices) p.z = p.z == 0 ? 0 : -p.z;
    surface.frame.vertical_axis = VerticalAxis::down;
    surface.frame.column_of_depths = false;
}

} // namespace

Result<std::vector<Surface>> read_sticks(std::string_view contents, std::string_view source,
                                         std::string_view name, const ReadOptions& options) {
    std::vector<Fault> faults;
    if (auto trouble = StickReader(contents, source).read(faults)) return *trouble;
    std::vector<Surface> surfaces;
    for (Fault& fault : faults) {
        if (fault.surface.name.empty()) fault.surface.name = name;
        const auto closed = take_closed(fault);
        StickSurface(fault).connect();
        if (auto trouble = fill(closed, fault.surface, source)) return *trouble;
        if (fault.surface.triangles.empty()) continue;
        if (options.depth) turn_depths_over(fault.surface);
        fault.surface.role = Role::fault;
        surfaces.push_back(std::move(fault.surface));
    }
    if (surfaces.empty())
        return Error{ErrorCode::nothing_to_do,
                     "no fault has two sticks or a closed line; a column with the number of the "
                     "stick, or a line "
                     "999 999 999 after each stick, tells them apart",
                     std::string(source)};
    return surfaces;
}

} // namespace terrane
