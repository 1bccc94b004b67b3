// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Paths of wells in LAS 2.0.
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include <terrane/io/points/detail/well_columns.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane::points::detail {

using namespace terrane::detail;

namespace {

/// A line of a header: MNEM.UNIT VALUE : DESCRIPTION.
struct HeaderLine {
    std::string_view mnemonic, unit, value;
};

/// Splits at the first dot, the first blank after it, and the last colon.
std::optional<HeaderLine> header_line(std::string_view line) {
    const std::size_t dot = line.find('.');
    if (dot == std::string_view::npos) return std::nullopt;
    HeaderLine made;
    made.mnemonic = trimmed(line.substr(0, dot));
    std::string_view rest = line.substr(dot + 1);
    if (const std::size_t colon = rest.rfind(':'); colon != std::string_view::npos)
        rest = rest.substr(0, colon);
    std::size_t blank = 0;
    while (blank < rest.size() && !is_blank(rest[blank])) ++blank;
    made.unit = rest.substr(0, blank);
    made.value = trimmed(rest.substr(blank));
    return made;
}

class LasReader {
public:
    LasReader(std::string_view contents, std::string_view source, WellColumns& columns) :
        in_(contents, source), columns_(columns) {}

    MaybeError read() {
        while (in_.next()) {
            const auto line = trimmed(in_.line());
            if (line.empty() || line.starts_with('#')) continue;
            MaybeError flaw;
            if (line.starts_with('~'))
                flaw = begin_section(line);
            else if (section_ == 'A')
                flaw = read_values(line);
            else
                flaw = read_header(line);
            if (flaw) return flaw;
        }
        if (section_ != 'A' || rows.empty())
            return in_.file_error(ErrorCode::nothing_to_do, "there is no row with a place");
        if (values_.size() % curves_ != 0)
            return in_.file_error(ErrorCode::bad_syntax,
                                  "the last row has values for some curves only");
        return std::nullopt;
    }

    std::vector<std::array<double, 4>> rows;
    std::map<std::string, std::pair<double, std::string>>
        places; ///< numbers of header lines, and their units
    std::string well;

private:
    MaybeError begin_section(std::string_view line) {
        section_ = line.size() > 1 ? static_cast<char>(line[1] & ~0x20) : ' ';
        if (section_ != 'A') return std::nullopt;
        if (!has_version_)
            return in_.error(ErrorCode::bad_syntax, "the version of LAS is missing: VERS");
        curves_ = columns_.count();
        if (!columns_.have_positions() && !columns_.have_survey())
            return in_.error(
                ErrorCode::bad_syntax,
                "no path of a well: there are no curves X, Y and Z, nor INCL and AZIM");
        if (!columns_.unit())
            return in_.error(ErrorCode::unsupported, "curves have different units");
        return std::nullopt;
    }

    MaybeError read_header(std::string_view line) {
        const auto header = header_line(line);
        if (std::string_view("VWCP").find(section_) == std::string_view::npos) return std::nullopt;
        if (!header) return in_.error(ErrorCode::bad_syntax, "a line of the header has no dot");
        const std::string mnemonic = lower(header->mnemonic);
        if (section_ == 'V') return read_version(mnemonic, header->value);
        if (section_ == 'C') return read_curve(mnemonic, *header);
        if (section_ == 'W' && mnemonic == "well") well = header->value;
        double number = 0;
        if (parse_double(header->value, number) != NumberState::ok) return std::nullopt;
        if (section_ == 'W' && mnemonic == "null") null_ = number;
        places.try_emplace(mnemonic, number, std::string(header->unit));
        return std::nullopt;
    }

    MaybeError read_version(const std::string& mnemonic, std::string_view value) {
        if (mnemonic == "vers") {
            double version = 0;
            has_version_ = parse_double(value, version) == NumberState::ok;
            if (!has_version_ || version != 2)
                return in_.error(ErrorCode::unsupported,
                                 fmt::format("LAS {} is not read; version 2.0 is", shown(value)));
        }
        if (mnemonic == "wrap") wraps_ = same_ignoring_case(value, "yes");
        return std::nullopt;
    }

    MaybeError read_curve(const std::string& mnemonic, const HeaderLine& header) {
        const bool is_first = columns_.count() == 0;
        if (is_first && (mnemonic == "time" || mnemonic == "etim" || mnemonic == "index"))
            return in_.error(ErrorCode::unsupported, "the first curve is no depth");
        if (same_ignoring_case(header.unit, "rad"))
            return in_.error(ErrorCode::unsupported, "angles in radians are not read");
        columns_.add(is_first ? "md" : mnemonic, header.unit);
        return std::nullopt;
    }

    MaybeError read_values(std::string_view line) {
        Tokens tokens(line);
        std::size_t here = 0;
        for (auto token = tokens.next(); !token.empty(); token = tokens.next(), ++here) {
            const std::size_t curve = values_.size() % curves_;
            const auto wanted = columns_.wanted();
            double value = null_;
            if (std::ranges::count(wanted, curve) > 0)
                if (auto flaw = in_.read_number(token, value)) return flaw;
            values_.push_back(value);
            if (values_.size() == curves_) take_row(wanted);
        }
        if (!wraps_ && here != curves_)
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("the row has {} values for {} curves", here, curves_));
        return std::nullopt;
    }

    void take_row(std::span<const std::size_t> wanted) {
        std::array<double, 4> row{};
        bool is_whole = true;
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            row[i] = values_[wanted[i]];
            is_whole = is_whole && row[i] != null_;
        }
        if (is_whole) rows.push_back(row);
        values_.clear();
    }

    LineParser in_;
    WellColumns& columns_;
    std::vector<double> values_; ///< of a row that is not whole
    std::size_t curves_ = 1;
    double null_ = -999.25;
    char section_ = ' ';
    bool has_version_ = false, wraps_ = false;
};

/// Adds the head that the header states, if it does.
MaybeError add_head(const LasReader& las, const WellColumns& columns, std::string_view source,
                    std::vector<WellHead>& heads) {
    const auto number = [&](std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (const auto found = las.places.find(name); found != las.places.end())
                return &found->second;
        return static_cast<const std::pair<double, std::string>*>(nullptr);
    };
    const auto* const x = number({"x", "xcoord"});
    const auto* const y = number({"y", "ycoord"});
    const auto* const z = number({"eref", "ekb", "kb"});
    if (x == nullptr || y == nullptr || z == nullptr) return std::nullopt;
    const std::string unit = columns.unit().value_or("");
    for (const auto* one : {x, y, z})
        if (!unit.empty() && !one->second.empty() && unit_named(one->second) != unit)
            return Error{ErrorCode::unsupported, "the head and the depths have different units",
                         std::string(source)};
    heads.push_back({"", {x->first, y->first, z->first}}); // others come first
    return std::nullopt;
}

} // namespace

Result<WellRows> read_las(std::string_view contents, std::string_view source, std::string_view name,
                          WellColumns& columns, std::vector<WellHead>& heads) {
    LasReader las(contents, source, columns);
    if (auto flaw = las.read()) return *flaw;
    if (!columns.have_positions())
        if (auto flaw = add_head(las, columns, source, heads)) return *flaw;
    WellRows well{las.well.empty() ? std::string(name) : las.well, std::move(las.rows)};
    const std::size_t depth = columns.have_positions() ? 3 : 0;
    if (well.rows.front()[depth] > well.rows.back()[depth]) std::ranges::reverse(well.rows);
    return well;
}

} // namespace terrane::points::detail
