// SPDX-License-Identifier: LGPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cstdio>
#include <new>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/reading.hpp>

#include "support/files.hpp"
#include "support/samples.hpp"

using namespace terrane;
using namespace test_support;
namespace fs = std::filesystem;

namespace {} // namespace

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
    const std::vector<std::string> names{
        "ts",   "obj",   "off", "stl", "ply", "vtp", "vtu",  "msh",    "msh22", "inp", "mesh",
        "poly", "smesh", "vtk", "exo", "ugi", "ogs", "geos", "pylith", "dxf",   "unv", "f3grid"};
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
    CHECK(of_surfaces == "ts obj off stl ply vtp msh msh22 inp mesh poly smesh vtk dxf unv ");
    CHECK(of_tetrahedra == "vtu msh msh22 inp mesh exo ugi ogs geos pylith unv f3grid ");
}

TEST_CASE("files: all files of a simulator are written, or none", "[io][files]") {
    TemporaryFolder folder;
    const auto files = write_tetrahedra_files(two_tetrahedra(), folder / "a.ugi");
    REQUIRE(files);
    CHECK(files->front() == folder / "a.ugi");
    CHECK(files->size() == entries(folder.path()));
    for (const auto& file : *files) CHECK(fs::exists(file));

    fs::remove_all(folder / "a_box.ss");
    fs::create_directory(folder / "a_box.ss"); // no file can be there
    const auto before = read_file(folder / "a.ugi").value();
    const auto failed = write_tetrahedra(cut_tetrahedra(), folder / "a.ugi");
    REQUIRE(!failed);
    CHECK(message_of(failed).find("a_box.ss") != std::string::npos);
    CHECK(read_file(folder / "a.ugi").value() == before);
    CHECK(entries(folder.path()) == files->size());

    CHECK(message_of(write_tetrahedra(two_tetrahedra(), "-", {.format = Format::geos})) ==
          "standard output: in this format tetrahedra are several files: name the first");
    const auto nowhere = write_tetrahedra(two_tetrahedra(), folder / "no" / "a.exo");
    CHECK(code_of(nowhere) == ErrorCode::cannot_open);
}

TEST_CASE("files: tetrahedra of second order", "[io][files]") {
    TemporaryFolder folder;
    for (const std::string name : {"vtu", "msh", "msh22", "inp", "exo", "ogs"}) {
        INFO(name);
        CHECK(holds_second_order(*format_named(name)));
        const auto first = folder / ("a." + name), second = folder / ("b." + name);
        CHECK(message_of(write_tetrahedra(two_tetrahedra(), first)) == "no error");
        CHECK(message_of(write_tetrahedra(two_tetrahedra(), second, {.order = 2})) == "no error");
        CHECK(read_file(first).value() != read_file(second).value());
    }
    for (const std::string name : {"mesh", "ugi", "geos", "pylith", "unv", "f3grid"}) {
        INFO(name);
        CHECK(!holds_second_order(*format_named(name)));
        const auto file = folder / ("c." + name);
        const auto failed = write_tetrahedra(two_tetrahedra(), file, {.order = 2});
        CHECK(code_of(failed) == ErrorCode::unsupported);
        CHECK(!fs::exists(file));
    }
    CHECK(message_of(write_tetrahedra(two_tetrahedra(), folder / "a.vtu", {.order = 3})) ==
          (folder / "a.vtu").string() + ": the order of tetrahedra is 1 or 2");
    CHECK(message_of(write_tetrahedra(cut_tetrahedra(), folder / "a.pylith")) ==
          (folder / "a.pylith").string() +
              ": PyLith splits nodes itself: make this file without split surfaces");
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
    const std::string list_of_readable =
        "; read are ts, ml, gp, mx, gm, obj, off, stl, ply, vtp, vtu, msh, irap, gri, fgr, "
        "zmap, zycor, cps3, cps, asc, agr, grd, xyz, csv, txt, dat, poi, pol, "
        "vs, pl, vtk, dxf, grdecl, sticks, vts, xml, landxml";
    check(read_surfaces("a.abc"), unknown_format,
          "a.abc: unknown format \".abc\"" + list_of_readable);
    check(read_surfaces("a"), unknown_format,
          "a: the file name has no extension that tells the format" + list_of_readable);
    check(read_surfaces("-"), unknown_format,
          "standard input: the format must be given" + list_of_readable);
    check(parse_surfaces("x", "a.inp", Format::inp), unsupported,
          "a.inp: this format is written, not read" + list_of_readable);
    check(parse_surfaces("", "b/a.off", Format::off), nothing_to_do, "b/a.off: the file is empty");
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

TEST_CASE("files: running out of memory is an error, not an exception", "[io][files]") {
    const auto bad = guard_memory("a.ts", []() -> Status { throw std::bad_alloc(); });
    const auto length = guard_memory("a.ts", []() -> Status { throw std::length_error("x"); });
    for (const auto& status : {bad, length}) {
        CHECK(message_of(status) == "a.ts: there is not enough memory");
        CHECK(code_of(status) == ErrorCode::out_of_memory);
    }
}
