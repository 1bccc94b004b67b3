// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/check/check.hpp>

#include <memory>

#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/capi/surfaces.h>

using namespace terrane::capi::detail;

terrane_code terrane_check(const terrane_surfaces* surfaces, const terrane_run* run,
                           terrane_check_report** out, terrane_error** error) {
    return produce(out, error, [&] {
        auto found = must(terrane::check(needed(surfaces, "surfaces").list, run_of(run)));
        auto report = std::make_unique<terrane_check_report>();
        report->report = std::move(found);
        report->contacts = contacts_of(report->report.contacts);
        return report;
    });
}

void terrane_check_free(terrane_check_report* report) {
    release(report);
}

terrane_code terrane_check_get_summary(const terrane_check_report* report,
                                       terrane_check_summary* summary, size_t struct_size) {
    if (!known(report)) return TERRANE_BAD_ARGUMENT;
    const terrane::CheckReport& r = report->report;
    return give_report(terrane_check_summary{r.surfaces, r.triangles, r.vertices,
                                             r.free_border_edges, r.components, r.clean() ? 1 : 0,
                                             0},
                       summary, struct_size);
}

const terrane_contact* terrane_check_contacts(const terrane_check_report* report, size_t* count) {
    return array_of<terrane_contact>(known(report) ? &report->contacts : nullptr, count);
}

const uint32_t* terrane_check_degenerate(const terrane_check_report* report, size_t* count) {
    return array_of<uint32_t>(known(report) ? &report->report.degenerate : nullptr, count);
}

const uint32_t* terrane_check_repeated(const terrane_check_report* report, size_t* count) {
    return array_of<uint32_t>(known(report) ? &report->report.repeated : nullptr, count);
}

const uint32_t* terrane_check_shared(const terrane_check_report* report, size_t* count) {
    return array_of<uint32_t>(known(report) ? &report->report.shared : nullptr, count);
}

const double* terrane_check_non_manifold_edges(const terrane_check_report* report, size_t* count) {
    return array_of<double>(known(report) ? &report->report.non_manifold_edges : nullptr, count);
}
