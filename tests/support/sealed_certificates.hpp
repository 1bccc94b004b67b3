// SPDX-License-Identifier: LGPL-3.0-or-later
//
// Certificates of surfaces that were sealed, extended or trimmed.
#pragma once

#include <charconv>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <terrane/algorithms/arrangement/restricted.hpp>
#include <terrane/algorithms/model/arrange_within.hpp>
#include <terrane/algorithms/verify/detail/kinds.hpp>

#include "support/cut_certificates.hpp"

namespace forged {

struct Growing {
    std::optional<Volume> volume{};
    double seal = 0, extend = 0;
};

/// Adds the records of inputs and outputs and the certificate to a subject.
inline void certify(Subject& s, const std::vector<File>& files, const Arranged& arranged,
                    const Volume* volume, const std::vector<std::string>& formats) {
    std::vector<InputRecord> records;
    for (std::size_t i = 0; i < files.size(); ++i) {
        const InputFile& file = s.inputs[i];
        records.push_back({files[i].name, file.sha256, file.bytes, file.surfaces.size()});
    }
    s.surfaces = arranged.surfaces; // for the digest
    if (volume != nullptr)
        for (InputFile& file : input_files(volume->files)) s.inputs.push_back(std::move(file));
    std::vector<OutputRecord> outputs;
    const Mesh& mesh = arranged.rounded.mesh;
    for (const std::string& format : formats) {
        auto text = format_mesh(mesh, format_named(format).value(), {});
        REQUIRE(text);
        outputs.push_back(record_output(text.value(), "out." + format, format, mesh.surfaces));
        s.contents.push_back(std::move(text).value());
    }
    const auto text =
        to_cut_certificate({records, arranged.surfaces, arranged.exact, &arranged.rounded, outputs},
                           {volume == nullptr ? nullptr : &volume->record,
                            volume == nullptr ? 0 : volume->boundary.size(), arranged.growth},
                           {});
    REQUIRE(text);
    s.certificate = Json::parse(text.value());
}

/// Returns the certificate of surfaces that were sealed or extended, with an output file in each
/// format.
inline Subject sealed_subject(const std::vector<File>& files, const Growing& how,
                              const std::vector<std::string>& formats = {"obj"}) {
    Subject s;
    s.inputs = input_files(files);
    std::vector<Surface> surfaces;
    for (const InputFile& file : s.inputs)
        surfaces.insert(surfaces.end(), file.surfaces.begin(), file.surfaces.end());
    ArrangeWithinOptions options;
    options.seal = how.seal;
    options.extend = how.extend;
    const auto arranged = arrange_within(
        surfaces, how.volume ? how.volume->boundary : std::vector<Surface>(), options);
    REQUIRE(arranged);
    REQUIRE(arranged->rounded.report.clean);
    certify(s, files, arranged.value(), how.volume ? &*how.volume : nullptr, formats);
    return s;
}

using Corners = std::array<Point3, 3>;

/// Returns the certificate that a producer would write who adds these triangles to surfaces, by
/// their numbers, and keeps the exact triangles for which keep(corners, parents) is true.
inline Subject
self_made(const std::vector<File>& files, const std::map<std::size_t, std::vector<Corners>>& added,
          const std::function<bool(const Corners&, const std::set<std::uint32_t>&)>& keep) {
    Subject s;
    s.inputs = input_files(files);
    Arranged arranged;
    for (const InputFile& file : s.inputs)
        arranged.surfaces.insert(arranged.surfaces.end(), file.surfaces.begin(),
                                 file.surfaces.end());
    for (const Surface& surface : arranged.surfaces)
        arranged.growth.push_back({surface.triangles.size(), surface.triangles.size()});
    for (const auto& [number, triangles] : added)
        for (const Corners& corners : triangles) {
            Surface& surface = arranged.surfaces[number];
            const auto v = static_cast<std::uint32_t>(surface.vertices.size());
            surface.vertices.insert(surface.vertices.end(), corners.begin(), corners.end());
            surface.triangles.push_back({v, v + 1, v + 2});
        }
    auto whole = arrange(arranged.surfaces);
    REQUIRE(whole);
    const auto rounded = round_to_doubles(whole.value());
    REQUIRE(rounded);
    const Mesh& mesh = rounded->mesh;
    REQUIRE(mesh.triangles.size() == whole->triangles.size());
    std::vector<bool> kept;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const auto parents = mesh.parents_of[t];
        kept.push_back(keep({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]},
                            {parents.begin(), parents.end()}));
    }
    arranged.exact = restricted(std::move(whole).value(), kept);
    auto rounded_part = round_to_doubles(arranged.exact);
    REQUIRE(rounded_part);
    arranged.rounded = std::move(rounded_part).value();
    certify(s, files, arranged, nullptr, {"obj"});
    return s;
}

/// Computes the surfaces of the exact part, the digest and the hashes anew.
inline void seal_grown(Subject& s) {
    const auto parsed = parse_certificate(s.certificate.dump(), "c");
    if (parsed && parsed->cut && parsed->sealed) {
        std::size_t own = 0;
        std::vector<Surface> files;
        for (const InputFile& file : s.inputs) {
            own += file.surfaces.size();
            files.insert(files.end(), file.surfaces.begin(), file.surfaces.end());
        }
        if (parsed->sealed->surfaces.size() == own && parsed->cut->volume.files == 0)
            s.surfaces = verifier::surfaces_of_exact(files, parsed.value());
    }
    seal(s);
}

/// Checks forgeries of certificates of grown surfaces.
inline void check_grown(const Subject& right, const std::vector<Forgery>& forgeries) {
    check_forgeries(right, forgeries, seal_grown);
}

/// A sheet z = height + slope y over x from `low` to `high` and y from 0 to 10, of 6 by 5 cells.
inline std::string sheet_text(const std::string& name, double low, double high, double height,
                              double slope) {
    std::string text;
    for (int i = 0; i <= 6; ++i)
        for (int j = 0; j <= 5; ++j)
            text += "v " + std::to_string(low + (high - low) * i / 6) + " " +
                    std::to_string(2 * j) + " " +
                    std::to_string(height + slope * 2 * j + 0.1 * ((i * j) % 3)) + "\n";
    text += "g " + name + "\n";
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 5; ++j) {
            const int a = 1 + 6 * i + j, b = a + 6;
            text += "f " + std::to_string(a) + " " + std::to_string(b) + " " +
                    std::to_string(b + 1) + "\nf " + std::to_string(a) + " " +
                    std::to_string(b + 1) + " " + std::to_string(a + 1) + "\n";
        }
    return text;
}

/// A sheet that ends 0.1 short of a fault, one that reaches 0.15 beyond it, and the fault.
inline std::vector<File> gaping() {
    return {{"short.obj", sheet_text("short", 0, 4.9, 0, 0.05)},
            {"long.obj", sheet_text("long", 0, 5.15, 2, -0.03)},
            {"fault.obj", "v 5 -1 -3\nv 5 11 -3\nv 5 11 5\nv 5 -1 5\ng fault\nf 1 2 3\nf 1 3 4\n"}};
}

inline Volume gaping_box() {
    return box_volume({1.3, 1.1, -1.3}, {5.5, 8.7, 3.4});
}

inline const Subject& right_sealed() {
    static const Subject subject = sealed_subject(gaping(), {std::nullopt, 0.3, 0});
    return subject;
}

inline const Subject& right_extended() {
    static const Subject subject = sealed_subject(gaping(), {gaping_box(), 0.3, 2.5});
    return subject;
}

inline Forgery sealed(const std::string& name, const std::function<void(Json&)>& change,
                      const std::string& rule) {
    return {name, [change](Json& c) { change(c["sealed"]); }, rule};
}

inline Forgery left_out(const std::string& name, const std::function<void(Json&)>& change,
                        const std::string& rule) {
    return {name, change, rule};
}

/// The input triangles of a certificate: those of a surface, given and added.
struct Numbering {
    explicit Numbering(const Json& c) {
        std::size_t s = 0;
        for (const Json& input : c["inputs"])
            for (const Json& surface : input["surfaces"]) {
                if (s == c["sealed"].size()) return;
                given.push_back(next);
                added.push_back(next + surface["triangles"].get<std::size_t>());
                next = added.back() + c["sealed"][s]["extended"].size() +
                       c["sealed"][s]["sealed"].size();
                ++s;
            }
    }
    [[nodiscard]] bool is_added(std::size_t p) const {
        for (std::size_t s = 0; s < given.size(); ++s)
            if (p >= added[s] && p < (s + 1 < given.size() ? given[s + 1] : next)) return true;
        return false;
    }
    std::vector<std::size_t> given, added;
    std::size_t next = 0;
};

/// Tells whether all parents of an exact triangle were added.
inline bool is_added(const Json& c, const Numbering& numbers, std::size_t t) {
    for (const Json& p : c["exact"]["parents"][t])
        if (!numbers.is_added(p.get<std::size_t>())) return false;
    return true;
}

inline bool is_dropped(const Json& c, std::size_t t) {
    const Json& dropped = c["cut"]["dropped"];
    return std::find(dropped.begin(), dropped.end(), Json(t)) != dropped.end();
}

/// Returns the exact triangles that were kept or dropped, and are added or given.
inline std::vector<std::size_t> exact_triangles(const Json& c, bool dropped, bool added) {
    const Numbering numbers(c);
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < c["exact"]["triangles"].size(); ++t)
        if (is_dropped(c, t) == dropped && is_added(c, numbers, t) == added) found.push_back(t);
    REQUIRE_FALSE(found.empty());
    return found;
}

/// Lists exact triangles as dropped, and takes those with the same numbers out of the doubles,
/// which have the triangles of the exact part.
inline void drop_exact(Json& c, const std::vector<std::size_t>& more) {
    const std::set<std::size_t> gone(more.begin(), more.end());
    std::set<std::size_t> dropped(c["cut"]["dropped"].begin(), c["cut"]["dropped"].end());
    for (std::size_t t = c["exact"]["triangles"].size(), kept = c["rounded"]["triangles"].size();
         t-- > 0;) {
        if (dropped.contains(t)) continue;
        --kept;
        if (gone.contains(t)) drop_triangle(c["rounded"], kept);
    }
    dropped.insert(gone.begin(), gone.end());
    c["cut"]["dropped"] = dropped;
    drop_unused(c["rounded"]);
    c["outputs"] = Json::array();
}

inline void set_number(Json& number, double value) {
    number = decimal_text(value);
}

/// Returns the number of each vertex of the doubles, by the exact vertex; -1: it was not kept.
inline std::vector<int> doubles_of_exact(const Json& c) {
    std::vector<int> number(c["exact"]["vertices"].size(), -1);
    for (std::size_t t = 0; t < c["exact"]["triangles"].size(); ++t)
        if (!is_dropped(c, t))
            for (const Json& v : c["exact"]["triangles"][t]) number[v.get<std::size_t>()] = 0;
    int next = 0;
    for (int& n : number)
        if (n == 0) n = next++;
    REQUIRE(static_cast<std::size_t>(next) == c["rounded"]["vertices"].size());
    return number;
}

/// Exchanges the diagonal of two triangles of one input triangle, and says that the doubles have
/// other triangles than the exact part. This is still valid.
inline Subject with_diagonal(Subject s) {
    Json& mesh = s.certificate["rounded"];
    const Json before = mesh["triangles"];
    std::map<std::set<std::size_t>, std::vector<std::size_t>> at;
    for (std::size_t t = 0; t < before.size(); ++t)
        for (std::size_t i = 0; i < 3; ++i)
            at[{before[t][i].get<std::size_t>(), before[t][(i + 1) % 3].get<std::size_t>()}]
                .push_back(t);
    const auto turn = [&](const Json& a, const Json& b, const Json& c) {
        const auto x = [&](const Json& v, std::size_t i) {
            return number_in(mesh["vertices"][v.get<std::size_t>()][i]);
        };
        return (x(b, 0) - x(a, 0)) * (x(c, 1) - x(a, 1)) -
               (x(b, 1) - x(a, 1)) * (x(c, 0) - x(a, 0));
    };
    for (const auto& [edge, pair] : at) {
        if (pair.size() != 2 || mesh["parents"][pair[0]] != mesh["parents"][pair[1]] ||
            mesh["parents"][pair[0]].size() != 1)
            continue;
        const auto beside = [&ends = edge](const Json& t) {
            for (std::size_t i = 0; i < 3; ++i)
                if (!ends.contains(t[i].get<std::size_t>())) return i;
            return std::size_t{0};
        };
        const Json first = before[pair[0]], second = before[pair[1]];
        const std::size_t i = beside(first), j = beside(second);
        const Json a = first[i], b = first[(i + 1) % 3], c = second[j], d = first[(i + 2) % 3];
        if (!(turn(a, b, c) * turn(a, c, d) > 1e-6)) continue; // not convex, or upright
        mesh["triangles"][pair[0]] = {a, b, c};
        mesh["triangles"][pair[1]] = {a, c, d};
        break;
    }
    REQUIRE(mesh["triangles"] != before);
    mesh["max_move"] = nullptr;
    mesh["deviation"] = "1e-13";
    s.certificate["outputs"] = Json::array();
    s.contents.clear();
    return s;
}

/// Puts what was trimmed back into the doubles.
inline void put_back(Json& c) {
    auto number = doubles_of_exact(c);
    Json& mesh = c["rounded"];
    int region = 0;
    for (const Json& regions : mesh["regions"])
        for (const Json& r : regions) region = std::max(region, r.get<int>() + 1);
    for (const std::size_t t : exact_triangles(c, true, false)) {
        Json corners = Json::array();
        for (const Json& v : c["exact"]["triangles"][t]) {
            int& n = number[v.get<std::size_t>()];
            if (n < 0) {
                const Json& how = c["exact"]["vertices"][v.get<std::size_t>()];
                REQUIRE(how[0] == "v");
                std::size_t k = how[1].get<std::size_t>();
                n = static_cast<int>(mesh["vertices"].size());
                Json place;
                std::size_t surface = 0;
                for (const Surface& s : right_sealed().surfaces) {
                    if (k < s.vertices.size()) {
                        place = {"", "", ""};
                        const Point3& p = s.vertices[k];
                        set_number(place[0], p.x);
                        set_number(place[1], p.y);
                        set_number(place[2], p.z);
                        break;
                    }
                    k -= s.vertices.size();
                    ++surface;
                }
                mesh["vertices"].push_back(place);
            }
            corners.push_back(n);
        }
        mesh["triangles"].push_back(corners);
        mesh["parents"].push_back(c["exact"]["parents"][t]);
        mesh["regions"].push_back({region});
    }
}

} // namespace forged
