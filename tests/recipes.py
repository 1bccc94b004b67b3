#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-3.0-or-later
"""Checks the recipes for conda-forge, vcpkg and Conan without their networks.

They are filled for an archive with hashes, parsed, and run as far as they are programs, with functions and classes of
vcpkg and Conan that only record what they are asked for. Their dependencies are those that CMake looks for, and the
options that they set are options of CMakeLists.txt.
"""
import argparse
import hashlib
import importlib.util
import json
import os
import re
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "scripts/packaging"))
import fill  # noqa: E402

# What CMake, or a header, looks for: its name for conda-forge, vcpkg and Conan.
DEPENDENCIES = {
    "CGAL": ("cgal-cpp", "cgal", "cgal"), "TBB": ("tbb-devel", "tbb", "onetbb"), "Eigen3": ("eigen", "eigen3", "eigen"),
    "fmt": ("fmt", "fmt", "fmt"), "nlohmann_json": ("nlohmann_json", "nlohmann-json", "nlohmann_json"),
    "pugixml": ("pugixml", "pugixml", "pugixml"), "ZLIB": ("zlib", "zlib", "zlib"), "CLI11": ("cli11", "cli11", "cli11"),
    "nettle": ("nettle", "nettle", "nettle"), "shp": ("shapelib", "shapelib", "shapelib"), "gmp": ("gmp", "gmp", "gmp"),
    "mpfr": ("mpfr", "mpfr", "mpfr"), "nanoflann": ("nanoflann", "nanoflann", "nanoflann"),
}
LEFT_OUT = {"Threads", "TetGen", "gmsh", "MPI"}  # part of the system; AGPL; GPL; chosen by sites
CMAKE = (ROOT / "CMakeLists.txt").read_text() + (ROOT / "cli/CMakeLists.txt").read_text()
OPTIONS = set(re.findall(r"^option\((TERRANE_\w+)", CMAKE, re.M)) | {"BUILD_SHARED_LIBS"}


class Filled(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.out = Path(cls.folder.name)
        archive = cls.out / "terrane.tar.gz"
        archive.write_bytes(b"the sources")
        cls.sha512 = hashlib.sha512(b"the sources").hexdigest()
        cls.values = fill.values_of(argparse.Namespace(
            archive=archive, url="https://host.invalid/terrane.tar.gz", home="https://host.invalid", maintainer="somebody"))
        fill.fill(cls.values, cls.out)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def names_of(self, column):
        return {names[column] for names in DEPENDENCIES.values()}

    def check_options(self, text):
        used = set(re.findall(r"(?:-D|\b)(TERRANE_[A-Z]+|BUILD_SHARED_LIBS)\b", text))
        self.assertGreater(len(used), 3)
        self.assertEqual(used - OPTIONS, set())
        self.assertLessEqual({"TERRANE_TETGEN", "TERRANE_GMSH", "TERRANE_TESTS"}, used)


class Dependencies(unittest.TestCase):
    def test_are_those_that_cmake_looks_for(self):
        found = set(re.findall(r"find_package\((\w+)", CMAKE))
        found |= set(re.findall(r"find_library\(\w+ (\w+)", CMAKE))
        linked = re.search(r"target_link_libraries\(terrane PUBLIC(.*?)\)\n", CMAKE, re.S)[1]
        found |= {name for name in ("gmp", "mpfr") if re.search(rf"\b{name}\b", linked)}
        included = subprocess.run(["grep", "-rlE", "include <nanoflann", str(ROOT / "algorithms")], check=False,
                                  capture_output=True, text=True).stdout
        found |= {"nanoflann"} if included else set()
        self.assertEqual(found - LEFT_OUT, set(DEPENDENCIES))


class Conda(Filled):
    def test_recipe(self):
        text = (self.out / "conda/meta.yaml").read_text()
        variables = dict(re.findall(r'{% set (\w+) = "([^"]*)" %}', text))
        self.assertEqual(variables, {"name": "terrane", "version": self.values["VERSION"]})
        text = re.sub(r"{%.*?%}", "", text)
        text = re.sub(r'{{ (?:compiler|stdlib)\("(\w+)"\) }}', r"compiler_\1", text)
        text = re.sub(r"{{ pin_subpackage\(.*?\) }}", "terrane", text)
        text = re.sub(r"{{ (\w+) }}", lambda m: variables[m[1]], text)
        self.assertNotIn("{{", text)
        recipe = yaml.safe_load(text)
        self.assertEqual(list(recipe), ["package", "source", "build", "requirements", "test", "about", "extra"])
        self.assertEqual(recipe["package"], {"name": "terrane", "version": self.values["VERSION"]})
        self.assertEqual(recipe["source"]["sha256"], self.values["SHA256"])
        host = {line.split()[0] for line in recipe["requirements"]["host"]}
        self.assertEqual(host - {"libboost-headers"}, self.names_of(0))  # CGAL's headers include Boost's
        self.assertEqual(recipe["requirements"]["host"], sorted(recipe["requirements"]["host"]))
        for file in recipe["about"]["license_file"]:
            self.assertTrue((ROOT / file).exists(), file)
        for file in recipe["test"]["files"]:
            self.assertTrue((self.out / "conda" / file).exists(), file)
        self.assertEqual(recipe["about"]["license"], "LGPL-3.0-or-later")

    def test_script(self):
        script = self.out / "conda/build.sh"
        subprocess.run(["bash", "-n", script], check=True)
        self.check_options(script.read_text())


# Functions of vcpkg that record how they are called; each knows the keywords that vcpkg documents.
VCPKG = """
cmake_minimum_required(VERSION 3.25)
function(vcpkg_download_distfile out)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "FILENAME;SHA512" "URLS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "unknown: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  message(STATUS "download ${arg_URLS} ${arg_FILENAME} ${arg_SHA512}")
  set(${out} /archive PARENT_SCOPE)
endfunction()
function(vcpkg_extract_source_archive out)
  set(${out} ${SOURCES} PARENT_SCOPE)
endfunction()
function(vcpkg_check_features)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_FEATURE_OPTIONS" "FEATURES;INVERTED_FEATURES")
  set(options)
  while(arg_FEATURES)
    list(POP_FRONT arg_FEATURES feature option)
    if(feature IN_LIST FEATURES)
      list(APPEND options -D${option}=ON)
    else()
      list(APPEND options -D${option}=OFF)
    endif()
  endwhile()
  set(${arg_OUT_FEATURE_OPTIONS} ${options} PARENT_SCOPE)
endfunction()
function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS;OPTIONS_DEBUG;OPTIONS_RELEASE")
  if(arg_UNPARSED_ARGUMENTS OR NOT EXISTS ${arg_SOURCE_PATH}/CMakeLists.txt)
    message(FATAL_ERROR "wrong: ${ARGV}")
  endif()
  message(STATUS "configure ${arg_OPTIONS}")
endfunction()
foreach(name cmake_install cmake_config_fixup fixup_pkgconfig copy_tools)
  cmake_language(EVAL CODE "function(vcpkg_${name})\\n message(STATUS \\"${name} \\${ARGV}\\")\\n endfunction()")
endforeach()
function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "COMMENT" "FILE_LIST")
  foreach(file IN LISTS arg_FILE_LIST)
    if(NOT EXISTS ${file})
      message(FATAL_ERROR "there is no ${file}")
    endif()
  endforeach()
endfunction()
"""


class Vcpkg(Filled):
    def run_port(self, features):
        port = self.out / "vcpkg/terrane"
        mock = self.out / "mock.cmake"
        mock.write_text(VCPKG + f'include("{port}/portfile.cmake")\n')
        done = subprocess.run(
            ["cmake", f"-DSOURCES={ROOT}", f"-DVERSION={self.values['VERSION']}", f"-DFEATURES={';'.join(features)}",
             f"-DCURRENT_PACKAGES_DIR={self.out}/packages", "-DPORT=terrane", "-P", mock],
            capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_manifest(self):
        text = (self.out / "vcpkg/terrane/vcpkg.json").read_text()
        manifest = json.loads(text)
        self.assertEqual(text, json.dumps(manifest, indent=2) + "\n")  # as vcpkg format-manifest leaves it
        self.assertRegex(manifest["version"], r"^\d+\.\d+\.\d+$")
        names = [d if isinstance(d, str) else d["name"] for d in manifest["dependencies"]]
        self.assertEqual(names, sorted(names))
        for feature in manifest["features"].values():
            names += feature.get("dependencies", [])
        self.assertEqual(set(names) - {"vcpkg-cmake", "vcpkg-cmake-config"}, self.names_of(1))
        self.assertLessEqual(set(manifest["default-features"]), set(manifest["features"]))

    def test_port(self):
        said = self.run_port(["core", "c", "tools"])
        self.assertIn(self.sha512, said)
        self.assertIn("-DTERRANE_C=ON;-DTERRANE_SHAPELIB=OFF;-DTERRANE_PROGRAM=ON", said)
        self.assertIn("copy_tools TOOL_NAMES;terrane", said)
        self.assertNotIn("copy_tools", self.run_port(["core"]))
        self.check_options(said)
        features = set(json.loads((self.out / "vcpkg/terrane/vcpkg.json").read_text())["features"])
        port = (self.out / "vcpkg/terrane/portfile.cmake").read_text()
        listed = re.search(r"FEATURES\n(.*?)\n\)", port, re.S)[1].split()
        self.assertEqual(set(listed[::2]), features)


def conan_modules(record):
    """Modules of Conan whose classes and functions only record what they are asked for."""
    class Recipe:
        def requires(self, reference):
            record["requires"].append(reference)

        def tool_requires(self, reference):
            record["tools"].append(reference)

    class Toolchain:
        def __init__(self, recipe):
            self.cache_variables = record["variables"]
            self.extra_cxxflags, self.extra_sharedlinkflags, self.extra_exelinkflags = [], [], []

        def generate(self):
            record["flags"] = self.extra_cxxflags

    class Component:
        def __init__(self):
            self.libs, self.requires, self.system_libs, self.properties = [], [], [], {}

        def set_property(self, name, value):
            self.properties[name] = value

    class Parts(dict):
        def __missing__(self, name):
            return self.setdefault(name, Component())

    def nothing(*_, **__):
        return types.SimpleNamespace(generate=lambda: None)

    modules = {
        "conan": {"ConanFile": Recipe},
        "conan.errors": {"ConanInvalidConfiguration": type("ConanInvalidConfiguration", (Exception,), {})},
        "conan.tools": {},
        "conan.tools.build": {"check_min_cppstd": nothing, "can_run": nothing},
        "conan.tools.cmake": {"CMake": nothing, "CMakeDeps": nothing, "CMakeToolchain": Toolchain,
                              "cmake_layout": nothing},
        "conan.tools.files": {"copy": nothing, "get": nothing, "rmdir": nothing},
    }
    for name, members in modules.items():
        module = types.ModuleType(name)
        module.__dict__.update(members)
        sys.modules[name] = module
    return Component, Parts


class Conan(Filled):
    def load(self, options):
        record = {"requires": [], "tools": [], "variables": {}, "flags": []}
        component, parts = conan_modules(record)
        path = self.out / "conan/all/conanfile.py"
        spec = importlib.util.spec_from_file_location("conanfile", path)
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        recipe = module.TerraneConan()
        recipe.options = types.SimpleNamespace(**options)
        recipe.settings = types.SimpleNamespace(os="Linux")
        recipe.version, recipe.ref = self.values["VERSION"], "terrane"
        recipe.cpp_info = component()
        recipe.cpp_info.components = parts()
        folders = types.SimpleNamespace(includedirs=["/gmp/include"], libdirs=["/gmp/lib"])
        found = types.SimpleNamespace(ref=types.SimpleNamespace(name="gmp"),
                                      cpp_info=types.SimpleNamespace(aggregated_components=lambda: folders))
        recipe.dependencies = types.SimpleNamespace(host={"gmp": found})
        for step in ("requirements", "build_requirements", "validate", "generate", "package_info"):
            getattr(recipe, step)()
        return recipe, record

    def test_recipe(self):
        recipe, record = self.load({"c_interface": True, "program": True, "shapelib": True})
        names = {reference.split("/")[0] for reference in record["requires"]}
        self.assertEqual(names, self.names_of(2))
        self.assertEqual(set(record["variables"]) - OPTIONS, set())
        self.assertIn("-I/gmp/include", record["flags"])
        parts = recipe.cpp_info.components
        self.assertEqual(set(parts), {"terrane", "verify", "c"})
        self.assertEqual({r.split("::")[0] for p in parts.values() for r in p.requires}, names)
        self.check_options("".join(record["variables"]).replace("TERRANE", " TERRANE"))
        self.assertEqual(set(recipe.options.__dict__), set(recipe.default_options))

    def test_without_options(self):
        recipe, record = self.load({"c_interface": False, "program": False, "shapelib": False})
        self.assertNotIn("c", recipe.cpp_info.components)
        self.assertFalse(record["variables"]["TERRANE_C"])
        self.assertNotIn("cli11", "".join(record["requires"]))

    def test_data(self):
        data = yaml.safe_load((self.out / "conan/all/conandata.yml").read_text())
        self.assertEqual(data["sources"][self.values["VERSION"]]["sha256"], self.values["SHA256"])
        config = yaml.safe_load((self.out / "conan/config.yml").read_text())
        self.assertEqual(config["versions"], {self.values["VERSION"]: {"folder": "all"}})


class Packages(unittest.TestCase):
    """No package is made that names nobody who answers for it."""

    def made(self, cached, given=None):
        """Run the script where the build tree says no more than this; return what it complains about."""
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "scripts").mkdir()
            (folder / "build").mkdir()
            script = folder / "scripts/packages.sh"
            script.write_text((ROOT / "scripts/packages.sh").read_text())
            (folder / "build/CMakeCache.txt").write_text(f"CMAKE_INSTALL_PREFIX:PATH=/usr\nTERRANE_MAINTAINER:STRING={cached}\n")
            environment = {k: v for k, v in os.environ.items() if k != "TERRANE_MAINTAINER"}
            if given is not None:
                environment["TERRANE_MAINTAINER"] = given
            done = subprocess.run(["bash", script, *(["build"] if given is None else [])], capture_output=True, text=True,
                                  env=environment)
            self.assertNotEqual(done.returncode, 0)  # there is nothing to pack
            return done.stderr

    NOBODY = ("", "Somebody", "somebody@example.org", "Somebody <somebody>", "<somebody@example.org>",
              "Terrane maintainers <maintainers@terrane.invalid>")
    SOMEBODY = "Somebody Else <somebody@example.org>"

    def test_script(self):
        refused = 'TERRANE_MAINTAINER="NAME <ADDRESS>" must name who answers for the packages'
        for contact in self.NOBODY:
            self.assertIn(refused, self.made(contact), contact)
            self.assertIn(refused, self.made("", contact), contact)
        self.assertNotIn(refused, self.made(self.SOMEBODY))
        self.assertNotIn(refused, self.made("", self.SOMEBODY))

    def test_cpack(self):
        for contact, generator, good in [(c, "DEB", False) for c in self.NOBODY[:-1]] + [(self.SOMEBODY, "DEB", True), ("", "TGZ", True)]:
            done = subprocess.run(["cmake", f"-DCPACK_PACKAGE_CONTACT={contact}", f"-DCPACK_GENERATOR={generator}", "-P",
                                   ROOT / "scripts/cmake/maintainer.cmake"], capture_output=True, text=True)
            self.assertEqual((done.returncode == 0, "TERRANE_MAINTAINER" in done.stderr), (good, not good), contact)

    def test_nobody_is_made_up(self):
        self.assertIn('set(TERRANE_MAINTAINER "" CACHE', (ROOT / "scripts/cmake/packages.cmake").read_text())


if __name__ == "__main__":
    unittest.main()
