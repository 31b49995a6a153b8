#pragma once

#include <QImage>
#include <QObject>
#include <map>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "session/background/background_query.h"
#include "session/project/media.h"

namespace eyrie::ui {

/// A place to be cut out of the video.
struct ChipWish {
    int id = 0;
    FrameIndex frame = 0;
    OrientedBox box;
    int height_px = 36;  ///< of the chip, screen px
};

/// Cuts small pictures of errors out of the video in the background: the box upright as in the video, with its
/// surroundings. Of several lists of wishes the newest wins. Signals arrive on the thread of this object.
class ErrorChips : public QObject {
    Q_OBJECT

 public:
    explicit ErrorChips(QObject* parent = nullptr) : QObject(parent) {}

    /// Another video, or none; wishes that are left are dropped.
    void setMedia(std::optional<Media> media);
    /// Answers with ready() for each, in the order of frames.
    void request(std::vector<ChipWish> wishes);

 signals:
    void ready(int id, const QImage& chip);

 private:
    std::optional<Media> media_;
    std::unique_ptr<FrameSource> source_;  ///< in the background only
    std::string source_of_;                ///< likewise
    BackgroundQuery query_;                ///< last: stops before the rest goes
};

/// The surroundings of a box, about three boxes wide, with the box drawn in.
QImage errorChip(const cv::Mat& gray, const OrientedBox& box, int height_px);

}  // namespace eyrie::ui
