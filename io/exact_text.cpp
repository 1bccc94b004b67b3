// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/exact_text.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

#include <terrane/algorithms/arrangement/exact_arrangement.hpp>
#include <terrane/algorithms/core/guarded.hpp>
#include <terrane/algorithms/core/parallel.hpp>
#include <terrane/algorithms/core/standard_arithmetic.hpp>
#include <terrane/io/text/names.hpp>
#include <terrane/io/text/text.hpp>
#include <terrane/kernel/fraction.hpp>

namespace terrane {

using namespace detail;

ExactText to_exact(const Arrangement& a, const Run& run) {
    const StandardArithmetic guard;
    ExactText exact;
    exact.surfaces = a.surfaces;
    for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
        exact.surfaces[s].name = one_line(a.surfaces[s].name);
        exact.input_triangles.push_back(a.inputs.first[s + 1] - a.inputs.first[s]);
    }
    using Block = std::vector<std::array<std::string, 3>>;
    const Run unstoppable{.threads = run.threads};
    auto blocks = for_blocks<Block>(
        a.vertices.size(), 1024, unstoppable, [&](std::size_t first, std::size_t last) {
            Block block;
            for (std::size_t v = first; v < last; ++v)
                block.push_back(fractions(a.state->points, a.vertices[v], 10));
            return block;
        });
    for (Block& b : blocks) std::move(b.begin(), b.end(), std::back_inserter(exact.vertices));
    exact.triangles = a.triangles;
    exact.parents_of = a.parents_of;
    exact.intersection_edges = a.intersection_edges;
    return exact;
}

namespace {

void append_header(std::string& out, std::string_view word, std::size_t count) {
    out += word;
    out += ' ';
    append_number(out, std::uint64_t(count));
    out += '\n';
}

void append_indices(std::string& out, std::span<const std::uint32_t> indices) {
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (i > 0) out += ' ';
        append_number(out, std::uint64_t(indices[i]));
    }
}

} // namespace

std::string to_text(const ExactText& exact) {
    std::string out = "terrane-exact 1\n";
    append_header(out, "surfaces", exact.surfaces.size());
    for (std::size_t s = 0; s < exact.surfaces.size(); ++s) {
        out += role_names[static_cast<std::size_t>(exact.surfaces[s].role)];
        out += ' ';
        append_number(out, std::uint64_t(exact.input_triangles[s]));
        out += ' ' + exact.surfaces[s].name + '\n';
    }
    append_header(out, "vertices", exact.vertices.size());
    for (const auto& [x, y, z] : exact.vertices)
        out.append(x).append(" ").append(y).append(" ").append(z).append("\n");
    append_header(out, "triangles", exact.triangles.size());
    for (std::size_t t = 0; t < exact.triangles.size(); ++t) {
        append_indices(out, exact.triangles[t]);
        out += ' ';
        append_indices(out, exact.parents_of[t]);
        out += '\n';
    }
    append_header(out, "intersection_edges", exact.intersection_edges.size());
    for (const Edge& e : exact.intersection_edges) {
        append_indices(out, e);
        out += '\n';
    }
    return out + "end\n";
}

namespace {

bool is_digits(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// Tells whether a text is a fraction such as "-5/3", "7" or "0", without a sign of zero, leading
/// zeros, and "/1".
bool is_fraction(std::string_view text) {
    const bool negative = text.starts_with('-');
    if (negative) text.remove_prefix(1);
    const auto slash = text.find('/');
    const auto above = text.substr(0, slash);
    if (!is_digits(above)) return false;
    if (above[0] == '0') return above == text && above == "0" && !negative;
    if (slash == std::string_view::npos) return true;
    const auto below = text.substr(slash + 1);
    return is_digits(below) && below[0] != '0' && below != "1";
}

class ExactReader {
public:
    ExactReader(std::string_view contents, std::string_view source) : in_(contents, source) {}

    Result<ExactText> read() {
        const bool known = in_.next() && in_.line() == "terrane-exact 1";
        if (!known) return in_.error(ErrorCode::bad_syntax, "\"terrane-exact 1\" is missing");
        using Step = MaybeError (ExactReader::*)();
        constexpr std::array<std::pair<std::string_view, Step>, 4> sections{
            {{"surfaces", &ExactReader::read_surface},
             {"vertices", &ExactReader::read_vertex},
             {"triangles", &ExactReader::read_triangle},
             {"intersection_edges", &ExactReader::read_edge}}};
        for (const auto& [word, step] : sections)
            if (auto trouble = read_section(word, step)) return *trouble;
        if (!in_.next() || in_.line() != "end")
            return in_.error(ErrorCode::bad_syntax, "\"end\" is missing");
        return std::move(out_);
    }

private:
    template <class Step>
    MaybeError read_section(std::string_view word, Step step) {
        std::int64_t count = 0;
        if (!in_.next()) return syntax("the file ends before \"" + std::string(word) + "\"");
        Tokens tokens(in_.line());
        if (tokens.next() != word || !parse_integer(tokens.next(), count) || count < 0 ||
            !tokens.rest().empty())
            return syntax("\"" + std::string(word) + "\" and a number are needed");
        for (std::int64_t i = 0; i < count; ++i) {
            if (!in_.next()) return syntax("the file ends within \"" + std::string(word) + "\"");
            if (auto trouble = (this->*step)()) return trouble;
        }
        return {};
    }

    MaybeError read_surface() {
        Tokens tokens(in_.line());
        const auto role = std::ranges::find(role_names, tokens.next());
        std::int64_t count = 0;
        if (role == role_names.end() || !parse_integer(tokens.next(), count) || count < 0 ||
            std::uint64_t(count) + input_triangles_ > UINT32_MAX)
            return syntax("a role, a number of triangles and a name are needed");
        out_.surfaces.push_back(
            {std::string(tokens.rest()), static_cast<Role>(role - role_names.begin())});
        out_.input_triangles.push_back(static_cast<std::uint32_t>(count));
        input_triangles_ += std::uint64_t(count);
        return {};
    }

    MaybeError read_vertex() {
        Tokens tokens(in_.line());
        std::array<std::string, 3> vertex;
        for (std::string& c : vertex) {
            c = tokens.next();
            if (!is_fraction(c))
                return in_.error(ErrorCode::bad_number, "three reduced fractions are needed");
        }
        if (!tokens.rest().empty()) return syntax("three numbers are needed");
        out_.vertices.push_back(std::move(vertex));
        return {};
    }

    MaybeError read_triangle() {
        Tokens tokens(in_.line());
        Triangle corners{};
        for (std::uint32_t& c : corners)
            if (auto trouble = read_index(tokens, out_.vertices.size(), c)) return trouble;
        std::vector<std::uint32_t> parents;
        do {
            std::uint32_t parent = 0;
            if (auto trouble = read_index(tokens, input_triangles_, parent)) return trouble;
            if (!parents.empty() && parent <= parents.back())
                return in_.error(ErrorCode::bad_index, "input triangles must ascend");
            parents.push_back(parent);
        } while (!tokens.rest().empty());
        out_.triangles.push_back(corners);
        out_.parents_of.push_back(parents);
        return {};
    }

    MaybeError read_edge() {
        Tokens tokens(in_.line());
        Edge edge{};
        for (std::uint32_t& end : edge)
            if (auto trouble = read_index(tokens, out_.vertices.size(), end)) return trouble;
        if (!tokens.rest().empty()) return syntax("two vertices are needed");
        auto& edges = out_.intersection_edges;
        if (edge[0] >= edge[1] || (!edges.empty() && edge <= edges.back()))
            return in_.error(ErrorCode::bad_index, "edges and their vertices must ascend");
        edges.push_back(edge);
        return {};
    }

    MaybeError read_index(Tokens& tokens, std::uint64_t count, std::uint32_t& index) {
        const auto token = tokens.next();
        std::int64_t value = 0;
        if (!parse_integer(token, value)) return syntax("an index is needed, not " + shown(token));
        if (value < 0 || std::uint64_t(value) >= count)
            return in_.error(ErrorCode::bad_index, "there is no " + shown(token));
        index = static_cast<std::uint32_t>(value);
        return {};
    }

    [[nodiscard]] Error syntax(std::string sentence) const {
        return in_.error(ErrorCode::bad_syntax, std::move(sentence));
    }

    LineParser in_;
    ExactText out_;
    std::uint64_t input_triangles_ = 0;
};

} // namespace

Result<ExactText> read_exact(std::string_view contents, std::string_view source) {
    return guard_memory(source, [&] { return ExactReader(contents, source).read(); });
}

} // namespace terrane
