#include "widgets/charts/origin_bar.h"

#include <QCoreApplication>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "widgets/theme_colours.h"

namespace eyrie::ui {

QString shownName(StateOrigin origin) {
    return QCoreApplication::translate("StateOrigin", nameOf(origin));
}

QColor originColour(StateOrigin origin, const QPalette& palette) {
    QColor colour;
    switch (origin) {
        case StateOrigin::detected:
            colour = QColor(0, 158, 115);
            break;
        case StateOrigin::reconstructed:
            colour = QColor(86, 180, 233);
            break;
        case StateOrigin::predicted:
            colour = QColor(230, 159, 0);
            break;
        case StateOrigin::standing:
            colour = QColor(0, 114, 178);
            break;
        case StateOrigin::by_hand:
            colour = QColor(204, 121, 167);
            break;
    }
    return isDark(palette) ? colour.lighter(115) : colour;
}

OriginBar::OriginBar(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setToolTip(tr("The track's life: detected, reconstructed, predicted, standing or by hand. Click to go there."));
}

void OriginBar::setStates(const std::vector<TrackFrame>& states) {
    spans_.clear();
    for (const TrackFrame& state : states) {
        const bool goes_on =
            !spans_.empty() && spans_.back().last + 1 == state.frame && spans_.back().origin == state.state.origin;
        if (goes_on) {
            spans_.back().last = state.frame;
        } else {
            spans_.push_back({state.frame, state.frame, state.state.origin});
        }
    }
    update();
}

void OriginBar::setCurrentFrame(FrameIndex frame) {
    current_ = frame;
    update();
}

QSize OriginBar::sizeHint() const {
    return {120, fontMetrics().height()};
}

double OriginBar::xOf(double frame) const {
    const double frames = spans_.back().last - spans_.front().first + 1;
    return (frame - spans_.front().first) / frames * width();
}

void OriginBar::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.fillRect(rect(), palette().color(QPalette::Base));
    if (spans_.empty()) return;
    for (const Span& span : spans_) {
        const double from = xOf(span.first);
        const double to = xOf(span.last + 1.0);
        painter.fillRect(QRectF(from, 0, std::max(to - from, 1.0), height()), originColour(span.origin, palette()));
    }
    if (current_ < spans_.front().first || current_ > spans_.back().last) return;
    painter.setPen(QPen(palette().color(QPalette::WindowText), 2));
    const double x = xOf(current_ + 0.5);
    painter.drawLine(QPointF(x, 0), QPointF(x, height()));
}

void OriginBar::mousePressEvent(QMouseEvent* event) {
    if (spans_.empty() || event->button() != Qt::LeftButton) return;
    const double share = std::clamp(event->position().x() / std::max(1, width()), 0.0, 1.0);
    const int frames = spans_.back().last - spans_.front().first + 1;
    emit frameActivated(spans_.front().first + std::min(frames - 1, static_cast<int>(share * frames)));
}

}  // namespace eyrie::ui

#include "moc_origin_bar.cpp"
