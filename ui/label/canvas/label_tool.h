#pragma once

#include <QCursor>
#include <QObject>
#include <QPointF>
#include <functional>
#include <optional>

#include "canvas/canvas_tool.h"
#include "canvas/drawing/loupe.h"
#include "label/canvas/box_handles.h"
#include "label/canvas/label_mark.h"
#include "widgets/delayed_call.h"

namespace eyrie::ui {

/// What the hand does on the canvas.
struct LabelToolCommands {
    /// Drawing, of a box or of a region, began or ended.
    std::function<void(bool drawing)> show_drawing = [](bool) {};
    std::function<void(bool drawing)> show_region_drawing = [](bool) {};
    /// At least three corners, px of the frame.
    std::function<void(const std::vector<cv::Point2d>& polygon, FrameIndex frame)> add_region =
        [](const std::vector<cv::Point2d>&, FrameIndex) {};
    std::function<void(const OrientedBox& box, FrameIndex frame)> add_box = [](const OrientedBox&, FrameIndex) {};
    std::function<void(ObjectId object, FrameIndex frame, const OrientedBox& box)> redraw_box =
        [](ObjectId, FrameIndex, const OrientedBox&) {};
    /// `turned`: by its turning handle.
    std::function<void(ObjectId object, FrameIndex frame, const OrientedBox& box, bool turned, bool resized)>
        change_box = [](ObjectId, FrameIndex, const OrientedBox&, bool, bool) {};
    /// An object was pointed at, or nothing; `add`: with Ctrl or Shift held.
    std::function<void(std::optional<ObjectId> object, bool add)> choose_object = [](std::optional<ObjectId>, bool) {};
    std::function<void(TrackId track, bool add)> choose_proposal = [](TrackId, bool) {};
};

/// Labels drawn and changed with the mouse. Changes nothing itself: it draws what it was given, shows a box that is
/// being drawn or dragged, and tells what came of it.
class LabelTool : public QObject, public CanvasTool {
    Q_OBJECT

 public:
    explicit LabelTool(QObject* parent = nullptr);
    void setCommands(LabelToolCommands commands) { commands_ = std::move(commands); }
    const LabelToolCommands& commands() const { return commands_; }

    void setScene(LabelScene scene);
    const LabelScene& scene() const { return scene_; }
    void setLoupeShown(bool shown) { loupe_shown_ = shown; }
    /// What the selected object looks like over many frames; shown while its frame and object are.
    void setStack(std::optional<LoupeStack> stack);
    void setStackShown(bool shown);
    /// The stack that a loupe shows now, or would show.
    const LoupeStack* stackHere() const;
    /// A key moved or turned the box: for a moment the loupe stands beside it.
    void showNudged();

    /// The next clicks draw an object: rear, front, and its width where no size is known or Shift is held. Dragging
    /// draws an upright one. With an object its box is drawn anew.
    void startDrawing(std::optional<ObjectId> object = std::nullopt);
    bool drawing() const { return drawing_; }
    /// The next clicks are the corners of an ignore region; a double click, the right button or Enter ends it.
    void startRegion();
    bool drawingRegion() const { return region_.has_value(); }
    /// Where the mouse is, image coordinates; nothing while it is elsewhere.
    const std::optional<QPointF>& cursorInImage() const { return cursor_image_; }
    /// Gives up drawing or dragging; answers whether there was anything to give up.
    bool cancel();
    /// The box being drawn or dragged.
    const std::optional<OrientedBox>& draft() const { return draft_; }

    void paint(QPainter& painter, const CanvasPlace& place) const override;
    bool press(const QMouseEvent& event, const CanvasPlace& place) override;
    bool move(const QMouseEvent& event, const CanvasPlace& place) override;
    bool release(const QMouseEvent& event, const CanvasPlace& place) override;
    bool doubleClick(const QMouseEvent& event, const CanvasPlace& place) override;
    void leave() override;
    const QCursor* cursor() const override;
    QString hint(const CanvasPlace& place) const override;
    bool takesPlaces() const override { return drawing_ || region_; }
    bool takeBack() override;
    bool finishByKey() override;

 signals:
    /// Something looks different.
    void repaintNeeded();

 private:
    const LabelMark* selectedMark() const;
    void paintLoupes(QPainter& painter, const CanvasPlace& place) const;
    void finishDrawing(const OrientedBox& box);
    double usualWidth(QPointF rear, QPointF front) const;
    void updateDraft(QPointF image_point);
    void finishRegion();
    void addRegionCorner(QPointF image_point);

    LabelToolCommands commands_;
    LabelScene scene_;
    bool loupe_shown_ = true;
    bool stack_shown_ = true;
    std::optional<LoupeStack> stack_;
    DelayedCall nudged_;  ///< runs while the loupe stands beside a box that keys move
    bool drawing_ = false;
    std::optional<ObjectId> redrawn_;  ///< whose box is drawn; nothing: a new object's
    std::optional<QPointF> rear_;
    std::optional<QPointF> front_;
    std::optional<QPointF> pressed_view_;  ///< while the button is down
    QPointF pressed_image_;
    bool dragging_ = false;
    std::optional<BoxHandle> handle_;  ///< being dragged
    std::optional<BoxHandle> hovered_;
    OrientedBox start_box_;
    std::optional<OrientedBox> draft_;
    std::optional<QPointF> cursor_view_;
    std::optional<QPointF> cursor_image_;
    std::optional<std::vector<cv::Point2d>> region_;  ///< corners so far
    bool region_refused_ = false;                     ///< these were to be a region, and are none
};

}  // namespace eyrie::ui
