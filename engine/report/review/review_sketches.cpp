#include <algorithm>
#include <cmath>

#include "io/tables/number_text.h"
#include "report/review/review_parts.h"
#include "report/svg_chart.h"

namespace eyrie {
namespace {

constexpr double kSide = 240;       ///< px of a sketch
constexpr double kSketchEdge = 26;  ///< around what is drawn
constexpr double kSpeed_s = 10;     ///< before and after the event
constexpr const char* kWayColour = "#9aa7b8";
constexpr const char* kEventColour = "#2d78c8";
constexpr const char* kPlaceColour = "#d64236";

std::string px(double value) {
    return fixedText(value, 1);
}

/// Metres on the ground to px of a sketch.
struct SketchFrame {
    cv::Point2d low;
    double scale = 1;
    cv::Point2d offset;
    std::string at(cv::Point2d metres) const {
        const cv::Point2d p = (metres - low) * scale + offset;
        return px(p.x) + "," + px(p.y);
    }
    cv::Point2d of(cv::Point2d metres) const { return (metres - low) * scale + offset; }
};

SketchFrame frameAround(const std::vector<cv::Point2d>& points, double least) {
    cv::Point2d low = points.front(), high = low;
    for (const cv::Point2d& point : points) {
        low = {std::min(low.x, point.x), std::min(low.y, point.y)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    SketchFrame frame;
    frame.low = low;
    frame.scale = (kSide - 2 * kSketchEdge) / std::max({high.x - low.x, high.y - low.y, least});
    const cv::Point2d used = (high - low) * frame.scale;
    frame.offset = {(kSide - used.x) / 2, (kSide - used.y) / 2};
    return frame;
}

std::string polyline(const std::string& points, const char* colour, double width) {
    return "<polyline fill=\"none\" stroke=\"" + std::string(colour) + "\" stroke-width=\"" + px(width) +
           "\" points=\"" + points + "\"/>";
}

/// The head of an arrow where a way ends.
std::string arrowHead(cv::Point2d end, cv::Point2d direction, const char* colour) {
    const double length = std::hypot(direction.x, direction.y);
    if (length < 1e-9) return {};
    const cv::Point2d along = direction * (1 / length), across(-along.y, along.x);
    const cv::Point2d tip = end + along * 9, left = end + across * 4.5, right = end - across * 4.5;
    return "<polygon fill=\"" + std::string(colour) + "\" points=\"" + px(tip.x) + "," + px(tip.y) + " " + px(left.x) +
           "," + px(left.y) + " " + px(right.x) + "," + px(right.y) + "\"/>";
}

std::string scaleBar(const SketchFrame& frame, const SceneScale& scale, double metres_per_px) {
    // Without a known GSD the ground is measured in px of its reference frame.
    const double unit = scale.gsd_known ? 1 : metres_per_px;
    const double length = niceStep((kSide - 2 * kSketchEdge) / frame.scale / unit, 4);
    const double wide = length * unit * frame.scale;
    const std::string y = px(kSide - 8);
    return "<line x1=\"10\" y1=\"" + y + "\" x2=\"" + px(10 + wide) + "\" y2=\"" + y +
           "\" stroke=\"#333333\" stroke-width=\"2\"/><text x=\"10\" y=\"" + px(kSide - 13) + "\" fill=\"#333333\">" +
           fixedText(length, 2) + (scale.gsd_known ? " m" : " px") + "</text>";
}

/// An arrow to the north in the upper right corner; empty where it is not known.
std::string northArrow(const ReviewScene& scene, const Event& event) {
    constexpr double kReach_px = 8;
    const GeoReference& places = scene.input().places;
    const auto here = places.metresOf(event.frame, event.place);
    const auto right = places.metresOf(event.frame, event.place + cv::Point2d(kReach_px, 0));
    const auto below = places.metresOf(event.frame, event.place + cv::Point2d(0, kReach_px));
    if (!here || !right || !below || scene.ground().of(event.frame) == nullptr) return {};
    const cv::Point2d x = *right - *here, y = *below - *here;
    // The step in the picture that leads straight north: the inverse of the local map, times (0, 1).
    const cv::Point2d north = cv::Point2d(-y.x, x.x) * (1 / x.cross(y));
    const double length = std::hypot(north.x, north.y);
    if (!std::isfinite(length) || length < 1e-12) return {};
    const cv::Point2d step = scene.ground().toGround(event.frame, event.place + north * (kReach_px / length)) -
                             scene.ground().toGround(event.frame, event.place);
    const cv::Point2d up = step * (1 / std::max(1e-12, std::hypot(step.x, step.y)));
    const cv::Point2d middle(kSide - 22, 24), end = middle + up * 7, begin = middle - up * 12;
    return "<line x1=\"" + px(begin.x) + "\" y1=\"" + px(begin.y) + "\" x2=\"" + px(end.x) + "\" y2=\"" + px(end.y) +
           "\" stroke=\"#333333\" stroke-width=\"1.5\"/>" + arrowHead(end, up, "#333333") + "<text x=\"" +
           px(kSide - 46) + "\" y=\"16\" fill=\"#333333\">N</text>";
}

}  // namespace

std::string pathSketch(const ReviewScene& scene, const Event& event) {
    std::vector<const GroundPath*> ways;
    std::vector<cv::Point2d> points;
    int stretch = scene.ground().indexOf(event.frame);
    for (const TrackId track : event.tracks) {
        const GroundPath* way = scene.pathOf(track, event.frame);
        if (way == nullptr || (stretch >= 0 && way->stretch != stretch)) continue;
        stretch = way->stretch;
        ways.push_back(way);
        for (const GroundSample& sample : way->samples) points.push_back(sample.at);
    }
    if (points.empty()) return {};
    const SceneScale& scale = scene.ground().footage().scale;
    const double metres_per_px = scene.ground().all()[static_cast<std::size_t>(stretch)].metres_per_px;
    const SketchFrame frame = frameAround(points, 20 * metres_per_px);
    const std::string side = px(kSide);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + side + "\" height=\"" + side +
                      "\" viewBox=\"0 0 " + side + " " + side + "\" font-family=\"sans-serif\" font-size=\"12\">" +
                      "<rect width=\"" + side + "\" height=\"" + side + "\" fill=\"#f6f7f9\"/>";
    for (const GroundPath* way : ways) {
        std::string all, part;
        for (const GroundSample& sample : way->samples) {
            all += frame.at(sample.at) + " ";
            if (sample.frame >= event.first_frame && sample.frame <= event.last_frame)
                part += frame.at(sample.at) + " ";
        }
        const cv::Point2d begin = frame.of(way->samples.front().at), end = frame.of(way->samples.back().at);
        svg += polyline(all, kWayColour, 2) + polyline(part, kEventColour, 3.5) + "<circle cx=\"" + px(begin.x) +
               "\" cy=\"" + px(begin.y) + "\" r=\"4\" fill=\"" + kWayColour + "\"/>" +
               arrowHead(end, way->samples.back().velocity, kWayColour);
    }
    if (scene.ground().of(event.frame) != nullptr && scene.ground().indexOf(event.frame) == stretch) {
        const cv::Point2d place = frame.of(scene.ground().toGround(event.frame, event.place));
        svg += "<circle cx=\"" + px(place.x) + "\" cy=\"" + px(place.y) + "\" r=\"7\" fill=\"none\" stroke=\"" +
               kPlaceColour + "\" stroke-width=\"2\"/>";
    }
    return svg + scaleBar(frame, scale, metres_per_px) + northArrow(scene, event) + "</svg>";
}

std::string speedSketch(const ReviewScene& scene, const Event& event) {
    const SceneScale& scale = scene.ground().footage().scale;
    const double begin = scene.secondsOf(event.first_frame) - kSpeed_s;
    const double end = scene.secondsOf(event.last_frame) + kSpeed_s;
    CurveChart chart{"seconds of the video", scale.gsd_known ? "km/h" : "px/frame", {}, {}, 0, false};
    std::map<FrameIndex, std::vector<double>> values;
    std::size_t count = 0;
    for (const TrackId track : event.tracks) {
        const GroundPath* way = scene.pathOf(track, event.frame);
        if (way == nullptr || !way->measured) continue;
        for (const GroundSample& sample : way->samples) {
            const double at = scene.secondsOf(sample.frame);
            if (at < begin || at > end) continue;
            auto& row = values[sample.frame];
            row.resize(count, std::nan(""));
            row.push_back(scale.gsd_known ? sample.speed * 3.6 : scale.pxPerFrame(sample.speed));
        }
        ++count;
        static constexpr const char* kColours[] = {"#2d78c8", "#2e9650", "#dea014", "#d64236", "#7a4fb5"};
        chart.series.push_back({std::to_string(track), kColours[(count - 1) % 5], {}});
    }
    if (values.size() < 2) return {};
    for (auto& [frame, row] : values) {
        row.resize(count, std::nan(""));
        chart.places.push_back(scene.secondsOf(frame));
        for (std::size_t i = 0; i < count; ++i) chart.series[i].values.push_back(row[i]);
    }
    return curvesSvg(chart, {480, 240});
}

}  // namespace eyrie
