// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/fill_map.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane::cli {
namespace {

constexpr int samples = 200; ///< cells along the longer side
constexpr double panel = 360, spacing = 30, head = 46, foot = 40;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Colours from dark blue over green to yellow, perceptually uniform.
constexpr std::array<std::string_view, 16> colours{
    "#440154", "#481a6c", "#472f7d", "#414487", "#39568c", "#31688e", "#2a788e", "#23888e",
    "#1f988b", "#22a884", "#35b779", "#54c568", "#7ad151", "#a5db36", "#d2e21b", "#fde725"};

struct Frame {
    double x = HUGE_VAL, y = HUGE_VAL; ///< lower left corner
    double width = 0, height = 0;
    double cell = 1; ///< side of a sample
    int columns = 1, rows = 1;

    explicit Frame(const Surface& s) {
        double right = -HUGE_VAL, top = -HUGE_VAL;
        for (const Triangle& t : s.triangles)
            for (const auto v : t) {
                const Point3& p = s.vertices[v];
                x = std::min(x, p.x);
                y = std::min(y, p.y);
                right = std::max(right, p.x);
                top = std::max(top, p.y);
            }
        width = right - x;
        height = top - y;
        cell = std::max(width, height) / samples;
        if (!(cell > 0) || !std::isfinite(cell)) cell = 1;
        columns = std::clamp(static_cast<int>(std::ceil(width / cell)), 1, samples);
        rows = std::clamp(static_cast<int>(std::ceil(height / cell)), 1, samples);
    }
};

/// Interpolates values at the centres of a frame's cells; cells without a triangle get NaN.
std::vector<double> sampled(const Surface& s, std::span<const double> value_of_vertex,
                            const Frame& f) {
    std::vector<double> values(static_cast<std::size_t>(f.columns * f.rows), nothing);
    const auto value = [&](std::uint32_t v) {
        return value_of_vertex.empty() ? s.vertices[v].z : value_of_vertex[v];
    };
    for (const Triangle& t : s.triangles) {
        const Point3 &a = s.vertices[t[0]], &b = s.vertices[t[1]], &c = s.vertices[t[2]];
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0) continue;
        const auto index = [](double at, int count) {
            return std::clamp(static_cast<int>(std::floor(at)), 0, count - 1);
        };
        const int i0 = index((std::min({a.x, b.x, c.x}) - f.x) / f.cell - 0.5, f.columns);
        const int i1 = index((std::max({a.x, b.x, c.x}) - f.x) / f.cell + 0.5, f.columns);
        const int j0 = index((std::min({a.y, b.y, c.y}) - f.y) / f.cell - 0.5, f.rows);
        const int j1 = index((std::max({a.y, b.y, c.y}) - f.y) / f.cell + 0.5, f.rows);
        for (int j = j0; j <= j1; ++j)
            for (int i = i0; i <= i1; ++i) {
                const double x = f.x + (i + 0.5) * f.cell, y = f.y + (j + 0.5) * f.cell;
                const double u = ((b.x - x) * (c.y - y) - (b.y - y) * (c.x - x)) / area;
                const double v = ((c.x - x) * (a.y - y) - (c.y - y) * (a.x - x)) / area;
                if (u < 0 || v < 0 || u + v > 1) continue;
                values[static_cast<std::size_t>(j * f.columns + i)] =
                    u * value(t[0]) + v * value(t[1]) + (1 - u - v) * value(t[2]);
            }
    }
    return values;
}

struct Scale {
    double low = HUGE_VAL, high = -HUGE_VAL;

    explicit Scale(std::span<const double> values) {
        for (const double v : values)
            if (std::isfinite(v)) {
                low = std::min(low, v);
                high = std::max(high, v);
            }
    }
    [[nodiscard]] std::size_t colour(double value) const {
        if (!(high > low)) return 0;
        const double share = (value - low) / (high - low) * double(colours.size());
        return static_cast<std::size_t>(std::clamp(share, 0.0, double(colours.size() - 1)));
    }
};

/// Draws the cells; neighbours of one colour in a row become one rectangle.
std::string picture(const Frame& f, std::span<const double> values, const Scale& scale) {
    constexpr std::size_t none = colours.size();
    const double size = panel / std::max(f.columns, f.rows);
    std::string text;
    for (int j = 0; j < f.rows; ++j) {
        const auto colour = [&](int i) {
            const double v = values[static_cast<std::size_t>(j * f.columns + i)];
            return std::isfinite(v) ? scale.colour(v) : none;
        };
        for (int i = 0, end = 0; i < f.columns; i = end) {
            const auto now = colour(i);
            for (end = i + 1; end < f.columns && colour(end) == now;) ++end;
            if (now == none) continue;
            text += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
                                "height=\"{:.2f}\" fill=\"{}\"/>\n",
                                i * size, (f.rows - 1 - j) * size, (end - i) * size + 0.2,
                                size + 0.2, colours[now]);
        }
    }
    return text;
}

std::string outlines(const Frame& f, const Surface& s, std::span<const BorderLoop> loops) {
    const double size = panel / std::max(f.columns, f.rows) / f.cell;
    std::string text;
    for (const BorderLoop& loop : loops) {
        const char* colour = loop.kind == LoopKind::outer  ? "black"
                             : loop.kind == LoopKind::hole ? "red"
                                                           : "blue";
        text += fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"0.6\" d=\"", colour);
        char command = 'M';
        for (const auto v : loop.vertices) {
            const Point3& p = s.vertices[v];
            text += fmt::format("{}{:.2f} {:.2f}", command, (p.x - f.x) * size,
                                (f.rows * f.cell - (p.y - f.y)) * size);
            command = 'L';
        }
        text += "Z\"/>\n";
    }
    return text;
}

std::string legend(const Scale& scale) {
    if (!(scale.high >= scale.low)) return {};
    std::string text;
    constexpr double width = panel / 2 / double(colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i)
        text += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"8\" "
                            "fill=\"{}\"/>\n",
                            double(i) * width, panel + 8, width + 0.2, colours[i]);
    return text + fmt::format("<text x=\"0\" y=\"{0:.0f}\">{1}</text>"
                              "<text x=\"{2:.0f}\" y=\"{0:.0f}\" text-anchor=\"end\">{3}"
                              "</text>\n",
                              panel + 28, figure(scale.low, 5), panel / 2, figure(scale.high, 5));
}

std::string panel_at(double x, double y, std::string_view title, const std::string& contents) {
    return fmt::format("<g transform=\"translate({:.0f} {:.0f})\">\n<text x=\"0\" y=\"-8\">{}"
                       "</text>\n{}</g>\n",
                       x, y, xml_escaped(title), contents);
}

std::string row_of(const FillMap& map, double y) {
    const Frame frame(*map.after);
    const auto before = sampled(*map.before, {}, frame), after = sampled(*map.after, {}, frame);
    auto error = sampled(*map.after, map.deviation, frame);
    for (std::size_t i = 0; i < error.size(); ++i)
        if (std::isfinite(before[i]) || error[i] == 0) error[i] = nothing;
    const Scale heights(after), errors(error);
    const auto borders = outlines(frame, *map.before, map.loops);
    const auto at = [](int column) { return spacing + column * (panel + spacing); };
    return panel_at(at(0), y, map.title + ", before",
                    picture(frame, before, heights) + borders + legend(heights)) +
           panel_at(at(1), y, "after", picture(frame, after, heights) + borders + legend(heights)) +
           panel_at(at(2), y, "expected error of interpolated points",
                    picture(frame, error, errors) + borders + legend(errors));
}

} // namespace

std::string svg_of(std::span<const FillMap> maps) {
    const double width = spacing + 3 * (panel + spacing);
    const double row = head + panel + foot;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, row * double(maps.size()));
    for (std::size_t i = 0; i < maps.size(); ++i) text += row_of(maps[i], row * double(i) + head);
    return text + "</svg>\n";
}

} // namespace terrane::cli
