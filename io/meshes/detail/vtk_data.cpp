// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/meshes/detail/vtk_data.hpp>

#include <algorithm>
#include <array>
#include <new>
#include <type_traits>

#include <zlib.h>
#ifdef TERRANE_HAS_LZ4
#include <lz4.h>
#endif
#ifdef TERRANE_HAS_LZMA
#include <lzma.h>
#endif

#include <terrane/io/text/bytes.hpp>

namespace terrane::detail {
namespace {

/// The most that zlib shrinks anything, with room for the header of a short stream.
constexpr std::size_t most_growth = 1040;

constexpr unsigned no_digit = 64;

unsigned base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return static_cast<unsigned>(c - 'A');
    if (c >= 'a' && c <= 'z') return static_cast<unsigned>(c - 'a') + 26;
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0') + 52;
    return c == '+' ? 62 : c == '/' ? 63 : no_digit;
}

/// Bytes that are read from the front, raw or as base64.
class ByteSource {
public:
    ByteSource(std::string_view text, bool base64, std::size_t at) :
        text_(text), base64_(base64), at_(at) {}

    /// Takes the next bytes; in base64 they are a stream of their own, padded at its end, or, if not
    /// `whole`, may be the beginning of one. Returns false if there are not as many, or other
    /// characters.
    bool take(std::size_t count, std::string& bytes, bool whole = true) {
        bytes.clear();
        if (at_ > text_.size() || count > text_.size() - at_) return false;
        if (!base64_) {
            bytes = text_.substr(at_, count);
            at_ += count;
            return true;
        }
        const std::size_t letters = (count + 2) / 3 * 4;
        if (letters > text_.size() - at_) return false;
        bytes.reserve(letters / 4 * 3);
        for (std::size_t i = at_; i < at_ + letters; i += 4)
            if (!append_group(i, bytes)) return false;
        at_ += letters;
        if (bytes.size() < count || (whole && bytes.size() > count)) return false;
        bytes.resize(count);
        return true;
    }

    /// Tells whether the stream that was taken last ends with so much padding.
    [[nodiscard]] bool was_padded(std::size_t count) const {
        return base64_ && at_ >= count &&
               text_.substr(at_ - count, count) == std::string(count, '=');
    }
    [[nodiscard]] bool is_base64() const { return base64_; }
    [[nodiscard]] std::size_t at() const { return at_; }
    void go_to(std::size_t at) { at_ = at; }

private:
    bool append_group(std::size_t at, std::string& bytes) const {
        std::array<unsigned, 4> digits{};
        std::size_t count = 4;
        while (count > 2 && text_[at + count - 1] == '=') --count;
        for (std::size_t k = 0; k < count; ++k) {
            digits[k] = base64_digit(text_[at + k]);
            if (digits[k] == no_digit) return false;
        }
        const bool has_spare_bits = (count == 2 && digits[1] % 16 != 0) ||
                                    (count == 3 && digits[2] % 4 != 0); // which say nothing
        if (has_spare_bits) return false;
        const unsigned group = digits[0] << 18U | digits[1] << 12U | digits[2] << 6U | digits[3];
        for (std::size_t k = 0; k + 1 < count; ++k)
            bytes += static_cast<char>(group >> (16 - 8 * k) & 255U);
        return true;
    }

    std::string_view text_;
    bool base64_;
    std::size_t at_;
};

std::uint64_t header_word(const std::string& bytes, std::size_t index, const VtkEncoding& e) {
    return e.wide_headers ? load<std::uint64_t>(bytes.data() + 8 * index, e.order)
                          : load<std::uint32_t>(bytes.data() + 4 * index, e.order);
}

constexpr auto too_short = "the data of the array end too soon, or are not base64";

std::optional<std::string> decode_plain(ByteSource& in, const VtkEncoding& e, std::string& bytes) {
    const std::size_t word = e.wide_headers ? 8 : 4, start = in.at();
    std::string header;
    if (!in.take(word, header, false)) return too_short;
    const std::uint64_t size = header_word(header, 0, e);
    if (size > SIZE_MAX / 2) return too_short;
    // Most programs encode the header and the data as one stream, some as two.
    const bool apart = !in.is_base64() || in.was_padded(word == 4 ? 2 : 1);
    if (!apart) in.go_to(start);
    if (!in.take(apart ? size : word + size, bytes)) return too_short;
    if (!apart) bytes.erase(0, word);
    return std::nullopt;
}

bool inflate_to(std::string_view from, std::size_t size, char* to) {
    uLongf made = size;
    const int code = uncompress(reinterpret_cast<Bytef*>(to), &made,
                                reinterpret_cast<const Bytef*>(from.data()), from.size());
    if (code == Z_MEM_ERROR) throw std::bad_alloc(); // nothing is wrong with the data
    return code == Z_OK && made == size;
}

#ifdef TERRANE_HAS_LZ4
bool unpack_lz4(std::string_view from, std::size_t size, char* to) {
    if (from.size() > LZ4_MAX_INPUT_SIZE || size > LZ4_MAX_INPUT_SIZE) return false;
    const auto length = static_cast<int>(size);
    return LZ4_decompress_safe(from.data(), to, static_cast<int>(from.size()), length) == length;
}
#endif

#ifdef TERRANE_HAS_LZMA
bool unpack_lzma(std::string_view from, std::size_t size, char* to) {
    std::uint64_t most_memory = std::uint64_t{256} << 20U;
    std::size_t read = 0, made = 0;
    const lzma_ret code = lzma_stream_buffer_decode(
        &most_memory, 0, nullptr, reinterpret_cast<const std::uint8_t*>(from.data()), &read,
        from.size(), reinterpret_cast<std::uint8_t*>(to), &made, size);
    if (code == LZMA_MEM_ERROR) throw std::bad_alloc();
    return code == LZMA_OK && made == size;
}
#endif

/// Appends the `size` bytes of a block.
bool append_block(VtkCompressor compressor, std::string_view from, std::size_t size,
                  std::string& bytes) {
    if (size / most_growth > from.size()) return false;
    const std::size_t start = bytes.size();
    bytes.resize(start + size);
    char* const to = bytes.data() + start;
#ifdef TERRANE_HAS_LZ4
    if (compressor == VtkCompressor::lz4) return unpack_lz4(from, size, to);
#endif
#ifdef TERRANE_HAS_LZMA
    if (compressor == VtkCompressor::lzma) return unpack_lzma(from, size, to);
#endif
    return compressor == VtkCompressor::zlib && inflate_to(from, size, to);
}

std::optional<std::string> decode_compressed(ByteSource& in, const VtkEncoding& e,
                                             std::string_view text, std::string& bytes) {
    const std::size_t word = e.wide_headers ? 8 : 4, start = in.at();
    std::string header, packed;
    if (!in.take(word, header, false)) return too_short;
    const std::uint64_t blocks = header_word(header, 0, e);
    if (blocks == 0) return std::nullopt;
    if (blocks > text.size()) return too_short;
    in.go_to(start);
    if (!in.take((3 + blocks) * word, header)) return too_short;
    const std::uint64_t whole = header_word(header, 1, e), last = header_word(header, 2, e);
    std::uint64_t size = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) {
        const std::uint64_t part = header_word(header, 3 + b, e);
        if (part > text.size() || (size += part) > text.size()) return too_short;
    }
    if (!in.take(size, packed)) return too_short;
    std::size_t at = 0;
    for (std::uint64_t b = 0; b < blocks; ++b) {
        const std::uint64_t part = header_word(header, 3 + b, e);
        const bool is_rest = b + 1 == blocks && last != 0;
        if (!append_block(e.compressor, std::string_view(packed).substr(at, part),
                          is_rest ? last : whole, bytes))
            return "the data of the array cannot be decompressed";
        at += part;
    }
    return std::nullopt;
}

template <class From, class To>
void convert_all(std::string_view bytes, std::endian order, std::vector<To>& values) {
    values.reserve(bytes.size() / sizeof(From));
    for (std::size_t at = 0; at + sizeof(From) <= bytes.size(); at += sizeof(From)) {
        values.push_back(static_cast<To>(load<From>(bytes.data() + at, order)));
    }
}

template <class To>
std::optional<std::string> convert_to(std::string_view bytes, std::string_view type,
                                      std::endian order, std::vector<To>& values) {
    values.clear();
    const bool is_float = type == "Float32" || type == "Float64";
    if (is_float && std::is_integral_v<To>) return "integers are needed";
    if (type == "Float64")
        convert_all<double>(bytes, order, values);
    else if (type == "Float32")
        convert_all<float>(bytes, order, values);
    else if (type == "Int64")
        convert_all<std::int64_t>(bytes, order, values);
    else if (type == "UInt64")
        convert_all<std::uint64_t>(bytes, order, values);
    else if (type == "Int32")
        convert_all<std::int32_t>(bytes, order, values);
    else if (type == "UInt32")
        convert_all<std::uint32_t>(bytes, order, values);
    else if (type == "Int16")
        convert_all<std::int16_t>(bytes, order, values);
    else if (type == "UInt16")
        convert_all<std::uint16_t>(bytes, order, values);
    else if (type == "Int8")
        convert_all<std::int8_t>(bytes, order, values);
    else if (type == "UInt8")
        convert_all<std::uint8_t>(bytes, order, values);
    else
        return "the type of the array must be Float32, Float64, Int8 to Int64, or UInt8 to UInt64";
    return std::nullopt;
}

} // namespace

std::optional<NumberType> number_type_named(std::string_view name) {
    constexpr std::array<std::string_view, 10> types{
        "Float64", "Float32", "Int8",   "UInt8", "Int16",
        "UInt16",  "Int32",   "UInt32", "Int64", "UInt64"}; // in the order of NumberType
    const auto* const found = std::ranges::find(types, name);
    if (found == types.end()) return std::nullopt;
    return static_cast<NumberType>(found - types.begin());
}

std::optional<VtkCompressor> vtk_compressor(std::string_view name) {
    if (name.empty()) return VtkCompressor::none;
    if (name == "vtkZLibDataCompressor") return VtkCompressor::zlib;
#ifdef TERRANE_HAS_LZ4
    if (name == "vtkLZ4DataCompressor") return VtkCompressor::lz4;
#endif
#ifdef TERRANE_HAS_LZMA
    if (name == "vtkLZMADataCompressor") return VtkCompressor::lzma;
#endif
    return std::nullopt;
}

std::optional<std::string> decode_vtk(std::string_view text, bool base64, std::size_t at,
                                      const VtkEncoding& encoding, std::string& bytes,
                                      std::size_t& used) {
    bytes.clear();
    ByteSource in(text, base64, at);
    auto flaw = encoding.compressor != VtkCompressor::none
                    ? decode_compressed(in, encoding, text, bytes)
                    : decode_plain(in, encoding, bytes);
    used += in.at() > at ? in.at() - at : 0;
    return flaw;
}

std::optional<std::string> convert_vtk(std::string_view bytes, std::string_view type,
                                       std::endian order, std::vector<double>& values) {
    return convert_to(bytes, type, order, values);
}

std::optional<std::string> convert_vtk(std::string_view bytes, std::string_view type,
                                       std::endian order, std::vector<std::int64_t>& values) {
    return convert_to(bytes, type, order, values);
}

} // namespace terrane::detail
