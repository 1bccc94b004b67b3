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

TEST_CASE("file set: two results in one place, or one in that of a kept file, are refused",
          "[io][files]") {
    TemporaryFolder folder;
    REQUIRE(write_file(folder / "kept", "old"));
    fs::create_symlink("kept", folder / "link");
    fs::create_symlink("new", folder / "to_new");
    fs::create_directory(folder / "empty");
    FileSet files;
    files.keep(folder / "link");
    REQUIRE(write_file(folder / "new", "one"));
    auto made = NewFolder::create(folder / "empty");
    REQUIRE(made);
    REQUIRE(made->publish());
    for (const char* const name : {"kept", "link", "new", "to_new", "empty/file"}) {
        const auto status = write_file(folder / name, "two");
        INFO(name);
        REQUIRE_FALSE(status);
        CHECK(status.error().code == ErrorCode::bad_option);
        CHECK(fs::path(status.error().place).filename() ==
              (name == std::string("link")     ? "kept"
               : name == std::string("to_new") ? "new"
                                               : fs::path(name).filename().string()));
    }
    auto again = NewFolder::create(folder / "new");
    REQUIRE(again);
    CHECK_FALSE(again->publish());
    REQUIRE(write_file(folder / "new2", "one"));
    REQUIRE(write_file("/dev/null", "one"));
    REQUIRE(write_file("/dev/null", "two"));
    REQUIRE(files.publish());
    CHECK(read_file(folder / "kept").value_or("") == "old");
    CHECK(read_file(folder / "new").value_or("") == "one");
}

TEST_CASE("file set: paths overlap by any of their names", "[io][files]") {
    TemporaryFolder folder;
    REQUIRE(write_file(folder / "a", "old"));
    fs::create_hard_link(folder / "a", folder / "hard");
    fs::create_symlink("b", folder / "to_b");
    CHECK(are_same(folder / "a", folder / "." / "a"));
    CHECK(are_same(folder / "a", folder / "hard"));
    CHECK(are_same(folder / "b", folder / "to_b"));
    CHECK(are_same(folder / "c", folder / "c" / ""));
    CHECK_FALSE(are_same(folder / "a", folder / "b"));
    CHECK_FALSE(are_same(folder / "c", folder / "c" / "d"));
    CHECK(overlap(folder / "c", folder / "c" / "d"));
    CHECK(overlap(folder / "to_b" / "d", folder / "b"));
    CHECK_FALSE(overlap(folder / "c", folder / "cd"));
    CHECK_FALSE(overlap("/dev/null", "/dev/null"));
}
