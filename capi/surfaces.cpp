// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/capi/surfaces.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include <terrane/algorithms/mesh/carry.hpp>
#include <terrane/algorithms/mesh/labels.hpp>
#include <terrane/algorithms/mesh/submesh.hpp>
#include <terrane/algorithms/mesh/validation.hpp>
#include <terrane/algorithms/plausibility/plausibility.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>
#include <terrane/io/structure_json.hpp>

namespace terrane::capi::detail {
namespace {

terrane_write_options default_writing() noexcept {
    return {sizeof(terrane_write_options), nullptr, 0, 1};
}

/// Returns the format that a caller names; none: the extension counts.
std::optional<Format> named_format(const char* name) {
    if (!name || *name == '\0') return std::nullopt;
    const auto format = format_named(name);
    if (!format) throw BadArgument{"options.format", "is no format that Terrane knows"};
    return format;
}

Role role_of(terrane_role role) {
    if (role < TERRANE_ROLE_UNKNOWN || role > TERRANE_ROLE_BOUNDARY)
        throw BadArgument{"role", "is not a role"};
    return static_cast<Role>(role);
}

Surface surface_of(const char* name, terrane_role role, std::vector<Point3> vertices,
                   const uint32_t* triangles, std::size_t triangle_count) {
    Surface surface{name ? name : "", role_of(role), std::move(vertices), {}, {}};
    surface.triangles.resize(triangle_count);
    if (triangle_count > 0)
        std::memcpy(surface.triangles.data(), triangles, triangle_count * sizeof(Triangle));
    return surface;
}

/// Appends surfaces to a list as a whole or, where memory is short, not at all.
void append(std::vector<Surface>& list, std::vector<Surface> more) {
    list.reserve(list.size() + more.size());
    for (Surface& s : more) list.push_back(std::move(s));
}

std::unique_ptr<terrane_surfaces> handle_of(Result<std::vector<Surface>> made) {
    auto handle = std::make_unique<terrane_surfaces>();
    handle->list = must(std::move(made));
    return handle;
}

Point3 point_of(const double (&numbers)[3]) {
    return {numbers[0], numbers[1], numbers[2]};
}

const Surface* surface_at(const terrane_surfaces* surfaces, std::size_t index) noexcept {
    return known(surfaces) && index < surfaces->list.size() ? &surfaces->list[index] : nullptr;
}

/// The members of terrane_read_options that check_reading names.
constexpr std::array<const char*, 3> reading_names{"options.depth", "options.max_edge",
                                                   "options.columns"};

} // namespace

terrane_read_options default_reading() noexcept {
    return {sizeof(terrane_read_options), nullptr, 0, 0, 0, nullptr, nullptr};
}

Reading reading_of(const terrane_read_options* given) {
    const auto options = options_of(given, default_reading());
    return {named_format(options.format),
            {options.depth != 0, options.max_edge, options.unit ? options.unit : "",
             options.columns ? options.columns : ""}};
}

WriteOptions writing_of(const terrane_write_options* given) {
    const auto options = options_of(given, default_writing());
    WriteOptions writing;
    writing.format = named_format(options.format);
    writing.ascii = options.ascii != 0;
    writing.compress = options.compress != 0;
    return writing;
}

} // namespace terrane::capi::detail

using namespace terrane::capi::detail;
using terrane::ErrorCode;

terrane_code terrane_read_options_init(terrane_read_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_reading());
}

terrane_code terrane_write_options_init(terrane_write_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_writing());
}

terrane_code terrane_surfaces_new(terrane_surfaces** out, terrane_error** error) {
    return produce(out, error, [] { return std::make_unique<terrane_surfaces>(); });
}

void terrane_surfaces_free(terrane_surfaces* surfaces) {
    release(surfaces);
}

terrane_code terrane_surfaces_add(terrane_surfaces* surfaces, const char* name, terrane_role role,
                                  const double* vertices, size_t vertex_count,
                                  const uint32_t* triangles, size_t triangle_count,
                                  terrane_error** error) {
    return call(error, [&] {
        auto& list = needed(surfaces, "surfaces").list;
        need_array(vertices, vertex_count, "vertices");
        need_array(triangles, triangle_count, "triangles");
        auto surface =
            surface_of(name, role, points_of(vertices, vertex_count), triangles, triangle_count);
        must(terrane::validate(std::span(&surface, 1)));
        list.push_back(std::move(surface));
    });
}

terrane_code terrane_surfaces_append(terrane_surfaces* surfaces, const terrane_surfaces* others,
                                     terrane_error** error) {
    return call(error, [&] {
        auto copies = needed(others, "others").list;
        append(needed(surfaces, "surfaces").list, std::move(copies));
    });
}

terrane_code terrane_surfaces_read(terrane_surfaces* surfaces, const char* path,
                                   const terrane_read_options* options, terrane_error** error) {
    return call(error, [&] {
        auto& list = needed(surfaces, "surfaces").list;
        const auto [format, reading] = reading_of(options);
        const auto chosen = format ? format : terrane::format_to_read(needed_file(path));
        must(check_reading({chosen}, reading, reading_names));
        auto read = must(terrane::read_surfaces(needed_file(path), format, reading));
        append(list, std::move(read));
    });
}

terrane_code terrane_surfaces_parse(terrane_surfaces* surfaces, const void* contents, size_t size,
                                    const char* source, const terrane_read_options* options,
                                    terrane_error** error) {
    return call(error, [&] {
        auto& list = needed(surfaces, "surfaces").list;
        need_array(contents, size, "contents");
        const auto [format, reading] = reading_of(options);
        if (!format) throw BadArgument{"options.format", "must name the format of the contents"};
        must(check_reading({format}, reading, reading_names));
        auto read = must(terrane::parse_surfaces({static_cast<const char*>(contents), size},
                                                 source ? source : "contents", *format, reading));
        append(list, std::move(read));
    });
}

terrane_code terrane_surfaces_write(const terrane_surfaces* surfaces, const char* path,
                                    const terrane_write_options* options, terrane_error** error) {
    return call(error, [&] {
        const auto& list = needed(surfaces, "surfaces").list;
        auto writing = writing_of(options);
        must(terrane::validate(list));
        const auto values = terrane::values_of(list);
        writing.values = values;
        must(terrane::write_mesh(terrane::concatenate(list), needed_file(path), writing));
    });
}

size_t terrane_surfaces_count(const terrane_surfaces* surfaces) {
    return known(surfaces) ? surfaces->list.size() : 0;
}

const char* terrane_surfaces_name(const terrane_surfaces* surfaces, size_t surface) {
    const auto* found = surface_at(surfaces, surface);
    return found ? found->name.c_str() : nullptr;
}

terrane_role terrane_surfaces_role(const terrane_surfaces* surfaces, size_t surface) {
    const auto* found = surface_at(surfaces, surface);
    return found ? static_cast<terrane_role>(found->role) : TERRANE_ROLE_UNKNOWN;
}

terrane_code terrane_surfaces_doubts(const terrane_surfaces* surfaces, int32_t blocks, char** text,
                                     terrane_error** error) {
    if (text) *text = nullptr;
    return call(error, [&] {
        const auto& list = needed(surfaces, "surfaces").list;
        need_array(text, 1, "text");
        const auto doubts = terrane::find_doubts(list, {.boundary = {}, .blocks = blocks != 0});
        const auto labels = terrane::unique_labels(terrane::infos_of(list));
        *text = text_for_caller(terrane::json_of(doubts, labels).dump());
    });
}

terrane_code terrane_surfaces_label(terrane_surfaces* surfaces, size_t surface, const char* name,
                                    terrane_role role, terrane_error** error) {
    return call(error, [&] {
        auto& list = needed(surfaces, "surfaces").list;
        std::string text = needed_text(name, "name");
        const auto meant = role_of(role);
        if (surface >= list.size())
            refuse(ErrorCode::bad_index, "there is no such surface",
                   "surface " + std::to_string(surface));
        list[surface].name = std::move(text);
        list[surface].role = meant;
    });
}

const double* terrane_surfaces_vertices(const terrane_surfaces* surfaces, size_t surface,
                                        size_t* vertex_count) {
    const auto* found = surface_at(surfaces, surface);
    return array_of<double>(found ? &found->vertices : nullptr, vertex_count);
}

const uint32_t* terrane_surfaces_triangles(const terrane_surfaces* surfaces, size_t surface,
                                           size_t* triangle_count) {
    const auto* found = surface_at(surfaces, surface);
    return array_of<uint32_t>(found ? &found->triangles : nullptr, triangle_count);
}

terrane_code terrane_box_boundary(const double low[3], const double high[3], terrane_surfaces** out,
                                  terrane_error** error) {
    return produce(out, error, [&] {
        need_array(low, 3, "low");
        need_array(high, 3, "high");
        const auto lowest = points_of(low, 1), highest = points_of(high, 1);
        return handle_of(terrane::box_boundary(lowest[0], highest[0]));
    });
}

terrane_code terrane_rotated_box_boundary(const terrane_rotated_box* box, terrane_surfaces** out,
                                          terrane_error** error) {
    return produce(out, error, [&] {
        need_array(box, 1, "box");
        need_reserved(*box, "box");
        return handle_of(terrane::rotated_box_boundary(
            {.place = point_of(box->place),
             .is_corner = box->is_corner != 0,
             .lengths = {box->lengths[0], box->lengths[1], box->lengths[2]},
             .azimuth = box->azimuth,
             .plunge = box->plunge,
             .roll = box->roll}));
    });
}

terrane_code terrane_polygon_boundary(const double* corners, size_t corner_count, double low,
                                      double high, terrane_surfaces** out, terrane_error** error) {
    return produce(out, error, [&] {
        need_array(corners, corner_count, "corners");
        std::vector<terrane::Point2> polygon(corner_count);
        if (corner_count > 0)
            std::memcpy(polygon.data(), corners, corner_count * sizeof(terrane::Point2));
        return handle_of(terrane::polygon_boundary(polygon, low, high));
    });
}

terrane_code terrane_closed_boundary(const terrane_surfaces* surfaces, const terrane_run* run,
                                     terrane_surfaces** out, terrane_error** error) {
    return produce(out, error, [&] {
        return handle_of(terrane::closed_boundary(needed(surfaces, "surfaces").list, run_of(run)));
    });
}
