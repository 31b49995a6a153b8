#include "chain/recording/chain_state.h"

#include <map>
#include <utility>

#include "chain/recording/run_recorder.h"
#include "core/error.h"
#include "core/state_values.h"
#include "detection/sliding_window/model_location.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/video/image_sequence.h"

namespace eyrie {
namespace {

constexpr std::uint32_t kFormat = 10;  ///< counts up with every change of what any stage keeps

/// What must be the same for a state to be of use.
std::string conditions(const ChainOptions& options, const SceneScale& scale) {
    std::string text = "eyrie chain state " + std::to_string(kFormat) + "\nengine " + engineVersion() + "\n";
    for (const auto& [name, value] : parameterValues(options)) text += name + "=" + value + "\n";
    StateWriter writer;
    double gsd = scale.gsd_m_per_px;
    double rate = scale.frame_rate_hz;
    bool known = scale.gsd_known;
    double right = scale.slope.right_per_px;
    double down = scale.slope.down_per_px;
    double x = scale.slope.centre_x;
    double y = scale.slope.centre_y;
    writer(gsd, rate, known, right, down, x, y);
    return text + writer.bytes();
}

template <class Archive>
void transferParts(Archive& archive, ChainStateParts& parts) {
    archive(parts.last_done, parts.classifier, parts.motion_half, parts.waiting, parts.track_half);
}

struct Unpacked {
    ChainStateParts parts;
    bool fits = false;
};

cv::Mat noPicture(FrameIndex) {
    throw DamagedState{"a picture where none belongs"};
}

Unpacked unpacked(std::string_view bytes, const ChainOptions& options, const SceneScale& scale) {
    Unpacked result;
    std::uint64_t sum = 0;
    if (bytes.size() < sizeof sum) throw DamagedState{"it ends too early"};
    std::memcpy(&sum, bytes.data() + bytes.size() - sizeof sum, sizeof sum);
    bytes.remove_suffix(sizeof sum);
    if (checksumOf(bytes) != sum) throw DamagedState{"its checksum differs"};
    StateReader reader(bytes, noPicture);
    std::uint64_t fingerprint = 0;
    reader(fingerprint);
    result.fits = fingerprint == checksumOf(conditions(options, scale));
    if (!result.fits) return result;
    transferParts(reader, result.parts);
    reader.end();
    return result;
}

[[noreturn]] void refuseOtherClassifier(const ChainOptions& options) {
    throw Error(ErrorKind::input,
                modelLocation(options.detection.sliding_window.model).string() +
                    " is not the classifier that the run was started with; put the old file back, or start a new run");
}

/// " (frame7.png)" for a picture of a folder, which may have been replaced or renamed.
std::string pictureName(const VideoInfo& video, FrameIndex frame) {
    if (!video.is_image_sequence || !isFolder(video.path)) return "";
    try {
        const std::vector<std::filesystem::path> pictures = imagesIn(video.path);
        const auto at = static_cast<std::size_t>(frame);
        return at < pictures.size() ? " (" + pictures[at].filename().string() + ")" : "";
    } catch (const Error&) {
        return "";  // they went meanwhile
    }
}

template <class Stage>
void restore(Stage& stage, std::string_view bytes, const PictureSource& pictures) {
    StateReader reader(bytes, pictures);
    reader(stage);
    reader.end();
}

}  // namespace

template <class Archive>
void WaitingMotion::transfer(Archive& archive) {
    archive(motion, times);
}

template <class Archive>
void MotionHalf::transfer(Archive& archive) {
    archive(registrar_, independent_motion_);
}

template <class Archive>
void TrackHalf::transfer(Archive& archive) {
    if (difference_) archive(*difference_);
    if (stacker_) archive(*stacker_);
    archive(tracker_);
    if (scores_) archive(*scores_);
}

template void WaitingMotion::transfer(StateWriter&);
template void MotionHalf::transfer(StateWriter&);
template void TrackHalf::transfer(StateWriter&);

std::uint64_t classifierChecksum(const DetectionOptions& options) {
    if (!looksThroughWindows(options.method)) return 0;
    return checksumOf(readWholeFile(modelLocation(options.sliding_window.model)));
}

std::string packedState(ChainStateParts parts, const ChainOptions& options, const SceneScale& scale) {
    StateWriter writer;
    std::uint64_t fingerprint = checksumOf(conditions(options, scale));
    writer(fingerprint);
    transferParts(writer, parts);
    std::string bytes = writer.bytes();
    const std::uint64_t sum = checksumOf(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
    return bytes;
}

std::unique_ptr<ChainProgress> unpackedState(std::string_view bytes, const ChainOptions& options,
                                             const SceneScale& scale, FrameSource& source) {
    const VideoInfo& video = source.info();
    std::map<FrameIndex, cv::Mat> read;  // by both halves
    const PictureSource pictures = [&](FrameIndex frame) {
        if (frame < 0 || frame >= video.frame_count) throw DamagedState{"a picture that the video does not have"};
        cv::Mat& gray = read[frame];
        if (gray.empty()) gray = source.read(frame, false).gray;
        return gray;
    };
    try {
        const auto [parts, fits] = unpacked(bytes, options, scale);
        if (!fits) return nullptr;
        auto progress = std::make_unique<ChainProgress>(options, scale);
        if (parts.classifier != progress->classifier) refuseOtherClassifier(options);
        progress->last_done = parts.last_done;
        restore(progress->motion_half, parts.motion_half, pictures);
        restore(progress->waiting, parts.waiting, pictures);
        restore(progress->track_half, parts.track_half, pictures);
        return progress;
    } catch (const DamagedState&) {
        return nullptr;
    } catch (const ChangedPicture& changed) {
        throw Error(ErrorKind::input, video.path.string() + " is not the same video any more: frame " +
                                          std::to_string(changed.frame) + pictureName(video, changed.frame) +
                                          " shows something else than when the run was started; put the old video "
                                          "back, or start a new run");
    }
}

}  // namespace eyrie
