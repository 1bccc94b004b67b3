// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Parses certificates strictly: everything that is not understood is refused, so that no statement
// counts as certified that was not judged.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <new>
#include <utility>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/verify/verify_certificate.hpp>

namespace terrane {

namespace {

using Json = nlohmann::json;

/// Thrown and caught in this file only.
struct Malformed {
    std::string place; ///< "exact.triangles[12]"
    std::string sentence;
};

/// A value in a JSON text, and its path.
class Node {
public:
    explicit Node(const Json& json) : json_(json) {}

    /// Precondition: has(key).
    [[nodiscard]] Node operator[](std::string_view key) const {
        return {json_.find(key).value(), this, key, 0};
    }
    [[nodiscard]] Node operator[](std::size_t i) const { return {json_[i], this, {}, i}; }
    [[nodiscard]] bool has(std::string_view key) const { return json_.contains(key); }
    [[nodiscard]] bool is_null() const { return json_.is_null(); }

    /// Checks that the value is an object with all required keys, and no others but optional ones.
    void expect_keys(std::initializer_list<std::string_view> required,
                     std::initializer_list<std::string_view> optional = {}) const {
        if (!json_.is_object()) fail("an object is needed");
        for (const std::string_view key : required)
            if (!has(key)) fail("\"" + std::string(key) + "\" is missing");
        for (const auto& item : json_.items())
            if (std::ranges::find(required, item.key()) == required.end() &&
                std::ranges::find(optional, item.key()) == optional.end())
                fail("an unknown key");
    }

    /// Returns the size of an array.
    [[nodiscard]] std::size_t size() const {
        if (!json_.is_array()) fail("an array is needed");
        return json_.size();
    }
    void expect_size(std::size_t n) const {
        if (size() != n) fail("an array of " + std::to_string(n) + " is needed");
    }

    [[nodiscard]] std::uint64_t count() const {
        if (!json_.is_number_unsigned()) fail("a whole number, not negative, is needed");
        return json_.get<std::uint64_t>();
    }
    [[nodiscard]] std::uint32_t index() const {
        const std::uint64_t n = count();
        if (n > UINT32_MAX) fail("the number is too large");
        return static_cast<std::uint32_t>(n);
    }
    [[nodiscard]] bool flag() const {
        if (!json_.is_boolean()) fail("true or false is needed");
        return json_.get<bool>();
    }
    [[nodiscard]] const std::string& string() const {
        if (!json_.is_string()) fail("a string is needed");
        return json_.get_ref<const std::string&>();
    }
    /// Returns a double that is given as decimal text.
    [[nodiscard]] double number() const {
        const std::string& text = string();
        double value = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (code != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
            fail("a finite number in quotes is needed");
        return value;
    }

    [[noreturn]] void fail(std::string sentence) const {
        throw Malformed{place(), std::move(sentence)};
    }

private:
    Node(const Json& json, const Node* up, std::string_view key, std::size_t i) :
        json_(json), up_(up), key_(key), i_(i) {}

    [[nodiscard]] std::string place() const {
        if (up_ == nullptr) return "";
        const std::string before = up_->place();
        if (key_.empty()) return before + "[" + std::to_string(i_) + "]";
        return before + (before.empty() ? "" : ".") + std::string(key_);
    }

    const Json& json_;
    const Node* up_ = nullptr; ///< nullptr: the value is the whole text
    std::string_view key_;     ///< of an object's member
    std::size_t i_ = 0;        ///< of an array's
};

/// Returns read(item) for each item of an array.
template <class Read>
auto each(const Node& array, const Read& read) {
    const std::size_t n = array.size();
    std::vector<decltype(read(array[0]))> values;
    values.reserve(n);
    for (std::size_t i = 0; i < n; ++i) values.push_back(read(array[i]));
    return values;
}

template <std::size_t n>
std::array<std::uint32_t, n> indices(const Node& array) {
    array.expect_size(n);
    std::array<std::uint32_t, n> values{};
    for (std::size_t i = 0; i < n; ++i) values[i] = array[i].index();
    return values;
}

std::uint32_t index(const Node& node) {
    return node.index();
}

IndexLists<std::uint32_t> lists(const Node& array) {
    IndexLists<std::uint32_t> result;
    for (std::size_t i = 0, n = array.size(); i < n; ++i) result.push_back(each(array[i], index));
    return result;
}

Role role(const Node& node) {
    constexpr std::array<std::string_view, 4> names{"unknown", "horizon", "fault", "boundary"};
    const auto found = std::ranges::find(names, node.string());
    if (found == names.end()) node.fail("no role of this name");
    return static_cast<Role>(found - names.begin());
}

CertifiedInput input(const Node& node) {
    node.expect_keys({"name", "sha256", "bytes", "surfaces"});
    const auto surface = [](const Node& s) {
        s.expect_keys({"name", "role", "vertices", "triangles"});
        return CertifiedSurface{s["name"].string(), role(s["role"]), s["vertices"].count(),
                                s["triangles"].count()};
    };
    return {node["name"].string(), node["sha256"].string(), node["bytes"].count(),
            each(node["surfaces"], surface)};
}

/// Reads ["v", i], ["lp", 5 indices], ["ppp", 9 indices] or ["ll", 4 indices, "x" | "y" | "z"].
Construction construction(const Node& node) {
    if (node.size() == 0) node.fail("a construction is needed");
    using Kind = Construction::Kind;
    constexpr std::array<std::pair<std::string_view, std::size_t>, 4> kinds{
        {{"v", 1}, {"lp", 5}, {"ppp", 9}, {"ll", 4}}};
    const auto kind =
        std::ranges::find(kinds, node[0].string(), [](const auto& k) { return k.first; });
    if (kind == kinds.end()) node[0].fail("no construction of this name");
    Construction how;
    how.kind = static_cast<Kind>(kind - kinds.begin());
    const bool has_axis = how.kind == Kind::line_line;
    node.expect_size(1 + kind->second + (has_axis ? 1 : 0));
    for (std::size_t i = 0; i < kind->second; ++i) how.v[i] = node[i + 1].index();
    if (has_axis) {
        const std::string& axis = node[5].string();
        if (axis != "x" && axis != "y" && axis != "z") node[5].fail("no axis of this name");
        how.axis = static_cast<Axis>(axis[0] - 'x');
    }
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
    return {node[0].number(), node[1].number(), node[2].number()};
}

RoundedClaim rounded(const Node& node) {
    node.expect_keys({"vertices", "triangles", "parents", "intersection_edges", "clean", "rounds",
                      "max_move", "deviation", "vanished"},
                     {"regions"});
    RoundedClaim claim;
    claim.vertices = each(node["vertices"], point);
    claim.triangles = each(node["triangles"], indices<3>);
    claim.parents_of = lists(node["parents"]);
    claim.intersection_edges = each(node["intersection_edges"], indices<2>);
    if (node.has("regions")) claim.regions_of = lists(node["regions"]);
    claim.clean = node["clean"].flag();
    claim.rounds = node["rounds"].index();
    claim.max_move = node["max_move"].number();
    claim.deviation = node["deviation"].number();
    claim.vanished = each(node["vanished"], index);
    return claim;
}

Certificate certificate(const Node& node) {
    node.expect_keys({"format", "version", "inputs", "exact", "rounded", "digest"});
    if (node["format"].string() != "terrane-certificate")
        node["format"].fail("this is no terrane-certificate");
    if (node["version"].count() != 1) node["version"].fail("this version is not known");
    Certificate result;
    result.inputs = each(node["inputs"], input);
    result.exact = exact(node["exact"]);
    if (const Node claim = node["rounded"]; !claim.is_null()) result.rounded = rounded(claim);
    result.digest = node["digest"].string();
    return result;
}

/// Returns "line 3, column 7" for the number of bytes read.
std::string place_in(std::string_view text, std::size_t bytes) {
    const std::string_view before = text.substr(0, bytes > 0 ? bytes - 1 : 0);
    const auto line = std::ranges::count(before, '\n') + 1;
    const std::size_t column = before.size() - (before.rfind('\n') + 1) + 1;
    return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

} // namespace

Result<Certificate> parse_certificate(std::string_view text, std::string_view source) {
    const std::string file(source);
    try {
        const Json json = Json::parse(text);
        return certificate(Node(json));
    } catch (const Json::parse_error& broken) {
        return Error{ErrorCode::bad_syntax, "this is no JSON",
                     file + ", " + place_in(text, broken.byte)};
    } catch (const Malformed& broken) {
        const std::string place = broken.place.empty() ? "" : ", " + broken.place;
        return Error{ErrorCode::bad_syntax, broken.sentence, file + place};
    } catch (const Json::exception&) { // such as a number beyond the largest double
        return Error{ErrorCode::bad_syntax, "this JSON can't be read", file};
    } catch (const std::bad_alloc&) {
        return Error{ErrorCode::out_of_memory, "there is not enough memory", file};
    }
}

} // namespace terrane
