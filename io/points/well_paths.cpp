// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/well_paths.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/points/detail/heading.hpp>
#include <terrane/io/points/detail/well_columns.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane {

using namespace detail;
using namespace points::detail;

namespace points::detail {
namespace {

constexpr std::array<std::pair<std::string_view, WellColumn>, 27> column_names{{
    {"well", WellColumn::well},
    {"name", WellColumn::well},
    {"wellname", WellColumn::well},
    {"well_name", WellColumn::well},
    {"borehole", WellColumn::well},
    {"md", WellColumn::depth},
    {"dept", WellColumn::depth},
    {"depth", WellColumn::depth},
    {"measured depth", WellColumn::depth},
    {"measured_depth", WellColumn::depth},
    {"x", WellColumn::x},
    {"easting", WellColumn::x},
    {"y", WellColumn::y},
    {"northing", WellColumn::y},
    {"z", WellColumn::z},
    {"elevation", WellColumn::z},
    {"inclination", WellColumn::inclination},
    {"incl", WellColumn::inclination},
    {"inc", WellColumn::inclination},
    {"dev", WellColumn::inclination},
    {"devi", WellColumn::inclination},
    {"deviation", WellColumn::inclination},
    {"azimuth", WellColumn::azimuth},
    {"azim", WellColumn::azimuth},
    {"azi", WellColumn::azimuth},
    {"az", WellColumn::azimuth},
    {"hazi", WellColumn::azimuth},
}};

bool is_length(WellColumn column) {
    return column == WellColumn::depth || column == WellColumn::x || column == WellColumn::y ||
           column == WellColumn::z;
}

} // namespace

void WellColumns::add(std::string_view name, std::string_view unit) {
    const std::size_t number = count_++;
    const std::size_t bracket = name.find_first_of("([");
    if (bracket != std::string_view::npos) {
        unit = name.substr(bracket + 1, name.find_first_of(")]", bracket) - bracket - 1);
        name = name.substr(0, bracket);
    }
    const std::string plain = lower(trimmed(name));
    const auto known =
        std::ranges::find(column_names, plain, &decltype(column_names)::value_type::first);
    if (known == column_names.end()) return;
    auto& found = found_[static_cast<std::size_t>(known->second)];
    const bool is_plain_depth = plain == "depth";
    if (found && (is_plain_depth || !has_plain_depth_ || known->second != WellColumn::depth))
        return; // the first one counts
    if (known->second == WellColumn::depth) has_plain_depth_ = is_plain_depth;
    found = number;
    if (is_length(known->second) && !trimmed(unit).empty()) units_.push_back(unit_named(unit));
}

std::vector<std::size_t> WellColumns::wanted() const {
    if (!have_positions())
        return {*at(WellColumn::depth), *at(WellColumn::inclination), *at(WellColumn::azimuth)};
    std::vector<std::size_t> wanted{*at(WellColumn::x), *at(WellColumn::y), *at(WellColumn::z)};
    if (at(WellColumn::depth) && !has_plain_depth_) wanted.push_back(*at(WellColumn::depth));
    return wanted;
}

std::optional<std::string> WellColumns::unit() const {
    for (const std::string& unit : units_)
        if (unit != units_.front()) return std::nullopt;
    return units_.empty() ? "" : units_.front();
}

Result<WellPath> path_of(const WellRows& well, const WellColumns& columns,
                         std::span<const WellHead> heads, std::string_view source) {
    WellPath path{well.name, {}};
    if (columns.have_positions()) {
        const bool has_depths = columns.wanted().size() > 3;
        for (const auto& [x, y, z, depth] : well.rows) {
            path.points.push_back({x, y, z});
            if (has_depths) path.depths.push_back(depth);
        }
        return path;
    }
    const WellHead* head = nullptr;
    for (const WellHead& one : heads)
        if (one.well == well.name || (one.well.empty() && head == nullptr)) head = &one;
    if (head == nullptr)
        return Error{ErrorCode::bad_option,
                     fmt::format("well {} has a survey, and its head is not stated", well.name),
                     std::string(source)};
    std::vector<WellStation> stations;
    for (const auto& row : well.rows) stations.push_back({row[0], row[1], row[2]});
    auto made = surveyed_path(well.name, head->place, stations);
    if (!made)
        return Error{made.error().code,
                     fmt::format("survey of well {}: {}", well.name, made.error().sentence),
                     std::string(source)};
    return made;
}

} // namespace points::detail

namespace {

/// Reads a table of wells.
class WellTable {
public:
    WellTable(std::string_view contents, std::string_view source, std::string_view name) :
        in_(contents, source), name_(name) {}

    MaybeError read() {
        while (in_.next()) {
            const auto line = trimmed(in_.line());
            if (line.empty() || line.starts_with('#')) continue;
            if (auto flaw = columns.count() == 0 ? read_heading(line) : read_row(in_.line()))
                return flaw;
        }
        if (wells.empty()) return in_.file_error(ErrorCode::nothing_to_do, "there is no well");
        return std::nullopt;
    }

    WellColumns columns;
    std::vector<WellRows> wells;

private:
    [[nodiscard]] std::vector<std::string_view> cells(std::string_view line) const {
        return delimiter_ == ' ' ? columns_of(line) : cells_of(line, delimiter_);
    }

    MaybeError read_heading(std::string_view line) {
        for (const char c : {',', '\t', ';'})
            if (line.find(c) != std::string_view::npos) delimiter_ = c;
        for (const std::string_view cell : cells(line)) columns.add(cell);
        if (!columns.have_positions() && !columns.have_survey())
            return in_.error(ErrorCode::bad_syntax,
                             "the heading of a table of wells names x, y and z, or md, inclination "
                             "and azimuth");
        if (!columns.unit())
            return in_.error(ErrorCode::unsupported, "columns have different units");
        return std::nullopt;
    }

    MaybeError read_row(std::string_view line) {
        const auto row = cells(line);
        const auto wanted = columns.wanted();
        const auto of_well = columns.at(WellColumn::well);
        std::size_t last = of_well.value_or(0);
        for (const std::size_t column : wanted) last = std::max(last, column);
        if (row.size() <= last)
            return in_.error(
                ErrorCode::bad_syntax,
                fmt::format("the row has {} cells, and {} are needed", row.size(), last + 1));
        std::array<double, 4> numbers{};
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (auto flaw = in_.read_number(row[wanted[i]], numbers[i])) return flaw;
        const std::string_view name = of_well ? row[*of_well] : name_;
        if (name.empty())
            return in_.error(ErrorCode::bad_syntax, "the name of the well is missing");
        auto well = std::ranges::find(wells, name, &WellRows::name);
        if (well == wells.end()) well = wells.insert(wells.end(), {std::string(name), {}});
        well->rows.push_back(numbers);
        return std::nullopt;
    }

    LineParser in_;
    std::string_view name_;
    char delimiter_ = ' ';
};

bool is_las(std::string_view contents) {
    while (!contents.empty()) {
        const auto line = trimmed(contents.substr(0, contents.find('\n')));
        if (!line.empty() && !line.starts_with('#')) return line.starts_with('~');
        contents.remove_prefix(std::min(contents.size(), contents.find('\n')));
        if (!contents.empty()) contents.remove_prefix(1);
    }
    return false;
}

} // namespace

Result<WellPaths> read_well_paths(std::string_view contents, std::string_view source,
                                  std::string_view name, std::span<const WellHead> heads) {
    return guard_memory(source, [&]() -> Result<WellPaths> {
        std::vector<WellHead> all(heads.begin(), heads.end());
        std::vector<WellRows> wells;
        WellColumns columns;
        if (is_las(contents)) {
            auto well = read_las(contents, source, name, columns, all);
            if (!well) return well.error();
            wells.push_back(std::move(*well));
        } else {
            WellTable table(contents, source, name);
            if (auto flaw = table.read()) return *flaw;
            columns = table.columns;
            wells = std::move(table.wells);
        }
        WellPaths made{{}, columns.unit().value_or("")};
        for (const WellRows& well : wells) {
            auto path = path_of(well, columns, all, source);
            if (!path) return path.error();
            made.paths.push_back(std::move(*path));
        }
        return made;
    });
}

} // namespace terrane
