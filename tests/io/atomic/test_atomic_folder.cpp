// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Counts how often files are flushed to the disk: calls that the library makes end here.
#include <atomic>
#include <string>

#include <catch2/catch.hpp>

#include <sys/syscall.h>
#include <unistd.h>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/atomic/file_set.hpp>

#include "support/files.hpp"

using namespace terrane;
using namespace test_support;
namespace fs = std::filesystem;

namespace {

std::atomic<unsigned> flushed_files{0}, flushed_file_systems{0};

/// Counts from its construction on.
struct FlushCounts {
    unsigned files_before = flushed_files, file_systems_before = flushed_file_systems;
    [[nodiscard]] unsigned files() const { return flushed_files - files_before; }
    [[nodiscard]] unsigned file_systems() const {
        return flushed_file_systems - file_systems_before;
    }
};

} // namespace

extern "C" int fsync(int number) {
    ++flushed_files;
    return static_cast<int>(::syscall(SYS_fsync, number));
}

extern "C" int syncfs(int number) noexcept {
    ++flushed_file_systems;
    return static_cast<int>(::syscall(SYS_syncfs, number));
}

TEST_CASE("folder: any number of files is flushed by one call", "[io][files]") {
    TemporaryFolder folder;
    for (const int count : {3, 300}) {
        const auto target = folder / std::to_string(count);
        auto made = NewFolder::create(target);
        REQUIRE(made);
        const FlushCounts flushes;
        for (int k = 0; k < count; ++k)
            REQUIRE(write_file(made->temporary() / std::to_string(k), "contents"));
        CHECK(flushes.files() == 0);
        CHECK(flushes.file_systems() == 0);
        REQUIRE(made->publish());
        CHECK(flushes.files() == 0);
        CHECK(flushes.file_systems() == 1);
        CHECK(entries(target) == static_cast<std::size_t>(count));
        CHECK(read_file(target / "2").value() == "contents");
    }
    CHECK(entries(folder.path()) == 2);
}

TEST_CASE("folder: it is flushed before it takes its place among the files of a run",
          "[io][files]") {
    TemporaryFolder folder;
    const FlushCounts flushes;
    FileSet set;
    auto made = NewFolder::create(folder / "a");
    REQUIRE(made);
    REQUIRE(write_file(made->temporary() / "b", "contents"));
    REQUIRE(made->publish());
    CHECK(flushes.file_systems() == 1);
    REQUIRE(write_file(folder / "c", "alone"));
    CHECK(flushes.files() == 1);
    CHECK(entries(folder.path()) == 2); // under temporary names
    REQUIRE(set.publish());
    CHECK(flushes.file_systems() == 1);
    CHECK(flushes.files() == 1);
    CHECK(read_file(folder / "a/b").value() == "contents");
}

TEST_CASE("folder: what can't be written in it is named as it will be called", "[io][files]") {
    TemporaryFolder folder;
    auto made = NewFolder::create(folder / "a");
    REQUIRE(made);
    const auto status = write_file(made->temporary() / "no/b", "contents");
    REQUIRE_FALSE(status);
    CHECK(status.error().code == ErrorCode::cannot_open);
    CHECK(status.error().place == (folder / "a/no/b").string());
    REQUIRE(write_file(made->temporary() / "c", "long contents"));
    REQUIRE(write_file(made->temporary() / "c", "short")); // replaces it
    REQUIRE(made->publish());
    CHECK(read_file(folder / "a/c").value() == "short");
    CHECK(entries(folder / "a") == 1);
}
