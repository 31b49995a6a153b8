#include "session/frames/opened_video.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace eyrie::ui {

OpenedVideo videoNotThere(const SequenceRecord& sequence) {
    OpenedVideo video;
    VideoInfo& info = video.info;
    info.path = sequence.path;
    info.size = sequence.size;
    info.frame_count = sequence.frame_count;
    info.frame_rate_hz = sequence.frame_rate_hz;
    info.frame_rate_assumed = sequence.rate_assumed;
    video.times_us.resize(static_cast<std::size_t>(std::max(0, info.frame_count)));
    for (std::size_t i = 0; i < video.times_us.size(); ++i)
        video.times_us[i] = std::llround(static_cast<double>(i) * 1e6 / std::max(0.001, info.frame_rate_hz));
    return video;
}

SequenceRecord sequenceOf(const Media& media, const VideoInfo& video) {
    SequenceRecord sequence;
    sequence.path = media.identity;
    sequence.size = video.size;
    sequence.frame_count = video.frame_count;
    sequence.frame_rate_hz = video.frame_rate_hz;
    sequence.rate_assumed = video.frame_rate_assumed;
    return sequence;
}

}  // namespace eyrie::ui
