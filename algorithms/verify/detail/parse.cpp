// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Parses certificates strictly: everything that is not understood is refused, so that no statement
// counts as certified that was not judged.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <new>
#include <utility>

#include <terrane/algorithms/verify/detail/decimal.hpp>
#include <terrane/algorithms/verify/detail/json.hpp>
#include <terrane/algorithms/verify/verify_certificate.hpp>

namespace terrane {

namespace {

using verifier::BadJson;
using verifier::Json;
using verifier::JsonKind;

/// Thrown and caught in this file only.
struct Malformed {
    std::string place; ///< "exact.triangles[12]"
    std::string sentence;
};

/// A value in a JSON text, and its path.
class Node {
public:
    explicit Node(const Json& json) : json_(json) {}

    /// Precondition: the value is an object with this key.
    [[nodiscard]] Node operator[](std::string_view key) const {
        return {json_, json_.find(value_, key).value(), this, key, 0};
    }
    [[nodiscard]] bool is_null() const { return kind() == JsonKind::null; }

    /// Checks that the value is an object with this key.
    void expect_key(std::string_view key) const {
        if (kind() != JsonKind::object) fail("an object is needed");
        if (!json_.find(value_, key)) fail("\"" + std::string(key) + "\" is missing");
    }
    /// Checks that the value is an object with these keys, and no others.
    void expect_keys(std::initializer_list<std::string_view> keys) const {
        for (const std::string_view key : keys) expect_key(key);
        if (json_[value_].count != keys.size()) fail("an unknown key");
    }

    /// Returns the size of an array.
    [[nodiscard]] std::size_t size() const {
        if (kind() != JsonKind::array) fail("an array is needed");
        return json_[value_].count;
    }
    void expect_size(std::size_t n) const {
        if (size() != n) fail("an array of " + std::to_string(n) + " is needed");
    }

    /// Calls visit(item, i) for each item of an array, in order.
    template <class Visit>
    void for_each(const Visit& visit) const {
        const std::size_t count = size();
        std::uint32_t at = value_ + 1;
        for (std::size_t i = 0; i < count; ++i, at = json_[at].after)
            visit(Node(json_, at, this, {}, i), i);
    }

    [[nodiscard]] std::uint64_t count() const {
        if (kind() != JsonKind::integer) fail("a whole number, not negative, is needed");
        return json_[value_].content;
    }
    [[nodiscard]] std::uint32_t index() const {
        const std::uint64_t n = count();
        if (n > UINT32_MAX) fail("the number is too large");
        return static_cast<std::uint32_t>(n);
    }
    [[nodiscard]] bool flag() const {
        if (kind() != JsonKind::boolean) fail("true or false is needed");
        return json_[value_].content == 1;
    }
    [[nodiscard]] std::string_view string() const {
        if (kind() != JsonKind::string) fail("a string is needed");
        return json_.string(json_[value_]);
    }
    /// Returns a double that is given as a string, the shortest decimal that reads back as it.
    [[nodiscard]] double number() const {
        const auto value = verifier::shortest_decimal<double>(string());
        if (!value) fail("a finite number in quotes, in its shortest form, is needed");
        return *value;
    }

    [[noreturn]] void fail(std::string sentence) const {
        throw Malformed{place(), std::move(sentence)};
    }

private:
    Node(const Json& json, std::uint32_t value, const Node* up, std::string_view key,
         std::size_t i) :
        json_(json),
        value_(value), up_(up), key_(key), i_(i) {}

    [[nodiscard]] JsonKind kind() const { return json_[value_].kind; }
    [[nodiscard]] std::string place() const {
        if (up_ == nullptr) return "";
        const std::string before = up_->place();
        if (key_.empty()) return before + "[" + std::to_string(i_) + "]";
        return before + (before.empty() ? "" : ".") + std::string(key_);
    }

    const Json& json_;
    std::uint32_t value_ = 0;  ///< its index
    const Node* up_ = nullptr; ///< nullptr: the value is the whole text
    std::string_view key_;     ///< of an object's member
    std::size_t i_ = 0;        ///< of an array's
};

/// Returns make(item) for each item of an array.
template <class Make>
auto each(const Node& array, const Make& make) {
    std::vector<decltype(make(array))> result;
    result.reserve(array.size());
    array.for_each([&](const Node& item, std::size_t) { result.push_back(make(item)); });
    return result;
}

template <std::size_t n>
std::array<std::uint32_t, n> indices(const Node& array) {
    array.expect_size(n);
    std::array<std::uint32_t, n> values{};
    array.for_each([&](const Node& item, std::size_t i) { values[i] = item.index(); });
    return values;
}

std::uint32_t index(const Node& node) {
    return node.index();
}

IndexLists<std::uint32_t> lists(const Node& array) {
    IndexLists<std::uint32_t> result;
    array.for_each([&](const Node& list, std::size_t) {
        list.for_each(
            [&](const Node& item, std::size_t) { result.values.push_back(item.index()); });
        result.close();
    });
    return result;
}

Role role(const Node& node) {
    constexpr std::array<std::string_view, 4> names{"unknown", "horizon", "fault", "boundary"};
    const auto found = std::ranges::find(names, node.string());
    if (found == names.end()) node.fail("no role of this name");
    return static_cast<Role>(found - names.begin());
}

std::string name(const Node& node) {
    return std::string(node.string());
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
    return {name(node["name"]), sha256(node["sha256"]), node["bytes"].count(),
            each(node["surfaces"], surface)};
}

CertifiedOutput output(const Node& node) {
    node.expect_keys({"name", "format", "sha256", "bytes", "surfaces"});
    const auto surface = [](const Node& s) {
        s.expect_keys({"name", "role"});
        return SurfaceInfo{name(s["name"]), role(s["role"])};
    };
    return {name(node["name"]), name(node["format"]), sha256(node["sha256"]), node["bytes"].count(),
            each(node["surfaces"], surface)};
}

/// The names of the constructions, and the number of indices of each.
constexpr std::array<std::pair<std::string_view, std::size_t>, 4> kinds{
    {{"v", 1}, {"lp", 5}, {"ppp", 9}, {"ll", 4}}};

Construction::Kind construction_kind(const Node& node) {
    const auto kind =
        std::ranges::find(kinds, node.string(), [](const auto& k) { return k.first; });
    if (kind == kinds.end()) node.fail("no construction of this name");
    return static_cast<Construction::Kind>(kind - kinds.begin());
}

Axis axis(const Node& node) {
    const std::string_view name = node.string();
    if (name != "x" && name != "y" && name != "z") node.fail("no axis of this name");
    return static_cast<Axis>(name[0] - 'x');
}

/// Reads ["v", i], ["lp", 5 indices], ["ppp", 9 indices] or ["ll", 4 indices, "x" | "y" | "z"].
Construction construction(const Node& node) {
    if (node.size() == 0) node.fail("a construction is needed");
    Construction how;
    std::size_t used = 0; // indices
    node.for_each([&](const Node& item, std::size_t i) {
        if (i == 0) {
            how.kind = construction_kind(item);
            used = kinds[static_cast<std::size_t>(how.kind)].second;
            node.expect_size(1 + used + (how.kind == Construction::Kind::line_line ? 1 : 0));
        } else if (i <= used) {
            how.v[i - 1] = item.index();
        } else {
            how.axis = axis(item);
        }
    });
    return how;
}

ArrangementClaim exact(const Node& node) {
    node.expect_keys(
        {"vertices", "triangles", "parents", "intersection_edges", "degenerate", "duplicates"});
    return {each(node["vertices"], construction),
            each(node["triangles"], indices<3>),
            lists(node["parents"]),
            each(node["intersection_edges"], indices<2>),
            each(node["degenerate"], index),
            each(node["duplicates"], indices<2>)};
}

Point3 point(const Node& node) {
    node.expect_size(3);
    std::array<double, 3> values{};
    node.for_each([&](const Node& item, std::size_t i) { values[i] = item.number(); });
    return {values[0], values[1], values[2]};
}

RoundedClaim rounded(const Node& node) {
    node.expect_keys({"vertices", "triangles", "parents", "intersection_edges", "regions", "clean",
                      "max_move", "deviation", "vanished"});
    RoundedClaim claim;
    claim.vertices = each(node["vertices"], point);
    claim.triangles = each(node["triangles"], indices<3>);
    claim.parents_of = lists(node["parents"]);
    claim.intersection_edges = each(node["intersection_edges"], indices<2>);
    claim.regions_of = lists(node["regions"]);
    claim.clean = node["clean"].flag();
    if (const Node move = node["max_move"]; !move.is_null()) claim.max_move = move.number();
    claim.deviation = node["deviation"].number();
    claim.vanished = each(node["vanished"], index);
    return claim;
}

void expect_string(const Node& node, std::string_view text, const std::string& otherwise) {
    if (node.string() != text) node.fail(otherwise);
}

Certificate certificate(const Node& node) {
    node.expect_key("format");
    expect_string(node["format"], "terrane-certificate", "this is no terrane-certificate");
    node.expect_key("version"); // first, since other versions have other keys
    if (node["version"].count() != 2) node["version"].fail("version 2 is needed");
    node.expect_keys(
        {"format", "version", "kind", "inputs", "outputs", "exact", "rounded", "digest"});
    expect_string(node["kind"], "arrangement", "this kind of certificate is not known");
    Certificate result;
    result.inputs = each(node["inputs"], input);
    result.outputs = each(node["outputs"], output);
    result.exact = exact(node["exact"]);
    if (const Node claim = node["rounded"]; !claim.is_null()) result.rounded = rounded(claim);
    result.digest = name(node["digest"]);
    return result;
}

} // namespace

Result<Certificate> parse_certificate(std::string_view text, std::string_view source) {
    const std::string file(source);
    try {
        const Json json(text);
        return certificate(Node(json));
    } catch (const BadJson& broken) {
        return Error{ErrorCode::bad_syntax, broken.sentence,
                     file + ", " + verifier::place_in(text, broken.offset)};
    } catch (const Malformed& broken) {
        const std::string place = broken.place.empty() ? "" : ", " + broken.place;
        return Error{ErrorCode::bad_syntax, broken.sentence, file + place};
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::out_of_memory, "there is not enough memory", file};
    }
}

} // namespace terrane
