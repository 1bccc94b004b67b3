// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/detail/recognition.hpp>

#include <terrane/io/text/text.hpp>

namespace terrane::detail {

namespace {

/// Tells whether a line is that of Irap: -996, a number of rows and two increments.
bool begins_irap(std::string_view line) {
    Tokens tokens(line);
    std::int64_t rows = 0;
    double x = 0, y = 0;
    return tokens.next() == "-996" && parse_integer(tokens.next(), rows) &&
           parse_double(tokens.next(), x) == NumberState::ok &&
           parse_double(tokens.next(), y) == NumberState::ok && tokens.rest().empty();
}

/// Tells whether a line is the first one of ZMAP+ behind its comments: "@top, GRID, 4".
bool begins_zmap(std::string_view line) {
    const auto comma = line.find(',');
    if (!line.starts_with('@') || comma == std::string_view::npos) return false;
    const auto rest = trimmed(line.substr(comma + 1));
    return lower(rest.substr(0, 4)) == "grid";
}

} // namespace

std::optional<Format> format_seen_in(std::string_view contents) {
    LineParser in(contents, "");
    while (in.next()) {
        const auto line = trimmed(in.line());
        if (line.empty() || line.starts_with('!') || line.starts_with('#')) continue;
        Tokens tokens(line);
        const auto first = tokens.next();
        if (first == "FSASCI" || first == "FSATTR" || first == "FSLIMI") return Format::cps3;
        if (begins_zmap(line)) return Format::zmap;
        if (begins_irap(line)) return Format::irap;
        if (same_ignoring_case(first, "ncols")) return Format::esri;
        if (first == "DSAA" || contents.starts_with("DSBB") || contents.starts_with("DSRB"))
            return Format::surfer;
        if (first != "GOCAD") return std::nullopt;
        const auto object = tokens.next();
        return same_ignoring_case(object, "VSet")    ? Format::vset
               : same_ignoring_case(object, "PLine") ? Format::pline
                                                     : Format::gocad;
    }
    return std::nullopt;
}

} // namespace terrane::detail
