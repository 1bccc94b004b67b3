// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/cli/reports/seal_plot.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include <terrane/cli/session/quantities.hpp>
#include <terrane/io/text/xml.hpp>

namespace terrane::cli {
namespace {

constexpr double plot_left = 90, plot_right = 30, plot_width = 560, plot_top = 40,
                 plot_height = 190, plot_between = 60, below = 50;
constexpr std::string_view blue = "#4477aa", red = "#cc3311", grey = "#777777";

/// A logarithmic axis of distances.
class Axis {
public:
    explicit Axis(const SealAdvice& advice) {
        double least = HUGE_VAL, most = advice.choice.widest;
        const auto widen = [&](double distance) {
            if (distance > 0) least = std::min(least, distance);
            most = std::max(most, distance);
        };
        for (const SurfaceGap& gap : advice.choice.gaps) widen(gap.width);
        for (const SealTrial& trial : advice.trials) widen(trial.distance);
        if (!(most > 0)) most = 1;
        if (!(least < most)) least = most / 10;
        low_ = std::floor(std::log10(least));
        high_ = std::max(std::ceil(std::log10(most)), low_ + 1);
    }

    /// Returns the position of a distance; that of gaps of no width is the left end.
    [[nodiscard]] double at(double distance) const {
        if (!(distance > 0)) return plot_left;
        const double share = (std::log10(distance) - low_) / (high_ - low_);
        return plot_left + plot_width * std::clamp(share, 0.0, 1.0);
    }
    /// Draws lines and numbers at powers of ten, at most some ten of them.
    [[nodiscard]] std::string ticks(double y0) const {
        std::string out;
        const double step = std::ceil((high_ - low_) / 10);
        for (double decade = low_; decade <= high_; decade += step)
            out += fmt::format("<path d=\"M{0:.1f} {1:.1f}v5\" stroke=\"black\"/>\n"
                               "<text x=\"{0:.1f}\" y=\"{2:.1f}\" text-anchor=\"middle\">{3}"
                               "</text>\n",
                               at(std::pow(10, decade)), y0, y0 + 20, figure(std::pow(10, decade)));
        return out;
    }

private:
    double low_ = 0, high_ = 1; ///< powers of ten
};

std::string text_at(double x, double y, std::string_view anchor, const std::string& text) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y,
                       anchor, xml_escaped(text));
}

std::string frame(double y, const std::string& title, const std::string& most) {
    return fmt::format("<path d=\"M{0:.1f} {1:.1f}V{2:.1f}H{3:.1f}\" fill=\"none\" "
                       "stroke=\"black\"/>\n",
                       plot_left, y, y + plot_height, plot_left + plot_width) +
           text_at(plot_left, y - 12, "start", title) + text_at(plot_left - 6, y + 5, "end", most) +
           text_at(plot_left - 6, y + plot_height, "end", "0");
}

/// Draws the breaks as dashed lines through a panel, the chosen one in red.
std::string breaks(const SealChoice& choice, const Axis& axis, double y, bool named,
                   const Quantities& quantities) {
    std::string out;
    for (const GapBreak& b : choice.breaks) {
        const bool chosen = b.distance == choice.distance;
        out += fmt::format("<path d=\"M{:.1f} {:.1f}v{:.1f}\" stroke=\"{}\" stroke-dasharray=\"4 "
                           "3\"/>\n",
                           axis.at(b.distance), y, plot_height, chosen ? red : grey);
        if (named)
            out += text_at(axis.at(b.distance) + 4, y + 12, "start",
                           quantities.length(b.distance, 3) + (chosen ? ", chosen" : ""));
    }
    return out;
}

/// Draws the length of all gaps that are not wider than a distance, as steps.
std::string lengths(const SealChoice& choice, const Axis& axis, const Quantities& quantities) {
    double all = 0;
    for (const SurfaceGap& gap : choice.gaps) all += gap.length;
    std::string path = fmt::format("M{:.1f} {:.1f}", plot_left, plot_top + plot_height);
    double sum = 0;
    for (const SurfaceGap& gap : choice.gaps) {
        sum += gap.length;
        path += fmt::format("H{:.1f}V{:.1f}", axis.at(gap.width),
                            plot_top + plot_height * (1 - sum / all));
    }
    path += fmt::format("H{:.1f}", plot_left + plot_width);
    return frame(plot_top, "length of all gaps that are not wider than the distance",
                 quantities.length(all)) +
           fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n", path,
                       blue) +
           breaks(choice, axis, plot_top, true, quantities);
}

/// Draws blocks and small ones among them as bars, at the left end without sealing.
std::string blocks(const SealAdvice& advice, const Axis& axis, const Quantities& quantities) {
    const double y = plot_top + plot_height + plot_between;
    std::size_t most = 1;
    for (const SealTrial& trial : advice.trials) most = std::max(most, trial.blocks);
    std::string out = frame(y,
                            "blocks after sealing at the distance (grey: small ones); triangles "
                            "added or removed",
                            std::to_string(most));
    out += breaks(advice.choice, axis, y, false, quantities);
    const auto bar = [&](double x, std::size_t count, std::string_view colour) {
        const double high = plot_height * static_cast<double>(count) / static_cast<double>(most);
        return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"{:.1f}\" "
                           "fill=\"{}\"/>\n",
                           x - 7, y + plot_height - high, high, colour);
    };
    for (const SealTrial& trial : advice.trials) {
        const double x = trial.distance > 0 ? axis.at(trial.distance) : plot_left + 10;
        out += bar(x, trial.blocks, blue) + bar(x, trial.small, grey);
        out += text_at(x + 10, y + plot_height - 20, "start",
                       fmt::format("{}{}", trial.blocks, trial.distance > 0 ? "" : ", not sealed"));
        if (trial.triangles > 0)
            out += text_at(x + 10, y + plot_height - 6, "start",
                           fmt::format("{} triangles", trial.triangles));
    }
    return out;
}

} // namespace

std::string seal_plot(const SealAdvice& advice, const Inputs& inputs) {
    const Axis axis(advice);
    const Quantities quantities = inputs.quantities();
    const double whole_width = plot_left + plot_width + plot_right,
                 whole_height = plot_top + 2 * plot_height + plot_between + below;
    std::string out =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0:.0f}\" "
                    "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
                    "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
                    whole_width, whole_height);
    out += lengths(advice.choice, axis, quantities) + axis.ticks(plot_top + plot_height);
    out += blocks(advice, axis, quantities) + axis.ticks(plot_top + 2 * plot_height + plot_between);
    out += text_at(plot_left + plot_width / 2, whole_height - 10, "middle",
                   "distance" + (inputs.unit.empty() ? "" : ", " + inputs.unit));
    return out + "</svg>\n";
}

} // namespace terrane::cli
