#include "report/svg_chart.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr double kLeft = 58;
constexpr double kRight = 12;
constexpr double kTop = 26;
constexpr double kBottom = 40;
constexpr int kMostTicks = 8;
constexpr double kBarHeight = 20;

std::string n(double value) {
    return fixedText(value, 1);
}

std::string beginning(double width, double height) {
    const std::string w = n(width);
    const std::string h = n(height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + w + "\" height=\"" + h + "\" viewBox=\"0 0 " + w +
           " " + h + "\" font-family=\"sans-serif\" font-size=\"12\"><rect width=\"" + w + "\" height=\"" + h +
           "\" fill=\"#ffffff\"/>";
}

std::string text(double x, double y, const std::string& anchor, const std::string& words) {
    return "<text x=\"" + n(x) + "\" y=\"" + n(y) + "\" text-anchor=\"" + anchor + "\" fill=\"#333333\">" +
           markupEscaped(words) + "</text>";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour) {
    return "<line x1=\"" + n(x1) + "\" y1=\"" + n(y1) + "\" x2=\"" + n(x2) + "\" y2=\"" + n(y2) + "\" stroke=\"" +
           colour + "\" stroke-width=\"1\"/>";
}

std::string rectangle(double x, double y, double width, double height, const std::string& colour) {
    return "<rect x=\"" + n(x) + "\" y=\"" + n(y) + "\" width=\"" + n(width) + "\" height=\"" + n(height) +
           "\" fill=\"" + colour + "\"/>";
}

/// Where values and places lie in the picture.
struct Plot {
    double width, height, first, last, top;
    double x(double place) const {
        return kLeft + (last > first ? (place - first) / (last - first) : 0) * (width - kLeft - kRight);
    }
    double y(double value) const { return height - kBottom - value / top * (height - kTop - kBottom); }
};

std::string axes(const Plot& plot, const CurveChart& chart) {
    std::string svg;
    const double value_step = niceStep(plot.top, 5);
    for (double value = 0; value <= plot.top * 1.0001; value += value_step) {
        svg += line(kLeft, plot.y(value), plot.width - kRight, plot.y(value), "#dddddd");
        svg += text(kLeft - 6, plot.y(value) + 4, "end", fixedText(value, value_step < 1 ? 2 : 0));
    }
    const double place_step = std::max(1.0, niceStep(plot.last - plot.first, kMostTicks));
    for (double place = std::ceil(plot.first / place_step) * place_step; place <= plot.last; place += place_step) {
        svg += line(plot.x(place), plot.height - kBottom, plot.x(place), plot.height - kBottom + 4, "#666666");
        svg += text(plot.x(place), plot.height - kBottom + 17, "middle", fixedText(place, 0));
    }
    svg += line(kLeft, plot.height - kBottom, plot.width - kRight, plot.height - kBottom, "#666666");
    svg += text((kLeft + plot.width - kRight) / 2, plot.height - 6, "middle", chart.place_label);
    svg += "<text transform=\"translate(14," + n((kTop + plot.height - kBottom) / 2) +
           ") rotate(-90)\" text-anchor=\"middle\" fill=\"#333333\">" + markupEscaped(chart.value_label) + "</text>";
    return svg;
}

std::string legend(const CurveChart& chart) {
    std::string svg;
    double x = kLeft;
    for (const ChartSeries& one : chart.series) {
        svg += rectangle(x, 8, 12, 10, one.colour);
        svg += text(x + 17, 17, "start", one.name);
        x += 40 + 8.0 * static_cast<double>(one.name.size());
    }
    return svg;
}

}  // namespace

double niceStep(double top, int most) {
    const double least = std::max(1e-9, top) / std::max(1, most);
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= least * (1 - 1e-9)) return factor * power;
    return 10 * power;
}

std::string curvesSvg(const CurveChart& chart, ChartSize size) {
    std::vector<double> below(chart.places.size(), 0);
    std::vector<std::vector<double>> heights;
    double largest = 0;
    for (const ChartSeries& one : chart.series) {
        std::vector<double> values = one.values;
        values.resize(chart.places.size(), std::nan(""));
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (chart.stacked) values[i] = below[i] += std::isfinite(values[i]) ? values[i] : 0;
            if (std::isfinite(values[i])) largest = std::max(largest, values[i]);
        }
        heights.push_back(std::move(values));
    }
    Plot plot{static_cast<double>(size.width), static_cast<double>(size.height), 0, 1, 1};
    if (!chart.places.empty()) {
        plot.first = chart.places.front();
        plot.last = std::max(chart.places.back(), plot.first + 1);
    }
    plot.top = chart.top > 0 ? chart.top : std::max(1.0, largest * 1.05);
    std::string svg = beginning(plot.width, plot.height) + axes(plot, chart);
    for (std::size_t s = heights.size(); s-- > 0;) {
        std::string points;
        const auto finish = [&](double last_place) {
            if (points.empty()) return;
            if (chart.stacked)
                svg += "<polygon fill=\"" + chart.series[s].colour + "\" points=\"" + n(plot.x(plot.first)) + "," +
                       n(plot.y(0)) + " " + points + n(plot.x(last_place)) + "," + n(plot.y(0)) + "\"/>";
            else
                svg += "<polyline fill=\"none\" stroke-width=\"1.8\" stroke=\"" + chart.series[s].colour +
                       "\" points=\"" + points + "\"/>";
            points.clear();
        };
        double last_place = plot.first;
        for (std::size_t i = 0; i < heights[s].size(); ++i) {
            if (!std::isfinite(heights[s][i])) {
                finish(last_place);
                continue;
            }
            last_place = chart.places[i];
            points += n(plot.x(last_place)) + "," + n(plot.y(heights[s][i])) + " ";
        }
        finish(last_place);
    }
    return svg + legend(chart) + "</svg>";
}

std::string sharesSvg(const std::vector<ChartBar>& bars, const std::vector<double>& lines, const std::string& label,
                      ChartSize size) {
    const Plot plot{static_cast<double>(size.width), static_cast<double>(size.height), 0, 1, 1};
    std::string svg = beginning(plot.width, plot.height);
    for (const double share : lines) {
        svg += line(kLeft, plot.y(share), plot.width - kRight, plot.y(share), "#dddddd");
        svg += text(kLeft - 6, plot.y(share) + 4, "end", fixedText(share * 100, 0) + " %");
    }
    const double step = (plot.width - kLeft - kRight) / std::max<double>(1, static_cast<double>(bars.size()));
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const double y = plot.y(bars[i].value);
        svg += rectangle(kLeft + static_cast<double>(i) * step, y, std::max(0.8, step - (step > 4 ? 1 : 0)),
                         plot.height - kBottom - y, bars[i].colour);
    }
    svg += line(kLeft, plot.height - kBottom, plot.width - kRight, plot.height - kBottom, "#666666");
    svg += text((kLeft + plot.width - kRight) / 2, plot.height - 14, "middle", label);
    return svg + "</svg>";
}

std::string lyingBarsSvg(const std::vector<ChartBar>& bars, int width) {
    constexpr double kNames = 190;
    constexpr double kValues = 60;
    double largest = 1;
    for (const ChartBar& bar : bars) largest = std::max(largest, bar.value);
    std::string svg = beginning(width, kBarHeight * static_cast<double>(std::max<std::size_t>(1, bars.size())) + 8);
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const double top = 4 + kBarHeight * static_cast<double>(i);
        const double length = bars[i].value / largest * (width - kNames - kValues);
        svg += text(kNames - 8, top + 14, "end", bars[i].name);
        svg += rectangle(kNames, top + 3, std::max(1.0, length), kBarHeight - 6, bars[i].colour);
        svg += text(kNames + length + 6, top + 14, "start", fixedText(bars[i].value, 0));
    }
    return svg + "</svg>";
}

}  // namespace eyrie
