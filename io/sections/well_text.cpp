// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/sections/well_text.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/file_set.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::string_view null_value = "-999.25";
constexpr double most_rows = 1e7;

std::string joined(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) {
        if (!all.empty()) all += " | ";
        all += text;
    }
    return all;
}

std::string text_of_number(double value) {
    std::string text;
    append_number(text, value);
    return text;
}

std::string row_of(const WellLog& log, const WellInterval& in, const SectionNames& names) {
    std::string row = fmt::format(
        "{},{},{},{},{},{},{}", csv_cell(log.name), in.surfaces.empty() ? "block" : "surface",
        text_of_number(in.from), text_of_number(in.to), csv_cell(blocks_text(in, names)),
        csv_cell(units_text(in, names)), csv_cell(surfaces_text(in, names)));
    for (const Point3& p : {in.entry, in.exit})
        for (const double x : {p.x, p.y, p.z}) row += ',' + text_of_number(x);
    return row + '\n';
}

std::string row_of(const WellLog& log, const WellMarker& marker, const SectionNames& names) {
    const WellInterval& next = log.intervals[marker.after];
    std::string row = fmt::format("{0},marker,{1},{1},{2},{3},{4}", csv_cell(log.name),
                                  text_of_number(marker.depth), csv_cell(blocks_text(next, names)),
                                  csv_cell(units_text(next, names)),
                                  csv_cell(names.surfaces[marker.surface].name));
    for (int twice = 0; twice < 2; ++twice)
        for (const double x : {marker.point.x, marker.point.y, marker.point.z})
            row += ',' + text_of_number(x);
    return row + '\n';
}

/// A code of a block or unit at a depth.
struct LasRow {
    double depth = 0;
    const WellInterval* interval = nullptr;
};

std::vector<LasRow> las_rows(const WellLog& log, double step) {
    std::vector<LasRow> rows;
    if (step > 0) {
        const double last = std::floor(log.intervals.back().to / step);
        std::size_t at = 0;
        for (double k = std::ceil(log.intervals.front().from / step); k <= last; ++k) {
            while (at + 1 < log.intervals.size() && log.intervals[at].to <= k * step) ++at;
            rows.push_back({k * step, &log.intervals[at]});
        }
        return rows;
    }
    for (const WellInterval& in : log.intervals)
        if (in.from < in.to) rows.push_back({in.from, &in});
    if (!rows.empty()) rows.push_back({log.intervals.back().to, rows.back().interval});
    return rows;
}

/// The different units of blocks, by the first block of each.
std::vector<std::string> units_of(const SectionNames& names) {
    std::vector<std::string> units;
    for (const std::string& unit : names.units)
        if (!unit.empty() && std::ranges::count(units, unit) == 0) units.push_back(unit);
    return units;
}

std::string las_header(const WellLog& log, const SectionNames& names, double step,
                       std::span<const LasRow> rows) {
    const auto line = [](std::string_view mnemonic, std::string_view unit, std::string_view value,
                         std::string_view description) {
        return fmt::format("{}.{} {} : {}\n", mnemonic, unit, value, description);
    };
    const std::string unit = names.length_unit.empty() ? "" : detail::one_line(names.length_unit);
    std::string text = "~Version\n";
    text += line("VERS", "", "2.0", "CWLS LOG ASCII STANDARD - VERSION 2.0");
    text += line("WRAP", "", "NO", "ONE LINE PER DEPTH STEP");
    text += "~Well\n";
    text +=
        line("STRT", unit, text_of_number(rows.empty() ? 0 : rows.front().depth), "first depth");
    text += line("STOP", unit, text_of_number(rows.empty() ? 0 : rows.back().depth), "last depth");
    text += line("STEP", unit, text_of_number(step), step > 0 ? "step" : "depths at changes");
    text += line("NULL", "", null_value, "no value");
    text += line("COMP", "", "", "company");
    text += line("WELL", "", detail::one_line(log.name), "well");
    for (const char* mnemonic : {"FLD", "LOC", "PROV", "SRVC", "DATE", "UWI"})
        text += line(mnemonic, "", "", "not stated");
    text += "~Curve\n";
    text += line("DEPT", unit, "", "measured depth");
    text += line("BLOCK", "", "", "number of the block, from this depth on");
    text += line("UNIT", "", "", "number of the unit, from this depth on");
    text += "~Parameter\n";
    for (std::size_t b = 0; b < names.blocks.size(); ++b)
        text += line(fmt::format("B{}", b), "", detail::one_line(names.blocks[b]), "block");
    const auto units = units_of(names);
    for (std::size_t u = 0; u < units.size(); ++u)
        text += line(fmt::format("U{}", u + 1), "", detail::one_line(units[u]), "unit");
    return text + "~A DEPT BLOCK UNIT\n";
}

Result<std::vector<std::string>> texts_of(std::span<const WellLog> logs, const SectionNames& names,
                                          WellFormat format, double step) {
    std::vector<std::string> texts;
    if (format == WellFormat::csv) return std::vector{wells_csv(logs, names)};
    for (const WellLog& log : logs) {
        const double length = log.intervals.back().to - log.intervals.front().from;
        if (step > 0 && length / step > most_rows)
            return Error{ErrorCode::bad_option, "makes more than 10^7 rows; take a larger one",
                         "step"};
        texts.push_back(well_las(log, names, step));
    }
    return texts;
}

} // namespace

std::optional<WellFormat> well_format(std::string_view extension) {
    if (same_ignoring_case(extension, ".csv")) return WellFormat::csv;
    if (same_ignoring_case(extension, ".las")) return WellFormat::las;
    return std::nullopt;
}

std::string blocks_text(const WellInterval& interval, const SectionNames& names) {
    std::vector<std::string> texts;
    for (const std::uint32_t block : interval.blocks) texts.push_back(names.blocks[block]);
    return joined(texts);
}

std::string surfaces_text(const WellInterval& interval, const SectionNames& names) {
    std::vector<std::string> texts;
    for (const std::uint32_t surface : interval.surfaces)
        texts.push_back(names.surfaces[surface].name);
    return joined(texts);
}

std::string units_text(const WellInterval& interval, const SectionNames& names) {
    std::vector<std::string> texts;
    for (const std::uint32_t block : interval.blocks)
        if (const std::string& unit = names.units[block];
            !unit.empty() && std::ranges::count(texts, unit) == 0)
            texts.push_back(unit);
    return joined(texts);
}

std::string wells_csv(std::span<const WellLog> logs, const SectionNames& names) {
    std::string out = "well,kind,from,to,block,unit,surface,x,y,z,x_to,y_to,z_to\n";
    for (const WellLog& log : logs) {
        auto marker = log.markers.begin();
        for (const WellInterval& in : log.intervals) {
            const auto number = static_cast<std::uint32_t>(&in - log.intervals.data());
            while (marker != log.markers.end() &&
                   (marker->before < number || marker->depth <= in.from))
                out += row_of(log, *marker++, names);
            out += row_of(log, in, names);
        }
        while (marker != log.markers.end()) out += row_of(log, *marker++, names);
    }
    return out;
}

std::string well_las(const WellLog& log, const SectionNames& names, double step) {
    const auto rows = las_rows(log, step);
    const auto units = units_of(names);
    std::string out = las_header(log, names, step, rows);
    for (const auto& [depth, interval] : rows) {
        append_number(out, depth);
        const bool is_in_block = interval->surfaces.empty();
        const std::uint32_t block = interval->blocks[0];
        const auto unit = std::ranges::find(units, names.units[block]);
        out += ' ';
        out += is_in_block ? std::to_string(block) : std::string(null_value);
        out += ' ';
        out += is_in_block && unit != units.end() ? std::to_string(unit - units.begin() + 1)
                                                  : std::string(null_value);
        out += '\n';
    }
    return out;
}

std::vector<std::filesystem::path> well_files(std::span<const std::string> wells, WellFormat format,
                                              const std::filesystem::path& path) {
    if (format == WellFormat::csv || wells.size() == 1) return {path};
    std::vector<std::filesystem::path> paths;
    WordNames words;
    for (const std::string& well : wells)
        paths.push_back(path.parent_path() / (path.stem().string() + '_' + words.add(well, "well") +
                                              path.extension().string()));
    return paths;
}

Result<std::vector<std::filesystem::path>> write_wells(std::span<const WellLog> logs,
                                                       const SectionNames& names, WellFormat format,
                                                       const std::filesystem::path& path,
                                                       double step) {
    using Paths = std::vector<std::filesystem::path>;
    return guard_memory("", [&]() -> Result<Paths> {
        const auto texts = texts_of(logs, names, format, step);
        if (!texts) return texts.error();
        if (texts->size() > 1 && path == "-")
            return Error{ErrorCode::bad_option, "several wells are several files of this format",
                         "standard output"};
        std::optional<FileSet> together;
        if (texts->size() > 1 && !FileSet::current()) together.emplace();
        std::vector<std::string> wells;
        for (const WellLog& log : logs) wells.push_back(log.name);
        Paths paths = well_files(wells, format, path);
        for (std::size_t i = 0; i < texts->size(); ++i)
            if (auto written = write_file(paths[i], (*texts)[i]); !written) return written.error();
        if (together)
            if (auto published = together->publish(); !published) return published.error();
        return paths;
    });
}

} // namespace terrane
