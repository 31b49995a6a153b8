#pragma once

#include <QCursor>
#include <QObject>
#include <functional>
#include <optional>
#include <vector>

#include "canvas/canvas_tool.h"
#include "core/review/zone.h"

namespace eyrie::ui {

class VideoView;

/// Draws a zone, a line or an arrow on the canvas: clicks set points, a double click, the right button or, while no
/// cross is shown, Enter ends it, Backspace takes the last point back, Escape gives up. Changes nothing itself.
class ZoneTool : public QObject, public CanvasTool {
    Q_OBJECT

 public:
    /// Works on the canvas while it draws; the canvas must outlive it.
    explicit ZoneTool(VideoView& canvas, QObject* parent = nullptr);
    ~ZoneTool() override;

    /// What becomes of the points, px of the frame shown: called when a drawing ends that holds enough of them.
    void setFinished(std::function<void(ZoneShape, const std::vector<cv::Point2d>&)> finished) {
        finished_ = std::move(finished);
    }
    /// Why a drawing cannot end yet, for people.
    void setRefused(std::function<void(const QString&)> refused) { refused_ = std::move(refused); }

    void start(ZoneShape shape);
    bool drawing() const { return shape_.has_value(); }
    std::optional<ZoneShape> shape() const { return shape_; }
    const std::vector<cv::Point2d>& points() const { return points_; }
    /// The picture below moved: the points are these now.
    void movePoints(std::vector<cv::Point2d> points);
    void finish();
    void cancel();

    void paint(QPainter& painter, const CanvasPlace& place) const override;
    bool press(const QMouseEvent& event, const CanvasPlace& place) override;
    bool move(const QMouseEvent& event, const CanvasPlace& place) override;
    bool release(const QMouseEvent& event, const CanvasPlace& place) override;
    bool doubleClick(const QMouseEvent& event, const CanvasPlace& place) override;
    void leave() override;
    const QCursor* cursor() const override;
    QString hint(const CanvasPlace& place) const override;
    bool takeBack() override;
    bool finishByKey() override;

 signals:
    /// Drawing began or ended.
    void drawingChanged();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    VideoView& canvas_;
    std::function<void(ZoneShape, const std::vector<cv::Point2d>&)> finished_ = [](ZoneShape, const auto&) {};
    std::function<void(const QString&)> refused_ = [](const QString&) {};
    std::optional<ZoneShape> shape_;
    std::vector<cv::Point2d> points_;
    std::optional<QPointF> mouse_;  ///< view coordinates; nothing while it is elsewhere
};

}  // namespace eyrie::ui
