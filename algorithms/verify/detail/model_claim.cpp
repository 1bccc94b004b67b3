// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/algorithms/verify/detail/model_claim.hpp>

#include <cmath>
#include <initializer_list>
#include <vector>

#include <nlohmann/json.hpp>

namespace terrane::verifier {

namespace {

using TextOf = std::string (*)(const Node& node);

/// A member of an object, and how its value is written.
struct Member {
    std::string_view key;
    TextOf text;
    bool is_optional = false; ///< null: it is left out
};

std::string number(const Node& node) {
    return node.is_null() ? "null" : in_json(node.number());
}

std::string count(const Node& node) {
    return std::to_string(node.count());
}

std::string flag(const Node& node) {
    return node.flag() ? "true" : "false";
}

std::string string(const Node& node) {
    return in_json(node.string());
}

template <TextOf text>
std::string list_of(const Node& node) {
    std::string all;
    node.for_each([&](const Node& item, std::size_t i) { all += (i > 0 ? "," : "") + text(item); });
    return "[" + all + "]";
}

/// Returns the members that are there, each with a comma before it.
std::string members(const Node& node, std::initializer_list<Member> all) {
    std::string text;
    for (const Member& member : all) {
        const Node value = node[member.key];
        if (member.is_optional && value.is_null()) continue;
        text += ",\"" + std::string(member.key) + "\":" + member.text(value);
    }
    return text;
}

std::string object(const Node& node, std::initializer_list<Member> all) {
    std::vector<std::string_view> keys;
    for (const Member& member : all) keys.push_back(member.key);
    node.expect_keys(keys);
    return "{" + members(node, all).substr(1) + "}";
}

ModelClaim::Block block(const Node& node) {
    node.expect_keys({"unit", "age", "volume", "above", "below", "beside"});
    return {members(node, {{"unit", string, true}, {"age", number, true}}), number(node["volume"]),
            members(node, {{"above", list_of<count>},
                           {"below", list_of<count>},
                           {"beside", list_of<count>}})};
}

std::string gap(const Node& node) {
    return object(node, {{"surface", count},
                         {"length", number},
                         {"least", number},
                         {"largest", number},
                         {"place", list_of<number>}});
}

std::string leak(const Node& node) {
    return object(node, {{"from", count},
                         {"to", count},
                         {"borders", count},
                         {"length", number},
                         {"least", number},
                         {"largest", number},
                         {"place", list_of<number>},
                         {"separates", flag, true}});
}

std::string rule(const Node& node) {
    return object(node, {{"surfaces", list_of<count>}, {"distance", number}});
}

std::string change(const Node& node) {
    return object(node, {{"kind", string},
                         {"surface", count},
                         {"length", number},
                         {"distance", number},
                         {"place", list_of<number>},
                         {"triangles", count}});
}

std::string seal(const Node& node) {
    if (node.is_null()) return "";
    return object(
        node, {{"distance", number}, {"rules", list_of<rule>, true}, {"changes", list_of<change>}});
}

} // namespace

ModelClaim model_claim(const Node& node) {
    node.expect_keys({"blocks", "gaps", "leaks", "seal"});
    return {each(node["blocks"], block), each(node["gaps"], list_of<gap>),
            each(node["leaks"], leak), seal(node["seal"])};
}

std::string in_json(double number) {
    return std::isfinite(number) ? nlohmann::json(number).dump() : "null";
}

std::string in_json(std::string_view text) {
    return nlohmann::json(text).dump();
}

} // namespace terrane::verifier
