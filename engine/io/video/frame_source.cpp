#include "io/video/frame_source.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.h"
#include "io/file_kind.h"
#include "io/video/image_sequence.h"
#include "io/video/parts/part_list.h"
#include "io/video/parts/part_source.h"
#include "io/video/video_reader.h"

namespace eyrie {
namespace {

constexpr double kSameRate = 0.005;  ///< share of the video's own one

/// A project or a table where a video belongs: says what takes them.
void refuseOtherThanVideo(const std::filesystem::path& path) {
    const FileKind kind = kindOfFile(path);
    const std::string what = path.string() + ": is " + nameOf(kind) + ", not a video; ";
    if (kind == FileKind::project) {
        throw Error(ErrorKind::input, what +
                                          "open it as a project in the window, look with eyrie-cli info, or give it to "
                                          "evaluate, report, sweep or export as --project");
    }
    if (kind == FileKind::text || kind == FileKind::json || kind == FileKind::xml) {
        if (hasVideoName(path)) throw Error(ErrorKind::input, what + "copy or record the video again");
        throw Error(ErrorKind::input, what +
                                          "import labels into a project (label workspace, or eyrie-cli import; --show "
                                          "tells what is in it), or evaluate against them as --ground-truth");
    }
}

}  // namespace

const VideoPart* VideoInfo::partOf(FrameIndex frame) const {
    if (frame < 0 || frame >= frame_count) return nullptr;
    const auto next = std::upper_bound(parts.begin(), parts.end(), frame, [](FrameIndex wanted, const VideoPart& part) {
        return wanted < part.first_frame;
    });
    return next == parts.begin() ? nullptr : &*std::prev(next);
}

std::int64_t shiftedStamp(std::int64_t stamp_us, std::int64_t shift_us) {
    std::int64_t shifted = 0;
    return stamp_us == kNoStamp || __builtin_add_overflow(stamp_us, shift_us, &shifted) ? kNoStamp : shifted;
}

bool isSameRate(double rate_hz, double own_rate_hz) {
    return std::abs(rate_hz - own_rate_hz) <= kSameRate * own_rate_hz;
}

double overridingRate(const SourceOptions& options, double own_rate_hz) {
    if (options.frame_rate_hz > 0) return options.frame_rate_hz;
    const double remembered = options.remembered_rate_hz;
    return remembered > 0 && !isSameRate(remembered, own_rate_hz) ? remembered : 0;
}

std::unique_ptr<FrameSource> openSource(const std::filesystem::path& path, const SourceOptions& options,
                                        const IndexProgress& progress, std::stop_token stop) {
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status))
        throw Error(ErrorKind::input,
                    path.string() + ": there is no such file or folder" +
                        (failure && failure != std::errc::no_such_file_or_directory ? " (" + failure.message() + ")"
                                                                                    : "; check the name"));
    if (std::filesystem::is_directory(status) || ImageSequence::isImageFile(path))
        return std::make_unique<ImageSequence>(path, options);
    if (!std::filesystem::is_regular_file(status))
        throw Error(ErrorKind::input, path.string() + ": is neither a file nor a folder");
    if (std::filesystem::file_size(path, failure) == 0 && !failure)
        throw Error(ErrorKind::input, path.string() + ": the file is empty; record or copy it again");
    if (hasPartListName(path)) return openPartList(path, options, progress, std::move(stop));
    refuseOtherThanVideo(path);
    return std::make_unique<VideoReader>(path, options, progress, std::move(stop));
}

}  // namespace eyrie
