// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/judge/judge.hpp>

#include <memory>
#include <utility>

#include <terrane/capi/detail/call.hpp>
#include <terrane/capi/detail/handles.hpp>
#include <terrane/capi/verification.h>

namespace terrane::capi::detail {
namespace {

static_assert(TERRANE_PROPERTY_FAILS == int(PropertyVerdict::fails) &&
              TERRANE_PROPERTY_NOT_JUDGED == int(PropertyVerdict::not_judged));

terrane_judge_options default_judging() noexcept {
    const JudgeOptions options;
    return {sizeof(terrane_judge_options), options.spacings, options.most_flaws,
            TERRANE_OPERATION_NONE, 0};
}

JudgeOptions judging_of(const terrane_judge_options* given) {
    const auto c = options_of(given, default_judging());
    JudgeOptions options{.spacings = c.spacings, .most_flaws = c.most_flaws};
    if (c.operation < TERRANE_OPERATION_NONE ||
        c.operation > TERRANE_OPERATION_SYMMETRIC_DIFFERENCE)
        throw BadArgument{"options.operation", "is no operation"};
    if (c.operation != TERRANE_OPERATION_NONE)
        options.operation = static_cast<BooleanOperation>(c.operation - TERRANE_OPERATION_UNION);
    return options;
}

const JudgedProperty* property_at(const terrane_mesh_judgement* judgement,
                                  std::size_t number) noexcept {
    return known(judgement) && number < judgement->judgement.properties.size()
               ? &judgement->judgement.properties[number]
               : nullptr;
}

} // namespace
} // namespace terrane::capi::detail

using namespace terrane::capi::detail;

terrane_code terrane_judge_options_init(terrane_judge_options* options, size_t struct_size) {
    return init_options(options, struct_size, default_judging());
}

terrane_code terrane_judge(const terrane_surfaces* output, const terrane_surfaces* inputs,
                           const terrane_judge_options* options, const terrane_run* run,
                           terrane_mesh_judgement** out, terrane_error** error) {
    return produce(out, error, [&] {
        const auto& made = needed(output, "output").list;
        const auto how = judging_of(options);
        auto found = std::make_unique<terrane_mesh_judgement>();
        found->judgement =
            inputs ? must(terrane::judge(made, needed(inputs, "inputs").list, how, run_of(run)))
                   : must(terrane::judge_soup(made, how, run_of(run)));
        return found;
    });
}

terrane_code terrane_judge_tetrahedra(const double* vertices, size_t vertex_count,
                                      const uint32_t* tetrahedra, size_t tetrahedron_count,
                                      const uint32_t* labels, const terrane_surfaces* inputs,
                                      const terrane_judge_options* options, const terrane_run* run,
                                      terrane_mesh_judgement** out, terrane_error** error) {
    return produce(out, error, [&] {
        need_array(vertices, vertex_count, "vertices");
        need_array(tetrahedra, tetrahedron_count, "tetrahedra");
        terrane::LabelledTetrahedra made{points_of(vertices, vertex_count), {}, {}};
        for (size_t t = 0; t < tetrahedron_count; ++t)
            made.tetrahedra.push_back({tetrahedra[4 * t], tetrahedra[4 * t + 1],
                                       tetrahedra[4 * t + 2], tetrahedra[4 * t + 3]});
        if (labels) made.labels.assign(labels, labels + tetrahedron_count);
        auto found = std::make_unique<terrane_mesh_judgement>();
        found->judgement = must(
            terrane::judge(made, needed(inputs, "inputs").list, judging_of(options), run_of(run)));
        return found;
    });
}

void terrane_mesh_judgement_free(terrane_mesh_judgement* judgement) {
    release(judgement);
}

int terrane_mesh_judgement_holds(const terrane_mesh_judgement* judgement) {
    return known(judgement) && judgement->judgement.holds() && judgement->judgement.complete() ? 1
                                                                                               : 0;
}

size_t terrane_mesh_judgement_count(const terrane_mesh_judgement* judgement) {
    return known(judgement) ? judgement->judgement.properties.size() : 0;
}

terrane_code terrane_mesh_judgement_property(const terrane_mesh_judgement* judgement, size_t number,
                                             terrane_property* property, size_t struct_size) {
    const auto* const p = property_at(judgement, number);
    if (!p) return TERRANE_BAD_ARGUMENT;
    return give_report(terrane_property{p->name.c_str(), p->sentence.c_str(), p->size, p->count,
                                        p->flaws.size(),
                                        static_cast<terrane_property_verdict>(p->verdict), 0},
                       property, struct_size);
}

terrane_code terrane_mesh_judgement_flaw(const terrane_mesh_judgement* judgement, size_t number,
                                         size_t flaw_number, terrane_property_flaw* flaw,
                                         size_t struct_size) {
    const auto* const p = property_at(judgement, number);
    if (!p || flaw_number >= p->flaws.size()) return TERRANE_BAD_ARGUMENT;
    const terrane::PropertyFlaw& f = p->flaws[flaw_number];
    return give_report(terrane_property_flaw{f.sentence.c_str(),
                                             {f.place.x, f.place.y, f.place.z},
                                             f.size,
                                             f.triangles.data(),
                                             f.triangles.size()},
                       flaw, struct_size);
}
