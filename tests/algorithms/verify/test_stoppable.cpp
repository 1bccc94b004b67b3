// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/stoppable.hpp>

#include <catch2/catch.hpp>

#include <functional>
#include <string>
#include <vector>

#include "support/claim.hpp"
#include "support/forged.hpp"

using namespace terrane;

namespace {

/// Two grids of n x n cells that cross.
std::vector<forged::File> crossing_grids(unsigned n) {
    std::vector<forged::File> files;
    for (const double slope : {0.013, -0.017}) {
        std::string text;
        for (unsigned j = 0; j <= n; ++j)
            for (unsigned i = 0; i <= n; ++i)
                text += "v " + std::to_string(i) + " " + std::to_string(j) + " " +
                        std::to_string(slope * (i + 0.3 * j - 0.61 * n) + 0.01 * (i * j % 5)) +
                        "\n";
        for (unsigned j = 0; j < n; ++j)
            for (unsigned i = 0; i < n; ++i) {
                const unsigned a = j * (n + 1) + i + 1;
                for (const unsigned c : {a + n + 2, a + n + 1}) {
                    const unsigned b = c == a + n + 2 ? a + 1 : a + n + 2;
                    text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                            std::to_string(c) + "\n";
                }
            }
        files.push_back({(slope > 0 ? "up" : "down") + std::string(".obj"), text});
    }
    return files;
}

using Work = std::function<Result<std::size_t>()>; // returns the number of violations

/// The calls of the verifier for a certificate, its output files, an arrangement and a mesh.
struct Works {
    forged::Subject subject;
    std::string text;
    Certificate certificate;
    std::size_t triangles = 0;
    std::vector<std::pair<std::string, Work>> all;

    explicit Works(unsigned n) :
        subject(forged::subject(crossing_grids(n),
                                {"obj", "vtp", "vtp-plain", "stl", "stl-ascii", "ply"})),
        text(subject.certificate.dump()), certificate(parse_certificate(text, "c").value()) {
        const auto& rounded = *certificate.rounded;
        triangles = rounded.triangles.size();
        const auto add = [&](std::string name, Work work) {
            all.emplace_back(std::move(name), std::move(work));
        };
        add("hash",
            [this]() -> Result<std::size_t> { return input_file(text, {}).sha256.size() - 64; });
        add("parse", [this]() -> Result<std::size_t> {
            return parse_certificate(text, "c").ok() ? 0U : 1U;
        });
        add("arrangement", [this]() -> Result<std::size_t> {
            return verify_arrangement(subject.surfaces, certificate.exact).size();
        });
        add("conforming", [&rounded]() -> Result<std::size_t> {
            return verify_conforming(rounded.vertices, rounded.triangles).size();
        });
        add("certificate", [this]() -> Result<std::size_t> {
            return verify_certificate(subject.inputs, certificate).violations.size();
        });
        for (std::size_t i = 0; i < subject.contents.size(); ++i)
            add("output " + certificate.outputs[i].format, [this, i]() -> Result<std::size_t> {
                return verify_output(subject.contents[i], certificate, i).violations.size();
            });
    }
};

} // namespace

TEST_CASE("stoppable: each function of the verifier ends when it is stopped") {
    std::stop_source stop;
    const Works works(4);
    for (const auto& [name, work] : works.all) {
        CAPTURE(name);
        const auto undisturbed = stoppable(stop.get_token(), work);
        REQUIRE(undisturbed.ok());
        CHECK(undisturbed.value() == 0);
    }
    stop.request_stop();
    for (const auto& [name, work] : works.all) {
        CAPTURE(name);
        const auto stopped = stoppable(stop.get_token(), work);
        REQUIRE_FALSE(stopped.ok());
        CHECK(stopped.error().code == ErrorCode::interrupted);
        CHECK(work().value() == 0); // nobody stops it outside
    }
}

TEST_CASE("stoppable: the verifier looks for a stop as often as it has work") {
    const Works small(8), large(24); // nine times as many triangles
    REQUIRE(large.triangles > 7 * small.triangles);
    for (std::size_t i = 0; i < small.all.size(); ++i) {
        const std::string& name = small.all[i].first;
        CAPTURE(name);
        if (name == "hash") continue; // a look per megabyte
        std::uint64_t few = 0, many = 0;
        REQUIRE(stoppable({}, small.all[i].second, &few).ok());
        REQUIRE(stoppable({}, large.all[i].second, &many).ok());
        CHECK(few > small.triangles);
        CHECK(many > 6 * few);
    }
}

TEST_CASE("stoppable: a request within another one") {
    std::stop_source outer, inner;
    inner.request_stop();
    const std::vector<Point3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Triangle> triangles{{0, 1, 2}};
    const auto judged = [&]() -> Result<std::size_t> {
        return verify_conforming(points, triangles).size();
    };
    const auto finished = stoppable(outer.get_token(), [&]() -> Result<std::size_t> {
        const auto stopped = stoppable(inner.get_token(), judged);
        CHECK_FALSE(stopped.ok());
        return judged(); // the outer one again
    });
    REQUIRE(finished.ok());
    CHECK(verifier::stop_request == nullptr);
}
