// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/certificate.hpp>

#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include <terrane/algorithms/arrangement/digest.hpp>
#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/sha256.hpp>
#include <terrane/io/atomic/atomic_file.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>

namespace terrane {

namespace fs = std::filesystem;
using namespace detail;

namespace {

/// Writes JSON piece by piece; a tree of values would take ten times the memory.
class Writer {
public:
    explicit Writer(std::string& out) : out_(out) {}

    void quote(std::string_view text) {
        using Handler = nlohmann::json::error_handler_t;
        out_ += nlohmann::json(text).dump(-1, ' ', false, Handler::replace);
    }
    void raw(std::string_view text) { out_ += text; }
    void number(std::uint64_t n) { append_number(out_, n); }
    /// Writes a double as a string.
    void quote(double value) {
        out_ += '"';
        append_number(out_, value);
        out_ += '"';
    }

    /// Writes "[a,b,c]", each item by write(item).
    template <class Items, class Write>
    void array(const Items& items, const Write& write, std::string_view between = ",") {
        out_ += '[';
        bool first = true;
        for (const auto& item : items) {
            if (!std::exchange(first, false)) out_ += between;
            write(item);
        }
        out_ += ']';
    }
    template <class Numbers>
    void numbers(const Numbers& items) {
        array(items, [this](std::uint32_t n) { number(n); });
    }
    /// Writes an array of arrays, each on a line of its own.
    template <class Items>
    void arrays(const Items& items) {
        array(
            items, [&](const auto& list) { numbers(list); }, ",\n");
    }
    void lists(const IndexLists<std::uint32_t>& lists) {
        out_ += '[';
        for (std::size_t i = 0; i < lists.size(); ++i) {
            if (i > 0) out_ += ",\n";
            numbers(lists[i]);
        }
        out_ += ']';
    }

private:
    std::string& out_;
};

void write_construction(Writer& out, const Construction& how) {
    struct Kind {
        std::string_view name;
        std::size_t indices;
    };
    constexpr std::array<Kind, 4> kinds{{{"v", 1}, {"lp", 5}, {"ppp", 9}, {"ll", 4}}};
    const Kind& kind = kinds[static_cast<std::size_t>(how.kind)];
    out.raw("[\"");
    out.raw(kind.name);
    out.raw("\"");
    for (std::size_t i = 0; i < kind.indices; ++i) {
        out.raw(",");
        out.number(how.v[i]);
    }
    constexpr std::array<std::string_view, 3> axes{",\"x\"]", ",\"y\"]", ",\"z\"]"};
    const bool has_axis = how.kind == Construction::Kind::line_line;
    out.raw(has_axis ? axes[static_cast<std::size_t>(how.axis)] : "]");
}

void write_surface(Writer& out, const Surface& surface) {
    out.raw("{\"name\":");
    out.quote(surface.name);
    out.raw(",\"role\":");
    out.quote(role_names[static_cast<std::size_t>(surface.role)]);
    out.raw(",\"vertices\":");
    out.number(surface.vertices.size());
    out.raw(",\"triangles\":");
    out.number(surface.triangles.size());
    out.raw("}");
}

void write_inputs(Writer& out, const Certified& certified) {
    std::size_t first = 0;
    out.array(
        certified.files,
        [&](const InputRecord& file) {
            out.raw("{\"name\":");
            out.quote(file.name);
            out.raw(",\"sha256\":");
            out.quote(file.sha256);
            out.raw(",\"bytes\":");
            out.number(file.bytes);
            out.raw(",\"surfaces\":");
            out.array(
                certified.surfaces.subspan(first, file.surfaces),
                [&](const Surface& s) { write_surface(out, s); }, ",\n");
            out.raw("}");
            first += file.surfaces;
        },
        ",\n");
}

void write_outputs(Writer& out, std::span<const OutputRecord> outputs) {
    const auto surface = [&](const SurfaceInfo& s) {
        out.raw("{\"name\":");
        out.quote(s.name);
        out.raw(",\"role\":");
        out.quote(role_names[static_cast<std::size_t>(s.role)]);
        out.raw("}");
    };
    out.array(
        outputs,
        [&](const OutputRecord& file) {
            out.raw("{\"name\":");
            out.quote(file.name);
            out.raw(",\"format\":");
            out.quote(file.format);
            out.raw(",\"sha256\":");
            out.quote(file.sha256);
            out.raw(",\"bytes\":");
            out.number(file.bytes);
            out.raw(",\"surfaces\":");
            out.array(file.surfaces, surface, ",\n");
            out.raw("}");
        },
        ",\n");
}

void write_exact(Writer& out, const Arrangement& a) {
    out.raw("{\"vertices\":");
    out.array(
        a.vertices, [&](PointIndex p) { write_construction(out, a.state->points.construction(p)); },
        ",\n");
    out.raw(",\n\"triangles\":");
    out.arrays(a.triangles);
    out.raw(",\n\"parents\":");
    out.lists(a.parents_of);
    out.raw(",\n\"intersection_edges\":");
    out.arrays(a.intersection_edges);
    out.raw(",\n\"degenerate\":");
    out.numbers(a.degenerate);
    out.raw(",\n\"duplicates\":");
    out.arrays(a.inputs.duplicates);
    out.raw("}");
}

/// Tells whether the mesh has the vertices, triangles and parents of the arrangement, and its
/// vertices at most other places.
bool has_exact_triangles(const Arrangement& a, const Mesh& mesh) {
    return a.vertices.size() == mesh.vertices.size() && a.triangles == mesh.triangles &&
           a.parents_of == mesh.parents_of;
}

/// The verifier shows the stated bounds without knowing how the mesh was rounded. With other
/// triangles than those of the arrangement its bound is up to 5/2 times the sum of all moves.
void write_report(Writer& out, const RoundingReport& report, bool exact_triangles) {
    constexpr double proof_slack = 4;
    out.raw(",\n\"clean\":");
    out.raw(report.clean ? "true" : "false");
    out.raw(",\"max_move\":");
    if (exact_triangles)
        out.quote(report.max_move);
    else
        out.raw("null");
    out.raw(",\"deviation\":");
    out.quote(exact_triangles ? report.deviation : proof_slack * report.deviation);
    out.raw(",\"vanished\":");
    out.numbers(report.vanished);
}

void write_rounded(Writer& out, const Arrangement& exact, const RoundedMesh& rounded) {
    const Mesh& mesh = rounded.mesh;
    out.raw("{\"vertices\":");
    out.array(
        mesh.vertices,
        [&](const Point3& p) {
            out.array(std::array{p.x, p.y, p.z}, [&](double c) { out.quote(c); });
        },
        ",\n");
    out.raw(",\n\"triangles\":");
    out.arrays(mesh.triangles);
    out.raw(",\n\"parents\":");
    out.lists(mesh.parents_of);
    out.raw(",\n\"intersection_edges\":");
    out.arrays(mesh.intersection_edges);
    out.raw(",\n\"regions\":");
    out.lists(mesh.regions_of);
    write_report(out, rounded.report, has_exact_triangles(exact, mesh));
    out.raw("}");
}

} // namespace

Result<InputRecord> record_input(const fs::path& path, std::string name, std::size_t surfaces) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    return InputRecord{std::move(name), hexadecimal(sha256(contents.value())),
                       contents.value().size(), surfaces};
}

OutputRecord record_output(std::string_view contents, std::string name, std::string format,
                           const Mesh& mesh) {
    return {std::move(name), std::move(format), hexadecimal(sha256(contents)), contents.size(),
            mesh.surfaces};
}

std::string certified_name(const fs::path& path, const fs::path& certificate) {
    std::error_code failed;
    const auto folder = certificate == "-" ? fs::path() : certificate.parent_path();
    // fs::proximate makes only existing paths absolute, and cannot compare them with others.
    const auto from = fs::absolute(folder.empty() ? fs::path(".") : folder, failed);
    const auto to = failed ? path : fs::absolute(path, failed);
    const auto relative = failed ? path : fs::proximate(to, from, failed);
    return (failed ? path : relative).generic_string();
}

std::string to_certificate(const Certified& certified, const Run& run) {
    std::string text;
    text.reserve(200 * certified.exact.triangles.size() + 4096);
    Writer out(text);
    out.raw("{\"format\":\"terrane-certificate\",\"version\":2,\"kind\":\"arrangement\",\n");
    out.raw("\"inputs\":");
    write_inputs(out, certified);
    out.raw(",\n\"outputs\":");
    write_outputs(out, certified.outputs);
    out.raw(",\n\"exact\":");
    write_exact(out, certified.exact);
    out.raw(",\n\"rounded\":");
    if (certified.rounded == nullptr)
        out.raw("null");
    else
        write_rounded(out, certified.exact, *certified.rounded);
    out.raw(",\n\"digest\":");
    out.quote(canonical_digest(certified.surfaces, certified.exact, run));
    out.raw("}\n");
    return text;
}

} // namespace terrane
