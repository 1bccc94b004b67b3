// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/legacy_vtk_arrays.hpp>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>

#include <terrane/io/meshes/detail/vtk_cells.hpp>
#include <terrane/io/meshes/detail/vtk_data.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/values.hpp>

namespace terrane::detail {

MaybeError LegacyVtkArrays::read(std::string section, std::size_t points, std::size_t cells) {
    points_ = points;
    cells_ = cells;
    auto trouble = read_sections(std::move(section));
    // Fields of cells come first in Terrane's files, those of points first in the lists.
    std::ranges::stable_sort(values_, {}, &ValueArray::on_triangles);
    describe_arrays({texts("value_name"), texts("value_unit"), fields_["value_no_data"]}, values_);
    return trouble;
}

/// Reads the arrays of a field, and keeps those about surfaces. Texts are kept as the codes of
/// their characters, each ended by a 0.
MaybeError LegacyVtkArrays::read_field(Arrays& arrays) {
    in_.token(); // its name
    std::size_t count = 0;
    if (auto trouble = in_.read_count(count)) return trouble;
    for (std::size_t a = 0; a < count; ++a) {
        while (in_.takes("metadata")) in_.skip_paragraph();
        const std::string name(in_.token());
        if (name.empty()) return in_.no_number({});
        std::size_t components = 0, tuples = 0;
        if (auto trouble = in_.read_count(components)) return trouble;
        if (auto trouble = in_.read_count(tuples)) return trouble;
        if (components != 0 && tuples > in_.size() / components)
            return in_.error(ErrorCode::bad_syntax, "the array is longer than the file");
        if (&arrays != &fields_) {
            if (auto trouble = read_values(name, components, tuples, arrays)) return trouble;
            continue;
        }
        std::vector<double> values;
        if (auto trouble = read_array(components * tuples, values)) return trouble;
        if (name.starts_with("surface") || name.starts_with("value_"))
            arrays[name] = std::move(values);
    }
    return std::nullopt;
}

/// Reads the type and the numbers of an array on points or cells.
MaybeError LegacyVtkArrays::read_values(const std::string& name, std::size_t components,
                                        std::size_t tuples, Arrays& arrays) {
    if (!in_.takes("string")) {
        LegacyType type{};
        if (auto trouble = in_.read_type(type)) return trouble;
        return read_values(name, components, tuples, type, arrays);
    }
    std::vector<std::string> texts;
    if (auto trouble = in_.read_texts(components * tuples, texts)) return trouble;
    ValueArray array = empty_array(name, components, arrays);
    set_texts(texts, array);
    keep(std::move(array));
    return std::nullopt;
}

MaybeError LegacyVtkArrays::read_values(const std::string& name, std::size_t components,
                                        std::size_t tuples, const LegacyType& type,
                                        Arrays& arrays) {
    ValueArray array = empty_array(name, components, arrays);
    array.type = *number_type_named(type.xml_name);
    const std::size_t count = components * tuples;
    auto trouble = array.type <= NumberType::float32
                       ? in_.read_numbers(count, type, array.numbers.emplace<0>())
                       : in_.read_numbers(count, type, array.numbers.emplace<1>());
    if (trouble) return trouble;
    if (name.starts_with("surface") || std::ranges::count(label_arrays, name) != 0)
        std::visit(
            [&](const auto& numbers) { arrays[name].assign(numbers.begin(), numbers.end()); },
            array.numbers);
    keep(std::move(array));
    return std::nullopt;
}

ValueArray LegacyVtkArrays::empty_array(const std::string& name, std::size_t components,
                                        const Arrays& arrays) const {
    ValueArray array{.name = decoded_word(name), .on_triangles = &arrays == &of_cells_};
    array.components = static_cast<std::uint32_t>(components);
    return array;
}

/// Keeps an array as values of the surfaces; one that can't be is only named.
void LegacyVtkArrays::keep(ValueArray array) {
    constexpr std::size_t most_arrays = 64; // a point may be in many surfaces
    const std::string name = array.name;
    const std::size_t count = array.on_triangles ? cells_ : points_;
    if (is_reserved(name)) return;
    if (values_.size() == most_arrays || !add_array(std::move(array), count, values_))
        note_values(name, left_out_);
}

MaybeError LegacyVtkArrays::read_array(std::size_t count, std::vector<double>& values) {
    if (!in_.takes("string")) {
        LegacyType type{};
        if (auto trouble = in_.read_type(type)) return trouble;
        return in_.read_numbers(count, type, values);
    }
    std::vector<std::string> texts;
    if (auto trouble = in_.read_texts(count, texts)) return trouble;
    for (const std::string& text : texts) {
        for (const char c : text) values.push_back(static_cast<unsigned char>(c));
        values.push_back(0);
    }
    return std::nullopt;
}

/// Reads the arrays of cells and points, of which the first section is the current one, up to
/// what is not known.
MaybeError LegacyVtkArrays::read_sections(std::string section) {
    std::size_t count = 0;
    Arrays unused;
    Arrays* arrays = &unused;
    while (!section.empty()) {
        if (section == "cell_data" || section == "point_data") {
            if (auto trouble = in_.read_count(count)) return trouble;
            arrays = section == "cell_data" ? &of_cells_ : &unused;
        } else if (section == "field") {
            if (auto trouble = read_field(*arrays)) return trouble;
        } else if (section == "scalars") {
            if (auto trouble = read_scalars(count, *arrays)) return trouble;
        } else if (section == "vectors" || section == "normals") {
            if (auto trouble = read_tuples(3, count, *arrays)) return trouble;
        } else if (section == "tensors") {
            if (auto trouble = read_tuples(9, count, *arrays)) return trouble;
        } else if (section == "metadata") {
            in_.skip_paragraph();
        } else {
            note_values(in_.token(), left_out_); // of texture coordinates, colours and the like
            return std::nullopt;
        }
        section = lower(in_.token());
    }
    return std::nullopt;
}

/// Reads "VECTORS name type" and the like, and the values.
MaybeError LegacyVtkArrays::read_tuples(std::size_t components, std::size_t count, Arrays& arrays) {
    const std::string name(in_.token());
    if (count > in_.size() / components)
        return in_.error(ErrorCode::bad_syntax, "the array is longer than the file");
    return read_values(name, components, count, arrays);
}

/// Reads "SCALARS name type [components]", "LOOKUP_TABLE name" and the values.
MaybeError LegacyVtkArrays::read_scalars(std::size_t count, Arrays& arrays) {
    const std::string name(in_.token());
    LegacyType type{};
    if (auto trouble = in_.read_type(type)) return trouble;
    std::size_t components = 1;
    if (!in_.takes("lookup_table")) {
        if (auto trouble = in_.read_count(components)) return trouble;
        if (!in_.takes("lookup_table"))
            return in_.error(ErrorCode::bad_syntax, "LOOKUP_TABLE is needed here");
    }
    in_.token(); // the name of the table
    if (components != 0 && count > in_.size() / components)
        return in_.error(ErrorCode::bad_syntax, "the array is longer than the file");
    return read_values(name, components, count, type, arrays);
}

/// Returns the texts in an array of character codes, each ended by a 0.
std::vector<std::string> LegacyVtkArrays::texts(const std::string& array) const {
    std::vector<std::string> texts;
    std::string text;
    const auto codes = fields_.find(array);
    if (codes == fields_.end()) return texts;
    for (const double code : codes->second) {
        if (code > 0 && code < 256)
            text += static_cast<char>(static_cast<unsigned char>(code));
        else
            texts.push_back(std::exchange(text, {}));
    }
    return texts;
}

} // namespace terrane::detail
