#include "review/card/story_sketch.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "widgets/charts/focus_ring.h"
#include "widgets/display_text.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {

constexpr double kSketchMargin = 6;
constexpr double kWayPerLine = 1.2;
constexpr std::size_t kKeySteps = 20;  ///< of arrow keys, from one end to the other
const QColor kSketchMark(255, 170, 30);

}  // namespace

StorySketch::StorySketch(Kind kind, QWidget* parent) : QWidget(parent), kind_(kind) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setFocusPolicy(Qt::TabFocus);  // a click leaves the focus with the list that one goes through
    new FocusRing(*this);
    setAccessibleName(kind == Kind::speed ? tr("Speed over time") : tr("Path over the ground"));
    setToolTip(kind == Kind::speed
                   ? tr("Speed over time; click to go there")
                   : tr("Path over the ground, turned as in the frame in which it begins; click to go there"));
}

QSize StorySketch::sizeHint() const {
    return kind_ == Kind::speed ? QSize(180, 60) : QSize(110, 110);
}

void StorySketch::setPoints(std::vector<StoryPoint> points, const SceneScale& scale) {
    points_ = std::move(points);
    scale_ = scale;
    update();
}

void StorySketch::setMark(FrameIndex frame) {
    if (frame == mark_) return;
    mark_ = frame;
    update();
}

QString StorySketch::figureText() const {
    if (points_.empty()) return {};
    if (kind_ == Kind::way) return lengthText(scale_.px(points_.back().way_m), scale_);
    const auto [least, most] = std::minmax_element(points_.begin(), points_.end(),
                                                   [](const auto& a, const auto& b) { return a.speed < b.speed; });
    return tr("%1 – %2").arg(numberText(shownSpeed(scale_.pxPerFrame(least->speed), scale_), scale_.gsd_known ? 0 : 1),
                             shortSpeedText(scale_.pxPerFrame(most->speed), scale_));
}

double StorySketch::figureHeight() const {
    const double figure = fontMetrics().lineSpacing();
    return height() - 2 * kSketchMargin > 2 * figure ? figure : 0;
}

QPolygonF StorySketch::line() const {
    QPolygonF line;
    if (points_.empty()) return line;
    QRectF room = QRectF(rect()).adjusted(kSketchMargin, kSketchMargin, -kSketchMargin, -kSketchMargin);
    if (kind_ == Kind::speed) {
        room.setTop(room.top() + figureHeight());
        double most = 0;
        for (const StoryPoint& point : points_) most = std::max(most, point.speed);
        const double begin = points_.front().seconds;
        const double life = std::max(1e-6, points_.back().seconds - begin);
        for (const StoryPoint& point : points_)
            line << QPointF(room.left() + room.width() * (point.seconds - begin) / life,
                            room.bottom() - (most > 0 ? room.height() * point.speed / most : 0));
        return line;
    }
    cv::Point2d low = points_.front().at;
    cv::Point2d high = low;
    for (const StoryPoint& point : points_) {
        low = {std::min(low.x, point.at.x), std::min(low.y, point.at.y)};
        high = {std::max(high.x, point.at.x), std::max(high.y, point.at.y)};
    }
    const double scale = std::min(room.width(), room.height()) / std::max({high.x - low.x, high.y - low.y, 1e-6});
    const cv::Point2d middle = (low + high) / 2;
    for (const StoryPoint& point : points_)
        line << room.center() + QPointF(point.at.x - middle.x, point.at.y - middle.y) * scale;
    return line;
}

int StorySketch::nearest(QPointF place) const {
    const QPolygonF shown = line();
    int best = -1;
    double least = 0;
    for (int i = 0; i < shown.size(); ++i) {
        const QPointF away = shown[i] - place;
        const double distance = kind_ == Kind::speed ? std::abs(away.x()) : std::hypot(away.x(), away.y());
        if (best < 0 || distance < least) {
            best = i;
            least = distance;
        }
    }
    return best;
}

void StorySketch::mousePressEvent(QMouseEvent* event) {
    const int at = nearest(event->position());
    if (at >= 0) go_to_(points_[static_cast<std::size_t>(at)].frame);
}

std::size_t StorySketch::markedPoint() const {
    const auto at = std::min_element(points_.begin(), points_.end(), [this](const auto& a, const auto& b) {
        return std::abs(a.frame - mark_) < std::abs(b.frame - mark_);
    });
    return static_cast<std::size_t>(at - points_.begin());
}

std::optional<std::size_t> StorySketch::pointAfter(const QKeyEvent& key) const {
    if (points_.empty() || key.modifiers() & ~Qt::KeypadModifier) return std::nullopt;
    const std::size_t last = points_.size() - 1;
    const std::size_t step = std::max<std::size_t>(1, points_.size() / kKeySteps);
    const std::size_t now = markedPoint();
    switch (key.key()) {
        case Qt::Key_Left:
            return now > step ? now - step : 0;
        case Qt::Key_Right:
            return std::min(now + step, last);
        case Qt::Key_Home:
            return 0;
        case Qt::Key_End:
            return last;
        default:
            return std::nullopt;
    }
}

bool StorySketch::event(QEvent* event) {
    // These keys go through the video otherwise.
    if (event->type() == QEvent::ShortcutOverride && pointAfter(*static_cast<QKeyEvent*>(event))) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void StorySketch::keyPressEvent(QKeyEvent* event) {
    if (const auto point = pointAfter(*event))
        go_to_(points_[*point].frame);
    else
        QWidget::keyPressEvent(event);
}

void StorySketch::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(blend(palette().window().color(), palette().text().color(), 0.07));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
    const QPolygonF shown = line();
    if (shown.isEmpty()) return;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(palette().highlight().color(), kWayPerLine + 0.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPolyline(shown);
    if (kind_ == Kind::way && shown.size() > 1) {
        // Where it came from is hollow.
        painter.setBrush(palette().window().color());
        painter.drawEllipse(shown.front(), 3, 3);
    }
    if (mark_ >= points_.front().frame && mark_ <= points_.back().frame) {
        const QPointF mark = shown[static_cast<int>(markedPoint())];
        painter.setPen(QPen(kSketchMark, 1.4));
        if (kind_ == Kind::speed)
            painter.drawLine(QPointF(mark.x(), 2 + figureHeight()), QPointF(mark.x(), height() - 2));
        painter.setBrush(kSketchMark);
        painter.drawEllipse(mark, 3, 3);
    }
    painter.setPen(quietText(palette()));
    QFont small = font();
    small.setPointSizeF(font().pointSizeF() * 0.85);
    painter.setFont(small);
    painter.drawText(QRectF(rect()).adjusted(5, 2, -5, -2), Qt::AlignTop | Qt::AlignRight, figureText());
}

}  // namespace eyrie::ui

#include "moc_story_sketch.cpp"
