// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Report pages of results, as the program writes them with --report.
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/page/page.hpp>
#include <terrane/io/text/units.hpp>

#include "handles.hpp"
#include "model_handle.hpp"
#include "surfaces.hpp"
#include "tetrahedra_handle.hpp"
#include "work_handle.hpp"

namespace terrane::python {

using namespace py::literals;

namespace {

using Surfaces = std::shared_ptr<const std::vector<Surface>>;

/// A page to write: what is known of it, its place, and the surfaces that it is about.
struct Request {
    page::PageFacts facts;
    std::filesystem::path path;
    Surfaces surfaces;
    unsigned threads = 1;
};

/// facts: (command, title, ((option, value), ...)).
Request to_request(const py::tuple& facts, const py::object& path, const py::sequence& surfaces,
                   const HowToRun& how) {
    Request request;
    request.path = to_path(path);
    must(page::check_pages(), request.path.string());
    request.facts.command = from_text(facts[0]);
    request.facts.title = from_text(facts[1]);
    for (const py::handle item : facts[2].cast<py::sequence>()) {
        const auto pair = item.cast<py::tuple>();
        request.facts.options.emplace_back(from_text(pair[0]), from_text(pair[1]));
    }
    request.surfaces = std::make_shared<const std::vector<Surface>>(to_surfaces(surfaces));
    request.facts.unit = detail::common_unit(*request.surfaces);
    request.threads = how.threads;
    return request;
}

void write_page(page::Page& page, const Request& request) {
    const page::Json run{
        {"seconds", page::Json::object()}, {"peak_rss_mb", nullptr}, {"threads", request.threads}};
    must(write_file(request.path, must(page.html(page::Json::object(), run))));
}

void add_model(page::Page& page, const ModelHandle& m, const Request& request, const Run& run) {
    must(page.add_holes(*request.surfaces, run));
    const SharedMesh mesh = m.model.mesh.mesh();
    const SharedMesh before = m.rounded ? m.rounded->mesh() : mesh;
    if (m.rounding) page.add_rounded(before, *m.rounding);
    page.add_mended(m.sealed, m.merged);
    if (&*mesh != &*before) page.add_improved(mesh, before);
    page.add_model(m.model, m.leaks);
}

void report_model(const ModelPointer& model, const std::optional<TetrahedraPointer>& tetrahedra,
                  const py::sequence& surfaces, const py::object& path, const py::tuple& facts,
                  const HowToRun& how) {
    run_stage(
        how, [model, tetrahedra, request = to_request(facts, path, surfaces, how)](const Run& run) {
            page::Page page(request.facts);
            add_model(page, *model, request, run);
            if (tetrahedra) page.add_tetrahedra(**tetrahedra);
            return write_page(page, request);
        });
}

void report_arrangement(const ArrangementPointer& arrangement, const py::sequence& surfaces,
                        const py::object& path, const py::tuple& facts, const HowToRun& how) {
    run_stage(how, [arrangement, request = to_request(facts, path, surfaces, how)](const Run& run) {
        const auto rounded = must(round_to_doubles(*arrangement, {}, run));
        page::Page page(request.facts);
        page.add_rounded(rounded.mesh, rounded.report);
        return write_page(page, request);
    });
}

void report_filled(const WorkPointer& work, const py::sequence& surfaces, const py::object& path,
                   const py::tuple& facts, const HowToRun& how) {
    run_stage(how, [work, request = to_request(facts, path, surfaces, how)](const Run&) {
        bool whole = true;
        for (const NumberedHole& hole : work->holes)
            whole = whole && (hole.report || hole.refused.empty());
        page::Page page(request.facts);
        page.add_filled(*work);
        page.set_verdict(page::filling_verdict(whole), whole);
        return write_page(page, request);
    });
}

} // namespace

void bind_report(py::module_& module) {
    module.def("has_reports", [] { return static_cast<bool>(page::check_pages()); });
    module.def("report_model", &report_model, "model"_a, "tetrahedra"_a, "surfaces"_a, "path"_a,
               "facts"_a, "how"_a);
    module.def("report_arrangement", &report_arrangement, "arrangement"_a, "surfaces"_a, "path"_a,
               "facts"_a, "how"_a);
    module.def("report_filled", &report_filled, "work"_a, "surfaces"_a, "path"_a, "facts"_a,
               "how"_a);
}

} // namespace terrane::python
