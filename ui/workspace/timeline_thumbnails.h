#pragma once

#include <QImage>
#include <QObject>
#include <QPointer>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/values/ids.h"
#include "session/background/background_query.h"
#include "session/background/lru_cache.h"
#include "widgets/delayed_call.h"

class QFrame;
class QLabel;

namespace eyrie::ui {

class ProjectSession;
class TimelineView;

/// While the pointer moves over the timeline, a small picture of that time above it. Read in the background, where of
/// several times the newest counts; what was read is kept for a while. Where the video is still being recorded, or is
/// not there, there are none.
class TimelineThumbnails : public QObject {
    Q_OBJECT

 public:
    static constexpr int kWidth = 192;  ///< px of a picture

    /// Both must outlive it.
    TimelineThumbnails(ProjectSession& session, TimelineView& timeline, QObject* parent = nullptr);
    ~TimelineThumbnails() override;

    /// The frame whose picture is seen; nothing while none is.
    std::optional<FrameIndex> shownFrame() const;
    QImage shownPicture() const { return picture_; }
    /// The frame that is read for a place of the timeline: of those that lie close together always the same.
    static FrameIndex frameToRead(FrameIndex pointed_at, double pixels_per_frame);
    /// A picture of the video (CV_8UC1 or CV_8UC3) as it is shown.
    static QImage thumbnailOf(const cv::Mat& picture);

 private:
    struct Opened;
    void pointAt(FrameIndex frame, int x);
    void hide();
    void forgetVideo();
    void closeVideo();
    void ask();
    void take(FrameIndex frame, const QImage& picture);
    void show(FrameIndex frame, const QImage& picture);
    void place();

    ProjectSession& session_;
    TimelineView& timeline_;
    QPointer<QFrame> popup_;  ///< the timeline's
    QLabel* picture_label_;
    QLabel* caption_;
    QImage picture_;
    std::optional<FrameIndex> shown_;
    std::optional<FrameIndex> wanted_;  ///< none: the pointer is elsewhere
    int x_ = 0;
    LruCache<FrameIndex, QImage> known_;
    DelayedCall ask_due_;
    DelayedCall close_due_;           ///< what decodes holds many pictures
    std::shared_ptr<Opened> opened_;  ///< used in the background alone
    BackgroundQuery query_;           ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
