// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/compressed.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>
#ifdef TERRANE_HAS_LZMA
#include <lzma.h>
#endif

#include <terrane/io/text/bytes.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane::detail {
namespace {

constexpr std::size_t free_growth = std::size_t{64} << 20U; ///< bytes
constexpr std::size_t most_growth = 100;                    ///< times the size, beyond

constexpr std::string_view gzip_magic = "\x1f\x8b", zip_magic = "PK\x03\x04",
                           xz_magic{"\xfd\x37zXZ\0", 6};

/// Collects the bytes of a method, up to the most that are taken.
class Decompressor {
public:
    Decompressor(std::string_view contents, std::string_view source, const char* method) :
        in_(contents), source_(source), method_(method),
        most_(std::max(free_growth, most_growth * contents.size())) {}

    /// Inflates gzip's members or, with negative bits, the raw data of a ZIP archive.
    Result<std::string> inflated(int bits) {
        z_stream stream{};
        if (inflateInit2(&stream, bits) != Z_OK) throw std::bad_alloc();
        const std::unique_ptr<z_stream, int (*)(z_stream*)> guard(&stream, inflateEnd);
        int state = Z_OK;
        while (state != Z_STREAM_END || !in_.empty()) {
            if (stream.avail_in == 0 && !in_.empty()) {
                const auto taken = take(std::size_t{1} << 30U);
                // zlib does not write to its input, whatever its type says.
                stream.next_in =
                    reinterpret_cast<Bytef*>(const_cast<char*>(taken.data())); // NOLINT
                stream.avail_in = static_cast<uInt>(taken.size());
            }
            stream.next_out = reinterpret_cast<Bytef*>(part_.data()); // NOLINT: bytes are bytes
            stream.avail_out = static_cast<uInt>(part_.size());
            state = inflate(&stream, Z_NO_FLUSH);
            if (state == Z_MEM_ERROR) throw std::bad_alloc();
            const bool is_done = state == Z_STREAM_END;
            if (state != Z_OK && !is_done) return damaged();
            if (auto trouble = append(part_.size() - stream.avail_out)) return *trouble;
            if (is_done && (stream.avail_in > 0 || !in_.empty())) { // another member
                if (bits < 0) return damaged();
                inflateReset(&stream);
                state = Z_OK;
            }
        }
        return std::move(out_);
    }

#ifdef TERRANE_HAS_LZMA
    Result<std::string> unpacked_xz() {
        constexpr std::uint64_t most_memory = std::uint64_t{256} << 20U; // xz -9 needs 65 MiB
        lzma_stream stream = LZMA_STREAM_INIT;
        if (lzma_stream_decoder(&stream, most_memory, LZMA_CONCATENATED) != LZMA_OK)
            throw std::bad_alloc();
        const std::unique_ptr<lzma_stream, void (*)(lzma_stream*)> guard(&stream, lzma_end);
        stream.next_in = reinterpret_cast<const std::uint8_t*>(in_.data()); // NOLINT: bytes
        stream.avail_in = in_.size();
        for (lzma_ret state = LZMA_OK; state != LZMA_STREAM_END;) {
            stream.next_out = reinterpret_cast<std::uint8_t*>(part_.data()); // NOLINT: bytes
            stream.avail_out = part_.size();
            state = lzma_code(&stream, LZMA_FINISH);
            if (state == LZMA_MEM_ERROR) throw std::bad_alloc();
            if (state == LZMA_MEMLIMIT_ERROR)
                return error(ErrorCode::unsupported,
                             "the xz data need more than 256 MiB of memory");
            if (state != LZMA_OK && state != LZMA_STREAM_END) return damaged();
            if (auto trouble = append(part_.size() - stream.avail_out)) return *trouble;
        }
        return std::move(out_);
    }
#endif

private:
    std::string_view take(std::size_t most) {
        const auto taken = in_.substr(0, most);
        in_.remove_prefix(taken.size());
        return taken;
    }

    MaybeError append(std::size_t count) {
        out_.append(part_.data(), count);
        if (out_.size() <= most_) return std::nullopt;
        return error(ErrorCode::unsupported,
                     fmt::format("the {} data grow to more than 100 times their size", method_));
    }

    [[nodiscard]] Error damaged() const {
        return error(ErrorCode::bad_syntax,
                     fmt::format("the {} data are damaged or cut off", method_));
    }
    [[nodiscard]] Error error(ErrorCode code, std::string sentence) const {
        return {code, std::move(sentence), std::string(source_)};
    }

    std::string_view in_, source_;
    const char* method_;
    std::size_t most_;
    std::string out_;
    std::array<char, 1U << 16U> part_{};
};

/// Reads the only file of a ZIP archive by the directory at its end. Source: PKWARE's APPNOTE.TXT, 4.3.
class ZipReader {
public:
    ZipReader(std::string_view contents, std::string_view source) :
        contents_(contents), source_(source) {}

    Result<std::string> read() {
        const auto end = contents_.rfind("PK\x05\x06");
        if (end == std::string_view::npos || contents_.size() - end < 22) return damaged();
        const auto entries = number<std::uint16_t>(end + 10);
        std::size_t at = number<std::uint32_t>(end + 16), file = 0, files = 0;
        if (entries == UINT16_MAX || at == UINT32_MAX)
            return error(ErrorCode::unsupported, "ZIP64 archives are not read");
        for (unsigned e = 0; e < entries; ++e) {
            if (!is_header(at, "PK\x01\x02", 46)) return damaged();
            const std::size_t name_size = number<std::uint16_t>(at + 28);
            const auto name = contents_.substr(at + 46, name_size);
            // Folders and what macOS adds are no files of the user.
            if (!name.ends_with('/') && !name.starts_with("__MACOSX/") && files++ == 0) file = at;
            at += 46 + name_size + number<std::uint16_t>(at + 30) + number<std::uint16_t>(at + 32);
        }
        if (files == 1) return read_file_at(file);
        return error(
            ErrorCode::unsupported,
            fmt::format("the ZIP archive has {} files; one with a single file is read", files));
    }

private:
    Result<std::string> read_file_at(std::size_t entry) {
        const auto flags = number<std::uint16_t>(entry + 8),
                   method = number<std::uint16_t>(entry + 10);
        const auto checksum = number<std::uint32_t>(entry + 16);
        const std::size_t packed = number<std::uint32_t>(entry + 20),
                          plain = number<std::uint32_t>(entry + 24),
                          at = number<std::uint32_t>(entry + 42);
        if (packed == UINT32_MAX || plain == UINT32_MAX || at == UINT32_MAX)
            return error(ErrorCode::unsupported, "ZIP64 archives are not read");
        if (flags % 2 != 0)
            return error(ErrorCode::unsupported, "the file in the ZIP archive needs a password");
        if (method != 0 && method != 8)
            return error(ErrorCode::unsupported,
                         "the file in the ZIP archive is not compressed by Deflate");
        if (!is_header(at, zip_magic, 30)) return damaged();
        const std::size_t start =
            at + 30 + number<std::uint16_t>(at + 26) + number<std::uint16_t>(at + 28);
        if (start > contents_.size() || packed > contents_.size() - start) return damaged();
        const auto data = contents_.substr(start, packed);
        auto out = method == 0 ? Result<std::string>(std::string(data))
                               : Decompressor(data, source_, "ZIP").inflated(-MAX_WBITS);
        if (!out) return out;
        const auto sum =
            crc32_z(0, reinterpret_cast<const Bytef*>(out->data()), out->size()); // NOLINT: bytes
        if (out->size() != plain || sum != checksum) return damaged();
        return out;
    }

    [[nodiscard]] bool is_header(std::size_t at, std::string_view magic, std::size_t size) const {
        return at <= contents_.size() && size <= contents_.size() - at &&
               contents_.substr(at).starts_with(magic);
    }
    template <class T>
    [[nodiscard]] T number(std::size_t at) const {
        return load<T>(contents_.data() + at);
    }
    [[nodiscard]] Error damaged() const {
        return error(ErrorCode::bad_syntax, "the ZIP archive is damaged or cut off");
    }
    [[nodiscard]] Error error(ErrorCode code, std::string sentence) const {
        return {code, std::move(sentence), std::string(source_)};
    }

    std::string_view contents_, source_;
};

} // namespace

bool is_compressed(std::string_view contents) {
    return contents.starts_with(gzip_magic) || contents.starts_with(xz_magic) ||
           contents.starts_with(zip_magic);
}

std::filesystem::path without_compression(const std::filesystem::path& path) {
    const auto ending = lower(path.extension().string());
    return ending == ".gz" || ending == ".xz" || ending == ".zip" ? path.parent_path() / path.stem()
                                                                  : path;
}

Result<std::string> decompressed(std::string_view contents, std::string_view source) {
    if (contents.starts_with(zip_magic)) return ZipReader(contents, source).read();
    if (contents.starts_with(gzip_magic))
        return Decompressor(contents, source, "gzip").inflated(16 + MAX_WBITS);
#ifdef TERRANE_HAS_LZMA
    return Decompressor(contents, source, "xz").unpacked_xz();
#else
    return Error{
        ErrorCode::unsupported,
        "this build cannot read xz, as liblzma (liblzma-dev) was not there when it was made",
        std::string(source)};
#endif
}

} // namespace terrane::detail
