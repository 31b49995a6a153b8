#include "canvas/timeline/timeline_view.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/time/time_text.h"
#include "core/time/utc_time.h"

namespace eyrie::ui {

namespace {
constexpr double kRightMargin = 10;
constexpr double kQualityHeight = 14;
constexpr double kTrackHeight = 14;
constexpr double kGap = 6;
constexpr double kMarkHeight = 12;
constexpr double kWatchedHeight = 12;  ///< of the row: its name must be read
constexpr double kMarkReach = 5;       ///< px beside a mark that count as on it
constexpr int kHeight = 104;
constexpr int kBriefHeight = 42;

/// A moment (µs, not negative) to so many decimals of the seconds, 0 to 6.
std::int64_t roundedToDecimals(std::int64_t time_us, int decimals) {
    std::int64_t unit = 1'000'000;
    for (int i = 0; i < decimals; ++i) unit /= 10;
    return (time_us + unit / 2) / unit * unit;
}

}  // namespace

TimelineView::TimelineView(QWidget* parent) : QWidget(parent) {
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Timeline"));
    layoutAxis();
}

void TimelineView::setTimes(std::vector<std::int64_t> times_us) {
    times_us_ = std::move(times_us);
    frames_.clear();
    track_life_.reset();
    run_range_.reset();
    setMarks({}, {});
    setKinds({});
    setWatched(std::nullopt);
    seams_ = {};
    axis_.setFrameCount(static_cast<int>(times_us_.size()));
    axis_.showAll();
    current_ = 0;
    update();
}

void TimelineView::setSeams(std::vector<FrameIndex> frames) {
    seams_ = TimelineSeams(std::move(frames));
    update();
}

void TimelineView::setClock(std::function<std::optional<std::int64_t>(std::int64_t video_us)> utc_at) {
    utc_at_ = std::move(utc_at);
    update();
}

QString TimelineView::rulerText(std::int64_t video_us, int decimals) const {
    if (!utc_at_) return QString::fromStdString(timeText(video_us, decimals));
    const auto utc_us = utc_at_(video_us);
    return utc_us ? QString::fromStdString(timeOfDayText(roundedToDecimals(*utc_us, decimals), decimals)) : QString();
}

void TimelineView::extendTimes(std::vector<std::int64_t> times_us) {
    times_us_ = std::move(times_us);
    axis_.extend(static_cast<int>(times_us_.size()));
    update();
}

void TimelineView::setFrames(std::vector<TimelineFrame> frames) {
    frames_ = std::move(frames);
    update();
}

void TimelineView::setFrameDone(FrameIndex index, const TimelineFrame& frame) {
    if (index < 0) return;  // of a live source it may be beyond the length that was told
    if (frames_.size() <= static_cast<size_t>(index)) frames_.resize(static_cast<size_t>(index) + 1);
    frames_[static_cast<size_t>(index)] = frame;
    update();
}

void TimelineView::setCurrentFrame(FrameIndex frame) {
    if (frame == current_) return;
    current_ = frame;
    if (!scrubbing_) axis_.reveal(frame);
    update();
}

void TimelineView::setRunRange(std::optional<std::pair<FrameIndex, FrameIndex>> range) {
    run_range_ = range;
    update();
}

void TimelineView::setTrackLife(std::optional<std::pair<FrameIndex, FrameIndex>> life, const QString& name) {
    track_life_ = life;
    track_name_ = name;
    update();
}

void TimelineView::setBrief(bool brief) {
    if (brief == std::exchange(brief_, brief)) return;
    updateGeometry();
    update();
}

int TimelineView::wantedHeight() const {
    if (brief_) return kBriefHeight;
    return kHeight + (marks_.empty() ? 0 : static_cast<int>(kMarkHeight + kGap - 2)) +
           (kindsHeight() > 0 ? static_cast<int>(kindsHeight() + kGap - 2) : 0) +
           (watched_ ? static_cast<int>(kWatchedHeight + kGap - 2) : 0);
}

void TimelineView::setKinds(std::vector<TimelineKind> kinds) {
    const int height = wantedHeight();
    kinds_ = TimelineKinds(std::move(kinds));
    if (wantedHeight() != height) updateGeometry();
    update();
}

void TimelineView::setKindsShown(bool shown) {
    if (shown == kinds_shown_) return;
    kinds_shown_ = shown;
    updateGeometry();
    update();
}

std::optional<QPointF> TimelineView::placeInKinds(int id) const {
    const auto found = kinds_.find(id);
    if (!found || !kinds_shown_) return std::nullopt;
    const double x = axis_.centreOf(found->second.first);
    const double y = rows().kinds.top() + found->first * TimelineKinds::kRowStep + TimelineKinds::kRowHeight / 2;
    return x >= axis_.left() && x <= axis_.right() ? std::optional(QPointF(x, y)) : std::nullopt;
}

std::optional<int> TimelineView::kindRowAt(QPointF place) const {
    const QRectF row = rows().kinds;
    return row.contains(place) ? kinds_.rowAt(place.y() - row.top()) : std::nullopt;
}

std::optional<int> TimelineView::idAt(QPointF place) const {
    if (const TimelineMark* mark = markAt(place)) return mark->id;
    const auto row = kindRowAt(place);
    return row ? kinds_.nearest(*row, place.x(), axis_, kMarkReach) : std::nullopt;
}

bool TimelineView::isFoldSwitch(QPointF place) const {
    const Rows row = rows();
    return !kinds_.empty() && !marks_.empty() && place.x() < axis_.left() && place.y() >= row.marks.top() &&
           place.y() <= std::max(row.marks.bottom(), row.kinds.bottom());
}

void TimelineView::setWatched(std::optional<std::vector<FrameSpan>> spans) {
    if (spans == watched_) return;
    const int height = wantedHeight();
    watched_ = std::move(spans);
    if (wantedHeight() != height) updateGeometry();
    update();
}

bool TimelineView::isWatched(FrameIndex frame) const {
    if (!watched_) return false;
    const auto span = std::lower_bound(watched_->begin(), watched_->end(), frame,
                                       [](const FrameSpan& each, FrameIndex wanted) { return each.last < wanted; });
    return span != watched_->end() && span->first <= frame;
}

void TimelineView::setMarks(const QString& row_name, std::vector<TimelineMark> marks,
                            std::function<QString(int id)> describe) {
    const int height = wantedHeight();
    marks_name_ = row_name;
    marks_ = TimelineMarks(std::move(marks));
    describe_mark_ = std::move(describe);
    if (wantedHeight() != height) updateGeometry();
    update();
}

std::optional<QPointF> TimelineView::placeOfMark(int id) const {
    const TimelineMark* mark = marks_.find(id);
    if (mark == nullptr) return std::nullopt;
    const QPointF place(axis_.centreOf(mark->frame), rows().marks.center().y());
    return place.x() >= axis_.left() && place.x() <= axis_.right() ? std::optional(place) : std::nullopt;
}

const TimelineMark* TimelineView::markAt(QPointF place) const {
    return rows().marks.contains(place) ? marks_.nearest(place.x(), axis_, kMarkReach) : nullptr;
}

void TimelineView::setPalette(PaletteKind palette) {
    colours_ = overlayColours(palette);
    update();
}

void TimelineView::showAll() {
    axis_.showAll();
    update();
}

void TimelineView::zoomBy(double factor) {
    axis_.reveal(current_);
    axis_.zoomAround(axis_.centreOf(current_), factor);
    update();
}

void TimelineView::showAround(FrameIndex first, FrameIndex last, std::int64_t margin_us) {
    if (times_us_.empty()) return;
    const auto end = static_cast<FrameIndex>(times_us_.size()) - 1;
    const auto time_of = [&](FrameIndex frame) {
        return times_us_[static_cast<std::size_t>(std::clamp(frame, 0, end))];
    };
    const auto from = std::lower_bound(times_us_.begin(), times_us_.end(), time_of(first) - margin_us);
    const auto behind = std::upper_bound(times_us_.begin(), times_us_.end(), time_of(last) + margin_us);
    axis_.showFrames(static_cast<FrameIndex>(from - times_us_.begin()),
                     static_cast<FrameIndex>(behind - times_us_.begin()) - 1);
    update();
}

void TimelineView::layoutAxis() {
    const double gutter = fontMetrics().horizontalAdvance(tr("vectors (max 20000)")) + 18.0;
    axis_.setSpan(gutter, width() - gutter - kRightMargin);
}

TimelineActivity TimelineView::activity() const {
    return {frames_, colours_, palette()};
}

TimelineView::Rows TimelineView::rows() const {
    Rows rows;
    const double left = axis_.left();
    const double width = axis_.right() - left;
    rows.ruler = QRectF(left, 0, width, kRulerHeight);
    rows.quality = QRectF(left, rows.ruler.bottom() + 2, width, kQualityHeight);
    if (brief_) return rows;
    rows.track = QRectF(left, height() - kTrackHeight - 4, width, kTrackHeight);
    const double top = rows.quality.bottom() + (marks_.empty() ? 0 : kGap - 2);
    rows.marks = QRectF(left, top, width, marks_.empty() ? 0 : kMarkHeight);
    const double kinds = kindsHeight();
    rows.kinds = QRectF(left, rows.marks.bottom() + (kinds > 0 ? kGap - 2 : 0), width, kinds);
    rows.watched = QRectF(left, rows.kinds.bottom() + (watched_ ? kGap - 2 : 0), width, watched_ ? kWatchedHeight : 0);
    const double below = rows.watched.bottom() + kGap;
    rows.activity = QRectF(left, below, width, rows.track.top() - kGap - below);
    return rows;
}

void TimelineView::resizeEvent(QResizeEvent*) {
    layoutAxis();
}

QString TimelineView::describeFrame(FrameIndex frame) const {
    const auto index = static_cast<size_t>(frame);
    QString text = tr("Frame %1, %2").arg(frame).arg(QString::fromStdString(timeText(times_us_[index])));
    if (const QString place = describe_place_ ? describe_place_(frame) : QString(); !place.isEmpty())
        text += QLatin1Char('\n') + place;
    if (isWatched(frame)) text += tr("\nwatched by somebody");
    if (index >= frames_.size() || !frames_[index].done) return text;
    const TimelineFrame& done = frames_[index];
    switch (done.state) {
        case RegistrationState::first:
            text += tr("\nnothing before it to register onto");
            break;
        case RegistrationState::registered:
            text += tr("\nregistered: %1 of %2 corners agree, rms %3 px")
                        .arg(done.inliers)
                        .arg(done.corners)
                        .arg(done.rms_px, 0, 'f', 3);
            break;
        case RegistrationState::frozen:
            text += tr("\nthe same picture as the previous frame");
            break;
        case RegistrationState::failed:
            text += tr("\ncould not be registered; tracks coast");
            break;
    }
    return text + tr("\n%1 motion vectors, %2 tracks").arg(done.motion_vectors).arg(done.tracks);
}

QString TimelineView::tipAt(QPointF place) const {
    const TimelineMark* mark = markAt(place);
    if (mark != nullptr && describe_mark_) return describe_mark_(mark->id);
    if (const auto row = kindRowAt(place)) return kinds_.textAt(*row, place.x(), axis_, kMarkReach);
    if (isFoldSwitch(place))
        return kinds_shown_ ? tr("Click to fold away the rows of the kinds of events")
                            : tr("Click to have a row for each kind of event");
    return place.x() >= axis_.left() ? describeFrame(axis_.frameAt(place.x())) : QString();
}

bool TimelineView::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip && axis_.frameCount() > 0) {
        const auto* help = static_cast<QHelpEvent*>(event);
        if (const QString tip = tipAt(help->pos()); !tip.isEmpty()) QToolTip::showText(help->globalPos(), tip, this);
        return true;
    }
    if (event->type() == QEvent::FontChange) layoutAxis();
    if (event->type() == QEvent::Leave || event->type() == QEvent::Hide) emit pointerLeft();
    return QWidget::event(event);
}

void TimelineView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || axis_.frameCount() == 0) return;
    if (isFoldSwitch(event->position())) {
        emit kindsShownWanted(!kinds_shown_);
        return;
    }
    if (const auto id = idAt(event->position())) {
        emit markClicked(*id);
        return;
    }
    // Beside the first frame stand names; clicked twice they show all, and the picture stays.
    if (event->position().x() < axis_.left() - kMarkReach) return;
    scrubbing_ = true;
    emit pointerLeft();  // the video itself shows what is there
    emit frameRequested(axis_.frameAt(event->position().x()), true);
}

void TimelineView::mouseMoveEvent(QMouseEvent* event) {
    const double x = event->position().x();
    if (scrubbing_)
        emit frameRequested(axis_.frameAt(x), true);
    else if (axis_.frameCount() > 0 && x >= axis_.left() && x <= axis_.right())
        emit pointedAt(axis_.frameAt(x), static_cast<int>(x));
    else
        emit pointerLeft();
}

void TimelineView::mouseReleaseEvent(QMouseEvent* event) {
    if (!scrubbing_ || event->button() != Qt::LeftButton) return;
    scrubbing_ = false;
    emit frameRequested(axis_.frameAt(event->position().x()), false);
}

void TimelineView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (isFoldSwitch(event->position()))
        mousePressEvent(event);  // the second of two clicks on it
    else if (event->button() == Qt::LeftButton && event->position().x() < axis_.left())
        showAll();
}

void TimelineView::wheelEvent(QWheelEvent* event) {
    const QPoint delta = event->angleDelta();
    if (event->modifiers() & Qt::ShiftModifier || std::abs(delta.x()) > std::abs(delta.y()))
        axis_.panBy(delta.x() != 0 ? delta.x() : delta.y());
    else
        axis_.zoomAround(event->position().x(), std::pow(1.25, delta.y() / 120.0));
    update();
    event->accept();
}

}  // namespace eyrie::ui

#include "moc_timeline_view.cpp"
