// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/points/shape_outline.hpp>

#include <string>

#include <fmt/format.h>

#ifdef TERRANE_HAS_SHAPELIB
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>

#include <shapefil.h>
#endif

namespace terrane {

#ifdef TERRANE_HAS_SHAPELIB

namespace {

using ShapeRing = std::vector<std::array<double, 2>>;

constexpr std::size_t header_bytes = 100; ///< of .shp and .shx

std::uint32_t big_endian(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = 256 * value + static_cast<unsigned char>(bytes[at + i]);
    return value;
}

void append_big_endian(std::string& bytes, std::size_t value) {
    for (unsigned shift = 32; shift > 0; shift -= 8)
        bytes += static_cast<char>(value >> (shift - 8) & 255U);
}

/// A file in memory, as shapelib sees it.
struct ShapeStream {
    std::string_view bytes;
    std::size_t at = 0;
};

/// The contents of a .shp and of the .shx that belongs to it, and the two as files: shapelib opens each once,
/// and no exception may pass through it.
struct ShapeBytes {
    std::string_view shp;
    std::string shx;
    ShapeStream shp_file{}, shx_file{};
};

/// Makes the .shx of a .shp: where each record begins, and its length, in words of two bytes.
/// Returns the number of the record that is not complete, if there is one.
std::optional<std::size_t> make_index(ShapeBytes& bytes) {
    std::string entries;
    std::size_t records = 0;
    for (std::size_t at = header_bytes; at < bytes.shp.size(); ++records) {
        if (bytes.shp.size() - at < 8) return records;
        const std::size_t words = big_endian(bytes.shp, at + 4);
        if (words < 2 || (bytes.shp.size() - at - 8) / 2 < words) return records;
        append_big_endian(entries, at / 2);
        append_big_endian(entries, words);
        at += 8 + 2 * words;
    }
    bytes.shx = bytes.shp.substr(0, 24);
    append_big_endian(bytes.shx, (header_bytes + entries.size()) / 2);
    bytes.shx += bytes.shp.substr(28, header_bytes - 28);
    bytes.shx += entries;
    return std::nullopt;
}

ShapeStream& stream_of(SAFile file) {
    return *reinterpret_cast<ShapeStream*>(file);
}

/// Opens a file by its name, which is the address of ShapeBytes and an extension.
SAFile open_shape(const char* name, const char* access) {
    const std::string_view text(name);
    const auto dot = text.find('.');
    std::uintptr_t address = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), address);
    if (code != std::errc() || dot == std::string_view::npos || end != text.data() + dot ||
        std::string_view(access) != "rb")
        return nullptr;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): shapelib 1.5 passes nothing but the name
    auto& bytes = *reinterpret_cast<ShapeBytes*>(address);
    const auto extension = text.substr(dot);
    if (extension != ".shp" && extension != ".shx") return nullptr;
    ShapeStream& stream = extension == ".shp" ? bytes.shp_file : bytes.shx_file;
    stream = {extension == ".shp" ? bytes.shp : std::string_view(bytes.shx), 0};
    return reinterpret_cast<SAFile>(&stream);
}

SAOffset read_shape(void* to, SAOffset size, SAOffset count, SAFile file) {
    ShapeStream& stream = stream_of(file);
    if (size == 0) return 0;
    const auto left = stream.bytes.size() - std::min(stream.at, stream.bytes.size());
    const std::size_t done = std::min<std::size_t>(count, left / size);
    if (done > 0) std::memcpy(to, stream.bytes.data() + stream.at, done * size);
    stream.at += done * size;
    return done;
}

SAOffset seek_shape(SAFile file, SAOffset offset, int whence) {
    ShapeStream& stream = stream_of(file);
    stream.at = offset + (whence == SEEK_CUR   ? stream.at
                          : whence == SEEK_END ? stream.bytes.size()
                                               : 0);
    return 0;
}

int close_shape(SAFile) {
    return 0;
}

// Version 1.6 of shapelib passes a pointer as well; the assignments below choose what fits.
[[maybe_unused]] SAFile open_shape(const char* name, const char* access, void*) {
    return open_shape(name, access);
}
[[maybe_unused]] SAOffset write_shape(void*, SAOffset, SAOffset, SAFile) {
    return 0;
}
[[maybe_unused]] SAOffset write_shape(const void*, SAOffset, SAOffset, SAFile) {
    return 0;
}
[[maybe_unused]] int remove_shape(const char*) {
    return -1;
}
[[maybe_unused]] int remove_shape(const char*, void*) {
    return -1;
}

/// Returns the functions by which shapelib reads from memory. It says nothing: errors show in what
/// it returns.
SAHooks hooks_for_memory() {
    SAHooks hooks{};
    hooks.FOpen = open_shape;
    hooks.FRead = read_shape;
    hooks.FWrite = write_shape;
    hooks.FSeek = seek_shape;
    hooks.FTell = [](SAFile file) -> SAOffset { return stream_of(file).at; };
    hooks.FFlush = [](SAFile) { return 0; };
    hooks.FClose = close_shape;
    hooks.Remove = remove_shape;
    hooks.Error = [](const char*) {};
    hooks.Atof = [](const char*) { return 0.0; };
    return hooks;
}

struct CloseShape {
    void operator()(SHPHandle file) const { SHPClose(file); }
};
struct DestroyShape {
    void operator()(SHPObject* object) const { SHPDestroyObject(object); }
};

Error shape_error(std::string_view source, ErrorCode code, std::string what) {
    return {code, std::move(what), std::string(source)};
}

std::string name_of_shapes(int type) {
    switch (type) {
    case SHPT_POINT:
    case SHPT_POINTZ:
    case SHPT_POINTM:
    case SHPT_MULTIPOINT:
    case SHPT_MULTIPOINTZ:
    case SHPT_MULTIPOINTM:
        return "points";
    case SHPT_ARC:
    case SHPT_ARCZ:
    case SHPT_ARCM:
        return "lines";
    default:
        return fmt::format("shapes of type {}", type);
    }
}

/// Reads the ring of a polygon; `number` counts from 0.
Result<ShapeRing> ring_of(const SHPObject& polygon, int number, std::string_view source) {
    if (polygon.nParts > 1)
        return shape_error(source, ErrorCode::unsupported,
                           fmt::format("polygon {} has {} rings, holes or parts; an outline is one "
                                       "ring",
                                       number + 1, polygon.nParts));
    ShapeRing ring;
    for (int v = 0; v < polygon.nVertices; ++v) {
        ring.push_back({polygon.padfX[v], polygon.padfY[v]});
        if (!std::isfinite(ring.back()[0]) || !std::isfinite(ring.back()[1]))
            return shape_error(
                source, ErrorCode::bad_number,
                fmt::format("corner {} of polygon {} is not finite", v + 1, number + 1));
    }
    return ring;
}

Result<ShapeRing> one_ring(SHPHandle file, std::string_view source) {
    int count = 0, type = 0;
    SHPGetInfo(file, &count, &type, nullptr, nullptr);
    if (type != SHPT_POLYGON && type != SHPT_POLYGONZ && type != SHPT_POLYGONM)
        return shape_error(source, ErrorCode::unsupported,
                           "the file has " + name_of_shapes(type) + "; an outline is a polygon");
    std::optional<ShapeRing> found;
    for (int i = 0; i < count; ++i) {
        const std::unique_ptr<SHPObject, DestroyShape> object(SHPReadObject(file, i));
        if (!object)
            return shape_error(source, ErrorCode::bad_syntax,
                               fmt::format("record {} is broken", i + 1));
        if (object->nSHPType == SHPT_NULL || object->nVertices == 0) continue;
        if (found)
            return shape_error(source, ErrorCode::unsupported,
                               fmt::format("polygon {} is a second one; an outline is one, so keep "
                                           "one in the file",
                                           i + 1));
        auto ring = ring_of(*object, i, source);
        if (!ring) return ring;
        found = std::move(*ring);
    }
    if (!found) return shape_error(source, ErrorCode::nothing_to_do, "there is no polygon");
    return std::move(*found);
}

} // namespace

bool reads_shapefiles() {
    return true;
}

Result<ShapeRing> read_shape_outline(std::string_view contents, std::string_view source) {
    if (contents.size() < header_bytes || big_endian(contents, 0) != 9994)
        return shape_error(source, ErrorCode::bad_syntax,
                           "this is no shapefile: it does not begin with its code");
    if (contents.size() > INT32_MAX)
        return shape_error(source, ErrorCode::unsupported, "the file is larger than 2 GiB");
    ShapeBytes bytes{contents, {}};
    if (const auto broken = make_index(bytes))
        return shape_error(source, ErrorCode::bad_syntax,
                           fmt::format("the file ends within record {}", *broken + 1));
    const auto name = fmt::format("{}", reinterpret_cast<std::uintptr_t>(&bytes));
    SAHooks hooks = hooks_for_memory();
    const std::unique_ptr<SHPInfo, CloseShape> file(SHPOpenLL(name.c_str(), "rb", &hooks));
    if (!file) return shape_error(source, ErrorCode::bad_syntax, "shapelib cannot read this file");
    return one_ring(file.get(), source);
}

#else

bool reads_shapefiles() {
    return false;
}

Result<std::vector<std::array<double, 2>>> read_shape_outline(std::string_view,
                                                              std::string_view source) {
    return Error{
        ErrorCode::unsupported,
        "this build cannot read shapefiles, as shapelib (libshp-dev) was not there when it "
        "was made",
        std::string(source)};
}

#endif

} // namespace terrane
