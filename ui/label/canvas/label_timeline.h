#pragma once

#include <QAbstractScrollArea>
#include <QColor>
#include <optional>
#include <set>
#include <vector>

#include "core/labels/annotation.h"

namespace eyrie::ui {

class TimelineView;

/// A stretch of an object's life that looks different.
struct RowSpan {
    enum class Kind { outside, occluded, ignored, checked, questionable };
    Kind kind = Kind::outside;
    FrameIndex first = 0;
    FrameIndex last = 0;
};

/// An object on the timeline.
struct ObjectTimelineRow {
    ObjectId id = 0;
    QString name;
    QColor colour;
    FrameIndex first = 0;
    FrameIndex last = 0;
    std::vector<FrameIndex> keyframes;
    std::set<FrameIndex> computed;  ///< of these, the ones that no hand set
    std::vector<RowSpan> spans;
};

/// A row per object under the timeline and in step with it: life as a bar, keyframes as diamonds, gaps, occlusion and
/// what was checked. Only rows in view are painted.
class LabelTimeline : public QAbstractScrollArea {
    Q_OBJECT

 public:
    /// `timeline` must outlive it.
    explicit LabelTimeline(TimelineView& timeline, QWidget* parent = nullptr);

    void setRows(std::vector<ObjectTimelineRow> rows);
    const std::vector<ObjectTimelineRow>& rows() const { return rows_; }
    void setSelection(const std::set<ObjectId>& selection, std::optional<ObjectId> main);

    QSize sizeHint() const override { return {600, 96}; }
    QSize minimumSizeHint() const override { return {240, 48}; }

 signals:
    void placeClicked(eyrie::ObjectId object, eyrie::FrameIndex frame);
    void frameRequested(eyrie::FrameIndex frame);

 protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    bool viewportEvent(QEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    int rowAt(int y) const;
    void layoutRows();
    void paintRow(QPainter& painter, const ObjectTimelineRow& row, double top) const;

    TimelineView& timeline_;
    std::vector<ObjectTimelineRow> rows_;
    std::set<ObjectId> selection_;
    std::optional<ObjectId> main_;
};

}  // namespace eyrie::ui
