// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests that the floating-point environment of a caller changes no bit of any result, and that it
// is given back: a host program may round upward, flush denormals to zero, or have other threads
// that do.
#include <catch2/catch.hpp>

#include <cfenv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#ifdef __SSE2__
#include <xmmintrin.h>
#endif

#include "support/paths.hpp"
#include "support/shapes.hpp"
#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/check/check.hpp>
#include <terrane/algorithms/layers/layers.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/model/model.hpp>
#include <terrane/algorithms/model/resolution.hpp>
#include <terrane/algorithms/pipeline/build.hpp>
#include <terrane/algorithms/quality/improve.hpp>
#include <terrane/algorithms/reconstruction/holes/holes.hpp>
#include <terrane/algorithms/reconstruction/kriging/fill_kriging.hpp>
#include <terrane/algorithms/reconstruction/rbf/rbf.hpp>
#include <terrane/algorithms/sealing/sealing.hpp>
#include <terrane/algorithms/tetgen/tetrahedra.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/algorithms/volume_of_interest/volume_of_interest.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/exact_text.hpp>
#include <terrane/io/files.hpp>
#include <terrane/io/structure_json.hpp>

using namespace terrane;
using namespace test_support;

namespace {

/// The bytes of files of docs/data one after another, read while nothing is foreign yet.
std::string contents_of(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) {
        std::ifstream file(std::filesystem::path(source_dir()) / "docs/data" / name,
                           std::ios::binary);
        all.append(std::istreambuf_iterator<char>(file), {});
    }
    return all;
}

std::string bits_of(const std::vector<double>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double)};
}

std::string bits_of_points(const std::vector<Point3>& points) {
    std::vector<double> numbers;
    for (const Point3& p : points) numbers.insert(numbers.end(), {p.x, p.y, p.z});
    return bits_of(numbers);
}

std::string bits_of(const Surface& s) {
    std::vector<double> numbers;
    for (const Triangle& t : s.triangles) numbers.insert(numbers.end(), t.begin(), t.end());
    return bits_of_points(s.vertices) + bits_of(numbers);
}

/// The results of all stages, as bytes, by their names.
using Results = std::map<std::string, std::string>;

/// The input of the stages.
struct Subject {
    std::string crossing = contents_of({"top.ts", "base.ts", "fault.ts"});
    Surface dome = punched(sheet(graph([](double x, double y) {
                                     return 50 * std::exp(-(x * x + y * y) / 2e4) + 0.1 * x;
                                 }),
                                 -150, -150, 150, 150, 20, 20, 0.2),
                           disk(20, 10, 45));
    Surface plane = sheet(graph([](double x, double y) { return 0.3 * x - 0.1 * y + 20; }), -150,
                          -150, 150, 150, 7, 7, 0.1);

    [[nodiscard]] Results operator()(unsigned threads) const {
        Results all;
        Run run;
        run.threads = threads;
        add_model(all, run);
        add_fillings(all, run);
        const std::vector<Surface> stack{dome, plane};
        if (const auto layered = stack_layers(
                stack, std::vector<Layer>{{SurfaceId(0), 1}, {SurfaceId(1), 2}}, {}, run))
            all["layers"] = format_mesh(layered->rounded.mesh, Format::obj).value_or("none");
        return all;
    }

private:
    void add_model(Results& all, const Run& run) const {
        const auto read = parse_surfaces(crossing, "a.ts", Format::gocad);
        if (!read) return;
        std::string input;
        for (const Surface& s : *read) input += bits_of(s);
        all["read"] = input;
        const auto found = check(*read, run);
        if (found) all["check"] = std::to_string(found->contacts.size());
        const auto exact = arrange(*read, {}, run);
        if (!exact) return;
        all["arrange"] = canonical_digest(*read, *exact, run);
        const auto rounded = round_to_doubles(*exact, {}, run);
        if (!rounded || !rounded->conforming) return;
        all["rounded"] = format_mesh(rounded->mesh, Format::vtp).value_or("none");
        all["rounding"] = bits_of({rounded->report.max_move, rounded->report.deviation});
        add_verdict(all, *read, *exact, *rounded);
        const auto model = make_model(*exact, *rounded->conforming, run);
        if (model) {
            StructureExtras extras;
            extras.exact_volumes = model->exact_volumes;
            extras.free_borders = model->borders;
            all["model"] = to_json(model->mesh, model->structure, extras);
        }
        ImproveOptions options;
        options.edge_length = 200;
        const auto improved = improve_and_measure(*rounded->conforming, options, run);
        if (!improved) return;
        all["improve"] = format_mesh(improved->improved.mesh, Format::ply).value_or("none");
        std::vector<double> measured = improved->bounds_back;
        for (const Deviation& d : improved->deviations)
            measured.insert(measured.end(), {d.out, d.back});
        measured.push_back(improved->improved.report.after.q.mean);
        all["measured"] = bits_of(measured);
        add_box(all, *read, run);
        const auto sealed = seal(*read, {.distance = 20}, run);
        if (sealed) all["seal"] = canonical_digest(sealed->surfaces, sealed->arrangement, run);
    }

    /// The verdict about a certificate and about a file that it names.
    void add_verdict(Results& all, const std::vector<Surface>& surfaces, const Arrangement& exact,
                     const RoundedMesh& rounded) const {
        const InputFile file = input_file(crossing, surfaces);
        const std::vector<InputRecord> inputs{{"a.ts", file.sha256, file.bytes, surfaces.size()}};
        const auto written = format_mesh(rounded.mesh, Format::obj);
        if (!written) return;
        std::vector<SurfaceInfo> infos;
        for (const Surface& s : surfaces) infos.push_back({s.name, s.role});
        const std::vector<OutputRecord> outputs{record_output(*written, "a.obj", "obj", infos)};
        const auto text = to_certificate({inputs, surfaces, exact, &rounded, outputs});
        const auto certificate = parse_certificate(text, "a.json");
        all["certificate"] = text + (certificate ? "" : certificate.error().message());
        if (!certificate) return;
        const Verdict verdict = verify_certificate(std::vector{file}, *certificate);
        const OutputVerdict output = verify_output(*written, *certificate, 0);
        std::string sentences;
        for (const Violation& v : verdict.violations) sentences += v.sentence;
        for (const Violation& v : output.violations) sentences += v.sentence;
        if (verdict.measured)
            all["verdict"] =
                sentences + bits_of({verdict.measured->deviation, verdict.measured->max_deviation,
                                     default_max_deviation(surfaces)});
        const auto alone = verify_rounded(surfaces, certificate->exact, *certificate->rounded);
        all["verifier's parts"] =
            std::to_string(verify_arrangement(surfaces, certificate->exact).size()) + ' ' +
            std::to_string(
                verify_conforming(rounded.mesh->vertices, rounded.mesh->triangles).size()) +
            (alone.measured ? bits_of({alone.measured->deviation}) : "none");
    }

    /// A rotated box, the model in it, that at a resolution, and its tetrahedra.
    static void add_box(Results& all, const std::vector<Surface>& surfaces, const Run& run) {
        const auto box = rotated_box_boundary(
            {.place = {1000, 750, -1200}, .lengths = {300.1, 250.7, 200.3}, .azimuth = 33.3});
        if (!box) return;
        for (const Surface& side : *box) all["box"] += bits_of(side);
        auto arranged = arrange_within(surfaces, *box, {}, run);
        if (!arranged || !arranged->rounded.conforming) return;
        TetrahedraOptions wanted; // as few as possible
        if (const auto made = tetrahedralize(arranged->rounded.mesh, wanted, run))
            all["tetrahedra"] = bits_of_points(made->vertices) +
                                std::string(reinterpret_cast<const char*>(made->tetrahedra.data()),
                                            made->tetrahedra.size() * sizeof(made->tetrahedra[0]));
        ImproveOptions improvement;
        improvement.edge_length = 151;
        if (!simplify_to({.length = 40.1}, improvement, {}, *arranged, run)) return;
        all["resolution"] = format_mesh(arranged->rounded.mesh, Format::ply).value_or("none") +
                            bits_of({improvement.max_deviation});
    }

    void add_fillings(Results& all, const Run& run) const {
        const auto loops = find_border_loops(dome, run);
        if (!loops) return;
        for (const BorderLoop& loop : *loops) {
            if (loop.kind != LoopKind::hole) continue;
            if (const auto kriged = fill_by_kriging(dome, loop, {}, run))
                all["kriging"] += bits_of(kriged->surface) + bits_of(kriged->expected_error);
            if (const auto filled = fill_by_rbf(dome, loop, {}, run))
                all["rbf"] += bits_of(filled->surface) + bits_of(filled->expected_error);
        }
    }
};

/// Sets a rounding mode, and on request that denormals are zero, while it lives.
class Foreign {
public:
    Foreign(int mode, bool flushes) {
        std::fegetenv(&before_);
        std::fesetround(mode);
#ifdef __SSE2__
        if (flushes) _mm_setcsr(_mm_getcsr() | 0x8040U);
#endif
    }
    ~Foreign() {
        std::fesetenv(&before_);
    }
    Foreign(const Foreign&) = delete;
    Foreign& operator=(const Foreign&) = delete;

private:
    std::fenv_t before_{};
};

unsigned control_word() {
#ifdef __SSE2__
    return _mm_getcsr() & 0xFFC0U; // without the flags of exceptions
#else
    return static_cast<unsigned>(std::fegetround());
#endif
}

} // namespace

TEST_CASE("foreign arithmetic: a caller's rounding mode changes no bit, and is given back",
          "[environment][once]") {
    const Subject subject;
    const Results expected = subject(1);
    for (const char* stage : {"read", "check", "arrange", "rounded", "model", "improve", "measured",
                              "seal", "kriging", "rbf", "layers", "box", "tetrahedra", "resolution",
                              "certificate", "verdict", "verifier's parts"}) {
        INFO(stage);
        REQUIRE(expected.contains(stage));
    }
    for (const unsigned threads : {1U, 2U})
        for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO, FE_TONEAREST}) {
            Results results;
            unsigned before = 0, after = 0;
            {
                const Foreign foreign(mode, mode == FE_TONEAREST);
                before = control_word();
                results = subject(threads);
                after = control_word();
            }
            INFO("mode " << mode << ", " << threads << " threads");
            CHECK(before == after);
            for (const auto& [stage, bytes] : expected) {
                INFO(stage);
                CHECK((results[stage] == bytes)); // too long to print
            }
        }
}
