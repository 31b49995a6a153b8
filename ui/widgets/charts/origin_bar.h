#pragma once

#include <QWidget>
#include <vector>

#include "store/runs/run_store.h"

namespace eyrie::ui {

/// The life of a track as a strip: where its boxes were detected, rebuilt, or only predicted.
class OriginBar : public QWidget {
    Q_OBJECT
 public:
    explicit OriginBar(QWidget* parent = nullptr);
    /// `states` ascend by frame; the bar keeps no reference to them.
    void setStates(const std::vector<TrackFrame>& states);
    void setCurrentFrame(FrameIndex frame);
    QSize sizeHint() const override;

 signals:
    void frameActivated(int frame);

 protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;

 private:
    struct Span {
        FrameIndex first;
        FrameIndex last;
        StateOrigin origin;
    };
    double xOf(double frame) const;
    std::vector<Span> spans_;  ///< ascending; frames between them have no state
    FrameIndex current_ = 0;
};

/// The word for people and the colour of an origin; the same in the bar and in its legend.
QString shownName(StateOrigin origin);
QColor originColour(StateOrigin origin, const QPalette& palette);

}  // namespace eyrie::ui
