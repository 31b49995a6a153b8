#include "report/clip/run_clip.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "correction/corrected_run.h"
#include "io/video/frame_colour.h"
#include "io/video/video_writer.h"
#include "report/clip/annotator.h"

namespace eyrie {
namespace {

/// Draws the tracks of a run, those that began before the clip with their trails.
class TrackPainter {
 public:
    TrackPainter(const ClipWish& wish, ProjectFile& project, const RunRecord& run)
        : store_(project), run_(run.id), annotator_(Annotator::Parts::tracks) {
        if (!wish.uncorrected) corrected_ = readCorrectedTracks(project, run);
        for (FrameIndex frame = std::max(0, wish.range.first - Annotator::kTrailFrames); frame < wish.range.first;
             ++frame)
            if (const auto result = resultOf(frame)) annotator_.follow(*result);
    }

    cv::Mat draw(const Frame& picture) {
        return annotator_.draw(picture, resultOf(picture.index).value_or(FrameResult()));
    }

 private:
    std::optional<FrameResult> resultOf(FrameIndex frame) const {
        auto result = store_.frameResult(run_, frame);
        if (result) result->tracks = corrected_.in(frame, std::move(result->tracks));
        return result;
    }

    RunStore store_;
    int run_;
    CorrectedTracks corrected_;
    Annotator annotator_;
};

/// The range as far as the video goes, which may have become shorter since the run.
FrameRange framesLeft(FrameRange range, const VideoInfo& video) {
    range.last = std::min(range.last, video.frame_count - 1);
    if (range.first > range.last) {
        throw Error(ErrorKind::input, video.path.string() + ": is shorter than when the run was made; it has " +
                                          std::to_string(video.frame_count) + " frames");
    }
    return range;
}

}  // namespace

FrameRange framesAround(FrameRange event, double around_s, FrameRange whole,
                        const std::function<double(FrameIndex)>& secondsOf) {
    constexpr double kSlack_s = 1e-6;
    event.first = std::clamp(event.first, whole.first, std::max(whole.first, whole.last));
    event.last = std::clamp(event.last, event.first, std::max(event.first, whole.last));
    const double begin = secondsOf(event.first) - around_s - kSlack_s;
    const double end = secondsOf(event.last) + around_s + kSlack_s;
    while (event.first > whole.first && secondsOf(event.first - 1) >= begin) --event.first;
    while (event.last < whole.last && secondsOf(event.last + 1) <= end) ++event.last;
    return event;
}

std::optional<FrameRange> writeClip(const ClipWish& wish, ProjectFile& project, const RunRecord& run,
                                    FrameSource& source, const std::filesystem::path& out,
                                    const std::function<void(double)>& progress, const std::stop_token& stop) {
    const auto [first, last] = framesLeft(wish.range, source.info());
    std::optional<TrackPainter> tracks;
    if (wish.overlay) tracks.emplace(wish, project, run);
    VideoWriterOptions options;
    options.frame_rate_hz = source.info().frame_rate_hz;
    const int zoom = wish.overlay ? annotationZoom(source.info().size) : 1;
    VideoWriter writer(out, source.info().size * zoom, options);
    const std::int64_t begin_us = source.timeOf(first);
    try {
        for (FrameIndex frame = first; frame <= last; ++frame) {
            if (stop.stop_requested()) {
                writer.abandon();
                return std::nullopt;
            }
            const Frame picture = source.read(frame, true);
            const cv::Mat image = tracks ? tracks->draw(picture) : colourOf(picture);
            // Frames keep their distances in time; where the rate is even the writer counts them itself, to the digit.
            writer.write(image, source.info().variable_frame_rate ? source.timeOf(frame) - begin_us : -1);
            if (progress) progress(static_cast<double>(frame - first + 1) / (last - first + 1));
        }
        writer.finish();
    } catch (...) {
        writer.abandon();  // half a clip is no evidence
        throw;
    }
    return FrameRange{first, last};
}

}  // namespace eyrie
