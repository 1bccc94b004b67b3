// SPDX-License-Identifier: LGPL-3.0-or-later
#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <locale>
#include <string>
#include <vector>

#include <pthread.h>

#include <terrane/algorithms/verify/verify.hpp>

#include "fixture.hpp"
#include "stage.hpp"

namespace failing {
namespace {

using namespace terrane;

/// The outcome of a call: the result as text, or the error.
std::string outcome(const Stage& stage) {
    const Answer answer = stage.call(-1, Mode::once);
    return answer.error ? "error: " + answer.error->message() : answer.text;
}

struct Call {
    const Stage& stage;
    std::string outcome{};
};

void* make_call(void* call) {
    auto& [stage, made] = *static_cast<Call*>(call);
    made = outcome(stage);
    return nullptr;
}

std::string in_small_thread(const Stage& stage, long stack_kib) {
    Call call{stage};
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, static_cast<std::size_t>(stack_kib) * 1024);
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before); // the thread inherits the mask
    pthread_t thread{};
    const int failed = pthread_create(&thread, &attributes, make_call, &call);
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    pthread_attr_destroy(&attributes);
    if (failed != 0) return "no thread";
    pthread_join(thread, nullptr);
    return call.outcome;
}

/// Numbers as in German: 1.234,5.
class German : public std::numpunct<char> {
protected:
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// A locale with commas, in C++ always, in C where the machine has one.
class Commas {
public:
    Commas() : before_(std::locale::global(std::locale(std::locale(), new German))) {
        std::setlocale(LC_ALL, "de_DE.UTF-8");
    }
    ~Commas() {
        std::locale::global(before_);
        std::setlocale(LC_ALL, "C");
    }
    Commas(const Commas&) = delete;
    Commas& operator=(const Commas&) = delete;

private:
    std::locale before_;
};

/// Makes a German locale of C where this machine can: few have one. Returns whether there is one.
bool make_german() {
    static const test_support::TemporaryFolder folder;
    const auto command =
        "localedef -i de_DE -f UTF-8 '" + (folder / "de_DE.UTF-8").string() + "' >/dev/null 2>&1";
    if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr && std::system(command.c_str()) == 0)
        setenv("LOCPATH", folder.path().c_str(), 1);
    const bool made = std::setlocale(LC_ALL, "de_DE.UTF-8") != nullptr;
    std::setlocale(LC_ALL, "C");
    return made;
}

/// JSON with a key that the reader knows, whose value is nested so deeply.
std::string nested(const std::string& before, std::size_t depth, const std::string& after) {
    return before + std::string(depth, '[') + std::string(depth, ']') + after;
}

std::string xml_nested(std::size_t depth) {
    std::string text = "<VTKFile type=\"PolyData\">";
    for (std::size_t i = 0; i < depth; ++i) text += "<a>";
    for (std::size_t i = 0; i < depth; ++i) text += "</a>";
    return text + "</VTKFile>";
}

std::vector<Stage> nested_texts() {
    constexpr std::size_t depth = 200'000;
    std::vector<Stage> stages;
    const auto project = nested(R"({"format": "terrane-project 1", "surfaces": )", depth, "}");
    stages.push_back(stage(
        "parse_project, nested", [project] { return parse_project(project, "/", "project.json"); },
        [](const Project&) { return std::string("parsed"); }));
    const auto column = nested(R"({"column": )", depth, "}");
    stages.push_back(stage(
        "parse_column, nested", [column] { return parse_column(column, "column.json"); },
        [](const StratigraphicColumn&) { return std::string("parsed"); }));
    const auto certificate =
        nested(R"({"format": "terrane-certificate 1", "inputs": )", depth, "}");
    stages.push_back(stage(
        "parse_certificate, nested",
        [certificate] { return parse_certificate(certificate, "certificate.json"); },
        [](const Certificate&) { return std::string("parsed"); }));
    const auto xml = xml_nested(depth);
    stages.push_back(stage(
        "parse_surfaces, nested", [xml] { return parse_surfaces(xml, "nested.vtp", Format::vtp); },
        [](const std::vector<Surface>& surfaces) { return text_of(surfaces); }));
    return stages;
}

} // namespace

std::vector<Stage> large_stages() {
    std::vector<Surface> surfaces{waves(50, 1, false), waves(50, 1.3, true)};
    surfaces.push_back({"fault",
                        Role::fault,
                        {{20.1, -1, -3}, {20.2, 51, -3}, {25.3, 51, 4}, {25.1, -1, 4}},
                        {{0, 1, 2}, {0, 2, 3}}});
    const auto box = needed(box_boundary({0.5, 0.5, -2}, {49.5, 49.5, 3}));
    const auto arranged = needed(arrange_within(surfaces, box));
    auto stages = nested_texts();
    stages.push_back(stage_of(
        "arrange_within, large", [surfaces, box] { return std::pair(surfaces, box); },
        [](std::pair<std::vector<Surface>, std::vector<Surface>> given) {
            return arrange_within(std::move(given.first), std::move(given.second));
        },
        [](const Arranged& made) { return text_of(*made.rounded.mesh); }));
    stages.push_back(stage(
        "find_volumes, large", [arranged] { return find_volumes(arranged.exact); },
        [](const Volumes& volumes) { return std::to_string(volumes.measures.size()); }));
    const auto mesh = arranged.rounded.conforming.value();
    stages.push_back(stage(
        "make_model, large", [arranged, mesh] { return make_model(arranged.exact, mesh); },
        [](const Model& model) { return text_of(*model.mesh); }));
    stages.push_back(stage(
        "improve, large", [mesh] { return improve(mesh, {.edge_length = 3, .passes = 1}); },
        [](const Improved& made) { return text_of(*made.mesh); }));
    stages.push_back(stage(
        "fill_surfaces, large",
        [surfaces] {
            const std::vector<FillTask> tasks{FillTask{SurfaceId(1), {}}};
            return fill_surfaces(surfaces, tasks);
        },
        [](const FillWork& work) { return text_of({work.surfaces[0].filled}); }));
    return stages;
}

int call_unusually(const std::vector<Stage>& stages, long stack_kib) {
    static const bool german = make_german();
    if (!german) std::printf("there is no German locale of C: only C++ has decimal commas\n");
    int flaws = 0;
    for (const Stage& stage : stages) {
        std::printf("%s\n", stage.name.c_str()); // the last one is the one that overflows the stack
        std::fflush(stdout);
        const std::string usual = outcome(stage);
        if (in_small_thread(stage, stack_kib) != usual) {
            std::printf("%s: another result in a thread of its own\n", stage.name.c_str());
            ++flaws;
        }
        const Commas commas;
        if (outcome(stage) != usual) {
            std::printf("%s: another result with decimal commas\n", stage.name.c_str());
            ++flaws;
        }
    }
    return flaws;
}

} // namespace failing
