// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/gzip.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <new>

#include <zlib.h>

namespace terrane::detail {
namespace {

constexpr std::size_t free_growth = std::size_t{64} << 20U; ///< bytes
constexpr std::size_t most_growth = 100;                    ///< times the size, beyond

} // namespace

bool is_gzip(std::string_view contents) {
    return contents.starts_with("\x1f\x8b");
}

Result<std::string> gunzipped(std::string_view contents, std::string_view source) {
    const auto error = [&](ErrorCode code, const char* sentence) {
        return Error{code, sentence, std::string(source)};
    };
    constexpr int gzip_alone = 16 + MAX_WBITS;
    z_stream stream{};
    if (inflateInit2(&stream, gzip_alone) != Z_OK) throw std::bad_alloc();
    const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
    const std::size_t most = std::max(free_growth, most_growth * contents.size());
    std::string out;
    std::array<char, 1U << 16U> part{};
    int state = Z_OK;
    while (state != Z_STREAM_END || !contents.empty()) {
        if (stream.avail_in == 0 && !contents.empty()) {
            const std::size_t taken = std::min<std::size_t>(contents.size(), 1U << 30U);
            // zlib does not write to its input, whatever its type says.
            stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(contents.data())); // NOLINT
            stream.avail_in = static_cast<uInt>(taken);
            contents.remove_prefix(taken);
        }
        stream.next_out = reinterpret_cast<Bytef*>(part.data()); // NOLINT: bytes are bytes
        stream.avail_out = static_cast<uInt>(part.size());
        state = inflate(&stream, Z_NO_FLUSH);
        if (state == Z_MEM_ERROR) throw std::bad_alloc();
        const bool is_done = state == Z_STREAM_END;
        if (state != Z_OK && !is_done)
            return error(ErrorCode::bad_syntax, "the gzip data are damaged or cut off");
        out.append(part.data(), part.size() - stream.avail_out);
        if (out.size() > most)
            return error(ErrorCode::unsupported,
                         "the gzip data grow to more than 100 times their size");
        if (is_done && (stream.avail_in > 0 || !contents.empty())) { // another member
            inflateReset(&stream);
            state = Z_OK;
        }
    }
    return out;
}

} // namespace terrane::detail
