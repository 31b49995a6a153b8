#include "label/canvas/label_timeline.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QScrollBar>
#include <QToolTip>
#include <algorithm>

#include "canvas/timeline/timeline_view.h"
#include "label/lists/objects_model.h"

namespace eyrie::ui {

namespace {
constexpr int kRowHeight = 17;
constexpr double kBar = 7;
constexpr double kDiamond = 4.2;
constexpr double kLeastDiamondGap = 4;
const QColor kChecked(70, 190, 110);
const QColor kQuestionable(240, 160, 50);

QColor mixed(const QColor& a, const QColor& b, double share) {
    return QColor::fromRgbF(static_cast<float>(a.redF() + (b.redF() - a.redF()) * share),
                            static_cast<float>(a.greenF() + (b.greenF() - a.greenF()) * share),
                            static_cast<float>(a.blueF() + (b.blueF() - a.blueF()) * share));
}
}  // namespace

LabelTimeline::LabelTimeline(TimelineView& timeline, QWidget* parent)
    : QAbstractScrollArea(parent), timeline_(timeline) {
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    setFrameShape(QFrame::NoFrame);
    setFocusPolicy(Qt::NoFocus);
    setAccessibleName(tr("Objects over time"));
    verticalScrollBar()->setSingleStep(kRowHeight);
    timeline_.installEventFilter(this);
}

bool LabelTimeline::eventFilter(QObject* watched, QEvent* event) {
    // The timeline repaints whenever its frames are shown elsewhere; the rows follow.
    if (watched == &timeline_ && event->type() == QEvent::Paint) viewport()->update();
    return QAbstractScrollArea::eventFilter(watched, event);
}

void LabelTimeline::setRows(std::vector<ObjectTimelineRow> rows) {
    rows_ = std::move(rows);
    layoutRows();
    viewport()->update();
}

void LabelTimeline::setSelection(const std::set<ObjectId>& selection, std::optional<ObjectId> main) {
    selection_ = selection;
    main_ = main;
    for (std::size_t i = 0; main_ && i < rows_.size(); ++i) {
        if (rows_[i].id != *main_) continue;
        const int top = static_cast<int>(i) * kRowHeight;
        const int shown = verticalScrollBar()->value();
        if (top < shown) verticalScrollBar()->setValue(top);
        if (top + kRowHeight > shown + viewport()->height())
            verticalScrollBar()->setValue(top + kRowHeight - viewport()->height());
        break;
    }
    viewport()->update();
}

void LabelTimeline::layoutRows() {
    const int height = static_cast<int>(rows_.size()) * kRowHeight;
    verticalScrollBar()->setPageStep(viewport()->height());
    verticalScrollBar()->setRange(0, std::max(0, height - viewport()->height()));
}

void LabelTimeline::resizeEvent(QResizeEvent*) {
    layoutRows();
}

int LabelTimeline::rowAt(int y) const {
    const int row = (y + verticalScrollBar()->value()) / kRowHeight;
    return row >= 0 && row < static_cast<int>(rows_.size()) ? row : -1;
}

void LabelTimeline::paintEvent(QPaintEvent*) {
    QPainter painter(viewport());
    painter.fillRect(viewport()->rect(), palette().base());
    if (rows_.empty()) {
        painter.setPen(mixed(palette().text().color(), palette().base().color(), 0.4));
        painter.drawText(viewport()->rect(), Qt::AlignCenter, tr("A row per object appears here once one is drawn"));
        return;
    }
    painter.setRenderHint(QPainter::Antialiasing);
    const int scrolled = verticalScrollBar()->value();
    const int first = scrolled / kRowHeight;
    const int last = std::min(static_cast<int>(rows_.size()) - 1, (scrolled + viewport()->height()) / kRowHeight);
    for (int i = first; i <= last; ++i)
        paintRow(painter, rows_[static_cast<std::size_t>(i)], i * kRowHeight - scrolled);
    const double x = timeline_.axis().centreOf(timeline_.currentFrame());
    painter.setPen(QPen(palette().highlight().color(), 1.4));
    painter.drawLine(QPointF(x, 0), QPointF(x, viewport()->height()));
}

void LabelTimeline::paintRow(QPainter& painter, const ObjectTimelineRow& row, double top) const {
    const TimelineAxis& axis = timeline_.axis();
    const QColor ground = palette().base().color();
    const double middle = top + kRowHeight / 2.0;
    const bool chosen = selection_.contains(row.id);
    if (chosen)
        painter.fillRect(QRectF(0, top, viewport()->width(), kRowHeight),
                         mixed(ground, palette().highlight().color(), row.id == main_ ? 0.3 : 0.18));
    painter.setPen(palette().text().color());
    const QRectF name(2, top, std::max(0.0, axis.left() - 8), kRowHeight);
    painter.drawText(name, Qt::AlignRight | Qt::AlignVCenter,
                     painter.fontMetrics().elidedText(row.name, Qt::ElideLeft, static_cast<int>(name.width())));
    painter.save();
    painter.setClipRect(QRectF(axis.left(), top, axis.right() - axis.left(), kRowHeight));
    const auto bar = [&](FrameIndex from, FrameIndex to, double height, double shift) {
        return QRectF(axis.xOf(from), middle - height / 2 + shift, std::max(2.0, axis.xOf(to + 1) - axis.xOf(from)),
                      height);
    };
    painter.setPen(Qt::NoPen);
    painter.setBrush(mixed(row.colour, ground, 0.35));
    painter.drawRoundedRect(bar(row.first, row.last, kBar, 0), 2, 2);
    for (const RowSpan& span : row.spans) {
        const QRectF all = bar(span.first, span.last, kBar, 0);
        switch (span.kind) {
            case RowSpan::Kind::outside:
                painter.fillRect(all, ground);
                painter.fillRect(bar(span.first, span.last, 1, 0), mixed(row.colour, ground, 0.5));
                break;
            case RowSpan::Kind::occluded:
                painter.fillRect(all, QBrush(mixed(ground, Qt::black, 0.25), Qt::Dense4Pattern));
                break;
            case RowSpan::Kind::ignored:
                painter.fillRect(all, QBrush(mixed(ground, Qt::black, 0.4), Qt::BDiagPattern));
                break;
            case RowSpan::Kind::checked:
                painter.fillRect(bar(span.first, span.last, 2, kBar / 2 + 2), kChecked);
                break;
            case RowSpan::Kind::questionable:
                painter.fillRect(bar(span.first, span.last, 2, kBar / 2 + 2), kQuestionable);
                break;
        }
    }
    // Keyframes nearer than a diamond are one on screen.
    const QColor by_hand = chosen ? palette().text().color() : mixed(palette().text().color(), row.colour, 0.3);
    double drawn = -1e9;
    for (const FrameIndex keyframe : row.keyframes) {
        const double x = axis.centreOf(keyframe);
        if (x - drawn < kLeastDiamondGap || x < axis.left() - kDiamond || x > axis.right() + kDiamond) continue;
        drawn = x;
        // Hollow: no hand set it.
        painter.setBrush(row.computed.contains(keyframe) ? ground : by_hand);
        painter.setPen(row.computed.contains(keyframe) ? QPen(by_hand, 1) : QPen(ground, 0.8));
        const QPointF points[] = {
            {x - kDiamond, middle}, {x, middle - kDiamond}, {x + kDiamond, middle}, {x, middle + kDiamond}};
        painter.drawPolygon(points, 4);
    }
    painter.restore();
}

void LabelTimeline::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    const int row = rowAt(static_cast<int>(event->position().y()));
    const TimelineAxis& axis = timeline_.axis();
    FrameIndex frame = axis.frameAt(event->position().x());
    if (row < 0) {
        emit frameRequested(frame);
        return;
    }
    const ObjectTimelineRow& hit = rows_[static_cast<std::size_t>(row)];
    for (const FrameIndex keyframe : hit.keyframes)  // a diamond is meant, not a pixel beside it
        if (std::abs(axis.centreOf(keyframe) - event->position().x()) <= kDiamond) frame = keyframe;
    emit placeClicked(hit.id, frame);
}

bool LabelTimeline::viewportEvent(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        const int row = rowAt(help->pos().y());
        if (row < 0) {
            QToolTip::hideText();
        } else {
            const ObjectTimelineRow& hit = rows_[static_cast<std::size_t>(row)];
            QToolTip::showText(help->globalPos(), tr("%1: frames %2 to %3, %4. Click to go there.")
                                                      .arg(hit.name)
                                                      .arg(hit.first)
                                                      .arg(hit.last)
                                                      .arg(keyframesText(static_cast<int>(hit.keyframes.size()),
                                                                         static_cast<int>(hit.computed.size()))));
        }
        return true;
    }
    return QAbstractScrollArea::viewportEvent(event);
}

}  // namespace eyrie::ui

#include "moc_label_timeline.cpp"
