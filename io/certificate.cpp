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

void write_report(Writer& out, const RoundingReport& report) {
    out.raw(",\n\"clean\":");
    out.raw(report.clean ? "true" : "false");
    out.raw(",\"rounds\":");
    out.number(report.rounds);
    out.raw(",\"max_move\":");
    out.quote(report.max_move);
    out.raw(",\"deviation\":");
    out.quote(report.deviation);
    out.raw(",\"vanished\":");
    out.numbers(report.vanished);
}

void write_rounded(Writer& out, const RoundedMesh& rounded) {
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
    if (mesh.regions_of.size() == mesh.triangles.size()) {
        out.raw(",\n\"regions\":");
        out.lists(mesh.regions_of);
    }
    write_report(out, rounded.report);
    out.raw("}");
}

} // namespace

Result<InputRecord> record_input(const fs::path& path, std::string name, std::size_t surfaces) {
    const auto contents = read_file(path);
    if (!contents) return contents.error();
    return InputRecord{std::move(name), hexadecimal(sha256(contents.value())),
                       contents.value().size(), surfaces};
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
    out.raw("{\"format\":\"terrane-certificate\",\"version\":1,\n\"inputs\":");
    write_inputs(out, certified);
    out.raw(",\n\"exact\":");
    write_exact(out, certified.exact);
    out.raw(",\n\"rounded\":");
    if (certified.rounded == nullptr)
        out.raw("null");
    else
        write_rounded(out, *certified.rounded);
    out.raw(",\n\"digest\":");
    out.quote(canonical_digest(certified.surfaces, certified.exact, run));
    out.raw("}\n");
    return text;
}

} // namespace terrane
