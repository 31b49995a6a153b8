#pragma once

#include <QCursor>
#include <QObject>
#include <functional>
#include <opencv2/core/types.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "canvas/canvas_tool.h"

namespace eyrie::ui {

class VideoView;

/// Moves the points of a zone, a line or an arrow on the canvas: by dragging them, or with Tab, which goes to the next,
/// Enter, which takes hold of it and lets it go, and arrows. Escape ends it, and so does Enter while no cross is shown.
/// Changes nothing itself.
class ZonePointsTool : public QObject, public CanvasTool {
    Q_OBJECT

 public:
    using Points = std::vector<cv::Point2d>;  ///< px of the frame shown

    /// Works on the canvas between start() and end(); the canvas must outlive it.
    explicit ZonePointsTool(VideoView& canvas, QObject* parent = nullptr);
    ~ZonePointsTool() override;

    /// What becomes of a point that was let go elsewhere.
    void setMoved(std::function<void(std::size_t point, cv::Point2d to)> moved) { moved_ = std::move(moved); }
    void start(Points points, bool closed);
    /// Where they lie now, as in another frame; what is held is let go if they are others.
    void setPoints(Points points);
    const Points& points() const { return points_; }
    void end();
    bool active() const;

    void paint(QPainter& painter, const CanvasPlace& place) const override;
    bool press(const QMouseEvent& event, const CanvasPlace& place) override;
    bool move(const QMouseEvent& event, const CanvasPlace& place) override;
    bool release(const QMouseEvent& event, const CanvasPlace& place) override;
    bool doubleClick(const QMouseEvent& event, const CanvasPlace& place) override;
    void leave() override {}
    const QCursor* cursor() const override;
    QString hint(const CanvasPlace& place) const override;
    bool dragsFrom(QPointF view_point, const CanvasPlace& place) const override {
        return pointAt(view_point, place.transform).has_value();
    }
    bool takeBack() override;
    bool finishByKey() override;

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    struct Held {
        std::size_t point = 0;
        cv::Point2d from;
        QPointF pressed_at;  ///< view coordinates
        bool moved = false;  ///< by more than a hand shakes
    };
    std::optional<std::size_t> pointAt(QPointF view_point, const ViewTransform& transform) const;
    void goToPoint(int further);

    VideoView& canvas_;
    std::function<void(std::size_t, cv::Point2d)> moved_ = [](std::size_t, cv::Point2d) {};
    Points points_;
    bool closed_ = true;
    bool started_ = false;
    std::optional<Held> held_;
    int at_ = -1;  ///< the point that Tab went to last
};

}  // namespace eyrie::ui
