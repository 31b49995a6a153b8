#include "removal/outlier_removal.h"

#include <algorithm>
#include <cmath>

#include "core/values/corner_density.h"
#include "removal/vector_support.h"

namespace eyrie {
namespace {

constexpr double kImageEdge = 0.5 + 1e-3;  // px beyond the middle of the outermost pixels, and rounding

/// By its corners: a share of areas would suffer from rounding.
bool whollyInImage(const OrientedBox& box, cv::Size image) {
    const OrientedBox around = box.upright();
    const double left = around.centre.x - around.length / 2;
    const double top = around.centre.y - around.width / 2;
    return left >= -kImageEdge && top >= -kImageEdge && left + around.length <= image.width - 1 + kImageEdge &&
           top + around.width <= image.height - 1 + kImageEdge;
}

/// The parameter that says so many vectors are needed.
const char* parameterOfNeeded(int needed, const OutlierRemovalOptions& options) {
    return needed > options.min_vectors ? "outliers.min_density_share" : "outliers.min_vectors";
}

/// Judges a detection by the vectors it has.
RemovalVerdict judgeSupportAndSize(const Detection& detection, const FrameMotion& motion,
                                   const OutlierRemovalOptions& options, const SceneScale& scale) {
    const int needed = vectorsNeeded(motion, options, scale.at(detection.box.centre));
    const auto count = static_cast<int>(detection.vectors.size());
    RemovalVerdict verdict{Rejection::none, parameterOfNeeded(needed, options), 1.0 * count, 1.0 * needed, false};
    verdict.moving_alike = options.compare_velocity;
    if (count < needed) {
        verdict.rejection = Rejection::outlier;
    } else if (const auto broken = brokenSizeLimit(detection.box, options, scale, motion.image_size)) {
        verdict = {Rejection::size, broken->parameter, broken->value, broken->limit, broken->at_most};
    }
    return verdict;
}

}  // namespace

std::optional<BrokenLimit> brokenSizeLimit(const OrientedBox& box, const OutlierRemovalOptions& options,
                                           const SceneScale& scale, cv::Size image) {
    const SceneScale here = scale.at(box.centre);
    const double shortest = here.px(options.min_length_m);
    const double longest = here.px(options.max_length_m);
    const double widest = here.px(options.max_width_m);
    if (!std::isfinite(box.area()) || box.area() < options.min_area)
        return BrokenLimit{"outliers.min_area", box.area(), options.min_area, false};
    if (options.inside_image && image.area() > 0 && !whollyInImage(box, image))
        return BrokenLimit{"outliers.inside_image", areaInImage(box, image) / box.area(), 1, false};
    if (box.length < shortest) return BrokenLimit{"outliers.min_length", box.length, shortest, false};
    if (options.max_length_m > 0 && box.length > longest)
        return BrokenLimit{"outliers.max_length", box.length, longest, true};
    if (options.max_width_m > 0 && box.width > widest)
        return BrokenLimit{"outliers.max_width", box.width, widest, true};
    return std::nullopt;
}

OutlierRemovalOptions OutlierRemovalOptions::thesis() {
    OutlierRemovalOptions options;
    options.min_vectors = 4;
    options.min_density_share = 0;
    options.vector_margin = 0;
    options.compare_velocity = false;
    options.min_length_m = 0;
    options.max_length_m = 0;
    options.max_width_m = 0;
    options.inside_image = true;
    return options;
}

void OutlierRemovalOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::removal);
    declare.integer("outliers.min_vectors", min_vectors, 0, 1000,
                    {"vectors", "T_out: detections with fewer motion vectors inside are rejected.", "Teutsch §5.5.2"});
    declare.real("outliers.min_density_share", min_density_share, 0, 2,
                 {"",
                  "T_out is at least this share of the vectors expected on a car at the corner density of the frame. 0 "
                  "switches it off.",
                  ""});
    declare.integer("outliers.max_min_vectors", max_min_vectors, 0, 1000,
                    {"vectors", "However dense the corners are, that many vectors are enough.", ""});
    declare.real("outliers.vector_margin", vector_margin, 0, 10,
                 {"px", "Motion vectors up to this far outside a box count as inside: corners lie on outlines.",
                  "Teutsch §5.5.2"});
    declare.flag("outliers.compare_velocity", compare_velocity,
                 {"", "Only vectors that move like the detection count as inside.", ""});
    declare.real("outliers.min_area", min_area, 0, 10000, {"px²", "Smaller boxes are rejected.", "Teutsch §5.4.1"});
    declare.real("outliers.min_length", min_length_m, 0, 100, {"m", "Shorter boxes are rejected; 0: no limit.", ""});
    declare.real("outliers.max_length", max_length_m, 0, 500, {"m", "Longer boxes are rejected; 0: no limit.", ""});
    declare.real("outliers.max_width", max_width_m, 0, 500, {"m", "Wider boxes are rejected; 0: no limit.", ""});
    declare.flag("outliers.inside_image", inside_image,
                 {"", "Boxes that reach beyond the image are rejected.", "Teutsch §7.4.3"});
}

int vectorsNeeded(const FrameMotion& motion, const OutlierRemovalOptions& options, const SceneScale& scale) {
    const double expected = cornersOnCar(motion, scale);
    const auto by_density = static_cast<int>(
        std::min(std::round(options.min_density_share * expected), static_cast<double>(options.max_min_vectors)));
    return std::max(options.min_vectors, by_density);
}

RemovalVerdict whyRemoved(const Detection& detection, const FrameMotion& motion, const OutlierRemovalOptions& options,
                          const SceneScale& scale) {
    const RemovalVerdict verdict = judgeSupportAndSize(detection, motion, options, scale);
    return verdict.rejection == detection.rejection ? verdict : RemovalVerdict{detection.rejection, {}, 0, 0, false};
}

std::vector<Detection> removeOutliers(std::vector<Detection> detections, const FrameMotion& motion,
                                      const OutlierRemovalOptions& options, const SceneScale& scale) {
    const double density = cornerDensity(motion);
    SupportRule rule;
    rule.margin_px = options.vector_margin;
    rule.compare_velocity = options.compare_velocity;
    for (Detection& detection : detections) {
        if (detection.rejection != Rejection::none) continue;
        measureSupport(detection, motion, rule);
        const SceneScale here = scale.at(detection.box.centre);
        if (!(detection.score > 0)) {
            const double car = carArea(here);
            // Boxes much smaller or larger than a car must not look surer or less sure for that alone.
            const double area = std::clamp(detection.box.area(), car / 2, car * 2);
            const double expected = std::max(1.0, density * area);
            detection.score = static_cast<double>(detection.vectors.size()) / expected;
        }
        detection.rejection = judgeSupportAndSize(detection, motion, options, scale).rejection;
    }
    return detections;
}

}  // namespace eyrie
