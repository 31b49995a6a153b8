#pragma once

#include <QRectF>
#include <QWidget>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "canvas/overlay_colours.h"
#include "canvas/timeline/timeline_activity.h"
#include "canvas/timeline/timeline_axis.h"
#include "canvas/timeline/timeline_frame.h"
#include "canvas/timeline/timeline_kinds.h"
#include "canvas/timeline/timeline_marks.h"
#include "canvas/timeline/timeline_seams.h"
#include "core/review/seen_frames.h"

namespace eyrie::ui {

/// Ruler with the video's own times, where its parts meet, registration quality, what happened by kinds, activity, the
/// life of the selected track and the place shown. Clicking and dragging scrub; the wheel zooms; arrow keys are left to
/// the window.
class TimelineView : public QWidget {
    Q_OBJECT

 public:
    explicit TimelineView(QWidget* parent = nullptr);

    /// A new video: presentation time of every frame, microseconds. Forgets all frames.
    void setTimes(std::vector<std::int64_t> times_us);
    /// First frames of the parts of the video but the first.
    void setSeams(std::vector<FrameIndex> frames);
    /// What is to be said of a frame besides what it was found to be, in lines; empty: nothing.
    void setDescription(std::function<QString(FrameIndex)> describe) { describe_place_ = std::move(describe); }
    /// What time it was at a moment of the video, µs since 1970-01-01, nothing where nobody knows: the ruler has the
    /// time of the day then. No function: it has the time of the video.
    void setClock(std::function<std::optional<std::int64_t>(std::int64_t video_us)> utc_at);
    /// What stands on the ruler at a moment of the video.
    QString rulerText(std::int64_t video_us, int decimals = 0) const;
    /// The video has grown: the same frames and some behind them. Keeps all that was told of the former.
    void extendTimes(std::vector<std::int64_t> times_us);
    /// All frames of a run, by index; may be shorter than the video.
    void setFrames(std::vector<TimelineFrame> frames);
    /// One more frame of a running run.
    void setFrameDone(FrameIndex index, const TimelineFrame& frame);
    void setCurrentFrame(FrameIndex frame);
    /// The range a running run is going to work on; nothing when none works.
    void setRunRange(std::optional<std::pair<FrameIndex, FrameIndex>> range);
    /// First and last frame and the name of the selected track.
    void setTrackLife(std::optional<std::pair<FrameIndex, FrameIndex>> life, const QString& name = {});
    /// Small marks in a row of their own, which is there while there are any; `describe` says what a mark is.
    void setMarks(const QString& row_name, std::vector<TimelineMark> marks,
                  std::function<QString(int id)> describe = {});
    const TimelineMarks& marks() const { return marks_; }
    /// Where a mark is drawn; nothing when it is out of view.
    std::optional<QPointF> placeOfMark(int id) const;
    /// A thin row for each kind of what happened, below the marks; ids are those of marks.
    void setKinds(std::vector<TimelineKind> kinds);
    const TimelineKinds& kinds() const { return kinds_; }
    /// Whether these rows are there, or folded away.
    void setKindsShown(bool shown);
    bool kindsShown() const { return kinds_shown_; }
    /// Where one of them is drawn; nothing when it is out of view, or the rows are folded.
    std::optional<QPointF> placeInKinds(int id) const;
    /// With nothing but ruler and registration, where other rows follow below and room is scarce.
    void setBrief(bool brief);
    /// What anybody watched, merged spans, in a thin row of its own, which is there while that is known.
    void setWatched(std::optional<std::vector<FrameSpan>> spans);
    const std::optional<std::vector<FrameSpan>>& watched() const { return watched_; }
    void setPalette(PaletteKind palette);

    FrameIndex currentFrame() const { return current_; }
    const TimelineAxis& axis() const { return axis_; }
    void showAll();
    /// Around the current frame.
    void zoomBy(double factor);
    /// Zooms to these frames with so much time of the video before and after them.
    void showAround(FrameIndex first, FrameIndex last, std::int64_t margin_us);

    QSize sizeHint() const override { return {600, wantedHeight()}; }
    QSize minimumSizeHint() const override { return {240, wantedHeight()}; }

 signals:
    /// The user wants to see this frame; `scrubbing` while the mouse is held.
    void frameRequested(FrameIndex frame, bool scrubbing);
    void markClicked(int id);
    /// The pointer moves over this frame without scrubbing; x in the widget.
    void pointedAt(FrameIndex frame, int x);
    /// It is over no frame any more, or scrubs.
    void pointerLeft();
    /// The user wants to have the rows of kinds, or to fold them away.
    void kindsShownWanted(bool shown);

 protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;

 private:
    static constexpr double kRulerHeight = 22;

    struct Rows {
        QRectF ruler, quality, marks, kinds, watched, activity, track;
    };
    Rows rows() const;
    void layoutAxis();
    void paintNames(QPainter& painter, const Rows& row, const TimelineActivity& curves) const;
    void paintRuler(QPainter& painter, const QRectF& row) const;
    int wantedHeight() const;
    void paintQuality(QPainter& painter, const QRectF& row) const;
    void paintMarks(QPainter& painter, const QRectF& row) const;
    void paintKinds(QPainter& painter, const QRectF& row) const;
    void paintWatched(QPainter& painter, const QRectF& row) const;
    bool isWatched(FrameIndex frame) const;
    double kindsHeight() const { return kinds_shown_ ? kinds_.height() : 0; }
    /// The row of kinds under a place of the widget.
    std::optional<int> kindRowAt(QPointF place) const;
    /// What a click on a place of the widget means, if it means a mark or something that happened.
    std::optional<int> idAt(QPointF place) const;
    /// Whether a place of the widget is the switch that folds the rows of kinds.
    bool isFoldSwitch(QPointF place) const;
    /// What is to be said of a place of the widget.
    QString tipAt(QPointF place) const;
    /// The mark under a place of the widget.
    const TimelineMark* markAt(QPointF place) const;
    void paintTrackLife(QPainter& painter, const QRectF& row) const;
    void paintSeams(QPainter& painter) const;
    void paintCursor(QPainter& painter) const;
    QString describeFrame(FrameIndex frame) const;
    /// The curves as they are now; valid while frames and axis are not changed.
    TimelineActivity activity() const;

    TimelineAxis axis_;
    std::vector<std::int64_t> times_us_;
    std::vector<TimelineFrame> frames_;
    std::optional<std::pair<FrameIndex, FrameIndex>> run_range_;
    std::optional<std::pair<FrameIndex, FrameIndex>> track_life_;
    QString track_name_;
    QString marks_name_;
    TimelineMarks marks_;
    TimelineKinds kinds_;
    bool kinds_shown_ = true;
    bool brief_ = false;
    std::function<QString(int id)> describe_mark_;
    std::optional<std::vector<FrameSpan>> watched_;
    TimelineSeams seams_;
    std::function<QString(FrameIndex)> describe_place_;
    std::function<std::optional<std::int64_t>(std::int64_t)> utc_at_;
    OverlayColours colours_ = overlayColours(PaletteKind::thesis);
    FrameIndex current_ = 0;
    bool scrubbing_ = false;
};

}  // namespace eyrie::ui
