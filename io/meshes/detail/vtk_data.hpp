// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The data of arrays in VTK's XML files: numbers as text, or bytes as base64 or raw, as they are or
// compressed by zlib, LZ4 or LZMA.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <terrane/algorithms/mesh/surface.hpp>

namespace terrane::detail {

/// Returns the type of number with this name in VTK's XML files.
std::optional<NumberType> number_type_named(std::string_view name);

/// What has compressed the blocks of an array.
enum class VtkCompressor { none, zlib, lz4, lzma };

/// Returns the compressor that VTK calls by this name; empty: none. Fails for names that are not known, and where the
/// library was not there when Terrane was built.
std::optional<VtkCompressor> vtk_compressor(std::string_view name);

/// How a file stores the bytes of its arrays.
struct VtkEncoding {
    std::endian order = std::endian::little;
    bool wide_headers = false; ///< 64 bits, not 32
    VtkCompressor compressor = VtkCompressor::none;
};

/// Decodes the bytes of an array, which begin with their header at `at`. `base64`: `text` is base64
/// without blanks, else raw bytes. Adds the number of bytes that it has read to `used`. Returns a
/// sentence about the flaw, if there is one. The bytes are at most some 1040 times as many as those
/// in `text`, which is the most that zlib achieves, and more than the others do in blocks of VTK's size.
std::optional<std::string> decode_vtk(std::string_view text, bool base64, std::size_t at,
                                      const VtkEncoding& encoding, std::string& bytes,
                                      std::size_t& used);

/// Converts the bytes of numbers of VTK's type ("Float64", "Int32", ...) to doubles or integers.
/// Returns a sentence about the flaw, if there is one; an unsigned number beyond int64 becomes negative, with the
/// same bits.
std::optional<std::string> convert_vtk(std::string_view bytes, std::string_view type,
                                       std::endian order, std::vector<double>& values);
std::optional<std::string> convert_vtk(std::string_view bytes, std::string_view type,
                                       std::endian order, std::vector<std::int64_t>& values);

} // namespace terrane::detail
