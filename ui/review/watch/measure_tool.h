#pragma once

#include <QCursor>
#include <QObject>
#include <optional>

#include "canvas/canvas_tool.h"
#include "ground/ground_measure.h"

namespace eyrie::ui {

class ProjectSession;
class VideoView;
class WatchedGround;

/// Measures on the canvas: two clicks tell how far two places of the ground are from each other; where the frame was
/// changed between the clicks, also how fast one gets from the first to the second. Both stay on the ground while the
/// video goes on. A third click begins anew.
class MeasureTool : public QObject, public CanvasTool {
    Q_OBJECT

 public:
    /// All must outlive it; while it works, the canvas must.
    MeasureTool(ProjectSession& session, VideoView& canvas, WatchedGround& ground, QObject* parent = nullptr);
    ~MeasureTool() override;

    void start();
    void end();
    bool measuring() const { return measuring_; }
    /// What is measured now, up to the cursor while the second place is not set: "12.4 m", "12.4 m in 3.2 s: 14 km/h";
    /// why not, or what to do.
    QString text() const;

    void paint(QPainter& painter, const CanvasPlace& place) const override;
    bool press(const QMouseEvent& event, const CanvasPlace& place) override;
    bool move(const QMouseEvent& event, const CanvasPlace& place) override;
    bool release(const QMouseEvent& event, const CanvasPlace& place) override;
    bool doubleClick(const QMouseEvent& event, const CanvasPlace& place) override;
    void leave() override;
    const QCursor* cursor() const override;
    QString hint(const CanvasPlace& place) const override;
    bool takeBack() override;

 signals:
    /// It began or ended.
    void measuringChanged();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    std::optional<FramePoint> shownHere(const FramePoint& point) const;
    std::optional<QPointF> inView(const std::optional<FramePoint>& point, const CanvasPlace& place) const;
    std::optional<FramePoint> farEnd() const;
    std::optional<GroundMeasure> between(const FramePoint& from, const FramePoint& to) const;

    ProjectSession& session_;
    VideoView& canvas_;
    WatchedGround& ground_;
    bool measuring_ = false;
    std::optional<FramePoint> from_;
    std::optional<FramePoint> to_;
    std::optional<QPointF> mouse_;  ///< image coordinates of the frame shown
};

}  // namespace eyrie::ui
