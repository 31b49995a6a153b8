#pragma once

#include <QCursor>
#include <QObject>
#include <QPointF>
#include <functional>
#include <optional>

#include "canvas/canvas_tool.h"
#include "core/geometry/oriented_box.h"

namespace eyrie::ui {

class VideoView;

/// Draws one upright box on the canvas by dragging; Escape gives up. Changes nothing itself.
class VehicleBoxTool : public QObject, public CanvasTool {
    Q_OBJECT

 public:
    /// Works on the canvas while it draws; the canvas must outlive it.
    explicit VehicleBoxTool(VideoView& canvas, QObject* parent = nullptr);

    /// What becomes of the box, px of the frame shown; it points to the right, or upwards where it is higher than wide.
    void setFinished(std::function<void(const OrientedBox&)> finished) { finished_ = std::move(finished); }
    /// Drawing began or ended.
    void setDrawingChanged(std::function<void()> changed) { drawing_changed_ = std::move(changed); }

    void start();
    void cancel();
    bool drawing() const { return drawing_; }

    void paint(QPainter& painter, const CanvasPlace& place) const override;
    bool press(const QMouseEvent& event, const CanvasPlace& place) override;
    bool move(const QMouseEvent& event, const CanvasPlace& place) override;
    bool release(const QMouseEvent& event, const CanvasPlace& place) override;
    bool doubleClick(const QMouseEvent& event, const CanvasPlace& place) override;
    void leave() override {}
    const QCursor* cursor() const override;
    QString hint(const CanvasPlace& place) const override;
    bool dragsFrom(QPointF, const CanvasPlace&) const override { return true; }
    bool takeBack() override;

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    VideoView& canvas_;
    std::function<void(const OrientedBox&)> finished_ = [](const OrientedBox&) {};
    std::function<void()> drawing_changed_ = [] {};
    bool drawing_ = false;
    std::optional<QPointF> pressed_;  ///< px of the frame, while the button is down
    QPointF dragged_;                 ///< the same
};

}  // namespace eyrie::ui
