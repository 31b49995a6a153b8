#pragma once

#include <QString>
#include <QWidget>
#include <vector>

namespace eyrie::ui {

/// How much of a true object's life was found.
struct TrackedShare {
    int object = 0;
    int frames = 0;
    int found = 0;
    int switches = 0;
    int fragments = 0;

    double share() const { return frames > 0 ? static_cast<double>(found) / frames : 0; }
};

/// Every true object as a column as high as the share of its frames in which it was found, best first, in the colours
/// of mostly tracked (at least 80 %), partially tracked and mostly lost (less than 20 %), with their numbers above. A
/// click reports the object.
class TrackedBar : public QWidget {
    Q_OBJECT

 public:
    explicit TrackedBar(QWidget* parent = nullptr);
    void setShares(std::vector<TrackedShare> shares);
    const std::vector<TrackedShare>& shares() const { return shares_; }
    QString text() const;

    QSize sizeHint() const override { return {320, 96}; }
    QSize minimumSizeHint() const override { return {160, 80}; }

 signals:
    void objectActivated(int object);

 protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;
    bool event(QEvent* event) override;

 private:
    QRectF columns() const;
    const TrackedShare* shareAt(QPointF place) const;
    QString headline() const;

    std::vector<TrackedShare> shares_;
};

}  // namespace eyrie::ui
