// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/atomic/atomic_folder.hpp>
#include <terrane/io/atomic/file_set.hpp>

#include "support/files.hpp"

using namespace terrane;
using namespace test_support;
namespace fs = std::filesystem;

TEST_CASE("file set: files and folders appear together, and can be read before", "[io][files]") {
    TemporaryFolder folder;
    std::vector<std::string> told;
    {
        FileSet files;
        CHECK(FileSet::current() == &files);
        REQUIRE(write_file(folder / "a", "one"));
        REQUIRE(write_file(folder / "b", "two"));
        auto made = NewFolder::create(folder / "c");
        REQUIRE(made);
        REQUIRE(write_file(made->temporary() / "d", "three"));
        REQUIRE(made->publish());
        files.then([&] { told.emplace_back("told"); });
        CHECK_FALSE(fs::exists(folder / "a"));
        CHECK_FALSE(fs::exists(folder / "c"));
        CHECK(read_file(folder / "a").value_or("") == "one");
        CHECK(read_file(folder / "." / "b").value_or("") == "two");
        CHECK(read_file(folder / "c" / "d").value_or("") == "three");
        CHECK(told.empty());
        REQUIRE(write_file_at_once(folder / "now", "four"));
        CHECK(fs::exists(folder / "now"));
        REQUIRE(files.publish());
        CHECK(told.size() == 1);
    }
    CHECK(FileSet::current() == nullptr);
    CHECK(read_file(folder / "a").value_or("") == "one");
    CHECK(read_file(folder / "c" / "d").value_or("") == "three");
    CHECK(entries(folder.path()) == 4);
}

TEST_CASE("file set: what is not published leaves nothing, and what was there", "[io][files]") {
    TemporaryFolder folder;
    REQUIRE(write_file(folder / "a", "old"));
    {
        FileSet files;
        REQUIRE(write_file(folder / "a", "new"));
        REQUIRE(write_file(folder / "b", "new"));
        auto made = NewFolder::create(folder / "c");
        REQUIRE(made);
        REQUIRE(made->publish());
        files.then([] { FAIL("nothing was written"); });
    }
    CHECK(read_file(folder / "a").value_or("") == "old");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("file set: where the last step fails, it says what was replaced", "[io][files]") {
    TemporaryFolder folder;
    FileSet files;
    REQUIRE(write_file(folder / "a", "new"));
    REQUIRE(write_file(folder / "b", "new"));
    fs::create_directory(folder / "b"); // by somebody else
    std::ofstream(folder / "b" / "c") << "other";
    const auto status = files.publish();
    REQUIRE_FALSE(status);
    CHECK(status.error().code == ErrorCode::write_failed);
    CHECK(status.error().place == (folder / "b").string());
    CHECK(status.error().sentence.ends_with("; written before: " + (folder / "a").string()));
    CHECK(read_file(folder / "a").value_or("") == "new");
}

TEST_CASE("file set: a process that ends at once can remove its temporary files", "[io][files]") {
    TemporaryFolder folder;
    {
        FileSet files;
        REQUIRE(write_file(folder / "a", "new"));
        auto made = NewFolder::create(folder / "c");
        REQUIRE(made);
        REQUIRE(write_file_at_once(made->temporary() / "d", "three"));
        CHECK(entries(folder.path()) == 2);
        remove_temporaries().unlock();
        CHECK(entries(folder.path()) == 0);
    }
}
