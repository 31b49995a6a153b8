#pragma once

#include <QCursor>
#include <QObject>
#include <QPointF>
#include <functional>
#include <optional>
#include <vector>

#include "canvas/canvas_tool.h"

namespace eyrie::ui {

class VideoView;

/// A control point as it lies in the frame shown.
struct ControlPointMark {
    int number = 0;  ///< as listed, from 1
    QPointF px;
    bool own = false;      ///< set in this frame; others were carried here by the registration and cannot be moved
    bool suspect = false;  ///< contradicts the others
};

/// What a person does to control points with the mouse and keys of the canvas.
struct ControlPointCommands {
    std::function<void(QPointF px)> add = [](QPointF) {};
    std::function<void(int number, QPointF px)> move = [](int, QPointF) {};
    std::function<void()> undo = [] {};
    std::function<void()> redo = [] {};
};

/// Sets control points on the canvas: a click adds one, dragging moves one, Z undoes, Escape or Enter ends it. Changes
/// nothing itself.
class ControlPointTool : public QObject, public CanvasTool {
    Q_OBJECT

 public:
    /// Works on the canvas between start() and end(); the canvas must outlive it.
    explicit ControlPointTool(VideoView& canvas, QObject* parent = nullptr);
    ~ControlPointTool() override;

    void setCommands(ControlPointCommands commands) { commands_ = std::move(commands); }
    void setMarks(std::vector<ControlPointMark> marks);
    const std::vector<ControlPointMark>& marks() const { return marks_; }
    /// A place whose coordinates are being asked for.
    void setDraft(std::optional<QPointF> px);

    /// Not while another tool is at work.
    void start();
    void end();
    bool active() const { return active_; }

    void paint(QPainter& painter, const CanvasPlace& place) const override;
    bool press(const QMouseEvent& event, const CanvasPlace& place) override;
    bool move(const QMouseEvent& event, const CanvasPlace& place) override;
    bool release(const QMouseEvent& event, const CanvasPlace& place) override;
    bool doubleClick(const QMouseEvent& event, const CanvasPlace& place) override;
    void leave() override {}
    const QCursor* cursor() const override;
    QString hint(const CanvasPlace& place) const override;
    bool dragsFrom(QPointF view_point, const CanvasPlace& place) const override {
        return markAt(view_point, place) != nullptr;
    }
    bool takeBack() override;
    bool finishByKey() override;

 signals:
    /// It began or ended.
    void activeChanged();

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    const ControlPointMark* markAt(QPointF view_point, const CanvasPlace& place) const;

    VideoView& canvas_;
    ControlPointCommands commands_;
    std::vector<ControlPointMark> marks_;
    std::optional<QPointF> draft_;
    bool active_ = false;
    std::optional<int> dragged_;         ///< number of the mark that is held
    std::optional<QPointF> pressed_px_;  ///< px of the frame, while the button is down
    QPointF held_px_;                    ///< where the mark that is held was
    bool moved_ = false;                 ///< by more than a hand shakes
};

}  // namespace eyrie::ui
