// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/page/arrays.hpp>

#include <algorithm>
#include <vector>

#include <zlib.h>

namespace terrane::page {
namespace {

/// Returns the difference of two numbers with its sign in the lowest bit.
std::uint32_t folded(std::uint32_t value, std::uint32_t before) {
    const std::uint32_t difference = value - before; // modulo 2^32, as the page adds
    return (difference << 1U) ^ (0U - (difference >> 31U));
}

} // namespace

Json Arrays::add(std::span<const std::uint32_t> values, std::size_t stride) {
    const std::size_t at = bytes_.size(), count = values.size();
    bytes_.resize(at + 4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t word = folded(values[i], i < stride ? 0 : values[i - stride]);
        for (std::size_t plane = 0; plane < 4; ++plane)
            bytes_[at + plane * count + i] = static_cast<char>(word >> (8 * plane) & 255U);
    }
    return {{"at", at}, {"count", count}, {"stride", stride}};
}

std::string gzipped(std::string_view bytes) {
    constexpr int gzip_format = 15 + 16; // the largest window, with gzip's header
    constexpr std::size_t most_at_once = 1U << 30U;
    z_stream stream{};
    if (deflateInit2(&stream, 6, Z_DEFLATED, gzip_format, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    std::string result;
    std::vector<char> buffer(1U << 16U);
    std::size_t at = 0;
    int state = Z_OK;
    while (state != Z_STREAM_END) {
        if (stream.avail_in == 0) {
            const std::size_t next = std::min(most_at_once, bytes.size() - at);
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + at));
            stream.avail_in = static_cast<uInt>(next);
            at += next;
        }
        stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
        stream.avail_out = static_cast<uInt>(buffer.size());
        state = deflate(&stream, at == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        result.append(buffer.data(), buffer.size() - stream.avail_out);
    }
    deflateEnd(&stream);
    return result;
}

std::string base64_of(std::string_view bytes) {
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) {
            return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
        };
        const std::uint32_t word = byte(0) << 16U | byte(1) << 8U | byte(2);
        const std::size_t used = std::min<std::size_t>(bytes.size() - i, 3);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= used ? digits[word >> (18 - 6 * k) & 63U] : '=';
    }
    return text;
}

} // namespace terrane::page
