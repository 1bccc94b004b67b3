// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/project.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <span>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/text/memory.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;
using Keys = std::span<const std::string_view>;

// ---- The keys of each object. project.schema.json says the same.

constexpr std::array<std::string_view, 12> project_level{
    "format", "folder", "threads", "surfaces",   "fill",   "layers", "volume_of_interest",
    "extend", "seal",   "improve", "tetrahedra", "outputs"};
constexpr std::array<std::string_view, 5> surfaces_level{"file", "objects", "name", "role",
                                                         "depth"};
constexpr std::array<std::string_view, 8> fill_level{"surface",       "method",    "model",
                                                     "max_area",      "mesh_size", "gap_slope",
                                                     "bridge_faults", "smoothing"};
constexpr std::array<std::string_view, 2> layers_level{"order", "min_thickness"};
constexpr std::array<std::string_view, 2> layer_level{"surface", "hardness"};
constexpr std::array<std::string_view, 4> volume_level{"box", "rotated_box", "polygon", "within"};
constexpr std::array<std::string_view, 2> box_level{"low", "high"};
constexpr std::array<std::string_view, 6> rotated_level{"centre",  "corner", "lengths",
                                                        "azimuth", "plunge", "roll"};
constexpr std::array<std::string_view, 2> polygon_level{"corners", "between"};
constexpr std::array<std::string_view, 3> improve_level{"edge_length", "max_deviation",
                                                        "edge_length_of"};
constexpr std::array<std::string_view, 8> tetrahedra_level{
    "edge_length", "max_volume", "quality", "size_of", "size_in", "split", "outside", "time_limit"};
constexpr std::array<std::string_view, 4> outputs_level{"surfaces", "tetrahedra", "blocks",
                                                        "certificate"};

constexpr std::array<std::string_view, 3> roles{"horizon", "fault", "boundary"};
constexpr std::array<std::string_view, 2> fill_methods{"kriging", "rbf"};
constexpr std::array<std::string_view, 5> variogram_models{"auto", "spherical", "exponential",
                                                           "gaussian", "power"};
constexpr std::array<std::string_view, 12> surface_formats{
    "vtp", "obj", "ts", "ply", "off", "stl", "msh", "msh22", "inp", "mesh", "poly", "smesh"};
constexpr std::array<std::string_view, 5> tetrahedra_formats{"vtu", "msh", "msh22", "inp", "mesh"};
constexpr std::array<std::string_view, 2> block_formats{"vtp", "obj"};
constexpr std::array<std::string_view, 1> formats{"terrane-project 1"};

constexpr double smallest_quality = 1.1;
constexpr double most_threads = 1024;

// ---- What is said

/// How many characters must be changed, added or removed.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

/// "a, b or c"
std::string listed(Keys words) {
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i)
        text += fmt::format("{}{}", i == 0 ? "" : i + 1 == words.size() ? " or " : ", ", words[i]);
    return text;
}

/// The key that was meant, most likely; else all that there are.
std::string advice(std::string_view unknown, Keys keys) {
    const auto nearest =
        std::min_element(keys.begin(), keys.end(), [&](std::string_view a, std::string_view b) {
            return edit_distance(unknown, a) < edit_distance(unknown, b);
        });
    if (edit_distance(unknown, *nearest) <= std::max<std::size_t>(2, nearest->size() / 3))
        return fmt::format("unknown key; did you mean {}?", *nearest);
    return "unknown key; there are " + listed(keys);
}

// ---- Reading

/// Reads values and keeps the first thing that is wrong; after that all values are empty.
class Parser {
public:
    explicit Parser(std::string_view source) : source_(source) {}

    [[nodiscard]] const std::optional<Error>& error() const { return error_; }

    void fail(const std::string& path, std::string sentence) {
        if (!error_)
            error_ = Error{ErrorCode::bad_option, std::move(sentence),
                           path.empty() ? source_ : source_ + ": " + path};
    }

    /// Whether it is an object of these keys.
    bool object(const Json& value, const std::string& path, Keys keys) {
        if (!value.is_object()) {
            fail(path, "must be an object");
            return false;
        }
        for (const auto& [key, unused] : value.items())
            if (std::find(keys.begin(), keys.end(), key) == keys.end())
                fail(join(path, key), advice(key, keys));
        return !error_;
    }

    /// The value of a key, or nothing.
    const Json* find(const Json& object, std::string_view key) const {
        const auto at = object.find(key);
        return at == object.end() || error_ ? nullptr : &*at;
    }

    const Json* need(const Json& object, std::string_view key, const std::string& path) {
        const Json* value = find(object, key);
        if (value == nullptr) fail(path, fmt::format("the key {} is missing", key));
        return value;
    }

    std::string text(const Json& value, const std::string& path) {
        if (value.is_string() && !value.get_ref<const std::string&>().empty())
            return value.get<std::string>();
        fail(path, "must be a string, not empty");
        return {};
    }

    std::string one_of(const Json& value, const std::string& path, Keys words) {
        if (value.is_string() &&
            std::find(words.begin(), words.end(), value.get<std::string>()) != words.end())
            return value.get<std::string>();
        fail(path, "must be " + listed(words));
        return {};
    }

    double number(const Json& value, const std::string& path) {
        if (value.is_number() && std::isfinite(value.get<double>())) return value.get<double>();
        fail(path, "must be a number");
        return 0;
    }

    double positive(const Json& value, const std::string& path) {
        if (value.is_number() && std::isfinite(value.get<double>()) && value.get<double>() > 0)
            return value.get<double>();
        fail(path, "must be a number larger than 0");
        return 0;
    }

    bool truth(const Json& value, const std::string& path) {
        if (value.is_boolean()) return value.get<bool>();
        fail(path, "must be true or false");
        return false;
    }

    /// Calls read(entry, path) for each of at least `least` entries, at most `most`.
    template <class Read>
    void array(const Json& value, const std::string& path, std::size_t least, std::size_t most,
               const Read& read) {
        if (!value.is_array() || value.size() < least || value.size() > most) {
            const auto count = least == most ? fmt::format(" of {}", least)
                               : least > 0   ? fmt::format(" of at least {}", least)
                                             : std::string();
            fail(path, "must be a list" + count);
            return;
        }
        for (std::size_t i = 0; i < value.size() && !error_; ++i)
            read(value[i], fmt::format("{}[{}]", path, i));
    }

    std::vector<std::string> texts(const Json& value, const std::string& path, std::size_t least) {
        std::vector<std::string> all;
        array(value, path, least, SIZE_MAX,
              [&](const Json& entry, const std::string& at) { all.push_back(text(entry, at)); });
        return all;
    }

    std::vector<std::string> words(const Json& value, const std::string& path, Keys choice) {
        std::vector<std::string> all;
        array(value, path, 1, SIZE_MAX, [&](const Json& entry, const std::string& at) {
            all.push_back(one_of(entry, at, choice));
        });
        return all;
    }

    template <std::size_t N>
    std::array<double, N> numbers(const Json& value, const std::string& path) {
        std::array<double, N> all{};
        std::size_t next = 0;
        array(value, path, N, N,
              [&](const Json& entry, const std::string& at) { all[next++] = number(entry, at); });
        return all;
    }

    Point3 point(const Json& value, const std::string& path) {
        const auto [x, y, z] = numbers<3>(value, path);
        return {x, y, z};
    }

    static std::string join(const std::string& path, std::string_view key) {
        return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
    }

private:
    std::string source_;
    std::optional<Error> error_;
};

/// The parts of a project, each by the keys of its object.
class ProjectParser {
public:
    ProjectParser(const fs::path& base, std::string_view source) : base_(base), in_(source) {}

    Result<Project> operator()(const Json& json) {
        Project project;
        if (in_.object(json, "", project_level)) read(json, project);
        if (in_.error()) return *in_.error();
        return project;
    }

private:
    [[nodiscard]] fs::path path_of(const std::string& name) const {
        return name.empty() ? fs::path() : (base_ / name).lexically_normal();
    }

    void read(const Json& json, Project& project) {
        if (const Json* v = in_.need(json, "format", "")) in_.one_of(*v, "format", formats);
        if (const Json* v = in_.need(json, "surfaces", ""))
            in_.array(*v, "surfaces", 1, SIZE_MAX, [&](const Json& entry, const std::string& at) {
                project.surfaces.push_back(surfaces(entry, at));
            });
        if (const Json* v = in_.need(json, "outputs", "")) project.outputs = outputs(*v);
        if (const Json* v = in_.find(json, "folder"))
            project.folder = path_of(in_.text(*v, "folder"));
        if (const Json* v = in_.find(json, "threads")) project.threads = threads(*v);
        if (const Json* v = in_.find(json, "fill"))
            in_.array(*v, "fill", 1, SIZE_MAX, [&](const Json& entry, const std::string& at) {
                project.fill.push_back(fill(entry, at));
            });
        if (const Json* v = in_.find(json, "layers")) project.layers = layers(*v);
        if (const Json* v = in_.find(json, "volume_of_interest")) volume(*v, project);
        if (const Json* v = in_.find(json, "extend")) {
            project.extend = in_.positive(*v, "extend");
            if (project.volume.index() == 0)
                in_.fail("extend", "needs volume_of_interest, to whose boundary it extends");
        }
        if (const Json* v = in_.find(json, "seal")) project.seal = in_.positive(*v, "seal");
        if (const Json* v = in_.find(json, "improve")) project.improve = improve(*v);
        if (const Json* v = in_.find(json, "tetrahedra")) project.tetrahedra = tetrahedra(*v);
        const bool turned = std::any_of(project.surfaces.begin(), project.surfaces.end(),
                                        [](const ProjectSurfaces& s) { return s.depth; });
        const bool changed = turned || !project.fill.empty() || project.layers ||
                             project.volume.index() != 0 || project.seal || project.improve;
        if (project.outputs.certificate && changed)
            in_.fail("outputs.certificate",
                     "must be false with fill, layers, volume_of_interest, seal, improve or depth: "
                     "a certificate is about whole surfaces as their files have them");
    }

    unsigned threads(const Json& value) {
        if (value.is_number_integer() && value.get<double>() >= 0 &&
            value.get<double>() <= most_threads)
            return value.get<unsigned>();
        in_.fail("threads", fmt::format("must be a whole number, 0 to {}", most_threads));
        return 0;
    }

    ProjectSurfaces surfaces(const Json& json, const std::string& path) {
        ProjectSurfaces s;
        if (!in_.object(json, path, surfaces_level)) return s;
        if (const Json* v = in_.need(json, "file", path))
            s.file = path_of(in_.text(*v, path + ".file"));
        if (const Json* v = in_.find(json, "objects"))
            s.objects = in_.texts(*v, path + ".objects", 1);
        if (const Json* v = in_.find(json, "name")) s.name = in_.text(*v, path + ".name");
        if (const Json* v = in_.find(json, "role")) s.role = role(*v, path + ".role");
        if (const Json* v = in_.find(json, "depth")) s.depth = in_.truth(*v, path + ".depth");
        return s;
    }

    std::optional<Role> role(const Json& value, const std::string& path) {
        const auto name = in_.one_of(value, path, roles);
        for (std::size_t r = 0; r < detail::role_names.size(); ++r)
            if (detail::role_names[r] == name) return static_cast<Role>(r);
        return std::nullopt;
    }

    ProjectFill fill(const Json& json, const std::string& path) {
        ProjectFill f;
        if (!in_.object(json, path, fill_level)) return f;
        if (const Json* v = in_.need(json, "surface", path))
            f.surface = in_.text(*v, path + ".surface");
        if (const Json* v = in_.find(json, "method"))
            f.method = in_.one_of(*v, path + ".method", fill_methods);
        if (const Json* v = in_.find(json, "model"))
            f.model = in_.one_of(*v, path + ".model", variogram_models);
        if (const Json* v = in_.find(json, "max_area"))
            f.max_area = in_.positive(*v, path + ".max_area");
        if (const Json* v = in_.find(json, "mesh_size"))
            f.mesh_size = in_.positive(*v, path + ".mesh_size");
        if (const Json* v = in_.find(json, "gap_slope"))
            f.gap_slope = in_.positive(*v, path + ".gap_slope");
        if (const Json* v = in_.find(json, "bridge_faults"))
            f.bridge_faults = in_.truth(*v, path + ".bridge_faults");
        if (const Json* v = in_.find(json, "smoothing"))
            f.smoothing = smoothing(*v, path + ".smoothing");
        return f;
    }

    double smoothing(const Json& value, const std::string& path) {
        if (value == "auto") return 0;
        if (value.is_number()) return in_.positive(value, path);
        in_.fail(path, "must be auto or a number larger than 0");
        return 0;
    }

    ProjectLayers layers(const Json& json) {
        ProjectLayers l;
        const std::string path = "layers";
        if (!in_.object(json, path, layers_level)) return l;
        if (const Json* v = in_.need(json, "order", path))
            in_.array(*v, path + ".order", 1, SIZE_MAX,
                      [&](const Json& entry, const std::string& at) {
                          l.order.push_back(layer(entry, at));
                      });
        if (const Json* v = in_.find(json, "min_thickness"))
            l.min_thickness = in_.positive(*v, path + ".min_thickness");
        return l;
    }

    ProjectLayer layer(const Json& json, const std::string& path) {
        ProjectLayer l;
        if (!in_.object(json, path, layer_level)) return l;
        if (const Json* v = in_.need(json, "surface", path))
            l.surface = in_.text(*v, path + ".surface");
        if (const Json* v = in_.need(json, "hardness", path))
            l.hardness = in_.number(*v, path + ".hardness");
        return l;
    }

    void volume(const Json& json, Project& project) {
        const std::string path = "volume_of_interest";
        if (!in_.object(json, path, volume_level)) return;
        if (json.size() != 1) return in_.fail(path, "must have one key: " + listed(volume_level));
        if (const Json* v = in_.find(json, "box")) project.volume = box(*v, path + ".box");
        if (const Json* v = in_.find(json, "rotated_box"))
            project.volume = rotated_box(*v, path + ".rotated_box");
        if (const Json* v = in_.find(json, "polygon"))
            project.volume = polygon(*v, path + ".polygon");
        if (const Json* v = in_.find(json, "within")) {
            ProjectWithin within;
            for (const auto& name : in_.texts(*v, path + ".within", 1))
                within.files.push_back(path_of(name));
            project.volume = std::move(within);
        }
    }

    ProjectBox box(const Json& json, const std::string& path) {
        ProjectBox b;
        if (!in_.object(json, path, box_level)) return b;
        if (const Json* v = in_.need(json, "low", path)) b.low = in_.point(*v, path + ".low");
        if (const Json* v = in_.need(json, "high", path)) b.high = in_.point(*v, path + ".high");
        return b;
    }

    RotatedBox rotated_box(const Json& json, const std::string& path) {
        RotatedBox b;
        if (!in_.object(json, path, rotated_level)) return b;
        const Json *centre = in_.find(json, "centre"), *corner = in_.find(json, "corner");
        if ((centre == nullptr) == (corner == nullptr)) {
            in_.fail(path, "must have one of the keys centre and corner");
            return b;
        }
        b.is_corner = corner != nullptr;
        b.place = in_.point(b.is_corner ? *corner : *centre,
                            path + (b.is_corner ? ".corner" : ".centre"));
        if (const Json* v = in_.need(json, "lengths", path)) {
            std::size_t next = 0;
            in_.array(*v, path + ".lengths", 3, 3, [&](const Json& entry, const std::string& at) {
                b.lengths[next++] = in_.positive(entry, at);
            });
        }
        if (const Json* v = in_.find(json, "azimuth"))
            b.azimuth = in_.number(*v, path + ".azimuth");
        if (const Json* v = in_.find(json, "plunge")) b.plunge = in_.number(*v, path + ".plunge");
        if (const Json* v = in_.find(json, "roll")) b.roll = in_.number(*v, path + ".roll");
        return b;
    }

    ProjectPolygon polygon(const Json& json, const std::string& path) {
        ProjectPolygon p;
        if (!in_.object(json, path, polygon_level)) return p;
        if (const Json* v = in_.need(json, "corners", path))
            in_.array(*v, path + ".corners", 3, SIZE_MAX,
                      [&](const Json& entry, const std::string& at) {
                          p.corners.push_back(in_.numbers<2>(entry, at));
                      });
        if (const Json* v = in_.need(json, "between", path))
            p.between = in_.numbers<2>(*v, path + ".between");
        return p;
    }

    std::vector<ProjectSize> sizes(const Json& json, const std::string& path) {
        std::vector<ProjectSize> all;
        if (!json.is_object()) {
            in_.fail(path, "must be an object of edge lengths by name");
            return all;
        }
        for (const auto& [name, length] : json.items())
            all.emplace_back(name, in_.positive(length, Parser::join(path, name)));
        return all;
    }

    ProjectImprove improve(const Json& json) {
        ProjectImprove i;
        const std::string path = "improve";
        if (!in_.object(json, path, improve_level)) return i;
        if (const Json* v = in_.find(json, "edge_length"))
            i.edge_length = in_.positive(*v, path + ".edge_length");
        if (const Json* v = in_.find(json, "max_deviation"))
            i.max_deviation = in_.positive(*v, path + ".max_deviation");
        if (const Json* v = in_.find(json, "edge_length_of"))
            i.edge_length_of = sizes(*v, path + ".edge_length_of");
        return i;
    }

    ProjectTetrahedra tetrahedra(const Json& json) {
        ProjectTetrahedra t;
        const std::string path = "tetrahedra";
        if (!in_.object(json, path, tetrahedra_level)) return t;
        if (const Json* v = in_.find(json, "edge_length"))
            t.edge_length = in_.positive(*v, path + ".edge_length");
        if (const Json* v = in_.find(json, "max_volume"))
            t.max_volume = in_.positive(*v, path + ".max_volume");
        if (const Json* v = in_.find(json, "quality")) t.quality = quality(*v, path + ".quality");
        if (const Json* v = in_.find(json, "size_of")) t.size_of = sizes(*v, path + ".size_of");
        if (const Json* v = in_.find(json, "size_in")) t.size_in = sizes(*v, path + ".size_in");
        if (const Json* v = in_.find(json, "split")) t.split = in_.texts(*v, path + ".split", 0);
        if (const Json* v = in_.find(json, "outside")) t.outside = in_.truth(*v, path + ".outside");
        if (const Json* v = in_.find(json, "time_limit"))
            t.time_limit = in_.positive(*v, path + ".time_limit");
        return t;
    }

    double quality(const Json& value, const std::string& path) {
        if (value.is_number() && std::isfinite(value.get<double>()) &&
            value.get<double>() >= smallest_quality)
            return value.get<double>();
        in_.fail(path, fmt::format("must be a number, at least {}", smallest_quality));
        return 0;
    }

    ProjectOutputs outputs(const Json& json) {
        ProjectOutputs o;
        const std::string path = "outputs";
        if (!in_.object(json, path, outputs_level)) return o;
        if (json.empty()) in_.fail(path, "must have at least one key: " + listed(outputs_level));
        if (const Json* v = in_.find(json, "surfaces"))
            o.surfaces = in_.words(*v, path + ".surfaces", surface_formats);
        if (const Json* v = in_.find(json, "tetrahedra"))
            o.tetrahedra = in_.words(*v, path + ".tetrahedra", tetrahedra_formats);
        if (const Json* v = in_.find(json, "blocks"))
            o.blocks = in_.one_of(*v, path + ".blocks", block_formats);
        if (const Json* v = in_.find(json, "certificate"))
            o.certificate = in_.truth(*v, path + ".certificate");
        return o;
    }

    const fs::path& base_;
    Parser in_;
};

// ---- The text

std::size_t line_of(std::string_view text, std::size_t byte) {
    const auto before = text.substr(0, std::min(byte, text.size()));
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

/// JSON lets a key be there twice, and the last one count: hardly ever what was meant.
class RepeatedKeys {
public:
    bool operator()(int, Json::parse_event_t event, const Json& value) {
        if (event == Json::parse_event_t::object_start) met_.emplace_back();
        if (event == Json::parse_event_t::object_end) met_.pop_back();
        if (event == Json::parse_event_t::key) {
            const auto key = value.get<std::string>();
            if (!met_.back().insert(key).second && repeated.empty()) repeated = key;
        }
        return true;
    }

    std::string repeated{};

private:
    std::vector<std::set<std::string>> met_{};
};

Result<Json> parsed(std::string_view text, std::string_view source) {
    try {
        RepeatedKeys keys;
        Json json = Json::parse(
            text, [&](int depth, auto event, Json& value) { return keys(depth, event, value); });
        if (keys.repeated.empty()) return json;
        return Error{ErrorCode::bad_option,
                     "the key " + detail::one_line(keys.repeated) + " is there twice",
                     std::string(source)};
    } catch (const Json::parse_error& broken) {
        return Error{ErrorCode::bad_syntax, "this is not JSON",
                     fmt::format("{}:{}", source, line_of(text, broken.byte))};
    } catch (const Json::exception&) { // a number that no double can hold
        return Error{ErrorCode::bad_syntax, "a number is too large", std::string(source)};
    }
}

} // namespace

Result<Project> parse_project(std::string_view text, const fs::path& base,
                              std::string_view source) {
    return detail::guard_memory(std::string(source), [&]() -> Result<Project> {
        const auto json = parsed(text, source);
        if (!json) return json.error();
        auto project = ProjectParser(base, source)(json.value());
        if (project) project->source = source;
        return project;
    });
}

Result<Project> read_project(const fs::path& path) {
    return detail::guard_memory(path.string(), [&]() -> Result<Project> {
        const auto text = read_file(path);
        if (!text) return text.error();
        return parse_project(text.value(), path.parent_path(), path.string());
    });
}

std::vector<std::string> project_keys() {
    std::vector<std::string> all;
    const auto add = [&](const std::string& path, Keys keys) {
        for (const std::string_view key : keys) all.push_back(path + std::string(key));
    };
    add("", project_level);
    add("surfaces[].", surfaces_level);
    add("fill[].", fill_level);
    add("layers.", layers_level);
    add("layers.order[].", layer_level);
    add("volume_of_interest.", volume_level);
    add("volume_of_interest.box.", box_level);
    add("volume_of_interest.rotated_box.", rotated_level);
    add("volume_of_interest.polygon.", polygon_level);
    add("improve.", improve_level);
    add("tetrahedra.", tetrahedra_level);
    add("outputs.", outputs_level);
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace terrane
