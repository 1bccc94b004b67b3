// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <csignal>
#include <cstdio>
#include <new>
#include <stdexcept>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>

#include "support/samples.hpp"

using namespace terrane;
using namespace terrane::test;
namespace fs = std::filesystem;

namespace {

std::size_t entries(const fs::path& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

ErrorCode code_of(const Status& status) {
    REQUIRE_FALSE(status);
    return status.error().code;
}

} // namespace

TEST_CASE("files: the extension tells the format, in any case", "[io][files]") {
    CHECK(format_of("a/b.ts") == Format::gocad);
    CHECK(format_of("MODEL.ML") == Format::gocad);
    CHECK(format_of("x.tar.Obj") == Format::obj);
    CHECK(format_of("x.msh") == Format::msh);
    CHECK(format_named("msh22") == Format::msh22);
    CHECK(format_of("x.inp") == Format::inp);
    CHECK(format_of("x.mesh") == Format::medit);
    CHECK(format_of("x.poly") == Format::poly);
    CHECK(format_of("x.smesh") == Format::smesh);
    CHECK_FALSE(format_of("x.abc"));
    CHECK_FALSE(format_of("x"));
    CHECK_FALSE(format_of("-"));
    CHECK(format_named("PLY") == Format::ply);
}

TEST_CASE("files: what is written reads back", "[io][files]") {
    TemporaryFolder folder;
    const auto mesh = float_mesh();
    std::size_t triangles = 0;
    for (const auto* name : {"a.ts", "a.OBJ", "a.off", "a.stl", "a.ply"}) {
        INFO(name);
        CHECK(message_of(write_mesh(mesh, folder / name)) == "no error");
        const auto result = read_surfaces(folder / name);
        REQUIRE(message_of(result) == "no error");
        triangles = 0;
        for (const auto& surface : result.value()) triangles += surface.triangles.size();
        const bool keeps_surfaces = name[2] == 't' || name[2] == 'O' || name[2] == 'p';
        CHECK(result.value().size() == (keeps_surfaces ? 3 : 1));
        CHECK(triangles == (keeps_surfaces ? 5 : 4));
        if (!keeps_surfaces) CHECK(result.value()[0].name == "a");
    }
    CHECK(message_of(write_mesh(mesh, folder / "text.stl", {.ascii = true})) == "no error");
    CHECK(read_surfaces(folder / "text.stl").value().size() == 3);
    CHECK(message_of(write_mesh(mesh, folder / "a.vtp")) == "no error");
    CHECK(message_of(write_mesh(mesh, folder / "a.msh")) == "no error");
    CHECK(message_of(write_tetrahedra(two_tetrahedra(), folder / "b.vtu")) == "no error");
    CHECK(message_of(write_tetrahedra(two_tetrahedra(), folder / "b.msh")) == "no error");
    CHECK(entries(folder.path()) == 10);
    const auto old = read_file(folder / "a.msh").value();
    CHECK(message_of(write_mesh(mesh, folder / "a.msh", {.format = Format::msh22})) == "no error");
    CHECK(read_file(folder / "a.msh").value() != old);
}

TEST_CASE("files: what holds surfaces, and what tetrahedra", "[io][files]") {
    TemporaryFolder folder;
    const std::vector<std::string> names{"ts",  "obj",   "off", "stl",  "ply",  "vtp",  "vtu",
                                         "msh", "msh22", "inp", "mesh", "poly", "smesh"};
    std::string of_surfaces, of_tetrahedra;
    for (const auto& name : names) {
        const auto format = format_named(name);
        REQUIRE(format);
        const auto surfaces = write_mesh(float_mesh(), folder / ("a." + name));
        const auto tetrahedra = write_tetrahedra(two_tetrahedra(), folder / ("b." + name));
        INFO(name << ": " << message_of(surfaces) << ", " << message_of(tetrahedra));
        CHECK(bool(surfaces) == holds_surfaces(*format));
        CHECK(bool(tetrahedra) == holds_tetrahedra(*format));
        if (surfaces) of_surfaces += name + " ";
        if (tetrahedra) of_tetrahedra += name + " ";
    }
    CHECK(of_surfaces == "ts obj off stl ply vtp msh msh22 inp mesh poly smesh ");
    CHECK(of_tetrahedra == "vtu msh msh22 inp mesh ");
}

TEST_CASE("files: reading what can't be read", "[io][files]") {
    TemporaryFolder folder;
    using enum ErrorCode;
    const auto check = [](const auto& result, ErrorCode code, const std::string& message) {
        CHECK(message_of(result) == message);
        if (!result) CHECK(result.error().code == code);
    };
    const auto missing = (folder / "no.ts").string();
    check(read_surfaces(missing), cannot_open,
          missing + ": cannot be read: No such file or directory");
    check(read_model(missing), cannot_open,
          missing + ": cannot be read: No such file or directory");
    fs::create_directory(folder / "folder.obj");
    check(read_surfaces(folder / "folder.obj"), cannot_open,
          (folder / "folder.obj").string() + ": cannot be read: Is a directory");
    check(read_surfaces("a.abc"), unknown_format, "a.abc: unknown format \".abc\"");
    check(read_surfaces("a"), unknown_format,
          "a: the file name has no extension that tells the format");
    check(read_surfaces("-"), unknown_format, "standard input: the format must be given");
    check(parse_surfaces("x", "a.vtu", Format::vtu), unsupported,
          "a.vtu: this format is written, not read");
    check(parse_surfaces("", "b/a.off", Format::off), nothing_to_do, "b/a.off: the file is empty");
}

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
    if (!fs::exists("/dev/full")) return;
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
    limit.rlim_cur = 100; // bytes: stands for a disk that fills up half way
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limit) == 0);
    const auto status = write_mesh(awkward_mesh(), folder / "a.obj");
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
    std::signal(SIGXFSZ, handler);
    CHECK(code_of(status) == ErrorCode::write_failed);
    CHECK(read_file(folder / "a.obj").value() == "old");
    CHECK(entries(folder.path()) == 1);
}

TEST_CASE("files: - is standard input and output", "[io][files]") {
    TemporaryFolder folder;
    const auto file = (folder / "stream").string();
    std::fflush(stdout);
    const int out = ::dup(STDOUT_FILENO);
    const int in = ::dup(STDIN_FILENO);
    const int stream = ::open(file.c_str(), O_RDWR | O_CREAT, 0600);
    REQUIRE(stream >= 0);
    ::dup2(stream, STDOUT_FILENO);
    const auto written = write_mesh(awkward_mesh(), "-", {.format = Format::off});
    const auto nameless = write_mesh(awkward_mesh(), "-");
    ::dup2(out, STDOUT_FILENO);
    ::lseek(stream, 0, SEEK_SET);
    ::dup2(stream, STDIN_FILENO);
    const auto result = read_surfaces("-", Format::off);
    ::dup2(in, STDIN_FILENO);
    for (const int descriptor : {out, in, stream}) ::close(descriptor);
    CHECK(message_of(written) == "no error");
    CHECK(message_of(nameless) == "standard output: the format must be given");
    REQUIRE(message_of(result) == "no error");
    CHECK(result.value()[0].triangles == awkward_mesh().triangles);
    CHECK(result.value()[0].name == "standard input");
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
    if (::geteuid() == 0) return; // nothing is forbidden to root
    TemporaryFolder folder;
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

TEST_CASE("files: running out of memory is an error, not an exception", "[io][files]") {
    const auto bad = guard_memory("a.ts", []() -> Status { throw std::bad_alloc(); });
    const auto length = guard_memory("a.ts", []() -> Status { throw std::length_error("x"); });
    for (const auto& status : {bad, length}) {
        CHECK(message_of(status) == "a.ts: there is not enough memory");
        CHECK(code_of(status) == ErrorCode::out_of_memory);
    }
}
