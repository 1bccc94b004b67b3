// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/check_report.hpp>

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

#include <terrane/cli/session/console.hpp>

namespace terrane::cli {
namespace {

constexpr std::size_t most_listed = 10; ///< of each kind, unless all are asked for

constexpr std::array contact_kinds{ContactKind::crossing,      ContactKind::coplanar_overlap,
                                   ContactKind::edges_cross,   ContactKind::edges_overlap,
                                   ContactKind::edge_on_face,  ContactKind::vertex_on_face,
                                   ContactKind::vertex_on_edge};

/// Lists the first of `items`, one per line, and says how many were left out.
template <class Item, class Line>
std::string listing(const std::vector<Item>& items, bool all, const Line& line) {
    return listed(
        items, all ? items.size() : most_listed,
        [&](const Item& item) { return "  " + line(item) + "\n"; }, " (--all lists them)");
}

std::string kinds_text(const CheckReport& r) {
    std::string text;
    for (const ContactKind kind : contact_kinds) {
        const auto count = std::count_if(r.contacts.begin(), r.contacts.end(),
                                         [&](const auto& c) { return c.kind == kind; });
        if (count > 0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name_of(kind));
    }
    return text.empty() ? text : " (" + text + ")";
}

class Writer {
public:
    Writer(const CheckReport& report, const Inputs& inputs, bool all) :
        r_(report), inputs_(inputs), all_(all) {}

    [[nodiscard]] std::string contacts() const {
        return fmt::format("improper contacts: {}{}\n", r_.contacts.size(), kinds_text(r_)) +
               listing(r_.contacts, all_, [this](const ImproperContact& c) {
                   return fmt::format("{} and {}: {} at {}", name(c.triangles[0]),
                                      name(c.triangles[1]), name_of(c.kind),
                                      inputs_.quantities().place(c.place));
               });
    }
    [[nodiscard]] std::string degenerate() const {
        return fmt::format("triangles without area: {}\n", r_.degenerate.size()) +
               listing(r_.degenerate, all_, [this](std::uint32_t t) {
                   return name(t) + ": corner at " + inputs_.quantities().place(corner(t));
               });
    }
    [[nodiscard]] std::string repeated() const {
        return fmt::format("repeated triangles: {}\n", r_.repeated.size()) +
               listing(r_.repeated, all_, [this](const auto& pair) {
                   return name(pair[0]) + " repeats " + name(pair[1]) + ": corner at " +
                          inputs_.quantities().place(corner(pair[0]));
               });
    }
    [[nodiscard]] std::string no_flaws() const {
        return fmt::format("no flaws by themselves: {}, {}, {}\n",
                           counted(r_.free_border_edges, "free border edge"),
                           counted(r_.non_manifold_edges.size(), "non-manifold edge"),
                           counted(r_.shared.size(), "triangle") + " in several surfaces");
    }

private:
    [[nodiscard]] std::string name(std::uint32_t t) const {
        return triangle_name(t, r_.first_triangle, inputs_.labels);
    }
    [[nodiscard]] Point3 corner(std::uint32_t t) const {
        const auto& first = r_.first_triangle;
        const auto after = std::upper_bound(first.begin(), first.end(), t);
        const auto s = static_cast<std::size_t>(std::distance(first.begin(), after)) - 1;
        const Surface& surface = inputs_.surfaces[s];
        return surface.vertices[surface.triangles[t - first[s]][0]];
    }

    const CheckReport& r_;
    const Inputs& inputs_;
    bool all_;
};

/// Turns numbers of triangles counted through all surfaces into surface and number within it.
class TriangleNames {
public:
    explicit TriangleNames(const std::vector<std::uint32_t>& first) : first_(first) {}

    Json operator()(std::uint32_t t) const {
        const auto after = std::upper_bound(first_.begin(), first_.end(), t);
        const auto s = static_cast<std::size_t>(std::distance(first_.begin(), after)) - 1;
        return {{"surface", s}, {"triangle", t - first_[s]}};
    }
    [[nodiscard]] Json pairs(const std::vector<std::array<std::uint32_t, 2>>& list) const {
        Json json = Json::array();
        for (const auto& [a, b] : list)
            json.push_back({{"triangle", (*this)(a)}, {"of", (*this)(b)}});
        return json;
    }

private:
    const std::vector<std::uint32_t>& first_;
};

Json surfaces_json(const Inputs& inputs) {
    Json json = Json::array();
    for (std::size_t s = 0; s < inputs.surfaces.size(); ++s)
        json.push_back({{"name", inputs.surfaces[s].name},
                        {"file", inputs.files[s]},
                        {"triangles", inputs.surfaces[s].triangles.size()},
                        {"vertices", inputs.surfaces[s].vertices.size()}});
    return json;
}

Json contacts_json(const CheckReport& report, const TriangleNames& name) {
    Json json = Json::array();
    for (const ImproperContact& c : report.contacts)
        json.push_back({{"kind", name_of(c.kind)},
                        {"triangles", Json::array({name(c.triangles[0]), name(c.triangles[1])})},
                        {"place", c.place}});
    return json;
}

} // namespace

std::string report_text(const CheckReport& report, const Inputs& inputs, const std::string& source,
                        bool all) {
    const Writer writer(report, inputs, all);
    const auto findings =
        report.contacts.size() + report.degenerate.size() + report.repeated.size();
    return fmt::format("{}: {}, {}, {} distinct vertices, {}\n", source,
                       counted(report.surfaces, "surface"), counted(report.triangles, "triangle"),
                       report.vertices, counted(report.components, "connected component")) +
           writer.contacts() + writer.degenerate() + writer.repeated() + writer.no_flaws() +
           (report.clean() ? "result: conforming\n"
                           : fmt::format("result: {}\n", counted(findings, "finding")));
}

Json json_of(const CheckReport& report, const Inputs& inputs) {
    const TriangleNames name(report.first_triangle);
    Json json;
    json["clean"] = report.clean();
    json["surfaces"] = surfaces_json(inputs);
    json["triangles"] = report.triangles;
    json["vertices"] = report.vertices;
    json["components"] = report.components;
    json["free_border_edges"] = report.free_border_edges;
    json["improper_contacts"] = contacts_json(report, name);
    json["degenerate"] = Json::array();
    for (const auto t : report.degenerate) json["degenerate"].push_back(name(t));
    json["repeated"] = name.pairs(report.repeated);
    json["shared"] = name.pairs(report.shared);
    json["non_manifold_edges"] = report.non_manifold_edges;
    return json;
}

} // namespace terrane::cli
