// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/tetgen/detail/process.hpp>

#include <algorithm>
#include <span>
#include <type_traits>

#include <fmt/format.h>

#include <terrane/algorithms/tetgen/detail/helper_process.hpp>
#include <terrane/algorithms/tetgen/detail/protocol.hpp>

namespace terrane::tetgen::detail {
namespace {

static_assert(sizeof(Point3) == sizeof(Coordinates) && std::is_trivially_copyable_v<Point3>);
static_assert(sizeof(BlockSides) == sizeof(SidesRecord) &&
              std::is_trivially_copyable_v<BlockSides>);
static_assert(sizeof(BlockBound) == sizeof(BlockRecord) &&
              std::is_trivially_copyable_v<BlockBound>);

// ---- The request ------------------------------------------------------------------------------

RequestHeader header_of(const TetgenInput& input) {
    RequestHeader header;
    const auto set = [&](bool is_set, RequestFlag flag) { header.flags |= is_set ? flag : 0U; };
    set(input.keep_facets, keep_facets_flag);
    set(input.improve, improve_flag);
    set(input.sort_points, sort_points_flag);
    set(input.parallel_delaunay, parallel_delaunay_flag);
    set(input.max_volume.has_value(), max_volume_flag);
    set(input.radius_edge_ratio.has_value(), radius_edge_ratio_flag);
    header.max_volume = input.max_volume.value_or(0);
    header.radius_edge_ratio = input.radius_edge_ratio.value_or(0);
    header.points = input.points.size();
    header.facets = input.facets.size();
    header.corners = input.facets.values.size();
    header.area_bounds = input.max_areas.size();
    header.blocks = input.blocks.size();
    header.sides = input.sides.size();
    return header;
}

Status send(HelperProcess& helper, const TetgenInput& input) {
    const RequestHeader header = header_of(input);
    for (const std::span<const std::byte> part :
         {std::as_bytes(std::span(&header, 1)), std::as_bytes(std::span(input.points)),
          std::as_bytes(std::span(input.facets.offsets)),
          std::as_bytes(std::span(input.facets.values)), std::as_bytes(std::span(input.max_areas)),
          std::as_bytes(std::span(input.blocks)), std::as_bytes(std::span(input.sides))})
        if (Status sent = helper.send(part); !sent) return sent;
    return Done{};
}

// ---- The reply --------------------------------------------------------------------------------

Error from_mesher(std::int32_t code, const HelperProcess& helper) {
    const char* const mesher = helper.mesher();
    switch (code) {
    case tetgen_out_of_memory:
        return {ErrorCode::out_of_memory, fmt::format("{} ran out of memory", mesher), ""};
    case 3:
    case 4:
    case 5: // the facets do not cross: they are too close for TetGen's tolerance
        return {ErrorCode::unsupported,
                fmt::format("the surfaces come too close to each other for {}", mesher), ""};
    case 10:
        return {ErrorCode::internal, fmt::format("{} did not accept its input", mesher), ""};
    case bad_request:
        return helper.broken("did not understand its input");
    case mesher_failed:
        return {ErrorCode::internal, fmt::format("{} failed", mesher), ""};
    default:
        return {ErrorCode::internal, fmt::format("{} failed with code {}", mesher, code), ""};
    }
}

Status check(const ReplyHeader& header, const HelperProcess& helper) {
    if (header.mark != reply_mark) return helper.broken("answers in another language");
    if (header.version != protocol_version || header.status == other_version) {
        Error error = helper.broken("belongs to another version of Terrane");
        error.code = ErrorCode::unsupported;
        return error;
    }
    if (header.status != done) return from_mesher(header.status, helper);
    if (std::max({header.points, header.tetrahedra, header.faces}) > most_items)
        return helper.broken("announces more than it can count");
    return Done{};
}

/// Receives an array, which grows as its contents arrive: a length alone reserves little memory.
template <class T>
Status receive(HelperProcess& helper, std::uint64_t length, std::vector<T>& array) {
    constexpr std::size_t least = (std::size_t{1} << 24U) / sizeof(T);
    while (array.size() < length) {
        const std::size_t old = array.size();
        array.resize(std::min<std::size_t>(length, std::max(2 * old, least)));
        Status received = helper.receive(std::as_writable_bytes(std::span(array).subspan(old)));
        if (!received) return received;
    }
    return Done{};
}

Result<TetgenOutput> receive(HelperProcess& helper) {
    ReplyHeader header;
    Status received = helper.receive(std::as_writable_bytes(std::span(&header, 1)));
    if (received) received = check(header, helper);
    TetgenOutput out;
    if (received) received = receive(helper, header.points, out.points);
    if (received) received = receive(helper, header.tetrahedra, out.tetrahedra);
    if (received) received = receive(helper, header.faces, out.faces);
    if (received) received = receive(helper, header.faces, out.face_facet);
    if (received) received = helper.finish();
    if (!received) return received.error();
    for (std::uint32_t& facet : out.face_facet) --facet; // 0, on no facet, becomes the largest
    return out;
}

} // namespace

Result<TetgenOutput> run_mesher(const TetgenInput& input, const std::stop_token& stop) {
    const char* const mesher = input.mesher == Mesher::gmsh ? "Gmsh" : "TetGen";
    if (input.points.size() > most_items || input.facets.size() > most_items)
        return Error{ErrorCode::unsupported, fmt::format("too many triangles for {}", mesher), ""};
    HelperProcess process(mesher, input.helper, input.time_limit, stop);
    if (Status started = process.start(); !started) return started.error();
    if (Status sent = send(process, input); !sent) return sent.error();
    return receive(process);
}

} // namespace terrane::tetgen::detail
