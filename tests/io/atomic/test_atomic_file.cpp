// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <csignal>
#include <cstdlib>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>

#include "support/files.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;
namespace fs = std::filesystem;

namespace {

/// Turns root, who may write anywhere, into the owner of `folder` who is not root, until the end of
/// the scope. Any other user stays who it is.
class OrdinaryUser {
public:
    explicit OrdinaryUser(const fs::path& folder) {
        if (::geteuid() != 0) return;
        REQUIRE(::chown(folder.c_str(), nobody, nobody) == 0);
        REQUIRE(::setresuid(nobody, nobody, 0) == 0);
        was_root_ = true;
    }
    OrdinaryUser(const OrdinaryUser&) = delete;
    OrdinaryUser& operator=(const OrdinaryUser&) = delete;
    ~OrdinaryUser() {
        if (was_root_ && ::setresuid(0, 0, 0) != 0) std::abort();
    }

private:
    static constexpr uid_t nobody = 65534;
    bool was_root_ = false;
};

} // namespace

TEST_CASE("files: what can't be written leaves nothing behind", "[io][files]") {
    TemporaryFolder folder;
    const auto mesh = awkward_mesh();
    using enum ErrorCode;
    CHECK(code_of(write_mesh(mesh, folder / "no/a.obj")) == cannot_open);
    CHECK(code_of(write_mesh(mesh, folder.path(), {.format = Format::obj})) == cannot_open);
    CHECK(code_of(write_mesh(mesh, folder / "a.abc")) == unknown_format);
    CHECK(code_of(write_mesh(mesh, folder / "a.vtu")) == unsupported);
    CHECK(code_of(write_tetrahedra(two_tetrahedra(), folder / "a.obj")) == unsupported);
    const auto stl = write_mesh(mesh, folder / "a.stl");
    CHECK(code_of(stl) == bad_number);
    CHECK(stl.error().place == (folder / "a.stl").string());
    const std::vector<CellArray> wrong{{"quality", std::vector<double>(3)}};
    CHECK(code_of(write_mesh(mesh, folder / "a.vtp", {.cells = wrong})) == bad_option);
    CHECK(entries(folder.path()) == 0);
}

TEST_CASE("files: a full disk is noticed", "[io][files]") {
    REQUIRE(fs::exists("/dev/full"));
    const auto status = write_mesh(awkward_mesh(), "/dev/full", {.format = Format::obj});
    CHECK(message_of(status) == "/dev/full: writing failed: No space left on device");
    CHECK(code_of(status) == ErrorCode::write_failed);
    CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("files: a write cut short leaves what was there", "[io][files]") {
    TemporaryFolder folder;
    REQUIRE(write_file(folder / "a.obj", "old"));
    struct rlimit before {};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    auto limit = before;
    limit.rlim_cur = 100; // bytes: like a disk that fills up half way
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    const auto status = write_mesh(awkward_mesh(), folder / "a.obj");
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, handler);
    CHECK(code_of(status) == ErrorCode::write_failed);
    CHECK(read_file(folder / "a.obj").value() == "old");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("files: replacing keeps permissions and follows links", "[io][files]") {
    TemporaryFolder folder;
    REQUIRE(write_file(folder / "a", "old"));
    REQUIRE(::chmod((folder / "a").c_str(), 0640) == 0);
    fs::create_symlink("a", folder / "link");
    REQUIRE(write_file(folder / "link", "new"));
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(read_file(folder / "a").value() == "new");
    struct stat info {};
    REQUIRE(::stat((folder / "a").c_str(), &info) == 0);
    CHECK((info.st_mode & 0777u) == 0640u);
    CHECK(entries(folder.path()) == 2);
}

TEST_CASE("files: protected folders and files stay as they are", "[io][files]") {
    TemporaryFolder folder;
    const OrdinaryUser user(folder.path());
    fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
    CHECK(code_of(write_file(folder / "a", "x")) == ErrorCode::cannot_open);
    fs::permissions(folder.path(), fs::perms::owner_all);
    REQUIRE(write_file(folder / "b", "old"));
    fs::permissions(folder / "b", fs::perms::owner_read);
    CHECK(code_of(write_file(folder / "b", "x")) == ErrorCode::cannot_open);
    CHECK(read_file(folder / "b").value() == "old");
    fs::remove(folder / "b");
    CHECK(entries(folder.path()) == 0);
}

TEST_CASE("files: a file in the place of a folder is kept", "[io][files]") {
    TemporaryFolder folder;
    REQUIRE(write_file(folder / "a", "old"));
    CHECK(code_of(write_file(folder / "a/b", "x")) == ErrorCode::cannot_open);
    CHECK(code_of(write_file(folder.path(), "x")) == ErrorCode::cannot_open);
    CHECK(read_file(folder / "a").value() == "old");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("files: any size is read whole", "[io][files]") {
    TemporaryFolder folder;
    for (const std::size_t size :
         {0ul, 1ul, (1ul << 20) - 1, 1ul << 20, (1ul << 20) + 1, 5000000ul}) {
        std::string contents(size, 'x');
        if (size != 0) contents.back() = '\0';
        REQUIRE(write_file(folder / "a", contents));
        CHECK(read_file(folder / "a").value() == contents);
    }
}
