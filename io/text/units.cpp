// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/units.hpp>

#include <array>
#include <cmath>

namespace terrane::detail {
namespace {

struct Unit {
    std::string_view name;
    double metres; ///< its length
    std::array<std::string_view, 6> spellings;
};

constexpr std::array<Unit, 5> units{{
    {"m", 1.0, {"m", "metre", "metres", "meter", "meters", "mtr"}},
    {"km", 1000.0, {"km", "kilometre", "kilometres", "kilometer", "kilometers", "kms"}},
    {"cm", 0.01, {"cm", "centimetre", "centimetres", "centimeter", "centimeters", "cms"}},
    {"ft", 0.3048, {"ft", "foot", "feet", "f", "'", "international feet"}},
    {"ftUS",
     1200.0 / 3937.0,
     {"ftus", "us-ft", "us_ft", "usft", "us survey foot", "us survey feet"}},
}};

} // namespace

std::string unit_named(std::string_view text) {
    const auto stated = trimmed(text);
    for (const Unit& unit : units)
        for (const auto spelling : unit.spellings)
            if (same_ignoring_case(stated, spelling)) return std::string(unit.name);
    return std::string(stated);
}

std::optional<double> metres_in(std::string_view unit) {
    const auto name = unit_named(unit);
    for (const Unit& known : units)
        if (known.name == name) return known.metres;
    return std::nullopt;
}

MaybeError convert_units(Surface& surface, std::string_view unit) {
    const auto wanted = metres_in(unit);
    if (!wanted)
        return Error{ErrorCode::bad_option, "no unit of length is called " + shown(unit), ""};
    const auto factor_of = [&](const std::string& stated) -> std::optional<double> {
        if (stated.empty() || stated == unit_named(unit)) return 1.0;
        const auto metres = metres_in(stated);
        return metres ? std::optional(*metres / *wanted) : std::nullopt;
    };
    CoordinateFrame& frame = surface.frame;
    const auto horizontal = factor_of(frame.horizontal_unit);
    const auto vertical = factor_of(frame.vertical_unit);
    if (!horizontal || !vertical)
        return Error{ErrorCode::unsupported,
                     "surface " + shown(surface.name) + " is in " +
                         shown(horizontal ? frame.vertical_unit : frame.horizontal_unit) +
                         ", which cannot be converted",
                     ""};
    for (Point3& p : surface.vertices) {
        if (*horizontal != 1) p = {p.x * *horizontal, p.y * *horizontal, p.z};
        if (*vertical != 1) p.z *= *vertical;
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            return Error{ErrorCode::bad_number, "a coordinate is too large to be converted", ""};
    }
    if (!frame.horizontal_unit.empty()) frame.horizontal_unit = unit_named(unit);
    if (!frame.vertical_unit.empty()) frame.vertical_unit = unit_named(unit);
    return std::nullopt;
}

std::string common_unit(std::span<const Surface> surfaces) {
    std::string unit;
    for (const Surface& s : surfaces)
        for (const std::string& stated : {s.frame.horizontal_unit, s.frame.vertical_unit}) {
            if (stated.empty()) continue;
            if (!unit.empty() && stated != unit) return {};
            unit = stated;
        }
    return unit;
}

} // namespace terrane::detail
