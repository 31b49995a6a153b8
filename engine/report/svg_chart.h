#pragma once

#include <string>
#include <vector>

/// Charts as SVG text, for reports. Sizes in px of the picture.
namespace eyrie {

/// Of a chart, in px of CSS.
struct ChartSize {
    int width = 720;
    int height = 240;
};

/// A curve, or a band of a stack.
struct ChartSeries {
    std::string name;
    std::string colour;          ///< "#2e9650"
    std::vector<double> values;  ///< NaN: a gap
};

/// Curves over the same places.
struct CurveChart {
    std::string place_label;
    std::string value_label;
    std::vector<double> places;  ///< ascending
    std::vector<ChartSeries> series;
    double top = 0;        ///< end of the value axis; 0: as the values need
    bool stacked = false;  ///< areas on top of each other
};

/// A bar with its text.
struct ChartBar {
    std::string name;
    std::string colour;
    double value = 0;
};

/// An SVG of curves, or of areas on top of each other, with axes and a legend.
std::string curvesSvg(const CurveChart& chart, ChartSize size = {});
/// Upright columns from `values` in [0, 1] with lines at the given shares.
std::string sharesSvg(const std::vector<ChartBar>& bars, const std::vector<double>& lines, const std::string& label,
                      ChartSize size = {720, 160});
/// Bars that lie, one below the other, with name and value.
std::string lyingBarsSvg(const std::vector<ChartBar>& bars, int width = 720);

/// Steps of 1, 2 or 5 · 10ⁿ that divide a range from 0 into at most about `most` parts.
double niceStep(double top, int most);

}  // namespace eyrie
