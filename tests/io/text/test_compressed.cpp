// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>

#include <zlib.h>

#include "support/paths.hpp"
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/text/compressed.hpp>

namespace compressed_test {

using namespace terrane;
using detail::decompressed, detail::is_compressed;

namespace {

std::string gzipped(std::string text) {
    z_stream stream{};
    REQUIRE(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY) == Z_OK);
    std::string out(deflateBound(&stream, text.size()) + 32, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(text.data());
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(out.data());
    stream.avail_out = static_cast<uInt>(out.size());
    REQUIRE(deflate(&stream, Z_FINISH) == Z_STREAM_END);
    out.resize(stream.total_out);
    deflateEnd(&stream);
    return out;
}

const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

} // namespace

TEST_CASE("gzip: surfaces are read, under their own name") {
    CHECK(format_to_read("a/top.obj.gz") == Format::obj);
    CHECK(format_to_read("top.TS.GZ") == Format::gocad);
    CHECK(format_to_read("top.ts") == Format::gocad);
    CHECK(format_to_read("top.gz") == std::nullopt);
    CHECK(format_of("top.obj.gz") == std::nullopt); // nothing is written so
    const auto read = parse_surfaces(gzipped(triangle), "a/top.obj.gz", Format::obj);
    REQUIRE(read);
    REQUIRE(read->size() == 1);
    CHECK(read->front().name == "top");
    CHECK(read->front().triangles.size() == 1);
}

TEST_CASE("gzip: members one after the other, of any size") {
    std::string large;
    for (int i = 0; i < 100'000; ++i) large += std::to_string(i * 7919 % 100'003) + "\n";
    const auto both = decompressed(gzipped(large) + gzipped("") + gzipped("end"), "f");
    REQUIRE(both);
    CHECK(*both == large + "end");
    CHECK(decompressed(gzipped(""), "f").value().empty());
}

TEST_CASE("gzip: what is cut off or damaged is an error, at each byte") {
    const std::string whole = gzipped(triangle);
    for (std::size_t n = 2; n < whole.size(); ++n) {
        const auto cut = decompressed(whole.substr(0, n), "f.gz");
        REQUIRE(!cut);
        CHECK(cut.error().code == ErrorCode::bad_syntax);
        CHECK(cut.error().place == "f.gz");
    }
    for (std::size_t n = 10; n < whole.size();
         ++n) { // beyond the header, which has fields for people
        std::string damaged = whole;
        damaged[n] = static_cast<char>(damaged[n] ^ 4);
        const auto read = decompressed(damaged, "f.gz");
        CHECK_FALSE(read); // by the checksum at the latest
    }
    CHECK_FALSE(decompressed(whole + "x", "f.gz"));
    CHECK_FALSE(is_compressed(""));
    CHECK_FALSE(is_compressed("\x1f"));
}

namespace {

const std::string zip_folder = test_support::test_data() + "/other_programs/";

std::string contents_of_file(const std::string& name) {
    return read_file(zip_folder + name).value();
}

} // namespace

TEST_CASE("xz and ZIP: surfaces are read, under their own name") {
    CHECK(format_to_read("a/top.ts.XZ") == Format::gocad);
    CHECK(format_to_read("top.obj.zip") == Format::obj);
    for (const std::string name : {"triangle.obj.xz", "triangle.obj.zip", "stored.obj.zip"}) {
        const auto read = read_surfaces(zip_folder + name);
        INFO(name);
        if (!read && name.ends_with("xz")) {
            CHECK(read.error().code == ErrorCode::unsupported);
            WARN(read.error().message());
            continue;
        }
        if (!read) FAIL(read.error().message());
        CHECK(read->front().name == name.substr(0, name.find('.')));
        CHECK(read->front().triangles.size() == 1);
    }
}

TEST_CASE("xz and ZIP: what is cut off or damaged is an error, at each byte") {
    for (const std::string name : {"triangle.obj.xz", "triangle.obj.zip", "stored.obj.zip"}) {
        const std::string whole = contents_of_file(name);
        INFO(name);
        const auto expected = decompressed(whole, "f");
        if (!expected) continue; // no liblzma
        CHECK(*expected == triangle);
        for (std::size_t n = 6; n < whole.size(); ++n)
            CHECK_FALSE(decompressed(whole.substr(0, n), "f"));
        for (std::size_t n = 6; n < whole.size(); ++n) {
            std::string damaged = whole;
            damaged[n] = static_cast<char>(damaged[n] ^ 4);
            const auto read =
                decompressed(damaged, "f"); // the header of ZIP has a date and the like
            CHECK((!read || *read == triangle));
        }
    }
    CHECK_FALSE(decompressed("PK\x03\x04 PK\x05\x06", "f"));
    const auto two = decompressed(contents_of_file("two.zip"), "f");
    REQUIRE_FALSE(two);
    CHECK(two.error().message() ==
          "f: the ZIP archive has 2 files; one with a single file is read");
}

TEST_CASE("gzip: data that grow beyond all texts are refused") {
    const auto read = decompressed(gzipped(std::string(std::size_t{100} << 20U, ' ')), "f.gz");
    REQUIRE(!read);
    CHECK(read.error().code == ErrorCode::unsupported);
}

} // namespace compressed_test
