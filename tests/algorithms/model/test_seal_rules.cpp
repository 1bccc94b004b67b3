// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Tests what a rule of sealing by name means, also where names have the signs that divide them.
#include <terrane/algorithms/model/seal_rules.hpp>

#include <string>
#include <vector>

#include <catch2/catch.hpp>

#include <terrane/algorithms/mesh/labels.hpp>

using namespace terrane;

namespace {

/// Writes rules as "0/2 1/2" or "1".
std::string found(const std::string& text, const std::vector<std::string>& names) {
    std::vector<SurfaceInfo> infos;
    for (const std::string& name : names) infos.push_back({name, Role::unknown});
    const auto rules = seal_rules_for(text, 5, infos, unique_labels(infos));
    if (!rules) {
        CHECK(rules.error().code == ErrorCode::bad_option);
        return rules.error().sentence;
    }
    std::string list;
    for (const SealRule& rule : *rules) {
        CHECK(rule.distance == 5);
        list += (list.empty() ? "" : " ") + std::to_string(rule.surface);
        if (rule.other) list += "/" + std::to_string(*rule.other);
    }
    return list;
}

} // namespace

TEST_CASE("seal rules: a surface, a pair, and names with a slash in them", "[seal]") {
    const std::vector<std::string> names{"top", "F1", "F1/F2", "F2", "F3=a", "a/b"};
    CHECK(found("top", names) == "0");
    CHECK(found("top/F1", names) == "0/1");
    CHECK(found("F1/F2", names) == "2"); // the whole is a name
    CHECK(found("F2/F1", names) == "3/1");
    CHECK(found("F1/F2/top", names) == "2/0");
    CHECK(found("F1/F3=a", names) == "1/4");
    CHECK(found("a/b/a/b", names) == "5/5");
    CHECK(found("top/top", names) == "0/0");
}

TEST_CASE("seal rules: all surfaces with a name, or one of them by its label", "[seal]") {
    const std::vector<std::string> names{"F", "F", "top"};
    CHECK(found("F_2", names) == "1");
    CHECK(found("F_2/top", names) == "1/2");
    CHECK(found("top/F", names) == "2/0 2/1");
    CHECK(found("F", names) == "0 1");
}

TEST_CASE("seal rules: a name that no surface has is refused with a suggestion", "[seal]") {
    const std::vector<std::string> names{"top", "base"};
    CHECK(found("bsae", names) == "no surface is called bsae; did you mean base?");
    CHECK(found("top/bsae", names) == "no surface is called bsae; did you mean base?");
    CHECK(found("tpo/base", names) == "no surface is called tpo; did you mean top?");
    CHECK(found("x", names) == "no surface is called x; there are top, base");
    CHECK(found("", names) == "no surface is called ; there are top, base");
    CHECK(found("/", names) == "no surface is called ; there are top, base");
}
