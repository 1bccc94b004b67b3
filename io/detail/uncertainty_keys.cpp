// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/detail/uncertainty_keys.hpp>

#include <algorithm>
#include <string>

#include <terrane/io/detail/project_keys.hpp>

namespace terrane::detail {
namespace {

constexpr double most_degrees = 45; ///< a standard deviation of an angle that still makes sense

/// Reads where the standard deviation of a field comes from: a number, kriging, or a map.
void read_deviation(JsonReader& in, const Json& json, const std::string& path,
                    const std::filesystem::path& base, ProjectField& field) {
    const Json *sd = in.find(json, "sd"), *map = in.find(json, "map");
    if ((sd == nullptr) == (map == nullptr))
        return in.fail(path, "must have one of the keys sd and map");
    if (map != nullptr) {
        field.map = (base / in.text(*map, path + ".map")).lexically_normal();
    } else if (sd->is_string() && *sd == "kriging") {
        field.kriging = true;
    } else if (sd->is_number()) {
        field.sd = in.positive(*sd, path + ".sd");
    } else {
        in.fail(path + ".sd", "must be kriging or a number larger than 0");
    }
}

ProjectField field_of(JsonReader& in, const Json& json, const std::string& path,
                      const std::filesystem::path& base) {
    ProjectField field;
    if (!in.object(json, path, field_level)) return field;
    if (const Json* v = in.find(json, "model"))
        field.model = in.one_of(*v, path + ".model", covariance_models);
    if (const Json* v = in.need(json, "range", path))
        field.range = in.positive(*v, path + ".range");
    if (const Json* v = in.find(json, "smoothness")) {
        field.smoothness = in.number(*v, path + ".smoothness");
        if (std::find(smoothnesses.begin(), smoothnesses.end(), field.smoothness) ==
            smoothnesses.end())
            in.fail(path + ".smoothness", "must be 1.5 or 2.5");
    }
    if (const Json* v = in.find(json, "azimuth")) field.azimuth = in.number(*v, path + ".azimuth");
    if (const Json* v = in.find(json, "ratio")) {
        field.ratio = in.positive(*v, path + ".ratio");
        if (field.ratio > 1) in.fail(path + ".ratio", "must be at most 1");
    }
    read_deviation(in, json, path, base, field);
    return field;
}

double degrees(JsonReader& in, const Json& value, const std::string& path) {
    const double angle = in.positive(value, path);
    if (angle > most_degrees) in.fail(path, "must be at most 45 degrees");
    return angle;
}

ProjectUncertainty entry_of(JsonReader& in, const Json& json, const std::string& path,
                            const std::filesystem::path& base) {
    ProjectUncertainty u;
    if (!in.object(json, path, uncertainty_level)) return u;
    if (const Json* v = in.need(json, "surface", path)) u.surface = in.text(*v, path + ".surface");
    if (const Json* v = in.find(json, "group")) u.group = in.text(*v, path + ".group");
    if (const Json* v = in.find(json, "field")) u.field = field_of(in, *v, path + ".field", base);
    if (const Json* v = in.find(json, "shift")) u.shift = in.positive(*v, path + ".shift");
    if (const Json* v = in.find(json, "tilt")) u.tilt = degrees(in, *v, path + ".tilt");
    if (const Json* v = in.find(json, "dip")) u.dip = degrees(in, *v, path + ".dip");
    if (const Json* v = in.find(json, "throw")) u.slip = in.positive(*v, path + ".throw");
    if (const Json* v = in.find(json, "throw_reach")) {
        u.reach = in.positive(*v, path + ".throw_reach");
        if (u.slip == 0) in.fail(path + ".throw_reach", "needs throw, whose reach it is");
    }
    if (!u.field && u.shift == 0 && u.tilt == 0 && u.dip == 0 && u.slip == 0)
        in.fail(path, "must have at least one of the keys field, shift, tilt, dip and throw");
    return u;
}

} // namespace

std::vector<ProjectUncertainty> uncertainty_of(JsonReader& in, const Json& json,
                                               const std::filesystem::path& base) {
    std::vector<ProjectUncertainty> all;
    in.array(json, "uncertainty", 1, SIZE_MAX, [&](const Json& entry, const std::string& at) {
        all.push_back(entry_of(in, entry, at, base));
    });
    return all;
}

} // namespace terrane::detail
