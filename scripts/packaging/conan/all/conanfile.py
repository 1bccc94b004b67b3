# SPDX-License-Identifier: LGPL-3.0-or-later
import os

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get, rmdir

required_conan_version = ">=2.0.9"


class TerraneConan(ConanFile):
    name = "terrane"
    description = "Exact conforming meshes of geological surfaces"
    license = "LGPL-3.0-or-later"
    url = "@URL@"
    homepage = "@HOME@"
    topics = ("geology", "mesh", "geometry", "exact-arithmetic")
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"
    options = {
        "c_interface": [True, False],
        "program": [True, False],
        "shapelib": [True, False],
    }
    default_options = {
        "c_interface": True,
        "program": False,
        "shapelib": False,
    }

    # Found by name, not by a package of CMake: their folders are told to the compiler.
    found_by_name = ("gmp", "mpfr", "nettle", "nanoflann", "shapelib")

    def layout(self):
        cmake_layout(self, src_folder="src")

    def requirements(self):
        self.requires("cgal/5.6.1")
        self.requires("eigen/3.4.0")
        self.requires("fmt/10.2.1")
        self.requires("gmp/6.3.0")
        self.requires("mpfr/4.2.1")
        self.requires("nanoflann/1.5.2")
        self.requires("nettle/3.9.1")
        self.requires("nlohmann_json/3.11.3")
        self.requires("onetbb/2021.10.0")
        self.requires("pugixml/1.14")
        self.requires("zlib/[>=1.2.11 <2]")
        if self.options.program:
            self.requires("cli11/2.4.1")
        if self.options.shapelib:
            self.requires("shapelib/1.6.0")

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25 <4]")

    def validate(self):
        check_min_cppstd(self, 20)
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration(f"{self.ref} is built on Linux only")

    def source(self):
        get(self, **self.conan_data["sources"][self.version], strip_root=True)

    def generate(self):
        tc = CMakeToolchain(self)
        tc.cache_variables["TERRANE_C"] = bool(self.options.c_interface)
        tc.cache_variables["TERRANE_PROGRAM"] = bool(self.options.program)
        tc.cache_variables["TERRANE_SHAPELIB"] = bool(self.options.shapelib)
        tc.cache_variables["TERRANE_GMSH"] = False  # GPL
        tc.cache_variables["TERRANE_LZ4"] = False
        tc.cache_variables["TERRANE_LZMA"] = False
        tc.cache_variables["TERRANE_TETGEN"] = False  # AGPL
        tc.cache_variables["TERRANE_TESTS"] = False
        tc.cache_variables["TERRANE_UNITY"] = True
        tc.cache_variables["TERRANE_WERROR"] = False
        for dependency in self.dependencies.host.values():
            if dependency.ref.name in self.found_by_name:
                info = dependency.cpp_info.aggregated_components()
                tc.extra_cxxflags.extend(f"-I{folder}" for folder in info.includedirs)
                tc.extra_sharedlinkflags.extend(f"-L{folder}" for folder in info.libdirs)
                tc.extra_exelinkflags.extend(f"-L{folder}" for folder in info.libdirs)
        tc.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        for name in ("LICENSE", os.path.join("LICENSES", "GPL-3.0-or-later.txt")):
            copy(self, name, self.source_folder, os.path.join(self.package_folder, "licenses"), keep_path=False)
        CMake(self).install()
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))
        rmdir(self, os.path.join(self.package_folder, "share"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "terrane")
        library = self.cpp_info.components["terrane"]
        library.set_property("cmake_target_name", "terrane::terrane")
        library.libs = ["terrane"]
        library.system_libs = ["m", "pthread"]
        library.requires = ["cgal::cgal", "eigen::eigen", "fmt::fmt", "gmp::gmp", "mpfr::mpfr",
                            "nanoflann::nanoflann", "nettle::nettle", "nlohmann_json::nlohmann_json",
                            "onetbb::onetbb", "pugixml::pugixml", "zlib::zlib"]
        if self.options.shapelib:
            library.requires.append("shapelib::shapelib")
        if self.options.program:
            library.requires.append("cli11::cli11")
        verify = self.cpp_info.components["verify"]
        verify.set_property("cmake_target_name", "terrane::verify")
        verify.libs = ["terrane_verify"]
        verify.requires = ["gmp::gmp", "nettle::nettle", "zlib::zlib"]
        if self.options.c_interface:
            shared = self.cpp_info.components["c"]
            shared.set_property("cmake_target_name", "terrane::c")
            shared.set_property("pkg_config_name", "terrane_c")
            shared.libs = ["terrane_c"]
