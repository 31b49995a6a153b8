#include <cmath>
#include <memory>

#include "canvas/drawing/edged_painter.h"
#include "canvas/drawing/track_captions.h"
#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

namespace {

constexpr double kArrowHead = 6;      ///< logical px
constexpr double kArrowSpread = 2.6;  ///< radians between the arrow and the sides of its head
constexpr double kShortestArrow = 4;  ///< logical px; an arrow of less is a dot

/// Of the selected track, or else of each one that is shown: the outline of its box with the shadow that is predicted
/// for it, and an arrow along it.
class ShadowLayer : public OverlayLayer {
 public:
    void paint(QPainter& painter, const OverlayScene& scene) const override {
        if (!scene.frame.shadow) return;
        QVector<QLineF> outlines;
        QVector<QLineF> arrows;
        visitShown(scene, [&](const TrackState& state) {
            if (scene.selected_track && scene.selected_track != state.id) return;
            const cv::Point2d reach = shadowReach(*scene.frame.shadow, state.box.centre, scene.frame.scale);
            appendOutline(outlines, shadowOutline(state.box, reach), scene);
            appendArrow(arrows, state.box.centre, state.box.centre + reach, scene);
        });
        const OverlayColours& colours = scene.style.colours;
        drawEdgedLines(painter, outlines, {colours.shadow, colours.edge, scene.style.line_width, Qt::DashLine});
        drawEdgedLines(painter, arrows, {colours.shadow, colours.edge, scene.style.line_width});
    }

 private:
    static QPointF inView(cv::Point2d point, const OverlayScene& scene) {
        return scene.transform.viewFromImage({point.x, point.y});
    }
    static void appendOutline(QVector<QLineF>& lines, const std::vector<cv::Point2d>& outline,
                              const OverlayScene& scene) {
        for (std::size_t i = 0; i < outline.size(); ++i)
            lines.append({inView(outline[i], scene), inView(outline[(i + 1) % outline.size()], scene)});
    }
    static void appendArrow(QVector<QLineF>& lines, cv::Point2d from, cv::Point2d to, const OverlayScene& scene) {
        const QLineF shaft(inView(from, scene), inView(to, scene));
        if (shaft.length() < kShortestArrow) return;
        const double angle = std::atan2(shaft.dy(), shaft.dx());
        lines.append(shaft);
        for (const double side : {angle + kArrowSpread, angle - kArrowSpread})
            lines.append({shaft.p2(), shaft.p2() + kArrowHead * QPointF(std::cos(side), std::sin(side))});
    }
};

}  // namespace

std::unique_ptr<OverlayLayer> shadowLayer() {
    return std::make_unique<ShadowLayer>();
}

}  // namespace eyrie::ui
