// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/project.hpp>

#include <array>
#include <new>
#include <string>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/detail/column_keys.hpp>
#include <terrane/io/detail/json_reader.hpp>

namespace terrane {

using namespace detail;

namespace detail {

namespace {

ColumnUnit unit_of(JsonReader& in, const Json& json, const std::string& path) {
    ColumnUnit unit;
    if (!in.object(json, path, column_level)) return unit;
    if (const Json* v = in.need(json, "unit", path)) unit.name = in.text(*v, path + ".unit");
    if (const Json* v = in.find(json, "surface")) unit.surface = in.text(*v, path + ".surface");
    if (const Json* v = in.find(json, "age")) unit.age = in.number(*v, path + ".age");
    if (const Json* v = in.find(json, "contact"))
        if (in.one_of(*v, path + ".contact", unit_contacts) == "erosive")
            unit.contact = UnitContact::erosive;
    return unit;
}

} // namespace

StratigraphicColumn column_of(JsonReader& in, const Json& json) {
    StratigraphicColumn column;
    in.array(json, "column", 1, SIZE_MAX, [&](const Json& entry, const std::string& at) {
        column.push_back(unit_of(in, entry, at));
    });
    if (in.error()) return column;
    if (const auto sound = check_column(column); !sound) {
        if (sound.error().code == ErrorCode::out_of_memory) throw std::bad_alloc();
        in.fail(sound.error().place, sound.error().sentence);
    }
    return column;
}

} // namespace detail

Result<StratigraphicColumn> parse_column(std::string_view text, std::string_view source) {
    return guard_memory(source, [&]() -> Result<StratigraphicColumn> {
        static constexpr std::array<std::string_view, 1> file_level{"column"};
        const auto json = parse_json(text, source);
        if (!json) return json.error();
        JsonReader in(source);
        StratigraphicColumn column;
        if (in.object(*json, "", file_level))
            if (const Json* v = in.need(*json, "column", "")) column = column_of(in, *v);
        if (in.error()) return *in.error();
        return column;
    });
}

Result<StratigraphicColumn> read_column(const std::filesystem::path& path) {
    return guard_memory("", [&]() -> Result<StratigraphicColumn> {
        const auto text = read_file(path);
        if (!text) return text.error();
        return parse_column(*text, path.string());
    });
}

} // namespace terrane
