#pragma once

#include <QString>
#include <QWidget>
#include <vector>

namespace eyrie::ui {

/// How much of the life of an object of the ground truth was found.
struct TrackedShare {
    enum class Rank { mostly, partially, mostly_lost };

    int object = 0;
    int frames = 0;
    int found = 0;
    int switches = 0;
    int fragments = 0;
    Rank rank = Rank::partially;

    double share() const { return frames > 0 ? static_cast<double>(found) / frames : 0; }
};

/// Every object of the ground truth as a column as high as the share of its frames in which it was found, best first,
/// in the colours of mostly tracked, partially tracked and mostly lost, with their numbers above. A click reports the
/// object.
class TrackedBar : public QWidget {
    Q_OBJECT

 public:
    explicit TrackedBar(QWidget* parent = nullptr);
    /// `limits`: the shares that part the ranks, where lines are drawn.
    void setShares(std::vector<TrackedShare> shares, std::vector<double> limits);
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
    std::vector<double> lines_;
};

}  // namespace eyrie::ui
