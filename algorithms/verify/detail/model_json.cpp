// SPDX-License-Identifier: LGPL-3.0-or-later
//
// compare_model_json of block_files.hpp. model.json has one element per line; each is followed from
// its first byte to its last, and what is not compared must have the right form.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <terrane/algorithms/verify/detail/block_files.hpp>
#include <terrane/algorithms/verify/detail/line_scanner.hpp>

namespace terrane::verifier {

namespace {

/// Follows one line.
class Follower {
public:
    Follower(std::string_view line, const LineScanner& in) : rest_(line), in_(in) {}

    Follower& expect(std::string_view text) {
        if (!rest_.starts_with(text)) in_.fail("\"" + std::string(text) + "\" is needed");
        rest_.remove_prefix(text.size());
        return *this;
    }
    /// Passes a number, or null.
    Follower& number() {
        if (rest_.starts_with("null")) return expect("null");
        double value = 0;
        const auto [end, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (code != std::errc()) in_.fail("a number is needed");
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return *this;
    }
    /// Takes a number, which must be this one; JSON has no infinity.
    Follower& number(double expected) {
        if (!std::isfinite(expected)) return expect("null");
        double value = 0;
        const auto [end, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (code != std::errc() || !same_bits(value, expected)) in_.fail("another volume");
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return *this;
    }
    /// Passes a string.
    Follower& string() {
        expect("\"");
        std::size_t end = 0;
        while (end < rest_.size() && rest_[end] != '"') end += rest_[end] == '\\' ? 2 : 1;
        if (end >= rest_.size()) in_.fail("a string has no end");
        rest_.remove_prefix(end + 1);
        return *this;
    }
    /// Passes an array of whole numbers.
    Follower& array() {
        expect("[");
        const std::size_t end = rest_.find(']');
        if (end == std::string_view::npos ||
            rest_.substr(0, end).find_first_not_of("0123456789,") != std::string_view::npos)
            in_.fail("an array of numbers is needed");
        rest_.remove_prefix(end + 1);
        return *this;
    }
    template <class Items>
    Follower& array(const Items& expected) {
        std::string text = "[";
        for (const std::uint32_t n : expected)
            text += (text.size() > 1 ? "," : "") + std::to_string(n);
        return expect(text + "]");
    }
    void end(bool last) {
        if (rest_ != (last ? "" : ",")) in_.fail("the line has more than it should");
    }

private:
    std::string_view rest_;
    const LineScanner& in_;
};

/// The interfaces around a block, those within it, and its neighbours.
struct Around {
    Numbers interfaces, inner;
    std::set<std::uint32_t> neighbours;
};

class ModelReader {
public:
    ModelReader(std::string_view contents, const ModelLists& lists) :
        in_(contents), lists_(lists), around_(lists.volumes.size()) {
        const auto& interfaces = lists.parts.interfaces;
        for (std::uint32_t i = 0; i < interfaces.size(); ++i) {
            const auto [low, high] = interfaces[i].blocks;
            if (low == high) {
                around_[low].inner.push_back(i);
                continue;
            }
            for (const std::uint32_t block : {low, high}) around_[block].interfaces.push_back(i);
            around_[low].neighbours.insert(high);
            around_[high].neighbours.insert(low);
        }
    }

    void read() {
        in_.expect("{");
        in_.expect("\"format\": \"terrane-model 1\",");
        list("surfaces", lists_.surfaces.size(), [](Follower& f, std::uint32_t) { surface(f); });
        list("blocks", around_.size(), [this](Follower& f, std::uint32_t b) { block(f, b); });
        list("interfaces", lists_.parts.interfaces.size(),
             [this](Follower& f, std::uint32_t i) { interface(f, i); });
        list("patches", lists_.parts.patches.size(),
             [this](Follower& f, std::uint32_t p) { patch(f, p); });
        // What follows is not compared: lines, corners, free borders, leaks.
    }

private:
    template <class Element>
    void list(std::string_view name, std::size_t count, const Element& element) {
        const std::string start = "\"" + std::string(name) + "\": [";
        if (count == 0) return in_.expect(start + "],");
        in_.expect(start);
        for (std::uint32_t i = 0; i < count; ++i) {
            Follower line(in_.next(), in_);
            element(line, i);
            line.end(i + 1 == count);
        }
        in_.expect("],");
    }

    static void surface(Follower& line) {
        line.expect("{\"name\":").string().expect(",\"role\":").string();
        line.expect(",\"area\":").number().expect(",\"dangling_area\":").number().expect("}");
    }

    void block(Follower& line, std::uint32_t b) const {
        const Around& around = around_[b];
        line.expect("{\"name\":").string().expect(",\"volume\":").number();
        line.expect(",\"volume_written\":").number(b == 0 ? outside_volume() : lists_.volumes[b]);
        line.expect(",\"area\":").number();
        for (const std::string_view place : {"above", "below", "beside"})
            line.expect(",\"" + std::string(place) + "\":").array();
        line.expect(",\"interfaces\":").array(around.interfaces);
        line.expect(",\"inner_interfaces\":").array(around.inner);
        line.expect(",\"neighbours\":").array(around.neighbours);
        if (b > 0 && !around.interfaces.empty()) line.expect(file("blocks/block_", b));
        line.expect("}");
    }

    void interface(Follower& line, std::uint32_t i) const {
        const Interface& interface = lists_.parts.interfaces[i];
        line.expect("{\"volumes\":").array(interface.blocks);
        line.expect(",\"surfaces\":").array(interface.surfaces);
        line.expect(",\"area\":").number();
        line.expect(",\"patches\":").array(interface.patches);
        line.expect(file("interfaces/interface_", i)).expect("}");
    }

    void patch(Follower& line, std::uint32_t p) const {
        const Patch& patch = lists_.parts.patches[p];
        line.expect("{\"interface\":" + std::to_string(patch.interface) + ",\"area\":").number();
        std::string ranges;
        const Numbers& t = patch.triangles;
        for (std::size_t i = 0, end = 0; i < t.size(); i = end) {
            while (end < t.size() && t[end] - t[i] == end - i) ++end;
            ranges += (i > 0 ? ",[" : "[") + std::to_string(t[i]) + "," +
                      std::to_string(t[end - 1]) + "]";
        }
        line.expect(",\"triangles\":[" + ranges + "],\"lines\":").array().expect("}");
    }

    [[nodiscard]] std::string file(const std::string& start, std::uint32_t number) const {
        return ",\"file\":\"" + start + std::to_string(number) + "." + lists_.part_format + "\"";
    }
    [[nodiscard]] double outside_volume() const { return lists_.volumes[0]; }

    LineScanner in_;
    const ModelLists& lists_;
    std::vector<Around> around_;
};

} // namespace

void compare_model_json(std::string_view contents, const ModelLists& lists) {
    ModelReader(contents, lists).read();
}

} // namespace terrane::verifier
