// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/values.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/no_index.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {
namespace {

bool is_same_array(const ValueArray& a, const ValueArray& b) {
    return a.name == b.name && a.on_triangles == b.on_triangles && a.components == b.components &&
           a.type == b.type && a.unit == b.unit && a.texts.empty() == b.texts.empty();
}

/// Gives an array a name that none of the others on the same elements has.
void rename_apart(const std::vector<ValueArray>& others, ValueArray& array) {
    const std::string name = array.name;
    const auto is_taken = [&] {
        return is_reserved(array.name) || std::ranges::any_of(others, [&](const ValueArray& other) {
                   return other.name == array.name && other.on_triangles == array.on_triangles;
               });
    };
    for (std::size_t n = 2; is_taken(); ++n) array.name = fmt::format("{}_{}", name, n);
}

/// Arrays over a whole mesh while they are joined.
class ArrayJoiner {
public:
    ArrayJoiner(std::size_t vertices, std::size_t triangles) :
        vertices_(vertices), triangles_(triangles) {}

    /// `where`: per value of the array, its vertex or triangle.
    void add(const ValueArray& array, std::span<const std::uint32_t> where) {
        const auto same = std::ranges::find_if(
            given_, [&](const ValueArray& g) { return is_same_array(g, array); });
        const auto at = static_cast<std::size_t>(same - given_.begin());
        if (same == given_.end()) begin(array);
        ValueArray& to = joined_[at];
        std::vector<std::int64_t> text_of;
        for (const std::string& text : array.texts) {
            const auto known = std::ranges::find(to.texts, text);
            text_of.push_back(known - to.texts.begin());
            if (known == to.texts.end()) to.texts.push_back(text);
        }
        std::visit(
            [&](auto& numbers) {
                using Numbers = std::decay_t<decltype(numbers)>;
                const auto& from = std::get<Numbers>(array.numbers);
                for (std::size_t i = 0; i < from.size(); ++i) {
                    const std::size_t k =
                        where[i / to.components] * to.components + i % to.components;
                    if (has_no_data(array, i) || is_set_[at][k]) continue;
                    is_set_[at][k] = true;
                    if constexpr (std::is_same_v<Numbers, std::vector<double>>)
                        numbers[k] = from[i];
                    else
                        numbers[k] = text_of.empty()
                                         ? from[i]
                                         : text_of.at(static_cast<std::size_t>(from[i]));
                }
            },
            to.numbers);
    }

    std::vector<ValueArray> take() {
        for (std::size_t a = 0; a < joined_.size();
             ++a) // an array without gaps needs no number for them
            if (std::ranges::count(is_set_[a], false) == 0) joined_[a].no_data = given_[a].no_data;
        return std::move(joined_);
    }

private:
    void begin(const ValueArray& array) {
        given_.push_back(array);
        given_.back().numbers = {};
        ValueArray empty = without_data(array, array.on_triangles ? triangles_ : vertices_);
        rename_apart(joined_, empty);
        is_set_.emplace_back(empty.size() * empty.components);
        joined_.push_back(std::move(empty));
    }

    std::size_t vertices_, triangles_;
    std::vector<ValueArray> given_; ///< parallel to joined_: without numbers
    std::vector<ValueArray> joined_;
    std::vector<std::vector<bool>> is_set_; ///< per array and number
};

} // namespace

bool is_reserved(std::string_view name) {
    constexpr auto known = std::to_array<std::string_view>(
        {"nx", "ny", "nz", "normals", "surface", "surfaces", "surface_count", "region", "parent",
         "block", "twin", "cut_side", "volume_front", "volume_back", "interface", "patch",
         "triangle", "vtkValidPointMask", "vtkGhostType"});
    return std::ranges::any_of(
        known, [&](std::string_view other) { return same_ignoring_case(name, other); });
}

bool add_array(ValueArray array, std::size_t count, std::vector<ValueArray>& arrays) {
    array.name = one_line(trimmed(array.name));
    const auto numbers = std::visit([](const auto& all) { return all.size(); }, array.numbers);
    if (array.name.empty() || is_reserved(array.name) || array.components == 0 || count == 0 ||
        numbers % array.components != 0 || array.size() != count)
        return false;
    if (!array.texts.empty())
        for (const std::int64_t code : std::get<1>(array.numbers))
            if (code < 0 || code >= static_cast<std::int64_t>(array.texts.size())) return false;
    rename_apart(arrays, array);
    arrays.push_back(std::move(array));
    return true;
}

void set_texts(std::span<const std::string> texts, ValueArray& array) {
    array.type = NumberType::int32;
    auto& codes = array.numbers.emplace<1>();
    std::map<std::string_view, std::int64_t> code_of;
    for (const std::string& text : texts) {
        const auto [known, is_new] =
            code_of.try_emplace(text, static_cast<std::int64_t>(array.texts.size()));
        if (is_new) array.texts.push_back(text);
        codes.push_back(known->second);
    }
}

void describe_arrays(const ArrayDescriptions& given, std::vector<ValueArray>& arrays) {
    if (given.names.size() != arrays.size() || given.units.size() != given.names.size() ||
        given.no_data.size() != given.names.size() ||
        !std::ranges::equal(given.names, arrays, {}, {}, &ValueArray::name))
        return;
    for (std::size_t i = 0; i < given.names.size(); ++i) {
        arrays[i].unit = given.units[i];
        if (!std::isnan(given.no_data[i])) arrays[i].no_data = given.no_data[i];
    }
}

void append_piece(std::span<const ValueArray> piece, bool on_triangles,
                  std::vector<ValueArray>& arrays, std::vector<std::string>& left_out) {
    const auto find = [&](auto& among, const ValueArray& array) {
        return std::ranges::find_if(among, [&](const ValueArray& other) {
            return other.on_triangles == on_triangles && other.name == array.name &&
                   other.type == array.type && other.components == array.components &&
                   other.texts == array.texts;
        });
    };
    for (const ValueArray& array : piece)
        if (find(arrays, array) == arrays.end()) note_values(array.name, left_out);
    std::erase_if(arrays, [&](ValueArray& array) {
        if (array.on_triangles != on_triangles) return false;
        const auto more = find(piece, array);
        if (more == piece.end()) {
            note_values(array.name, left_out);
            return true;
        }
        std::visit(
            [&](auto& numbers) {
                const auto& further = std::get<std::decay_t<decltype(numbers)>>(more->numbers);
                numbers.insert(numbers.end(), further.begin(), further.end());
            },
            array.numbers);
        return false;
    });
}

std::vector<ValueArray> joined_values(std::size_t vertices, std::span<const Triangle> triangles,
                                      const IndexLists<std::uint32_t>& surfaces_of,
                                      std::span<const SurfaceValues> values) {
    if (std::ranges::all_of(values, &SurfaceValues::empty)) return {};
    std::vector<std::vector<std::uint32_t>> triangles_of(values.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t s : surfaces_of[t])
            if (s < values.size() && !values[s].empty()) triangles_of[s].push_back(t);
    ArrayJoiner joiner(vertices, triangles.size());
    for (std::size_t s = 0; s < values.size(); ++s) {
        std::vector<std::uint32_t> used;
        for (const std::uint32_t t : triangles_of[s])
            used.insert(used.end(), triangles[t].begin(), triangles[t].end());
        std::ranges::sort(used);
        used.erase(std::unique(used.begin(), used.end()), used.end());
        for (const ValueArray& array : values[s])
            joiner.add(array, array.on_triangles ? triangles_of[s] : used);
    }
    return joiner.take();
}

void append_value(std::string& out, const ValueArray& array, std::size_t i) {
    if (!array.is_integer())
        return array.type == NumberType::float32
                   ? append_number(out, static_cast<float>(std::get<0>(array.numbers)[i]))
                   : append_number(out, std::get<0>(array.numbers)[i]);
    const std::int64_t number = std::get<1>(array.numbers)[i];
    out += array.type == NumberType::uint64 ? fmt::format("{}", static_cast<std::uint64_t>(number))
                                            : fmt::format("{}", number);
}

} // namespace terrane::detail
