// SPDX-License-Identifier: LGPL-3.0-or-later
//
// model.json, for block_files.hpp.
#include <array>
#include <set>

#include <terrane/algorithms/verify/detail/block_files.hpp>
#include <terrane/algorithms/verify/detail/measure.hpp>
#include <terrane/algorithms/verify/detail/model_claim.hpp>
#include <terrane/algorithms/verify/detail/model_lines.hpp>

namespace terrane::verifier {

namespace {

/// The interfaces around a block, those within it, its neighbours, and its area.
struct Around {
    Numbers interfaces, inner;
    std::set<std::uint32_t> neighbours;
    double area = 0;
};

std::string in_brackets(const auto& numbers) {
    std::string text;
    for (const std::uint32_t n : numbers) text += (text.empty() ? "" : ",") + std::to_string(n);
    return "[" + text + "]";
}

double area_of(const WrittenMesh& mesh, const Numbers& triangles) {
    double sum = 0;
    for (const std::uint32_t t : triangles) {
        const auto& [a, b, c] = mesh.triangles[t];
        sum += area_between(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
    }
    return sum;
}

class ModelWriter {
public:
    ModelWriter(Comparison& out, const ModelLists& lists) :
        out_(out), lists_(lists), lines_(find_lines(lists.mesh, lists.surfaces, lists.parts)),
        around_(lists.volumes.size()), areas_(lists.surfaces.size()),
        dangling_areas_(lists.surfaces.size()) {
        for (const Patch& patch : lists.parts.patches)
            patch_areas_.push_back(area_of(lists.mesh, patch.triangles));
        for (std::uint32_t i = 0; i < lists.parts.interfaces.size(); ++i) add_interface(i);
    }

    void write() {
        Numbers borders;
        for (std::uint32_t l = 0; l < lines_.lines.size(); ++l)
            if (lines_.lines[l].kind == "free border") borders.push_back(l);
        if (lists_.stated.blocks.size() != around_.size() ||
            lists_.stated.gaps.size() != borders.size())
            out_.fail("the certificate states another number of blocks or of free borders");
        out_ << "{\n\"format\": \"terrane-model 1\"";
        list("surfaces", lists_.surfaces.size(), [&](std::uint32_t s) { return surface(s); });
        list("blocks", around_.size(), [&](std::uint32_t b) { return block(b); });
        list("interfaces", interface_areas_.size(), [&](std::uint32_t i) { return interface(i); });
        list("patches", patch_areas_.size(), [&](std::uint32_t p) { return patch(p); });
        list("lines", lines_.lines.size(), [&](std::uint32_t l) { return line(l); });
        list("corners", lines_.corners.size(), [&](std::uint32_t c) { return corner(c); });
        list("free_borders", borders.size(),
             [&](std::uint32_t b) { return free_border(borders[b], lists_.stated.gaps[b]); });
        list("leaks", lists_.stated.leaks.size(),
             [&](std::uint32_t l) { return lists_.stated.leaks[l]; });
        if (!lists_.stated.seal.empty()) out_ << ",\n\"seal\": " << lists_.stated.seal;
        out_ << "\n}\n";
    }

private:
    void add_interface(std::uint32_t i) {
        const Interface& interface = lists_.parts.interfaces[i];
        const auto [low, high] = interface.blocks;
        double area = 0;
        for (const std::uint32_t p : interface.patches) area += patch_areas_[p];
        interface_areas_.push_back(area);
        for (const std::uint32_t s : interface.surfaces) {
            areas_[s] += area;
            if (low == high) dangling_areas_[s] += area;
        }
        if (low == high) return around_[low].inner.push_back(i);
        for (const std::uint32_t block : {low, high}) {
            around_[block].interfaces.push_back(i);
            around_[block].area += area;
        }
        around_[low].neighbours.insert(high);
        around_[high].neighbours.insert(low);
    }

    /// Writes an array with a line for each element.
    void list(std::string_view name, std::size_t count, const auto& element) {
        out_ << ",\n\"" << name << "\": [";
        for (std::uint32_t i = 0; i < count; ++i) out_ << (i > 0 ? ",\n" : "\n") << element(i);
        out_ << (count > 0 ? "\n]" : "]");
    }

    [[nodiscard]] std::string surface(std::uint32_t s) const {
        const SurfaceInfo& info = lists_.surfaces[s];
        return "{\"name\":" + in_json(info.name) + ",\"role\":" + in_json(name_of(info.role)) +
               ",\"area\":" + in_json(areas_[s]) +
               ",\"dangling_area\":" + in_json(dangling_areas_[s]) + "}";
    }

    [[nodiscard]] std::string block(std::uint32_t b) const {
        const Around& around = around_[b];
        const ModelClaim::Block& stated = lists_.stated.blocks[b];
        std::string text = "{\"name\":" + in_json(lists_.names[b]) + stated.unit_and_age;
        if (b > 0)
            text += ",\"volume\":" + stated.volume +
                    ",\"volume_written\":" + in_json(lists_.volumes[b]);
        text += ",\"area\":" + in_json(around.area) + stated.positions +
                ",\"interfaces\":" + in_brackets(around.interfaces) +
                ",\"inner_interfaces\":" + in_brackets(around.inner) +
                ",\"neighbours\":" + in_brackets(around.neighbours);
        return text + (b > 0 && !around.interfaces.empty() ? file("block", b) : "") + "}";
    }

    [[nodiscard]] std::string interface(std::uint32_t i) const {
        const Interface& interface = lists_.parts.interfaces[i];
        return "{\"volumes\":" + in_brackets(interface.blocks) +
               ",\"surfaces\":" + in_brackets(interface.surfaces) +
               ",\"area\":" + in_json(interface_areas_[i]) +
               ",\"patches\":" + in_brackets(interface.patches) + file("interface", i) + "}";
    }

    [[nodiscard]] std::string patch(std::uint32_t p) const {
        const Patch& patch = lists_.parts.patches[p];
        const Numbers& t = patch.triangles;
        std::string ranges;
        for (std::size_t i = 0, end = 0; i < t.size(); i = end) {
            while (end < t.size() && t[end] - t[i] == end - i) ++end;
            ranges += (i > 0 ? "," : "") + in_brackets(std::array{t[i], t[end - 1]});
        }
        return "{\"interface\":" + std::to_string(patch.interface) +
               ",\"area\":" + in_json(patch_areas_[p]) + ",\"triangles\":[" + ranges +
               "],\"lines\":" + in_brackets(lines_.lines_of_patch[p]) + "}";
    }

    [[nodiscard]] std::string line(std::uint32_t l) const {
        const LinePart& line = lines_.lines[l];
        return "{\"kind\":" + in_json(line.kind) + ",\"vertices\":" + in_brackets(line.vertices) +
               ",\"corners\":" +
               (line.corners[0] == no_number ? "null" : in_brackets(line.corners)) +
               ",\"patches\":" + in_brackets(line.patches) +
               ",\"surfaces\":" + in_brackets(line.surfaces) +
               ",\"length\":" + in_json(line.length) + "}";
    }

    [[nodiscard]] std::string corner(std::uint32_t c) const {
        const CornerPart& corner = lines_.corners[c];
        const Point3& place = lists_.mesh.vertices[corner.vertex];
        return "{\"vertex\":" + std::to_string(corner.vertex) + ",\"position\":[" +
               in_json(place.x) + "," + in_json(place.y) + "," + in_json(place.z) +
               "],\"lines\":" + in_brackets(corner.lines) + "}";
    }

    [[nodiscard]] std::string free_border(std::uint32_t l, const std::string& gaps) const {
        const LinePart& line = lines_.lines[l];
        const bool closed = line.vertices.front() == line.vertices.back();
        return "{\"line\":" + std::to_string(l) + ",\"surfaces\":" + in_brackets(line.surfaces) +
               ",\"length\":" + in_json(line.length) +
               ",\"closed\":" + (closed ? "true" : "false") + ",\"gaps\":" + gaps + "}";
    }

    [[nodiscard]] std::string file(const std::string& kind, std::uint32_t number) const {
        return ",\"file\":\"" + lists_.file_of(kind, number) + "\"";
    }

    Comparison& out_;
    const ModelLists& lists_;
    LineParts lines_;
    std::vector<Around> around_;
    std::vector<double> areas_, dangling_areas_; ///< per surface
    std::vector<double> patch_areas_, interface_areas_;
};

} // namespace

std::string difference(std::string_view contents, const ModelLists& lists) {
    return compared(contents, "json", [&](Comparison& out) { ModelWriter(out, lists).write(); });
}

} // namespace terrane::verifier
