// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/grids/irap.hpp>

#include <cmath>

#include <fmt/format.h>

#include <terrane/io/grids/grid_text.hpp>
#include <terrane/io/text/bytes.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::int64_t magic = -996;
constexpr double text_null = 9999900;
constexpr float binary_null = 1e30F;
constexpr std::uint32_t first_record = 32; ///< bytes

MaybeError read_text_header(TokenStream& text, Grid& grid) {
    std::int64_t first = 0;
    if (auto trouble = text.integer("-996", first)) return trouble;
    if (first != magic)
        return text.in().error(ErrorCode::bad_syntax, "an Irap grid begins with -996");
    double unused = 0;
    if (auto trouble = text.count("the number of rows", grid.ny)) return trouble;
    for (double* step : {&grid.dx, &grid.dy})
        if (auto trouble = text.number("the steps", *step)) return trouble;
    for (int i = 0; i < 4; ++i)
        if (auto trouble = text.number("the limits", unused)) return trouble;
    if (auto trouble = text.count("the number of columns", grid.nx)) return trouble;
    for (double* number : {&grid.rotation, &grid.x, &grid.y})
        if (auto trouble = text.number("rotation and origin", *number)) return trouble;
    for (int i = 0; i < 7; ++i)
        if (auto trouble = text.number("the seven unused numbers", unused)) return trouble;
    return check_steps(text.in(), grid);
}

MaybeError read_text(LineParser& in, Grid& grid) {
    TokenStream text(in);
    if (auto trouble = read_text_header(text, grid)) return trouble;
    if (auto trouble = make_room(text, grid)) return trouble;
    for (double& value : grid.values) {
        if (auto trouble = text.number("the last height", value)) return trouble;
        if (value >= text_null) value = no_height;
    }
    if (!text.next().empty())
        return in.error(ErrorCode::bad_syntax,
                        fmt::format("there are more than {} x {} heights", grid.nx, grid.ny));
    return std::nullopt;
}

class BinaryReader {
public:
    BinaryReader(std::string_view bytes, std::string_view source) :
        bytes_(bytes), source_(source) {}

    MaybeError read(Grid& grid) {
        std::string_view record;
        if (auto trouble = next_record(record, first_record)) return trouble;
        if (integer(record, 0) != magic)
            return error(ErrorCode::bad_syntax, "an Irap grid begins with -996");
        const auto rows = integer(record, 1);
        grid.dx = number(record, 6);
        grid.dy = number(record, 7);
        if (auto trouble = next_record(record, 16)) return trouble;
        const auto columns = integer(record, 0);
        grid.rotation = number(record, 1);
        grid.x = number(record, 2);
        grid.y = number(record, 3);
        if (auto trouble = next_record(record, 28)) return trouble;
        if (auto trouble = check(grid, columns, rows)) return trouble;
        return read_heights(grid);
    }

private:
    [[nodiscard]] Error error(ErrorCode code, std::string sentence) const {
        return {code, std::move(sentence), fmt::format("{}, byte {}", source_, at_)};
    }

    /// Reads the next record of FORTRAN, which is enclosed by two copies of its length.
    MaybeError next_record(std::string_view& record, std::uint32_t wanted = 0) {
        const auto left = bytes_.size() - at_;
        const auto length =
            left < 8 ? 0 : load<std::uint32_t>(bytes_.data() + at_, std::endian::big);
        if (left < 8 || length > left - 8 || (wanted != 0 && length != wanted) ||
            load<std::uint32_t>(bytes_.data() + at_ + 4 + length, std::endian::big) != length)
            return error(ErrorCode::bad_syntax,
                         wanted == 0 ? "a record is not whole"
                                     : fmt::format("a record of {} bytes is missing", wanted));
        record = bytes_.substr(at_ + 4, length);
        at_ += length + 8;
        return std::nullopt;
    }

    static std::int32_t integer(std::string_view record, std::size_t i) {
        return load<std::int32_t>(record.data() + 4 * i, std::endian::big);
    }
    static float number(std::string_view record, std::size_t i) {
        return load<float>(record.data() + 4 * i, std::endian::big);
    }

    [[nodiscard]] MaybeError check(Grid& grid, std::int64_t columns, std::int64_t rows) const {
        if (columns < 1 || rows < 1 ||
            static_cast<std::uint64_t>(columns * rows) > (bytes_.size() - at_) / 4)
            return error(ErrorCode::bad_syntax,
                         fmt::format("the file can't hold {} x {} heights", columns, rows));
        grid.nx = static_cast<std::uint32_t>(columns);
        grid.ny = static_cast<std::uint32_t>(rows);
        for (const double value : {grid.x, grid.y, grid.dx, grid.dy, grid.rotation})
            if (!std::isfinite(value))
                return error(ErrorCode::bad_number, "origin, steps or rotation are not finite");
        if (grid.dx == 0 || grid.dy == 0)
            return error(ErrorCode::bad_number, "the nodes of the grid coincide");
        return std::nullopt;
    }

    MaybeError read_heights(Grid& grid) {
        const auto wanted = std::size_t{grid.nx} * grid.ny;
        while (grid.values.size() < wanted) {
            std::string_view record;
            if (auto trouble = next_record(record)) return trouble;
            if (record.empty() || record.size() % 4 != 0 ||
                record.size() / 4 > wanted - grid.values.size())
                return error(ErrorCode::bad_syntax,
                             "a record has more heights than there are nodes");
            for (std::size_t i = 0; i < record.size() / 4; ++i) {
                const float value = number(record, i);
                if (std::isnan(value) || std::isinf(value))
                    return error(ErrorCode::bad_number, "a height is not finite");
                grid.values.push_back(value >= binary_null ? no_height : double{value});
            }
        }
        if (at_ != bytes_.size())
            return error(ErrorCode::bad_syntax, "there is more than one grid");
        return std::nullopt;
    }

    std::string_view bytes_;
    std::string_view source_;
    std::size_t at_ = 0;
};

} // namespace

Result<Grid> read_irap(std::string_view contents, std::string_view source, std::string_view name) {
    Grid grid;
    grid.name = name;
    const bool binary = contents.size() >= 4 &&
                        load<std::uint32_t>(contents.data(), std::endian::big) == first_record;
    if (binary) {
        if (auto trouble = BinaryReader(contents, source).read(grid)) return *trouble;
        return grid;
    }
    LineParser in(contents, source);
    if (auto trouble = read_text(in, grid)) return *trouble;
    return grid;
}

} // namespace terrane
