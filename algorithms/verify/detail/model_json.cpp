// SPDX-License-Identifier: LGPL-3.0-or-later
//
// compare_model_json of block_files.hpp. model.json has one element per line; each is followed from
// its first byte to its last, and what is not compared must have the right form. Areas and lengths
// are sums in floating point and must agree to twelve digits.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <terrane/algorithms/verify/detail/block_files.hpp>
#include <terrane/algorithms/verify/detail/line_scanner.hpp>
#include <terrane/algorithms/verify/detail/model_lines.hpp>

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
    /// Whether the rest of the line begins so.
    [[nodiscard]] bool begins(std::string_view text) const { return rest_.starts_with(text); }
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
        if (code != std::errc() || !same_bits(value, expected)) in_.fail("another number");
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return *this;
    }
    /// Takes a number that differs from this one by at most `slack`.
    Follower& near(double expected, double slack) {
        if (!std::isfinite(expected)) return expect("null");
        double value = 0;
        const auto [end, code] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
        if (code != std::errc() || !(std::fabs(value - expected) <= slack))
            in_.fail("another area or length");
        rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
        return *this;
    }
    /// Takes a string, which must be this one.
    Follower& string(std::string_view expected) {
        std::string text = "\"";
        for (const char c : expected) text += escaped(c);
        return expect(text + "\"");
    }
    /// Passes what is left of the line, which must end so.
    Follower& rest(std::string_view end) {
        const bool more = rest_.ends_with(',');
        if (!rest_.substr(0, rest_.size() - (more ? 1 : 0)).ends_with(end))
            in_.fail("\"" + std::string(end) + "\" is needed");
        rest_ = more ? "," : "";
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
    /// Returns a character as JSON writes it in a string.
    static std::string escaped(char c) {
        static constexpr std::string_view plain = "\b\f\n\r\t\"\\", letters = "bfnrt\"\\";
        if (const std::size_t i = plain.find(c); i != std::string_view::npos)
            return {'\\', letters[i]};
        const auto code = static_cast<unsigned char>(c);
        if (code >= 0x20) return {c};
        static constexpr std::string_view digits = "0123456789abcdef";
        return {'\\', 'u', '0', '0', digits[code / 16], digits[code % 16]};
    }

    std::string_view rest_;
    const LineScanner& in_;
};

/// An area, and how far a sum of it in floating point may be from it.
struct Area {
    double value = 0, slack = 0;

    void add(const Area& other) {
        value += other.value;
        slack += other.slack;
    }
};

/// The interfaces around a block, those within it, its neighbours, and its area.
struct Around {
    Numbers interfaces, inner;
    std::set<std::uint32_t> neighbours;
    Area area;
};

Area area_of(const WrittenMesh& mesh, const Numbers& triangles) {
    Area area;
    for (const std::uint32_t t : triangles) {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto minus = [&](std::uint32_t v, std::uint32_t w) {
            const Point3 &p = mesh.vertices[v], &q = mesh.vertices[w];
            return Point3{p.x - q.x, p.y - q.y, p.z - q.z};
        };
        const Point3 u = minus(b, a), v = minus(c, a);
        const double x = u.y * v.z - u.z * v.y, y = u.z * v.x - u.x * v.z,
                     z = u.x * v.y - u.y * v.x;
        const double longer = std::hypot(u.x, u.y, u.z) + std::hypot(v.x, v.y, v.z);
        area.add({std::hypot(x, y, z) / 2, 1e-12 * longer * longer});
    }
    return area;
}

class ModelReader {
public:
    ModelReader(std::string_view contents, const ModelLists& lists) :
        in_(contents), lists_(lists), lines_(find_lines(lists.mesh, lists.surfaces, lists.parts)),
        around_(lists.volumes.size()), areas_(lists.surfaces.size()),
        dangling_areas_(lists.surfaces.size()) {
        const auto& interfaces = lists.parts.interfaces;
        for (std::uint32_t i = 0; i < interfaces.size(); ++i) {
            const auto [low, high] = interfaces[i].blocks;
            interface_areas_.push_back(area_of(lists.mesh, interfaces[i].triangles));
            for (const std::uint32_t s : interfaces[i].surfaces) {
                areas_[s].add(interface_areas_[i]);
                if (low == high) dangling_areas_[s].add(interface_areas_[i]);
            }
            if (low == high) {
                around_[low].inner.push_back(i);
                continue;
            }
            for (const std::uint32_t block : {low, high}) {
                around_[block].interfaces.push_back(i);
                around_[block].area.add(interface_areas_[i]);
            }
            around_[low].neighbours.insert(high);
            around_[high].neighbours.insert(low);
        }
    }

    void read() {
        in_.expect("{");
        in_.expect("\"format\": \"terrane-model 1\",");
        list("surfaces", lists_.surfaces.size(),
             [this](Follower& f, std::uint32_t s) { surface(f, s); });
        list("blocks", around_.size(), [this](Follower& f, std::uint32_t b) { block(f, b); });
        list("interfaces", lists_.parts.interfaces.size(),
             [this](Follower& f, std::uint32_t i) { interface(f, i); });
        list("patches", lists_.parts.patches.size(),
             [this](Follower& f, std::uint32_t p) { patch(f, p); });
        list("lines", lines_.lines.size(), [this](Follower& f, std::uint32_t l) { line(f, l); });
        list("corners", lines_.corners.size(),
             [this](Follower& f, std::uint32_t c) { corner(f, c); });
        Numbers borders;
        for (std::uint32_t l = 0; l < lines_.lines.size(); ++l)
            if (lines_.lines[l].kind == "free border") borders.push_back(l);
        list("free_borders", borders.size(),
             [&](Follower& f, std::uint32_t b) { free_border(f, borders[b]); });
        leaks();
        in_.expect("}");
        in_.end();
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

    void surface(Follower& line, std::uint32_t s) const {
        const SurfaceInfo& info = lists_.surfaces[s];
        line.expect("{\"name\":").string(info.name);
        line.expect(",\"role\":").string(name_of(info.role));
        line.expect(",\"area\":").near(areas_[s].value, areas_[s].slack);
        line.expect(",\"dangling_area\":").near(dangling_areas_[s].value, dangling_areas_[s].slack);
        line.expect("}");
    }

    void block(Follower& line, std::uint32_t b) const {
        const Around& around = around_[b];
        line.expect("{\"name\":").string(); // names are not compared
        if (line.begins(",\"unit\":")) line.expect(",\"unit\":").string();
        if (line.begins(",\"age\":")) line.expect(",\"age\":").number();
        if (b > 0) {
            line.expect(",\"volume\":").number();
            line.expect(",\"volume_written\":").number(lists_.volumes[b]);
        }
        line.expect(",\"area\":").near(around.area.value, around.area.slack);
        for (const std::string_view place : {"above", "below", "beside"})
            line.expect(",\"" + std::string(place) + "\":").array();
        line.expect(",\"interfaces\":").array(around.interfaces);
        line.expect(",\"inner_interfaces\":").array(around.inner);
        line.expect(",\"neighbours\":").array(around.neighbours);
        if (b > 0 && !around.interfaces.empty()) line.expect(file("blocks", "/block_", b));
        line.expect("}");
    }

    void interface(Follower& line, std::uint32_t i) const {
        const Interface& interface = lists_.parts.interfaces[i];
        line.expect("{\"volumes\":").array(interface.blocks);
        line.expect(",\"surfaces\":").array(interface.surfaces);
        line.expect(",\"area\":").near(interface_areas_[i].value, interface_areas_[i].slack);
        line.expect(",\"patches\":").array(interface.patches);
        line.expect(file("interfaces", "/interface_", i)).expect("}");
    }

    void patch(Follower& line, std::uint32_t p) const {
        const Patch& patch = lists_.parts.patches[p];
        const Area area = area_of(lists_.mesh, patch.triangles);
        line.expect("{\"interface\":" + std::to_string(patch.interface) + ",\"area\":");
        line.near(area.value, area.slack);
        std::string ranges;
        const Numbers& t = patch.triangles;
        for (std::size_t i = 0, end = 0; i < t.size(); i = end) {
            while (end < t.size() && t[end] - t[i] == end - i) ++end;
            ranges += (i > 0 ? ",[" : "[") + std::to_string(t[i]) + "," +
                      std::to_string(t[end - 1]) + "]";
        }
        line.expect(",\"triangles\":[" + ranges + "],\"lines\":");
        line.array(lines_.lines_of_patch[p]).expect("}");
    }

    void line(Follower& follower, std::uint32_t l) const {
        const LinePart& line = lines_.lines[l];
        follower.expect("{\"kind\":").string(line.kind);
        follower.expect(",\"vertices\":").array(line.vertices).expect(",\"corners\":");
        if (line.corners[0] == no_number)
            follower.expect("null");
        else
            follower.array(line.corners);
        follower.expect(",\"patches\":").array(line.patches);
        follower.expect(",\"surfaces\":").array(line.surfaces);
        follower.expect(",\"length\":").near(line.length, 1e-12 * line.length).expect("}");
    }

    void corner(Follower& line, std::uint32_t c) const {
        const CornerPart& corner = lines_.corners[c];
        const Point3& place = lists_.mesh.vertices[corner.vertex];
        line.expect("{\"vertex\":" + std::to_string(corner.vertex) + ",\"position\":[");
        line.number(place.x).expect(",").number(place.y).expect(",").number(place.z);
        line.expect("],\"lines\":").array(corner.lines).expect("}");
    }

    /// Reads a free border; its gaps, which depend on the nearest surfaces, are not compared.
    void free_border(Follower& follower, std::uint32_t l) const {
        const LinePart& line = lines_.lines[l];
        follower.expect("{\"line\":" + std::to_string(l) + ",\"surfaces\":").array(line.surfaces);
        follower.expect(",\"length\":").near(line.length, 1e-12 * line.length);
        const bool closed = line.vertices.front() == line.vertices.back();
        follower.expect(",\"closed\":").expect(closed ? "true" : "false");
        follower.expect(",\"gaps\":[").rest("]}");
    }

    /// Passes the leaks, and the gaps that were sealed, if there is such a list. They are the last
    /// keys, and not compared.
    void leaks() {
        std::string_view line = in_.next();
        if (line == "\"leaks\": [") {
            for (line = in_.next(); line != "]" && line != "],"; line = in_.next())
                Follower(line, in_).expect("{\"from\":").rest("}");
        } else if (line != "\"leaks\": []" && line != "\"leaks\": [],") {
            in_.fail("the leaks are needed");
        }
        if (line.ends_with(","))
            Follower(in_.next(), in_).expect("\"seal\": {\"distance\":").rest("]}");
    }

    [[nodiscard]] std::string file(const std::string& kind, const std::string& start,
                                   std::uint32_t number) const {
        const std::string name =
            lists_.part_format.empty()
                ? kind + ".vtp"
                : kind + start + std::to_string(number) + "." + lists_.part_format;
        return ",\"file\":\"" + name + "\"";
    }

    LineScanner in_;
    const ModelLists& lists_;
    LineParts lines_;
    std::vector<Around> around_;
    std::vector<Area> areas_, dangling_areas_; ///< per surface
    std::vector<Area> interface_areas_;
};

} // namespace

void compare_model_json(std::string_view contents, const ModelLists& lists) {
    ModelReader(contents, lists).read();
}

} // namespace terrane::verifier
