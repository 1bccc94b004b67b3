// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Checks cases with known results, each in a folder: input files, and expected.json.
//   certified check FOLDER          checks all cases in FOLDER; 0 if all are as expected
//   certified record FOLDER/CASE    writes expected.json, if the verifier accepts the certificate
// In every case the certificate must be valid, and neither the order of the files nor the search
// method may change the digest.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/arrangement/arrangement.hpp>
#include <terrane/algorithms/rounding/rounding.hpp>
#include <terrane/algorithms/verify/verify.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/certificate.hpp>
#include <terrane/io/files.hpp>

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using namespace terrane;

namespace {

/// The message about a case that can't be run at all.
struct Failure {
    std::string message;
};

template <class T>
T taken(Result<T> result) {
    if (!result) throw Failure{result.error().message()};
    return std::move(result).value();
}

struct Inputs {
    std::vector<InputRecord> records;
    std::vector<InputFile> files;
    std::vector<Surface> surfaces; ///< of all files
};

Inputs read_inputs(const std::vector<fs::path>& paths) {
    Inputs inputs;
    for (const fs::path& path : paths) {
        auto surfaces = taken(read_surfaces(path));
        inputs.records.push_back(
            taken(record_input(path, path.filename().string(), surfaces.size())));
        inputs.surfaces.insert(inputs.surfaces.end(), surfaces.begin(), surfaces.end());
        inputs.files.push_back(input_file(taken(read_file(path)), std::move(surfaces)));
    }
    return inputs;
}

/// Returns the input files of a case, by name.
std::vector<fs::path> files_of(const fs::path& folder) {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename() != "expected.json") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

void require_valid(const Inputs& inputs, const Arrangement& exact, const RoundedMesh& rounded) {
    const auto text = to_certificate({inputs.records, inputs.surfaces, exact, &rounded});
    const auto certificate = taken(parse_certificate(text, "certificate"));
    const auto violations = verify_certificate(inputs.files, certificate).violations;
    if (violations.empty()) return;
    throw Failure{"refuted: " + name_of(violations[0].rule) + ": " + violations[0].sentence};
}

void require_same_digest(std::vector<fs::path> paths, const std::string& digest) {
    std::reverse(paths.begin(), paths.end());
    auto inputs = read_inputs(paths);
    std::reverse(inputs.surfaces.begin(), inputs.surfaces.end());
    const auto exact = taken(arrange(inputs.surfaces, {.search = Search::brute}));
    if (canonical_digest(inputs.surfaces, exact) != digest)
        throw Failure{"the digest depends on the order of surfaces or on the search"};
}

/// Returns the results in the form of expected.json; throws a Failure if the certificate is not
/// valid.
Json outcome(const fs::path& folder) {
    const auto paths = files_of(folder);
    const Inputs inputs = read_inputs(paths);
    const auto exact = taken(arrange(inputs.surfaces));
    const auto rounded = taken(round_to_doubles(exact));
    require_valid(inputs, exact, rounded);
    const std::string digest = canonical_digest(inputs.surfaces, exact);
    require_same_digest(paths, digest);
    const Mesh& mesh = rounded.mesh;
    return {{"digest", digest},
            {"exact",
             {{"vertices", exact.vertices.size()},
              {"triangles", exact.triangles.size()},
              {"intersection_edges", exact.intersection_edges.size()},
              {"degenerate", exact.degenerate.size()},
              {"duplicates", exact.inputs.duplicates.size()}}},
            {"rounded",
             {{"clean", rounded.report.clean},
              {"rounds", rounded.report.rounds},
              {"vertices", mesh.vertices.size()},
              {"triangles", mesh.triangles.size()},
              {"intersection_edges", mesh.intersection_edges.size()},
              {"regions", rounded.regions.size()},
              {"vanished", rounded.report.vanished.size()}}}};
}

/// Describes a difference from the expected results, or a failure; empty if there is none.
std::string flaw(const fs::path& folder) {
    try {
        const auto expected = Json::parse(taken(read_file(folder / "expected.json")));
        const Json found = outcome(folder);
        return found == expected ? "" : "not as expected: " + Json::diff(expected, found).dump();
    } catch (const Failure& failure) {
        return failure.message;
    } catch (const Json::exception& broken) {
        return broken.what();
    }
}

int check(const fs::path& folder) {
    std::vector<fs::path> cases;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_directory()) cases.push_back(entry.path());
    std::sort(cases.begin(), cases.end());
    std::size_t flawed = 0;
    for (const fs::path& path : cases) {
        const std::string what = flaw(path);
        if (what.empty()) continue;
        std::printf("%s: %s\n", path.filename().c_str(), what.c_str());
        ++flawed;
    }
    std::printf("%zu cases, %zu as expected\n", cases.size(), cases.size() - flawed);
    return flawed == 0 && !cases.empty() ? 0 : 1;
}

int record(const fs::path& folder) {
    try {
        const Json found = outcome(folder);
        (void)taken(write_file(folder / "expected.json", found.dump(2) + "\n"));
        std::printf("%s: %s\n", folder.c_str(), found["rounded"].dump().c_str());
        return 0;
    } catch (const Failure& failure) {
        std::printf("%s: %s\n", folder.c_str(), failure.message.c_str());
        return 1;
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::string_view command = argc == 3 ? argv[1] : "";
    if (command == "check") return check(argv[2]);
    if (command == "record") return record(argv[2]);
    std::puts("usage: certified check FOLDER | record FOLDER/CASE");
    return 2;
}
