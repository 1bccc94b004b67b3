// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/project.hpp>

#include <algorithm>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/detail/column_keys.hpp>
#include <terrane/io/detail/json_reader.hpp>
#include <terrane/io/detail/project_keys.hpp>
#include <terrane/io/detail/uncertainty_keys.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/results.hpp>
#include <terrane/io/text/names.hpp>

namespace terrane {

namespace fs = std::filesystem;
using namespace detail;

namespace {

/// Adds the keys of the described fields that project files have.
template <class Options>
void add_keys(std::vector<std::string_view>& keys) {
    const Options options{};
    Options::describe(
        [&keys](const Field& field, const auto&) {
            if (field.in_project) keys.push_back(field.name);
        },
        options);
}

std::vector<std::string_view> fill_level() {
    std::vector<std::string_view> keys(own_fill_level.begin(), own_fill_level.end());
    add_keys<FillOptions>(keys);
    return keys;
}

std::vector<std::string_view> improve_level() {
    std::vector<std::string_view> keys;
    add_keys<ImproveOptions>(keys);
    add_keys<Resolution>(keys);
    return keys;
}

std::vector<std::string_view> tetrahedra_level() {
    std::vector<std::string_view> keys(own_tetrahedra_level.begin(), own_tetrahedra_level.end());
    add_keys<TetrahedraOptions>(keys);
    return keys;
}

/// Reads a project; each function reads the object of one kind by its keys.
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
        if (const Json* v = in_.find(json, "unit")) project.unit = in_.one_of(*v, "unit", units);
        if (const Json* v = in_.find(json, "column")) project.column = column_of(in_, *v);
        if (const Json* v = in_.find(json, "fill"))
            in_.array(*v, "fill", 1, SIZE_MAX, [&](const Json& entry, const std::string& at) {
                project.fill.push_back(fill(entry, at));
            });
        if (const Json* v = in_.find(json, "layers")) project.layers = layers(*v);
        if (const Json* v = in_.find(json, "volume_of_interest")) volume(*v, project);
        if (const Json* v = in_.find(json, "tolerance"))
            project.tolerance = in_.positive(*v, "tolerance");
        if (const Json* v = in_.find(json, "extend")) {
            project.extend = in_.positive(*v, "extend");
            if (project.volume.index() == 0)
                in_.fail("extend", "needs volume_of_interest, to whose boundary it extends");
        }
        if (const Json* v = in_.find(json, "seal")) project.seal = automatic(*v, "seal");
        if (const Json* v = in_.find(json, "seal_of")) project.seal_of = seal_of(*v);
        if (const Json* v = in_.find(json, "min_volume"))
            project.min_volume = automatic(*v, "min_volume");
        if (const Json* v = in_.find(json, "max_move"))
            project.max_move = in_.positive(*v, "max_move");
        if (const Json* v = in_.find(json, "improve")) project.improve = improve(*v);
        if (const Json* v = in_.find(json, "tetrahedra")) project.tetrahedra = tetrahedra(*v);
        if (const Json* v = in_.find(json, "uncertainty"))
            project.uncertainty = uncertainty_of(in_, *v, base_);
        const bool turned = std::any_of(project.surfaces.begin(), project.surfaces.end(),
                                        [](const ProjectSurfaces& s) { return s.depth; });
        const bool changed = turned || project.tolerance || !project.unit.empty() ||
                             !project.fill.empty() || project.layers || project.improve;
        if (project.outputs.certificate && changed)
            in_.fail("outputs.certificate", "must be false with unit, fill, layers, tolerance, "
                                            "improve or depth: a certificate is about "
                                            "whole surfaces as their files have them");
        check_tetrahedra_formats(project);
        const std::string& parts = project.outputs.blocks;
        if (project.outputs.certificate && !parts.empty() && !is_certified(parts))
            in_.fail("outputs.certificate", "is about blocks as vtp or obj only");
        if (project.outputs.certificate && project.min_volume)
            in_.fail("outputs.certificate",
                     "must be false with min_volume: a certificate can't show yet that only small "
                     "blocks were merged");
    }

    /// Refuses formats of tetrahedra that can't hold what is asked for.
    void check_tetrahedra_formats(const Project& project) {
        for (std::size_t i = 0; i < project.outputs.tetrahedra.size(); ++i) {
            const auto format = format_named(project.outputs.tetrahedra[i]);
            const auto path = fmt::format("outputs.tetrahedra[{}]", i);
            if (!format) continue; // said already
            if (project.tetrahedra.order == 2 && !holds_second_order(*format))
                in_.fail(path, "has no tetrahedra of second order: tetrahedra.order must be 1");
            if (*format == Format::pylith && !project.tetrahedra.split.empty())
                in_.fail(path, "is for PyLith, which splits nodes itself: tetrahedra.split must be "
                               "empty");
            if (project.outputs.certificate &&
                (project.tetrahedra.order == 2 || *format > Format::medit))
                in_.fail(
                    "outputs.certificate",
                    "is about tetrahedra of first order in vtu, msh, msh22, inp and mesh only");
        }
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
        if (!in_.object(json, path, fill_level())) return f;
        if (const Json* v = in_.need(json, "surface", path))
            f.surface = in_.text(*v, path + ".surface");
        if (const Json* v = in_.find(json, "method"))
            if (in_.one_of(*v, path + ".method", fill_methods) == "rbf")
                f.options.method = FillMethod::rbf;
        if (const Json* v = in_.find(json, "model"))
            f.options.model =
                variogram_model_named(in_.one_of(*v, path + ".model", variogram_models));
        read_fields(json, path, f.options);
        if (const Json* v = in_.find(json, "smoothing"))
            f.options.smoothing = automatic(*v, path + ".smoothing");
        return f;
    }

    /// Reads a positive number, or 0 for "auto".
    double automatic(const Json& value, const std::string& path) {
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
            all.emplace_back(name, in_.positive(length, JsonReader::join(path, name)));
        return all;
    }

    /// Reads distances by the names of surfaces, or pairs of them.
    std::vector<ProjectSize> seal_of(const Json& json) {
        std::vector<ProjectSize> all;
        if (!json.is_object()) {
            in_.fail("seal_of", "must be an object of distances by name");
            return all;
        }
        for (const auto& [name, distance] : json.items()) {
            const bool is_none = distance.is_number() && distance.get<double>() == 0;
            all.emplace_back(
                name, is_none ? 0 : in_.positive(distance, JsonReader::join("seal_of", name)));
        }
        return all;
    }

    /// Reads the described numbers and truth values of a struct that project files have.
    template <class Options>
    void read_fields(const Json& json, const std::string& path, Options& options) {
        Options::describe(
            [&]<class T>(const Field& field, T& value) {
                const Json* const v = field.in_project ? in_.find(json, field.name) : nullptr;
                if (!v) return;
                const std::string at = JsonReader::join(path, field.name);
                if constexpr (std::is_same_v<T, bool>) {
                    value = in_.truth(*v, at);
                } else if constexpr (std::is_same_v<T, double> ||
                                     std::is_same_v<T, std::optional<double>>) {
                    const double number = in_.positive(*v, at);
                    value = number;
                    if (auto flaw = flaw_of(field, number); flaw && !in_.error())
                        in_.fail(at, *std::move(flaw));
                }
            },
            options);
    }

    ProjectImprove improve(const Json& json) {
        ProjectImprove i;
        const std::string path = "improve";
        if (!in_.object(json, path, improve_level())) return i;
        read_fields(json, path, i.options);
        read_fields(json, path, i.resolution);
        if (const Json* v = in_.find(json, "edge_length_of"))
            i.edge_length_of = sizes(*v, path + ".edge_length_of");
        return i;
    }

    ProjectTetrahedra tetrahedra(const Json& json) {
        ProjectTetrahedra t;
        const std::string path = "tetrahedra";
        if (!in_.object(json, path, tetrahedra_level())) return t;
        read_fields(json, path, t.options);
        if (const Json* v = in_.find(json, "size_of")) t.size_of = sizes(*v, path + ".size_of");
        if (const Json* v = in_.find(json, "size_in")) t.size_in = sizes(*v, path + ".size_in");
        if (const Json* v = in_.find(json, "split")) t.split = in_.texts(*v, path + ".split", 0);
        if (const Json* v = in_.find(json, "outside")) t.outside = in_.truth(*v, path + ".outside");
        if (const Json* v = in_.find(json, "optimise"))
            if (!in_.truth(*v, path + ".optimise")) t.options.optimise.reset();
        if (const Json* v = in_.find(json, "move_vertices"))
            t.move_vertices = in_.truth(*v, path + ".move_vertices");
        if (const Json* v = in_.find(json, "refine_bad"))
            t.refine_bad = rounds(*v, path + ".refine_bad");
        if (const Json* v = in_.find(json, "order")) t.order = order(*v, path + ".order");
        if (const Json* v = in_.find(json, "mesher"))
            t.options.mesher =
                static_cast<Mesher>(std::find(meshers.begin(), meshers.end(),
                                              in_.one_of(*v, path + ".mesher", meshers)) -
                                    meshers.begin()); // in the order of the type
        return t;
    }

    unsigned rounds(const Json& value, const std::string& path) {
        const double count = value.is_number_integer() ? value.get<double>() : -1;
        if (count >= 0 && count <= most_rounds) return value.get<unsigned>();
        in_.fail(path, fmt::format("must be a whole number from 0 to {}", most_rounds));
        return 0;
    }

    unsigned order(const Json& value, const std::string& path) {
        if (value.is_number_integer() && (value.get<double>() == 1 || value.get<double>() == 2))
            return value.get<unsigned>();
        in_.fail(path, "must be 1 or 2");
        return 1;
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
        if (const Json* v = in_.find(json, "gocad")) o.gocad = in_.truth(*v, path + ".gocad");
        return o;
    }

    const fs::path& base_;
    JsonReader in_;
};

} // namespace

Result<Project> parse_project(std::string_view text, const fs::path& base,
                              std::string_view source) {
    return guard_memory(source, [&]() -> Result<Project> {
        const auto json = parse_json(text, source);
        if (!json) return json.error();
        auto project = ProjectParser(base, source)(json.value());
        if (project) project->source = source;
        return project;
    });
}

Result<Project> read_project(const fs::path& path) {
    return guard_memory("", [&]() -> Result<Project> {
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
    add("column[].", column_level);
    add("fill[].", fill_level());
    add("layers.", layers_level);
    add("layers.order[].", layer_level);
    add("volume_of_interest.", volume_level);
    add("volume_of_interest.box.", box_level);
    add("volume_of_interest.rotated_box.", rotated_level);
    add("volume_of_interest.polygon.", polygon_level);
    add("improve.", improve_level());
    add("tetrahedra.", tetrahedra_level());
    add("uncertainty[].", uncertainty_level);
    add("uncertainty[].field.", field_level);
    add("outputs.", outputs_level);
    std::sort(all.begin(), all.end());
    return all;
}

} // namespace terrane
