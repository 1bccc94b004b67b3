// SPDX-License-Identifier: LGPL-3.0-or-later
//
// The extension module terrane._core: the library's stages with arrays and tuples. The package around it, which is
// what people use, checks arguments and gives results their names.
#include <pybind11/pybind11.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/algorithms/core/run.hpp>

#include "handles.hpp"
#include "surfaces.hpp"

namespace py = pybind11;
using namespace py::literals;

PYBIND11_MODULE(_core, module) {
    using namespace terrane::python;
    module.doc() = "The library's stages. Private: use the package terrane.";
    module.attr("version") = TERRANE_VERSION;
    terrane::throw_on_gmp_out_of_memory(); // else lack of memory in GMP ends the interpreter
    translate_errors();
    module.def("figure", &terrane::figure, py::arg("value"), py::arg("digits") = 6);
    module.def("keep_freed_memory", &terrane::keep_freed_memory);
    py::class_<HowToRun>(module, "HowToRun")
        .def(py::init([](unsigned threads, const py::object& progress) {
                 return HowToRun{threads, progress};
             }),
             "threads"_a, "progress"_a);
    bind_surface(module);
    bind_mesh(module); // classes come before the functions that name them in their signatures
    bind_files(module);
    bind_arrangement(module);
    bind_volumes(module);
    bind_model(module);
    bind_sealing(module);
    bind_improve(module);
    bind_fill(module);
    bind_layers(module);
    bind_selection(module);
    bind_maps(module);
    bind_sections(module);
    bind_cells(module);
    bind_wells(module);
    bind_tetrahedra(module);
    bind_verify(module);
    bind_judge(module);
    bind_project(module);
    bind_ensemble(module);
    bind_report(module);
    py::module_::import("atexit").attr("register")(py::cpp_function(&end_stages));
}
