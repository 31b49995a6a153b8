#include "widgets/charts/tracked_bar.h"

#include <QContextMenuEvent>
#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

#include "widgets/charts/copy_menu.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {
const QColor kTrackedColour(46, 160, 90);
const QColor kPartlyColour(222, 160, 20);
const QColor kLostColour(214, 66, 54);

const QColor& colourOf(TrackedShare::Rank rank) {
    return rank == TrackedShare::Rank::mostly        ? kTrackedColour
           : rank == TrackedShare::Rank::mostly_lost ? kLostColour
                                                     : kPartlyColour;
}
}  // namespace

TrackedBar::TrackedBar(QWidget* parent) : QWidget(parent) {
    setAccessibleName(tr("How much of each object was found"));
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void TrackedBar::setShares(std::vector<TrackedShare> shares, std::vector<double> limits) {
    shares_ = std::move(shares);
    lines_ = std::move(limits);
    lines_.push_back(1);
    std::stable_sort(shares_.begin(), shares_.end(),
                     [](const TrackedShare& a, const TrackedShare& b) { return a.share() > b.share(); });
    update();
}

QString TrackedBar::text() const {
    QStringList lines{tr("object\tframes\tfound\tshare\tswitches\tfragments")};
    for (const TrackedShare& one : shares_)
        lines << QStringLiteral("%1\t%2\t%3\t%4\t%5\t%6")
                     .arg(one.object)
                     .arg(one.frames)
                     .arg(one.found)
                     .arg(one.share(), 0, 'f', 4)
                     .arg(one.switches)
                     .arg(one.fragments);
    return lines.join(QLatin1Char('\n'));
}

QString TrackedBar::headline() const {
    int mostly = 0;
    int lost = 0;
    for (const TrackedShare& one : shares_) {
        mostly += one.rank == TrackedShare::Rank::mostly;
        lost += one.rank == TrackedShare::Rank::mostly_lost;
    }
    return tr("%1 mostly tracked · %2 partially · %3 mostly lost")
        .arg(mostly)
        .arg(static_cast<int>(shares_.size()) - mostly - lost)
        .arg(lost);
}

QRectF TrackedBar::columns() const {
    const double left = fontMetrics().horizontalAdvance(QStringLiteral("100 % "));
    return {left, fontMetrics().height() + 6.0, std::max(10.0, width() - left - 4),
            std::max(10.0, height() - fontMetrics().height() - 10.0)};
}

const TrackedShare* TrackedBar::shareAt(QPointF place) const {
    const QRectF area = columns();
    if (shares_.empty() || !area.contains(place)) return nullptr;
    const auto index =
        static_cast<std::size_t>((place.x() - area.left()) / area.width() * static_cast<double>(shares_.size()));
    return &shares_[std::min(index, shares_.size() - 1)];
}

void TrackedBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRectF(0, 0, width(), fontMetrics().height() + 2), Qt::AlignLeft | Qt::AlignVCenter, headline());
    const QRectF area = columns();
    painter.fillRect(area, palette().color(QPalette::Base));
    const QColor grid = blend(palette().color(QPalette::Base), palette().color(QPalette::WindowText), 0.25);
    for (const double share : lines_) {
        const double y = area.bottom() - share * area.height();
        painter.setPen(grid);
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
        painter.setPen(quietText(palette()));
        painter.drawText(QRectF(0, y - fontMetrics().height() / 2.0, area.left() - 4, fontMetrics().height()),
                         Qt::AlignRight | Qt::AlignVCenter, tr("%1 %").arg(std::lround(share * 100)));
    }
    const double step = area.width() / std::max<double>(1, static_cast<double>(shares_.size()));
    const double gap = step > 4 ? 1 : 0;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
        const double height = std::max(1.0, shares_[i].share() * area.height());
        painter.fillRect(QRectF(area.left() + static_cast<double>(i) * step, area.bottom() - height,
                                std::max(1.0, step - gap), height),
                         colourOf(shares_[i].rank));
    }
}

bool TrackedBar::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        if (const TrackedShare* one = shareAt(help->pos()))
            QToolTip::showText(help->globalPos(),
                               tr("Object %1: found in %2 of %3 frames (%4 %), %5 switches, %6 fragments. Click to go "
                                  "to its first error.")
                                   .arg(one->object)
                                   .arg(one->found)
                                   .arg(one->frames)
                                   .arg(one->share() * 100, 0, 'f', 1)
                                   .arg(one->switches)
                                   .arg(one->fragments),
                               this);
        else
            QToolTip::hideText();
        return true;
    }
    return QWidget::event(event);
}

void TrackedBar::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    if (const TrackedShare* one = shareAt(event->position())) emit objectActivated(one->object);
}

void TrackedBar::contextMenuEvent(QContextMenuEvent* event) {
    offerCopies(*this, text(), event->globalPos());
}

}  // namespace eyrie::ui

#include "moc_tracked_bar.cpp"
