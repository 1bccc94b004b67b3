// SPDX-License-Identifier: LGPL-3.0-or-later
#include <terrane/io/text/histogram_svg.hpp>

#include <algorithm>

#include <fmt/format.h>

#include <terrane/io/text/xml.hpp>

namespace terrane {
namespace {

constexpr double width = 360, height = 240, left = 55, top = 40, gap = 40, below = 45;

std::string bars(const Histogram& h, double x0, double largest) {
    std::string out;
    const double each = width / static_cast<double>(h.counts.size());
    for (std::size_t i = 0; i < h.counts.size(); ++i) {
        if (h.counts[i] == 0) continue;
        const double high = height * static_cast<double>(h.counts[i]) / largest;
        out += fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                           "fill=\"#4477aa\"><title>{}</title></rect>\n",
                           x0 + static_cast<double>(i) * each + 0.5, top + height - high, each - 1,
                           high, h.counts[i]);
    }
    return out;
}

std::string axes(const Histogram& h, double x0, double largest) {
    const double y0 = top + height;
    std::string out = fmt::format("<path d=\"M{0:.2f} {1:.2f}V{2:.2f}H{3:.2f}\" fill=\"none\" "
                                  "stroke=\"black\"/>\n",
                                  x0, top, y0, x0 + width);
    for (int tenth = 0; tenth <= 10; tenth += 2)
        out += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{:.1f}</text>\n",
                           x0 + width * tenth / 10, y0 + 16, tenth / 10.0);
    out += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">q</text>\n",
                       x0 + width / 2, y0 + 34);
    out += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">{}</text>\n", x0 - 5,
                       top + 5, static_cast<std::size_t>(largest));
    out +=
        fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"end\">0</text>\n", x0 - 5, y0);
    out += fmt::format("<path d=\"M{0:.2f} {1:.2f}V{2:.2f}\" stroke=\"#cc3311\" "
                       "stroke-dasharray=\"4 3\"><title>mean {3:.4f}</title></path>\n",
                       x0 + width * h.mean, top, y0, h.mean);
    out += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"middle\">{}</text>\n",
                       x0 + width / 2, top - 16, xml_escaped(h.title));
    return out;
}

} // namespace

std::string histogram_svg(std::span<const Histogram> histograms) {
    const double whole = left + static_cast<double>(histograms.size()) * (width + left + gap);
    std::string out =
        fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" width=\"{0:.0f}\" "
                    "height=\"{1:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
                    "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"white\"/>\n",
                    whole, top + height + below);
    double x0 = left;
    for (const Histogram& h : histograms) {
        const double largest = static_cast<double>(std::max<std::size_t>(
            1, h.counts.empty() ? 1 : *std::max_element(h.counts.begin(), h.counts.end())));
        out += bars(h, x0, largest) + axes(h, x0, largest);
        x0 += width + left + gap;
    }
    return out + "</svg>\n";
}

} // namespace terrane
