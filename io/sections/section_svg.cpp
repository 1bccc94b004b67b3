// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/sections/section_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include <terrane/algorithms/core/figure.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane {
namespace {

constexpr double most_wide = 900, most_high = 600, left = 90, top = 50, below = 90, legend = 260;
constexpr std::array<std::string_view, 12> colours{"#88ccee", "#ddcc77", "#ee99aa", "#77bb88",
                                                   "#bbbbbb", "#ee8866", "#99ddff", "#bbcc33",
                                                   "#cc99bb", "#44bb99", "#eedd88", "#aaaadd"};

/// A step of 1, 2 or 5 times a power of ten, of which about `count` fit into a length.
double step_for(double length, double count) {
    const double least = length / count, ten = std::pow(10, std::floor(std::log10(least)));
    return least <= ten ? ten : least <= 2 * ten ? 2 * ten : least <= 5 * ten ? 5 * ten : 10 * ten;
}

std::string text_at(double x, double y, std::string_view more, std::string_view text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n", x, y, more,
                       xml_escaped(text));
}

/// The way of a fill: of the colours, then hatched in each of four ways.
class Fills {
public:
    /// Returns the fill for a unit or block, which is new if it was not asked for before.
    std::string of(const std::string& name) {
        const auto [at, is_new] = number_.try_emplace(name, names_.size());
        if (is_new) names_.push_back(name);
        return fill(at->second);
    }
    [[nodiscard]] std::string patterns() const {
        constexpr std::array<std::string_view, 4> hatches{"M0 0L8 8", "M0 8L8 0", "M0 4H8",
                                                          "M4 0V8"};
        std::string out;
        for (std::size_t i = colours.size(); i < names_.size(); ++i)
            out += fmt::format(
                "<pattern id=\"fill{}\" width=\"8\" height=\"8\" patternUnits=\"userSpaceOnUse\">"
                "<rect width=\"8\" height=\"8\" fill=\"{}\"/><path d=\"{}\" stroke=\"#444444\" "
                "stroke-width=\"1\"/></pattern>\n",
                i, colours[i % colours.size()], hatches[i / colours.size() % hatches.size()]);
        return out.empty() ? out : "<defs>\n" + out + "</defs>\n";
    }
    [[nodiscard]] std::string legend_at(double x, double y) const {
        std::string out;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const double at = y + 22 * static_cast<double>(i);
            out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"24\" height=\"14\" "
                               "fill=\"{}\" stroke=\"#444444\" stroke-width=\"0.5\"/>\n",
                               x, at, fill(i));
            out += text_at(x + 32, at + 11, "", names_[i]);
        }
        return out;
    }
    [[nodiscard]] std::size_t count() const { return names_.size(); }
    /// A bound of the width of the legend.
    [[nodiscard]] double width() const {
        constexpr double of_character = 7.5;
        std::size_t longest = 0;
        for (const std::string& name : names_) longest = std::max(longest, name.size());
        return 50 + of_character * static_cast<double>(longest);
    }

private:
    static std::string fill(std::size_t i) {
        return i < colours.size() ? std::string(colours[i]) : fmt::format("url(#fill{})", i);
    }
    std::map<std::string, std::size_t> number_;
    std::vector<std::string> names_;
};

class Drawing {
public:
    Drawing(const Section& section, const SectionNames& names) : section_(section), names_(names) {
        for (const auto& p : section.flat)
            for (const std::size_t k : {0U, 1U}) {
                low_[k] = std::min(low_[k], p[k]);
                high_[k] = std::max(high_[k], p[k]);
            }
        for (const std::size_t k : {0U, 1U})
            if (!(low_[k] < high_[k])) {
                low_[k] = (section.flat.empty() ? 0 : low_[k]) - 0.5;
                high_[k] = low_[k] + 1;
            }
        scale_ = std::min(most_wide / (high_[0] - low_[0]),
                          most_high / (high_[1] - low_[1]) / names.exaggeration);
    }

    std::string operator()() {
        const std::string parts = polygons() + lines();
        const double wide = left + width() + 30 + std::max(legend, fills_.width());
        const double high =
            std::max(top + height() + below, top + 22 * static_cast<double>(fills_.count()) + 20);
        return fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" "
                           "width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
                           "font-family=\"sans-serif\" font-size=\"12\">\n"
                           "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
                           wide, high) +
               fills_.patterns() + text_at(left, top - 22, " font-size=\"16\"", names_.title) +
               parts + axes() + scale_bar() + labels() +
               fills_.legend_at(left + width() + 30, top) + "</svg>\n";
    }

private:
    [[nodiscard]] double width() const { return scale_ * (high_[0] - low_[0]); }
    [[nodiscard]] double height() const {
        return scale_ * names_.exaggeration * (high_[1] - low_[1]);
    }
    [[nodiscard]] double x(double along) const { return left + scale_ * (along - low_[0]); }
    [[nodiscard]] double y(double up) const {
        return top + scale_ * names_.exaggeration * (high_[1] - up);
    }

    [[nodiscard]] std::string way(std::span<const std::uint32_t> vertices) const {
        std::string out;
        for (const std::uint32_t v : vertices)
            out += fmt::format("{}{:.2f} {:.2f}", out.empty() ? 'M' : 'L', x(section_.flat[v][0]),
                               y(section_.flat[v][1]));
        return out;
    }

    /// The unit of a block, or its name if it has none.
    [[nodiscard]] const std::string& shown_as(BlockId block) const {
        return names_.units[block].empty() ? names_.blocks[block] : names_.units[block];
    }

    std::string polygons() {
        std::string out;
        for (const SectionPolygon& polygon : section_.polygons) {
            std::string key = shown_as(names_.shown(polygon)),
                        name = names_.blocks[names_.shown(polygon)];
            if (names_.shows_pairs && polygon.block != 0 && polygon.behind != 0) {
                key = shown_as(polygon.block) + " | " + shown_as(polygon.behind);
                name = names_.blocks[polygon.block] + " | " + names_.blocks[polygon.behind];
            }
            std::string d;
            for (const auto& ring : polygon.rings) d += way(ring) + 'Z';
            out += fmt::format("<path d=\"{}\" fill=\"{}\" fill-rule=\"evenodd\"><title>{}</title>"
                               "</path>\n",
                               d, fills_.of(key), xml_escaped(name));
        }
        return out;
    }

    [[nodiscard]] std::string lines() const {
        std::string out;
        for (const SectionLine& line : section_.lines) {
            const SurfaceInfo& surface = names_.surfaces[line.surface];
            const bool fault = surface.role == Role::fault,
                       boundary = surface.role == Role::boundary;
            out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
                               "stroke-linejoin=\"round\"><title>{}</title></path>\n",
                               way(line.vertices),
                               fault      ? "#bb0000"
                               : boundary ? "#777777"
                                          : "black",
                               fault      ? 2
                               : boundary ? 0.6
                                          : 1.1,
                               xml_escaped(surface.name));
        }
        return out;
    }

    /// The length of a line in the drawing, and the place in its middle.
    [[nodiscard]] std::pair<double, std::array<double, 2>>
    middle_of(std::span<const std::uint32_t> v) const {
        const auto at = [&](std::size_t i) {
            return std::array{x(section_.flat[v[i]][0]), y(section_.flat[v[i]][1])};
        };
        std::vector<double> way{0};
        for (std::size_t i = 1; i < v.size(); ++i)
            way.push_back(way.back() +
                          std::hypot(at(i)[0] - at(i - 1)[0], at(i)[1] - at(i - 1)[1]));
        const double half = way.back() / 2;
        const auto after = std::lower_bound(way.begin() + 1, way.end(), half);
        const auto i = static_cast<std::size_t>(after - way.begin());
        const double share = way[i] > way[i - 1] ? (half - way[i - 1]) / (way[i] - way[i - 1]) : 0;
        return {way.back(),
                {at(i - 1)[0] + share * (at(i)[0] - at(i - 1)[0]),
                 at(i - 1)[1] + share * (at(i)[1] - at(i - 1)[1])}};
    }

    /// Names each surface at the middle of its longest line, but for boundaries; or each line by its height.
    [[nodiscard]] std::string labels() const {
        constexpr double least_named = 60; // pixels
        std::map<std::uint32_t, std::pair<double, std::array<double, 2>>> places;
        std::string out;
        const auto label = [&](const std::array<double, 2>& place, const std::string& text) {
            out += text_at(place[0], place[1] - 4,
                           " text-anchor=\"middle\" stroke=\"white\" stroke-width=\"3\" "
                           "paint-order=\"stroke\" stroke-linejoin=\"round\"",
                           text);
        };
        for (const SectionLine& line : section_.lines) {
            if (names_.surfaces[line.surface].role == Role::boundary) continue;
            const auto middle = middle_of(line.vertices);
            if (names_.shows_heights && middle.first >= least_named)
                label(middle.second, figure(section_.vertices[line.vertices[0]].z));
            auto& best = places[line.surface];
            if (middle.first > best.first) best = middle;
        }
        if (!names_.shows_heights)
            for (const auto& [surface, place] : places)
                label(place.second, names_.surfaces[surface].name);
        return out;
    }

    [[nodiscard]] std::string axes() const {
        const double bottom = top + height();
        std::string out = fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                                      "height=\"{:.1f}\" fill=\"none\" stroke=\"black\"/>\n",
                                      left, top, width(), height());
        const auto each = [](double low, double high, double pixels, const auto& tick) {
            const double step = step_for(high - low, std::max(2.0, pixels / 90));
            const double first = std::ceil(low / step) * step;
            for (int k = 0; k < 100 && first + k * step <= high; ++k) tick(first + k * step);
        };
        each(low_[0], high_[0], width(), [&](double at) {
            out += fmt::format("<path d=\"M{:.1f} {:.1f}v5\" stroke=\"black\"/>\n", x(at), bottom);
            out += text_at(x(at), bottom + 18, " text-anchor=\"middle\"", figure(at));
        });
        each(low_[1], high_[1], height(), [&](double at) {
            out += fmt::format("<path d=\"M{:.1f} {:.1f}h-5\" stroke=\"black\"/>\n", left, y(at));
            out += text_at(left - 8, y(at) + 4, " text-anchor=\"end\"", figure(at));
        });
        return out;
    }

    [[nodiscard]] std::string scale_bar() const {
        const double length = step_for(high_[0] - low_[0], 8), bottom = top + height() + 45;
        std::string out = fmt::format("<path d=\"M{0:.1f} {1:.1f}v6h{2:.1f}v-6\" fill=\"none\" "
                                      "stroke=\"black\" stroke-width=\"1.5\"/>\n",
                                      left, bottom, scale_ * length);
        std::string text = figure(length);
        if (!names_.length_unit.empty()) text += " " + names_.length_unit;
        if (names_.exaggeration != 1)
            text += fmt::format(", vertical exaggeration {}", figure(names_.exaggeration));
        return out + text_at(left, bottom + 22, "", text);
    }

    const Section& section_;
    const SectionNames& names_;
    static constexpr double none = std::numeric_limits<double>::infinity();
    std::array<double, 2> low_{none, none}, high_{-none, -none};
    double scale_ = 1; ///< pixels per unit of the model, along
    Fills fills_;
};

} // namespace

std::string section_svg(const Section& section, const SectionNames& names) {
    return Drawing(section, names)();
}

} // namespace terrane
