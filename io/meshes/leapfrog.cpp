// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/leapfrog.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/text/bytes.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

using namespace detail;

namespace {

constexpr std::string_view first_line = "%ARANZ-1.0";
constexpr std::string_view data_mark = "[binary]";
/// Four bytes and this number, which tells the byte order, precede the arrays.
constexpr double order_mark = 1.23456789;
constexpr std::size_t mark_bytes = 4 + sizeof(double);

class LeapfrogReader {
public:
    LeapfrogReader(std::string_view contents, std::string_view source) :
        contents_(contents), in_(contents, source) {}

    Result<std::vector<Surface>> read(std::string_view name) {
        const auto mark = contents_.find(data_mark);
        if (mark == std::string_view::npos)
            return in_.file_error(ErrorCode::bad_syntax, "there is no [binary]");
        data_ = contents_.substr(mark + data_mark.size());
        const std::size_t lines =
            static_cast<std::size_t>(std::ranges::count(contents_.substr(0, mark), '\n'));
        if (!take_order()) return in_.file_error(ErrorCode::bad_syntax, "the arrays are cut off");
        while (in_.next() && in_.number() <= lines)
            if (auto trouble = read_array()) return *trouble;
        if (surface_.triangles.empty())
            return in_.file_error(ErrorCode::nothing_to_do, "there is no triangle");
        for (const Triangle& corners : surface_.triangles)
            for (const std::uint32_t v : corners)
                if (v >= surface_.vertices.size())
                    return in_.file_error(
                        ErrorCode::bad_index,
                        fmt::format(
                            "a triangle names vertex {}, which does not exist: there are {}", v,
                            surface_.vertices.size()));
        surface_.name = name;
        return std::vector<Surface>{std::move(surface_)};
    }

private:
    bool take_order() {
        if (data_.size() < mark_bytes) return false;
        for (const std::endian order : {std::endian::little, std::endian::big})
            if (load<double>(data_.data() + 4, order) == order_mark) {
                order_ = order;
                data_.remove_prefix(mark_bytes);
                return true;
            }
        return false;
    }

    /// Reads the array of a line "Location Double 3 N;".
    MaybeError read_array() {
        auto line = trimmed(in_.line());
        if (!line.ends_with(';')) return std::nullopt;
        line.remove_suffix(1);
        Tokens tokens(line);
        const auto name = tokens.next(), type = tokens.next();
        const std::size_t size = type == "Double"                       ? 8
                                 : type == "Integer" || type == "Float" ? 4
                                                                        : 0;
        std::int64_t width = 0, count = 0;
        if (size == 0 || !parse_integer(tokens.next(), width) ||
            !parse_integer(tokens.next(), count) || width < 1 || count < 0)
            return in_.error(ErrorCode::bad_syntax, shown(line) + " describes no array");
        const auto columns = static_cast<std::size_t>(width),
                   rows = static_cast<std::size_t>(count);
        if (rows > data_.size() / size / columns)
            return in_.error(ErrorCode::bad_syntax, "the array is cut off");
        const bool is_location = name == "Location", is_triangles = name == "Tri";
        if ((is_location && (type != "Double" || columns != 3)) ||
            (is_triangles && (type != "Integer" || columns != 3)))
            return in_.error(ErrorCode::unsupported,
                             shown(line) + " is not of a kind that is read");
        for (std::size_t i = 0; i < rows; ++i) {
            const char* const row = data_.data() + i * columns * size;
            if (is_location && !add_vertex(row))
                return in_.error(ErrorCode::bad_number, fmt::format("vertex {} is not finite", i));
            if (is_triangles)
                surface_.triangles.push_back({load<std::uint32_t>(row, order_),
                                              load<std::uint32_t>(row + 4, order_),
                                              load<std::uint32_t>(row + 8, order_)});
        }
        data_.remove_prefix(rows * columns * size);
        return std::nullopt;
    }

    bool add_vertex(const char* row) {
        const Point3 p{load<double>(row, order_), load<double>(row + 8, order_),
                       load<double>(row + 16, order_)};
        surface_.vertices.push_back(p);
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    }

    std::string_view contents_, data_;
    LineParser in_;
    std::endian order_ = std::endian::little;
    Surface surface_;
};

} // namespace

bool is_leapfrog(std::string_view contents) {
    return contents.starts_with(first_line);
}

Result<std::vector<Surface>> read_leapfrog(std::string_view contents, std::string_view source,
                                           std::string_view name) {
    return guard_memory(source, [&] { return LeapfrogReader(contents, source).read(name); });
}

} // namespace terrane
