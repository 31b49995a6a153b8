#pragma once

#include <QWidget>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "canvas/key_pointer.h"
#include "canvas/marks/place_mark.h"
#include "canvas/overlay_settings.h"
#include "canvas/view_frame.h"
#include "canvas/view_transform.h"

namespace eyrie::ui {

class CanvasTool;
struct CanvasPlace;

/// The canvas: one video frame with its overlays. The wheel zooms to the cursor, dragging pans; pixels are smooth below
/// 400 % and sharp squares from there on. Shows what it is given and asks nobody. Tools call update() when what they
/// draw is another; what lies under it the view itself paints anew when that changed.
class VideoView : public QWidget {
    Q_OBJECT

 public:
    /// `settings` must outlive the view.
    explicit VideoView(OverlaySettings& settings, QWidget* parent = nullptr);
    ~VideoView() override;

    /// Shows a frame. A frame without picture keeps the canvas' size and shows its overlays on an empty ground.
    void setFrame(ViewFrame frame);
    const ViewFrame& frame() const { return frame_; }
    /// Empties the canvas and announces the size of the frames to come.
    void clear(QSize image_size);
    void setSelectedTrack(std::optional<TrackId> track);
    /// The image stacks of a frame, which come later than the frame itself; ignored when another one is shown.
    void setStacks(FrameIndex frame, std::vector<StackMark> stacks);
    /// What is watched, as it lies in a frame; ignored when another one is shown.
    void setZones(FrameIndex frame, std::vector<ZoneMark> zones);
    /// Where north is in a frame, degrees clockwise from +x; ignored when another one is shown.
    void setNorth(FrameIndex frame, std::optional<double> north_deg);
    /// What the evaluation says of a frame, which comes apart from it; ignored when another one is shown.
    void setVerdicts(FrameIndex frame, bool evaluated, std::vector<VerdictMark> verdicts,
                     std::vector<BoxRecord> ground_truth);
    /// The search area that is looked at more closely, image coordinates.
    void setInspectedArea(std::optional<OrientedBox> area);
    const std::optional<OrientedBox>& inspectedArea() const { return inspected_area_; }
    /// The place that is asked about; nothing: none.
    void setPlaceMark(std::optional<PlaceMark> mark);
    /// A few words that stand on the picture, such as "preview"; empty: none.
    void setBadge(const QString& text);
    void setBadgeOnRight(bool on_right);
    /// How much of the top lies under something else, px: what is written there moves down.
    void setCovered(int covered_px);
    /// What the mouse does and what is drawn on top; null: the canvas' own. Must outlive the view, or be taken away.
    void setTool(CanvasTool* tool);
    CanvasTool* tool() const { return tool_; }
    /// Where the cross is that keys move while a tool takes places, view coordinates; nothing while there is none.
    std::optional<QPointF> keyPointer() const;
    /// Shows the cross at another place of the view, where a tool takes places; what keys held is let go where it was.
    void moveKeyPointer(QPointF view_point);
    /// Takes the cross away, as when a tool that stays has ended what it wanted places for.
    void hideKeyPointer();

    const ViewTransform& transform() const { return transform_; }
    void fit();
    /// One image pixel on one screen pixel, around the cursor if it is over the canvas, else the middle.
    void showOneToOne();
    void zoomBy(double factor);
    /// Restores a remembered place: zoom (screen px per image px) and the image point in the middle.
    void restore(double zoom, QPointF centre);
    void centreOn(QPointF image_point);
    /// Turns the picture clockwise around the middle of the canvas, radians; 0 is as filmed.
    void setRotation(double radians);
    /// Lays the frame shown on the ground, so that this stands still from frame to frame (ViewTransform::setGround());
    /// the view goes on with it where the picture would leave it. To be given with every frame.
    void setGround(const std::optional<QTransform>& ground_from_image);

    /// The canvas as it is painted, for pictures of it.
    QImage picture() const;

    QSize sizeHint() const override { return {960, 600}; }
    QSize minimumSizeHint() const override { return {240, 160}; }

 signals:
    /// Sub-pixel position under the cursor, image coordinates; nothing when it left the image.
    void cursorMoved(std::optional<QPointF> image_point);
    void transformChanged();
    /// A frame was given; what belongs to it and comes apart from it may be given now.
    void frameGiven(FrameIndex frame);
    void trackClicked(std::optional<TrackId> track);
    /// The user pointed at a place, image coordinates; `margin`: px of the image within which something is meant. Comes
    /// after trackClicked().
    void placeClicked(QPointF image_point, double margin);
    /// The context menu of a place is asked for, image coordinates; `margin` as above.
    void placeMenuRequested(QPointF image_point, double margin, QPoint global);
    /// The space bar was tapped while the canvas had the focus.
    void playToggled();

 protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void changeEvent(QEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void keyReleaseEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

 private:
    void paint(QPainter& painter) const;
    void paintPicture(QPainter& painter) const;
    void paintWithTool(QPainter& painter);
    void prepareToDraw(QPainter& painter) const;
    QImage emptyPicture() const;
    void paintImage(QPainter& painter) const;
    void paintInspectedArea(QPainter& painter) const;
    void paintPlaceMark(QPainter& painter) const;
    void paintBadge(QPainter& painter) const;
    void paintTool(QPainter& painter) const;
    void adoptSize();
    void transformWasChanged();
    void pictureWasChanged();
    void reportCursor(QPointF view_point);
    CanvasPlace place(bool by_keys = false) const;
    QPointF anchor() const;
    bool toolTakesKeys() const;
    bool takesToolKey(const QKeyEvent& key);
    bool finishesByKey(const QKeyEvent& key);
    void movePointer(QPointF step);
    void setByKey(const QKeyEvent& key);
    void mouseTakesOver();
    void updateCursorShape();
    bool toolTakes(bool (CanvasTool::*handler)(const QMouseEvent&, const CanvasPlace&), const QMouseEvent& event);

    OverlaySettings& settings_;
    std::vector<std::pair<OverlayKind, std::unique_ptr<OverlayLayer>>> layers_;
    ViewFrame frame_;
    ViewTransform transform_;
    std::optional<TrackId> selected_track_;
    std::optional<OrientedBox> inspected_area_;
    std::optional<PlaceMark> place_mark_;
    QString badge_;
    bool badge_on_right_ = false;
    int covered_px_ = 0;
    std::optional<QPointF> drag_from_;  ///< view point of the last drag step
    QPointF pressed_at_;
    bool dragged_ = false;
    bool space_held_ = false;
    bool space_panned_ = false;
    CanvasTool* tool_ = nullptr;
    bool picture_changed_ = true;  ///< since it was painted: what lies under a tool
    QImage under_tool_;            ///< kept from the second time on that it is painted the same; null: not kept
    KeyPointer pointer_;
};

}  // namespace eyrie::ui
