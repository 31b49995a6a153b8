#pragma once

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <opencv2/core/types.hpp>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/values/frame.h"

namespace eyrie {

/// One file of a video that consists of several, which follow each other without a gap in frames and in time.
struct VideoPart {
    std::filesystem::path file;  ///< absolute
    FrameIndex first_frame = 0;  ///< in the whole video
    int frame_count = 0;
    std::int64_t first_time_us = 0;            ///< of its first frame, in the time of the whole video
    int first_picture = 0;                     ///< coded pictures of the parts before it
    std::int64_t stamp_shift_us = 0;           ///< takes its container's stamps to PictureStamp::stamp_us of the whole
    std::optional<std::int64_t> start_utc_us;  ///< when its first frame was taken, as a person wrote into the list
    std::optional<std::int64_t> created_utc_us = {};  ///< VideoInfo::created_utc_us of the file
};

/// What is known of a video before its first frame is decoded.
struct VideoInfo {
    std::filesystem::path path;  ///< absolute: the video file, the folder of images or the list of parts
    cv::Size size;               ///< px, of the first frame; a frame of another size is an Error(input) when read
    int frame_count = 0;
    double frame_rate_hz = 25;  ///< mean rate from the time stamps, or the one given by the user; > 0
    double gsd_m_per_px = 0;    ///< metres per pixel where the source itself knows it (built-in scenes); 0: unknown
    bool frame_rate_assumed = false;  ///< neither the video nor anybody says it
    bool variable_frame_rate = false;
    bool is_image_sequence = false;
    std::string codec;                  ///< "h264", "png sequence" …
    std::string container;              ///< "mov,mp4,…", "folder"
    std::vector<VideoPart> parts = {};  ///< in order, where the video consists of several files; else none
    /// When the file was begun, µs since 1970-01-01, as its container says; many never say it, some in local time, and
    /// who converts a video may put in when that was done. None of several parts.
    std::optional<std::int64_t> created_utc_us = {};

    /// The part that a frame lies in; null where the video is one file, or has no such frame.
    const VideoPart* partOf(FrameIndex frame) const;
};

/// A presentation stamp that is not there.
inline constexpr std::int64_t kNoStamp = INT64_MIN;

/// A coded picture on the clock of its container and in the time of the video.
struct PictureStamp {
    std::int64_t stamp_us = kNoStamp;  ///< presentation stamp, µs; kNoStamp: none
    std::int64_t time_us = kNoStamp;   ///< timeOf() of its frame; kNoStamp: it is never shown
};

/// A stamp of a part's container on the clock of the whole video; what does not fit is no stamp.
std::int64_t shiftedStamp(std::int64_t stamp_us, std::int64_t shift_us);

/// A frame was not read, since who asked for it had something better to do; nothing is wrong with it.
class ReadingGivenUp : public std::exception {
 public:
    const char* what() const noexcept override { return "reading was given up"; }
};

/// Random access to the frames of a video or image folder, exact to the frame. Not thread-safe: one thread, one source.
class FrameSource {
 public:
    virtual ~FrameSource() = default;
    virtual const VideoInfo& info() const = 0;
    /// Frame `index` in [0, frame_count). Throws Error(input) naming file and frame when it cannot be decoded.
    virtual Frame read(FrameIndex index, bool with_colour) = 0;
    /// Presentation time from the start of the video, microseconds, without decoding.
    virtual std::int64_t timeOf(FrameIndex index) const = 0;
    /// The pictures of a video file in file order, without decoding; nothing for what is none. Of several parts one
    /// after the other, the clock of each container shifted so that it goes on from the part before.
    virtual std::vector<PictureStamp> pictureStamps() const { return {}; }
    /// Whether there is more of the video now than when it was opened, since somebody still writes it. Its frames stay
    /// those of then; who wants the others opens it anew.
    virtual bool hasGrown() const noexcept { return false; }
    /// `given_up` is asked between the pictures that are decoded on the way to a frame; where it says yes, read()
    /// throws ReadingGivenUp. What reads any frame at once never asks.
    virtual void giveUpWhen(std::function<bool()> /*given_up*/) {}
};

/// How a video is opened.
struct SourceOptions {
    double frame_rate_hz =
        0;  ///< > 0 overrides the video's own rate (needed for image folders); 0: own, 25 for folders
    /// The rate a project knows for this video; 0: none. Where `frame_rate_hz` says nothing it counts like it, unless
    /// it is the video's own: then the time stamps stay as they are.
    double remembered_rate_hz = 0;
    std::filesystem::path index_folder;  ///< where indexes are cached; empty: the user's cache folder
};

/// Whether a rate is the video's own one, only measured again; a project keeps rates as they were measured.
bool isSameRate(double rate_hz, double own_rate_hz);

/// The rate that overrides a video's own one, `own_rate_hz`; 0: none does.
double overridingRate(const SourceOptions& options, double own_rate_hz);

/// Called while a video is indexed, with the share done in [0, 1].
using IndexProgress = std::function<void(double share)>;

/// Opens a video file, a folder of images or a list of parts (parts/part_list.h). Throws Error(input) with file, reason
/// and remedy; an aborted indexing (`stop` requested) throws Error(input) "stopped while indexing".
std::unique_ptr<FrameSource> openSource(const std::filesystem::path& path, const SourceOptions& options = {},
                                        const IndexProgress& progress = {}, std::stop_token stop = {});

}  // namespace eyrie
