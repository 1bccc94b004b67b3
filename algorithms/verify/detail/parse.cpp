// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Parses certificates strictly: everything that is not understood is refused, so that no statement
// counts as certified that was not judged. This file reads what all kinds have in common.
#include <algorithm>
#include <array>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>
#include <terrane/algorithms/verify/verify.hpp>

namespace terrane {

namespace {

using verifier::BadJson;
using verifier::each;
using verifier::Json;
using verifier::Kind;
using verifier::Malformed;
using verifier::Node;

Role role(const Node& node) {
    const auto& names = verifier::names_of_roles;
    const auto found = std::ranges::find(names, node.string());
    if (found == names.end()) node.fail("no role of this name");
    return static_cast<Role>(found - names.begin());
}

std::string name(const Node& node) {
    return std::string(node.string());
}

/// Refuses a zero byte in a name: the system would open the file named by what precedes it.
std::string file_name(const Node& node) {
    if (node.string().find('\0') != std::string_view::npos) node.fail("a zero in a file name");
    return name(node);
}

std::string sha256(const Node& node) {
    const std::string_view text = node.string();
    if (text.size() != 64 || text.find_first_not_of("0123456789abcdef") != std::string_view::npos)
        node.fail("64 lower-case hexadecimal digits are needed");
    return std::string(text);
}

CertifiedInput input(const Node& node) {
    node.expect_keys({"name", "sha256", "bytes", "surfaces"});
    const auto surface = [](const Node& s) {
        s.expect_keys({"name", "role", "vertices", "triangles"});
        return CertifiedSurface{name(s["name"]), role(s["role"]), s["vertices"].count(),
                                s["triangles"].count()};
    };
    return {file_name(node["name"]), sha256(node["sha256"]), node["bytes"].count(),
            each(node["surfaces"], surface)};
}

CertifiedOutput output(const Node& node) {
    node.expect_keys({"name", "format", "sha256", "bytes", "surfaces"});
    const auto surface = [](const Node& s) {
        s.expect_keys({"name", "role"});
        return SurfaceInfo{name(s["name"]), role(s["role"])};
    };
    return {file_name(node["name"]), name(node["format"]), sha256(node["sha256"]),
            node["bytes"].count(), each(node["surfaces"], surface)};
}

void expect_string(const Node& node, std::string_view text, const std::string& otherwise) {
    if (node.string() != text) node.fail(otherwise);
}

/// Checks the keys of a certificate of a kind.
void expect_keys(const Node& node, const Kind& kind) {
    std::vector<std::string_view> keys{"format", "version", "kind", "inputs", "outputs"};
    keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
    if (kind.can_be_cut)
        for (const std::string_view key : {"cut", "sealed"})
            if (node.has(key)) keys.push_back(key);
    node.expect_keys(keys);
}

Certificate certificate(const Node& node) {
    node.expect_key("format");
    expect_string(node["format"], "terrane-certificate", "this is no terrane-certificate");
    node.expect_key("version"); // first, since other versions have other keys
    if (node["version"].count() != 2) node["version"].fail("version 2 is needed");
    node.expect_key("kind");
    const Kind* kind = verifier::find_kind(node["kind"].string());
    if (kind == nullptr) node["kind"].fail("this kind of certificate is not known");
    expect_keys(node, *kind);
    Certificate result;
    result.inputs = each(node["inputs"], input);
    result.outputs = each(node["outputs"], output);
    kind->parse(node, result);
    return result;
}

Result<Certificate> parsed(std::string_view text, const std::string& file) {
    try {
        const Json json(text);
        return certificate(Node(json));
    } catch (const BadJson& broken) {
        return Error{ErrorCode::bad_syntax, broken.sentence,
                     file + ", " + verifier::place_in(text, broken.offset)};
    } catch (const Malformed& broken) {
        const std::string place = broken.place.empty() ? "" : ", " + broken.place;
        return Error{ErrorCode::bad_syntax, broken.sentence, file + place};
    }
}

} // namespace

Result<Certificate> parse_certificate(std::string_view text, std::string_view source) {
    const StandardArithmetic arithmetic;
    try {
        return parsed(text, std::string(source));
    } catch (const std::bad_alloc&) {
    } catch (const std::length_error&) {
    }
    return Error{ErrorCode::out_of_memory, "out of memory", ""}; // this short, it needs no memory
}

} // namespace terrane
