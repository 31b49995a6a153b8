#include "workspace/timeline_thumbnails.h"

#include <QFrame>
#include <QLabel>
#include <QScreen>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <exception>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "canvas/drawing/image_convert.h"
#include "canvas/timeline/timeline_view.h"
#include "session/project_session.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr std::size_t kKept_bytes = std::size_t{24} << 20U;
constexpr int kAskEvery_ms = 60;
constexpr int kKeptOpen_ms = 20'000;  ///< once the pointer is gone
constexpr double kGrid_px = 4;        ///< places of the timeline that are nearer share a picture
constexpr int kAbove_px = 4;

}  // namespace

/// The video that was read last.
struct TimelineThumbnails::Opened {
    std::string identity;
    std::unique_ptr<FrameSource> source;
};

TimelineThumbnails::TimelineThumbnails(ProjectSession& session, TimelineView& timeline, QObject* parent)
    : QObject(parent),
      session_(session),
      timeline_(timeline),
      popup_(new QFrame(&timeline, Qt::ToolTip)),
      picture_label_(new QLabel(popup_)),
      caption_(new QLabel(popup_)),
      known_(kKept_bytes),
      ask_due_(kAskEvery_ms, [this] { ask(); }),
      close_due_(kKeptOpen_ms, [this] { closeVideo(); }),
      opened_(std::make_shared<Opened>()) {
    popup_->setAttribute(Qt::WA_ShowWithoutActivating);
    popup_->setAttribute(Qt::WA_TransparentForMouseEvents);
    popup_->setFrameShape(QFrame::StyledPanel);
    caption_->setAlignment(Qt::AlignCenter);
    auto* rows = new QVBoxLayout(popup_);
    rows->setContentsMargins(3, 3, 3, 3);
    rows->setSpacing(2);
    rows->setSizeConstraint(QLayout::SetFixedSize);
    rows->addWidget(picture_label_);
    rows->addWidget(caption_);
    connect(&timeline, &TimelineView::pointedAt, this, &TimelineThumbnails::pointAt);
    connect(&timeline, &TimelineView::pointerLeft, this, &TimelineThumbnails::hide);
    whenChanged(session, this, {{SessionChange::video, [this] { forgetVideo(); }}});
}

TimelineThumbnails::~TimelineThumbnails() = default;

FrameIndex TimelineThumbnails::frameToRead(FrameIndex pointed_at, double pixels_per_frame) {
    const int step = std::max(1, static_cast<int>(std::floor(kGrid_px / std::max(pixels_per_frame, 1e-6))));
    return pointed_at / step * step;
}

QImage TimelineThumbnails::thumbnailOf(const cv::Mat& picture) {
    if (picture.empty()) return {};
    const double scale = static_cast<double>(kWidth) / picture.cols;
    cv::Mat small;
    cv::resize(picture, small, {kWidth, std::max(1, static_cast<int>(std::lround(picture.rows * scale)))}, 0, 0,
               scale < 1 ? cv::INTER_AREA : cv::INTER_LINEAR);
    return imageForDisplay(small);
}

std::optional<FrameIndex> TimelineThumbnails::shownFrame() const {
    return popup_ != nullptr && popup_->isVisible() ? shown_ : std::nullopt;
}

void TimelineThumbnails::pointAt(FrameIndex frame, int x) {
    if (!session_.media() || session_.videoMissing() || session_.liveSource() != nullptr) return hide();
    wanted_ = frameToRead(frame, timeline_.axis().pixelsPerFrame());
    x_ = x;
    if (const QImage* known = known_.find(*wanted_)) {
        show(*wanted_, *known);
    } else {
        if (shownFrame()) place();
        if (!ask_due_.pending()) ask_due_.start();
    }
}

void TimelineThumbnails::hide() {
    wanted_.reset();
    ask_due_.stop();
    close_due_.start();
    if (popup_ != nullptr) popup_->hide();
}

void TimelineThumbnails::forgetVideo() {
    hide();
    query_.cancel();
    known_.clear();
    closeVideo();
}

void TimelineThumbnails::closeVideo() {
    close_due_.stop();
    query_.post([opened = opened_](const BackgroundTask&) { opened->source.reset(); });
}

void TimelineThumbnails::ask() {
    if (!wanted_ || !session_.media()) return;
    close_due_.stop();
    const auto work = [this, frame = *wanted_, media = *session_.media(),
                       opened = opened_](const BackgroundTask& task) {
        QImage picture;
        try {
            if (!opened->source || opened->identity != media.identity) {
                opened->source = media.open({}, task.stop());
                opened->identity = media.identity;
            }
            if (task.stop().stop_requested()) return;
            const Frame read = opened->source->read(frame, true);
            picture = thumbnailOf(read.colour.empty() ? read.gray : read.colour);
        } catch (const std::exception&) {
            opened->source.reset();  // what cannot be read has no picture here; the canvas tells why
            return;
        }
        task.tell([this, frame, picture] { take(frame, picture); });
    };
    // Each that was begun is shown, so that there is something to see however fast the pointer moves.
    query_.ask(work, {}, BackgroundQuery::Former::finish);
}

void TimelineThumbnails::take(FrameIndex frame, const QImage& picture) {
    if (picture.isNull()) return;
    known_.put(frame, picture, static_cast<std::size_t>(picture.sizeInBytes()));
    if (wanted_) show(frame, picture);
}

void TimelineThumbnails::show(FrameIndex frame, const QImage& picture) {
    if (popup_ == nullptr) return;
    shown_ = frame;
    picture_ = picture;
    picture_label_->setPixmap(QPixmap::fromImage(picture));
    // The time of the picture, which may still be one of a moment ago.
    const auto& times = session_.timesUs();
    const auto index = static_cast<std::size_t>(frame);
    const QString time = index < times.size() ? timeline_.rulerText(times[index], 1) : QString();
    caption_->setText(time.isEmpty() ? tr("Frame %1").arg(frame) : time);
    popup_->adjustSize();
    place();
    popup_->show();
}

void TimelineThumbnails::place() {
    QPoint corner = timeline_.mapToGlobal(QPoint(x_ - popup_->width() / 2, -popup_->height() - kAbove_px));
    const QRect seen = timeline_.screen()->availableGeometry();
    corner.setX(std::clamp(corner.x(), seen.left(), std::max(seen.left(), seen.right() - popup_->width())));
    corner.setY(std::max(corner.y(), seen.top()));
    popup_->move(corner);
}

}  // namespace eyrie::ui

#include "moc_timeline_thumbnails.cpp"
