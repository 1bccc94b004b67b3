// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/grdecl.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include <terrane/io/text/text.hpp>
#include <terrane/io/text/units.hpp>

namespace terrane {

using namespace detail;

namespace {

std::string upper(std::string_view text) {
    std::string result(text);
    for (char& c : result)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return result;
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string without_quotes(std::string_view word) {
    while (!word.empty() && (word.front() == '\'' || word.front() == '"')) word.remove_prefix(1);
    while (!word.empty() && (word.back() == '\'' || word.back() == '"')) word.remove_suffix(1);
    return std::string(trimmed(word));
}

class GrdeclReader {
public:
    GrdeclReader(std::string_view contents, std::string_view source) :
        in_(contents, source), most_values_(256 * contents.size()) {}

    MaybeError read(CornerPointGrid& grid) {
        in_.allow_d_exponents();
        for (auto word = next(); !word.empty() && !ended_; word = next())
            if (first_in_line_ && is_letter(word[0]))
                if (auto trouble = read_keyword(upper(word), grid)) return trouble;
        if (auto trouble = check_complete()) return trouble;
        return take_over(grid);
    }

private:
    /// Returns the next word, "/" at the end of a record; empty at the end of the file.
    std::string_view next() {
        first_in_line_ = false;
        for (;;) {
            while (!rest_.empty() && is_blank(rest_[0])) rest_.remove_prefix(1);
            if (!rest_.empty() && !rest_.starts_with("--")) break;
            if (!in_.next()) return {};
            rest_ = in_.line();
            first_in_line_ = true;
        }
        std::size_t end = 0;
        if (rest_[0] == '/') {
            const auto word = rest_.substr(0, 1);
            rest_ = {}; // what follows is a comment
            return word;
        }
        if (rest_[0] == '\'' || rest_[0] == '"') {
            end = std::min(rest_.find(rest_[0], 1), rest_.size() - 1) + 1;
        } else {
            while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '/') ++end;
        }
        const auto word = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return word;
    }

    MaybeError read_keyword(const std::string& keyword, CornerPointGrid& grid) {
        if (keyword == "SPECGRID" || keyword == "DIMENS") return read_size(keyword, grid);
        if (keyword == "COORD") return read_array(keyword, coord_);
        if (keyword == "ZCORN") return read_array(keyword, zcorn_);
        if (keyword == "ACTNUM") return read_array(keyword, actnum_);
        if (keyword == "FAULTS") return read_faults(grid);
        if (keyword == "MAPAXES") return read_map_axes();
        if (keyword == "GRIDUNIT" || keyword == "MAPUNITS") return read_unit(keyword);
        if (keyword == "METRIC") usual_unit_ = "m";
        if (keyword == "FIELD") usual_unit_ = "ft";
        if (keyword == "TITLE") (void)in_.next();
        if (keyword == "END" || keyword == "ENDINC") ended_ = true;
        if (keyword == "INCLUDE" || keyword == "IMPORT" || keyword == "GDFILE") {
            const auto file = without_quotes(next());
            return in_.error(ErrorCode::unsupported,
                             fmt::format("{} names the file {}, which is not read; put its text in "
                                         "place of these lines",
                                         keyword, shown(file)));
        }
        for (const char* local : {"CARFIN", "REFINE", "RADFIN", "RADFIN4"})
            if (keyword == local)
                return in_.error(ErrorCode::unsupported,
                                 keyword + ": local grids are not read, only one grid");
        for (const char* change : {"EQUALS", "COPY", "ADD", "MULTIPLY"})
            if (keyword == change) return pass_changes(keyword);
        return std::nullopt;
    }

    /// Passes over the records of a keyword that changes arrays.
    MaybeError pass_changes(const std::string& keyword) {
        std::size_t words = 0; // of this record
        for (auto word = next(); !word.empty(); word = next()) {
            if (word == "/") {
                if (words == 0) return std::nullopt;
                words = 0;
                continue;
            }
            ++words;
            const auto array = upper(without_quotes(word));
            if (array == "ACTNUM" || array == "ZCORN" || array == "COORD")
                return in_.error(ErrorCode::unsupported,
                                 fmt::format("{} changes {}, which is not done; write the values "
                                             "under {} itself",
                                             keyword, array, array));
        }
        return std::nullopt;
    }

    MaybeError read_size(const std::string& keyword, CornerPointGrid& grid) {
        const bool known = grid.nx != 0;
        const std::array<std::uint32_t, 3> before{grid.nx, grid.ny, grid.nz};
        for (std::uint32_t* count : {&grid.nx, &grid.ny, &grid.nz}) {
            const auto word = next();
            std::int64_t value = 0;
            if (!parse_integer(word, value) || value < 1 || value > INT32_MAX)
                return in_.error(
                    ErrorCode::bad_syntax,
                    fmt::format("{} needs three numbers of cells, not {}", keyword, shown(word)));
            *count = static_cast<std::uint32_t>(value);
        }
        if (known && before != std::array{grid.nx, grid.ny, grid.nz})
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("{} says {} x {} x {} cells, but {} x {} x {} were stated",
                                         keyword, grid.nx, grid.ny, grid.nz, before[0], before[1],
                                         before[2]));
        // At most 2^29 cells, so that corners have numbers of 32 bits.
        const auto columns = std::uint64_t{grid.nx} * grid.ny;
        if (columns > (1U << 29U) || columns * grid.nz > (1U << 29U))
            return in_.error(ErrorCode::unsupported, "the grid has more than 536870912 cells");
        cells_ = columns * grid.nz;
        pillars_ = (std::uint64_t{grid.nx} + 1) * (std::uint64_t{grid.ny} + 1);
        size_ = fmt::format("{} x {} x {}", grid.nx, grid.ny, grid.nz);
        return keyword == "SPECGRID" ? read_kind_of_grid() : skip_record();
    }

    /// Reads the number of reservoirs and the type of coordinates.
    MaybeError read_kind_of_grid() {
        auto word = next();
        if (word == "/") return std::nullopt;
        if (word != "1" && word != "1*")
            return in_.error(ErrorCode::unsupported,
                             "SPECGRID: several reservoirs (" + shown(word) + ") are not read");
        word = next();
        if (word == "/") return std::nullopt;
        if (upper(without_quotes(word)) == "T")
            return in_.error(ErrorCode::unsupported,
                             "SPECGRID: radial grids (T) are not read, only Cartesian ones (F)");
        return skip_record();
    }

    MaybeError skip_record() {
        for (auto word = next(); !word.empty(); word = next())
            if (word == "/") break;
        return std::nullopt;
    }

    /// The values of a keyword.
    struct Array {
        std::size_t line = 0; ///< of the keyword; 0: it is not there
        std::vector<double> values;
    };

    [[nodiscard]] std::uint64_t wanted_count(const Array& array) const {
        return &array == &coord_ ? 6 * pillars_ : &array == &zcorn_ ? 8 * cells_ : cells_;
    }

    MaybeError read_array(const std::string& keyword, Array& array) {
        if (cells_ == 0)
            return in_.error(ErrorCode::bad_syntax,
                             keyword + " stands before SPECGRID, which tells how many cells there "
                                       "are");
        if (array.line != 0)
            return in_.error(
                ErrorCode::bad_syntax,
                fmt::format("{} is there twice, first in line {}", keyword, array.line));
        array.line = in_.number();
        const auto wanted = wanted_count(array);
        if (wanted > most_values_)
            return in_.error(ErrorCode::unsupported,
                             fmt::format("{} x {} values are more than 256 for each byte of the "
                                         "file",
                                         keyword, wanted));
        for (auto word = next(); word != "/"; word = next()) {
            if (word.empty())
                return in_.error(ErrorCode::bad_syntax,
                                 fmt::format("the file ends within {}, after {} of {} values",
                                             keyword, array.values.size(), wanted));
            if (auto trouble = read_values(keyword, word, wanted, array.values)) return trouble;
        }
        if (array.values.size() == wanted) return std::nullopt;
        return in_.error(ErrorCode::bad_syntax,
                         fmt::format("{} has {} values; {} cells need {}", keyword,
                                     array.values.size(), size_, wanted));
    }

    /// Reads "0.5" or "3*0.5".
    MaybeError read_values(const std::string& keyword, std::string_view word, std::uint64_t wanted,
                           std::vector<double>& values) const {
        std::int64_t count = 1;
        if (const auto star = word.find('*'); star != std::string_view::npos) {
            if (!parse_integer(word.substr(0, star), count) || count < 1)
                return in_.error(ErrorCode::bad_syntax,
                                 shown(word) + " does not repeat a value, as in 3*0.5");
            word.remove_prefix(star + 1);
            if (word.empty())
                return in_.error(ErrorCode::bad_syntax,
                                 keyword + " has no default values, as 3* would ask for");
        }
        double value = 0;
        if (auto trouble = in_.read_number(word, value)) return trouble;
        if (static_cast<std::uint64_t>(count) > wanted - values.size())
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("{} has more than the {} values that {} cells need",
                                         keyword, wanted, size_));
        values.insert(values.end(), static_cast<std::size_t>(count), value);
        return std::nullopt;
    }

    /// Reads records such as 'F1' 3 3 1 9 1 22 'X' /, up to an empty one.
    MaybeError read_faults(CornerPointGrid& grid) {
        if (cells_ == 0)
            return in_.error(ErrorCode::bad_syntax,
                             "FAULTS stands before SPECGRID, which tells how many cells there are");
        for (auto word = next(); word != "/"; word = next()) {
            if (word.empty())
                return in_.error(ErrorCode::bad_syntax, "the file ends within FAULTS");
            if (auto trouble = read_fault(without_quotes(word), grid)) return trouble;
        }
        return std::nullopt;
    }

    MaybeError read_fault(const std::string& name, CornerPointGrid& grid) {
        std::array<std::uint32_t, 6> box{};
        for (std::size_t n = 0; n < 6; ++n) {
            const auto word = next();
            const std::uint32_t most = n < 2 ? grid.nx : n < 4 ? grid.ny : grid.nz;
            std::int64_t value = 0;
            if (!parse_integer(word, value) || value < 1 || value > most ||
                (n % 2 == 1 && value < box[n - 1]))
                return in_.error(ErrorCode::bad_syntax,
                                 fmt::format("fault {} is at cells {}, but there are {}",
                                             shown(name), shown(word), size_));
            box[n] = static_cast<std::uint32_t>(value);
        }
        const auto side = upper(without_quotes(next()));
        if (auto trouble = skip_record()) return trouble;
        const char axis = side.empty() ? '?' : side[0];
        if (axis == 'Z' || axis == 'K') return std::nullopt; // between layers
        const bool across_i = axis == 'X' || axis == 'I';
        if ((!across_i && axis != 'Y' && axis != 'J') ||
            box[across_i ? 0 : 2] != box[across_i ? 1 : 3])
            return in_.error(ErrorCode::bad_syntax,
                             fmt::format("fault {} is no row of faces X, Y or Z", shown(name)));
        const auto [number, added] =
            fault_numbers_.try_emplace(name, static_cast<std::uint32_t>(grid.faults.size()));
        if (added) grid.faults.push_back(name);
        const auto count = std::uint64_t{box[1] - box[0] + 1} * (box[3] - box[2] + 1);
        if (count > most_values_ - grid.faces.size())
            return in_.error(ErrorCode::unsupported, "FAULTS names too many faces");
        const std::uint32_t behind = side.ends_with('-') ? 0 : 1;
        for (auto i = box[0] - 1; i < box[1]; ++i)
            for (auto j = box[2] - 1; j < box[3]; ++j)
                grid.faces.push_back({across_i ? i + behind : i, across_i ? j : j + behind,
                                      across_i, number->second});
        return std::nullopt;
    }

    MaybeError read_map_axes() {
        has_map_axes_ = true;
        for (double& value : map_axes_)
            if (auto trouble = in_.read_number(next(), value)) return trouble;
        const auto& [yx, yy, ox, oy, xx, xy] = map_axes_;
        const double along_y = std::hypot(yx - ox, yy - oy), along_x = std::hypot(xx - ox, xy - oy);
        if (along_x == 0 || along_y == 0 || !std::isfinite(along_x) || !std::isfinite(along_y))
            return in_.error(ErrorCode::bad_number, "MAPAXES: an axis has no direction");
        return skip_record();
    }

    MaybeError read_unit(const std::string& keyword) {
        const auto line = in_.number();
        std::vector<std::string> words;
        for (auto word = next(); word != "/" && !word.empty(); word = next())
            words.push_back(without_quotes(word));
        if (words.empty())
            return in_.error_at(line, ErrorCode::bad_syntax, keyword + " names no unit");
        (keyword == "GRIDUNIT" ? grid_unit_ : map_unit_) = unit_named(words[0]);
        if (keyword == "GRIDUNIT" && words.size() > 1) in_map_ = upper(words[1]) == "MAP";
        return std::nullopt;
    }

    [[nodiscard]] MaybeError check_complete() const {
        if (cells_ == 0)
            return in_.file_error(ErrorCode::bad_syntax,
                                  "there is no SPECGRID and no DIMENS, so this is no grid");
        if (coord_.line == 0 || zcorn_.line == 0)
            return in_.file_error(
                ErrorCode::bad_syntax,
                fmt::format("there is no {}; only corner-point grids are read, not DX, DY, DZ and "
                            "TOPS",
                            coord_.line == 0 ? "COORD" : "ZCORN"));
        if (has_map_axes_ && !in_map_ && !map_unit_.empty() && !grid_unit_.empty() &&
            map_unit_ != grid_unit_)
            return in_.file_error(ErrorCode::unsupported,
                                  fmt::format("MAPUNITS is {}, but GRIDUNIT is {}",
                                              shown(map_unit_), shown(grid_unit_)));
        return std::nullopt;
    }

    MaybeError take_over(CornerPointGrid& grid) {
        grid.pillars.resize(pillars_);
        for (std::size_t n = 0; n < coord_.values.size(); ++n)
            grid.pillars[n / 6][n % 6] = coord_.values[n];
        if (has_map_axes_ && !in_map_) turn(grid);
        for (const auto& pillar : grid.pillars)
            for (const double value : pillar)
                if (!std::isfinite(value))
                    return in_.file_error(ErrorCode::bad_number,
                                          "MAPAXES: a pillar is beyond all doubles");
        grid.depths = std::move(zcorn_.values);
        for (const double value : actnum_.values) grid.active.push_back(value != 0 ? 1 : 0);
        const auto& unit = grid_unit_.empty() ? usual_unit_ : grid_unit_;
        grid.frame.horizontal_unit = grid.frame.vertical_unit = unit;
        return std::nullopt;
    }

    /// Turns and shifts the pillars from the axes of the grid to those of the map.
    void turn(CornerPointGrid& grid) const {
        const auto& [yx, yy, ox, oy, xx, xy] = map_axes_;
        const double along_y = std::hypot(yx - ox, yy - oy), along_x = std::hypot(xx - ox, xy - oy);
        const std::array<double, 2> i{(xx - ox) / along_x, (xy - oy) / along_x},
            j{(yx - ox) / along_y, (yy - oy) / along_y};
        for (auto& pillar : grid.pillars)
            for (const std::size_t end : {0U, 3U}) {
                const double x = pillar[end], y = pillar[end + 1];
                pillar[end] = ox + (x * i[0] + y * j[0]);
                pillar[end + 1] = oy + (x * i[1] + y * j[1]);
            }
    }

    LineParser in_;
    std::string_view rest_;
    bool first_in_line_ = false; ///< the word that next() returned is the first one of its line
    bool ended_ = false;
    std::uint64_t most_values_, cells_ = 0, pillars_ = 0;
    std::string size_; ///< "3 x 4 x 2", for messages
    Array coord_, zcorn_, actnum_;
    std::map<std::string, std::uint32_t> fault_numbers_;
    bool has_map_axes_ = false, in_map_ = false;
    std::array<double, 6> map_axes_{}; ///< x and y of a point on the y axis, of the origin, of x
    std::string grid_unit_, map_unit_, usual_unit_;
};

} // namespace

Result<CornerPointGrid> read_corner_points(std::string_view contents, std::string_view source) {
    CornerPointGrid grid;
    if (auto trouble = GrdeclReader(contents, source).read(grid)) return *trouble;
    return grid;
}

Result<std::vector<Surface>> read_grdecl(std::string_view contents, std::string_view source) {
    const auto grid = read_corner_points(contents, source);
    if (!grid) return grid.error();
    auto surfaces = surfaces_of_corner_points(*grid);
    if (surfaces) return surfaces;
    Error error = surfaces.error();
    error.place = source;
    return error;
}

} // namespace terrane
