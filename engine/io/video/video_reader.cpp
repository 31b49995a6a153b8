#include "io/video/video_reader.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "core/time/clock_step.h"
#include "io/tables/size_text.h"
#include "io/video/index_cache.h"

namespace eyrie {

namespace {

/// Key frames to go back for a frame that does not come out of the nearest one: streams that refresh gradually, or
/// refer across key frames.
constexpr std::size_t kStartsToTry = 4;
/// Streams that refresh gradually have no key pictures, only places from which one is built up; measured, what the
/// decoder delivers from there is right only after another period.
constexpr std::size_t kStartsToRefresh = 2;
/// Decoding on is cheaper than seeking when the key frame is this few packets ahead.
constexpr int kPacketsWorthDecoding = 8;

void turn(cv::Mat& image, int quarter_turns) {
    if (image.empty() || quarter_turns == 0) return;
    static constexpr cv::RotateFlags turns[] = {cv::ROTATE_90_CLOCKWISE, cv::ROTATE_180,
                                                cv::ROTATE_90_COUNTERCLOCKWISE};
    cv::Mat turned;
    cv::rotate(image, turned, turns[quarter_turns - 1]);
    image = turned;
}

struct FrameTiming {
    double rate_hz = 0;  ///< 0: unknown
    bool is_variable = false;
};

/// Lost frames do not change the rate: it is the mean over the usual steps if nearly all steps are that, or are whole
/// multiples of it and fewer.
FrameTiming timingOf(const std::vector<std::int64_t>& ticks, double tick_s) {
    if (ticks.size() < 2) return {};
    std::vector<double> steps_s;
    for (std::size_t i = 1; i < ticks.size(); ++i)
        steps_s.push_back(static_cast<double>(ticks[i] - ticks[i - 1]) * tick_s);
    std::vector<double> sorted = steps_s;
    std::nth_element(sorted.begin(), sorted.begin() + std::ssize(sorted) / 2, sorted.end());
    const double usual_s = sorted[sorted.size() / 2];
    // Containers round stamps to as little as a millisecond.
    const double tolerance_s = std::max(0.0015, 0.05 * usual_s);
    double sum_s = 0;
    std::size_t usual_steps = 0;
    std::size_t whole_steps = 0;
    for (const double step_s : steps_s) {
        const double frames = std::max(1.0, std::round(step_s / usual_s));
        if (std::abs(step_s - frames * usual_s) > tolerance_s) continue;
        ++whole_steps;
        if (frames > 1) continue;
        sum_s += step_s;
        ++usual_steps;
    }
    if (usual_steps * 3 < steps_s.size() * 2 || whole_steps * 10 < steps_s.size() * 9) {
        sum_s = 0;
        std::size_t steps = 0;
        for (const double step_s : steps_s) {
            if (isClockJump(step_s, usual_s)) continue;
            sum_s += step_s;
            ++steps;
        }
        if (sum_s <= 0) return {};
        return {static_cast<double>(steps) / sum_s, true};
    }
    return {static_cast<double>(usual_steps) / sum_s, usual_steps < steps_s.size()};
}

}  // namespace

VideoReader::VideoReader(const std::filesystem::path& path, const SourceOptions& options, const IndexProgress& progress,
                         std::stop_token stop) {
    info_.path = std::filesystem::absolute(path).lexically_normal();
    const FileState file = stateOf(info_.path);
    bytes_ = file.size;
    const IndexCache cache(options.index_folder);
    if (auto known = cache.load(info_.path)) {
        index_ = std::move(*known);
    } else {
        decoder_ = buildVideoIndex(info_.path, index_, progress, std::move(stop));
        cache.save(file, index_);
    }
    frame_of_packet_ = index_.framesOfPackets();
    for (std::size_t number = 0; number < index_.packets.size(); ++number)
        if (index_.packets[number].key && frame_of_packet_[number] >= 0)
            key_packets_.push_back(static_cast<int>(number));
    describe(options);
}

bool VideoReader::hasGrown() const noexcept {
    return stateOf(info_.path).size > bytes_;
}

void VideoReader::describe(const SourceOptions& options) {
    const auto& ticks = index_.shown_ticks;
    stamp_tick_numerator_ = index_.tick_numerator;
    stamp_tick_denominator_ = index_.tick_denominator;
    const double tick_s = static_cast<double>(index_.tick_numerator) / static_cast<double>(index_.tick_denominator);
    info_.size = index_.coded_size;
    if (index_.quarter_turns % 2 != 0) std::swap(info_.size.width, info_.size.height);
    info_.frame_count = static_cast<int>(index_.shown.size());
    info_.codec = index_.codec;
    info_.container = index_.container;
    info_.created_utc_us = index_.created_utc_us;
    info_.frame_rate_hz = index_.nominal_rate_hz > 0 ? index_.nominal_rate_hz : 25.0;
    const FrameTiming timing = timingOf(ticks, tick_s);
    if (timing.rate_hz > 0) info_.frame_rate_hz = timing.rate_hz;
    info_.variable_frame_rate = timing.is_variable;
    if (const double rate = overridingRate(options, info_.frame_rate_hz); rate > 0) {
        info_.frame_rate_hz = rate;
        info_.variable_frame_rate = false;
        index_.tick_numerator = 1000;
        index_.tick_denominator = std::max<std::int64_t>(1, std::llround(rate * 1000));
        for (std::size_t i = 0; i < ticks.size(); ++i) index_.shown_ticks[i] = static_cast<std::int64_t>(i);
    }
}

void VideoReader::checkIndex(FrameIndex index) const {
    if (index < 0 || index >= info_.frame_count)
        throw Error(ErrorKind::input, info_.path.string() + ": there is no frame " + std::to_string(index) +
                                          "; the video has frames 0 to " + std::to_string(info_.frame_count - 1));
}

std::int64_t VideoReader::timeOf(FrameIndex index) const {
    checkIndex(index);
    return av_rescale(index_.shown_ticks[static_cast<std::size_t>(index)], index_.tick_numerator * 1'000'000,
                      index_.tick_denominator);
}

std::vector<PictureStamp> VideoReader::pictureStamps() const {
    std::vector<PictureStamp> stamps(index_.packets.size());
    for (std::size_t i = 0; i < stamps.size(); ++i) {
        const std::int64_t pts = index_.packets[i].pts;
        if (pts != kNoStamp)
            stamps[i].stamp_us = av_rescale(pts, stamp_tick_numerator_ * 1'000'000, stamp_tick_denominator_);
        if (frame_of_packet_[i] >= 0) stamps[i].time_us = timeOf(frame_of_packet_[i]);
    }
    return stamps;
}

/// Packets to start from, nearest first. A key frame that is shown later than the wanted one does not do: what it
/// follows in the file and precedes on screen refers to frames before it.
std::vector<int> VideoReader::startsFor(FrameIndex index) const {
    const int packet = index_.shown[static_cast<std::size_t>(index)];
    std::vector<int> starts;
    auto key = std::upper_bound(key_packets_.begin(), key_packets_.end(), packet);
    while (key != key_packets_.begin() && starts.size() < kStartsToTry) {
        --key;
        if (frame_of_packet_[static_cast<std::size_t>(*key)] <= index) starts.push_back(*key);
    }
    const int first = index_.firstStart();
    if (starts.empty() || (starts.size() < kStartsToTry && starts.back() != first)) starts.push_back(first);
    return starts;
}

/// Whether a packet is a whole picture that is shown before a frame. What never shows by itself may be the second field
/// of the picture before it.
bool VideoReader::showsBefore(FrameIndex index, int packet) const {
    const auto number = static_cast<std::size_t>(packet);
    const auto shows = [&](std::size_t each) { return each >= frame_of_packet_.size() || frame_of_packet_[each] >= 0; };
    return shows(number) && shows(number + 1) && frame_of_packet_[number] < index;
}

const AVFrame* VideoReader::decodeUpTo(FrameIndex index) {
    // Far from a key frame half the pictures on the way may be such that nothing depends on.
    decoder_->leaveOut([this, index](int packet) { return showsBefore(index, packet); });
    while ((picture_ = decoder_->next()) != nullptr) {
        const int packet = decoder_->packetOf(*picture_);
        const FrameIndex frame = frame_of_packet_[static_cast<std::size_t>(packet)];
        if (frame < 0) continue;
        start_came_out_ = start_came_out_ || packet == start_;
        picture_frame_ = frame;
        if (frame >= index) return frame == index ? picture_ : nullptr;
        if (given_up_ && given_up_()) throw ReadingGivenUp();
    }
    picture_frame_ = -1;
    return nullptr;
}

const AVFrame& VideoReader::pictureOf(FrameIndex index) {
    if (picture_ != nullptr && picture_frame_ == index) return *picture_;
    if (!decoder_) decoder_ = std::make_unique<VideoDecoder>(info_.path, index_);
    const std::vector<int> starts = startsFor(index);
    const bool ahead = picture_ != nullptr && picture_frame_ < index;
    if (ahead && starts.front() <= decoder_->nextPacket() + kPacketsWorthDecoding)
        if (const AVFrame* picture = decodeUpTo(index)) return *picture;
    for (std::size_t tried = 0; tried < starts.size(); ++tried) {
        picture_ = nullptr;
        start_ = starts[tried];
        start_came_out_ = false;
        decoder_->startAt(start_);
        const AVFrame* picture = nullptr;
        try {
            picture = decodeUpTo(index);
        } catch (const ReadingGivenUp&) {
            picture_ = nullptr;  // whether what follows from this start is whole was not seen yet
            throw;
        }
        if (picture == nullptr) continue;
        const bool lacks_references = (picture->flags & AV_FRAME_FLAG_CORRUPT) != 0;
        const bool still_refreshes = !start_came_out_ && tried < kStartsToRefresh;
        if ((!lacks_references && !still_refreshes) || tried + 1 == starts.size()) return *picture;
    }
    throw Error(ErrorKind::input,
                info_.path.string() + ": frame " + std::to_string(index) +
                    " cannot be decoded; the file is damaged there. Leave the frame out of the range");
}

Frame VideoReader::read(FrameIndex index, bool with_colour) {
    checkIndex(index);
    const AVFrame& picture = pictureOf(index);
    const std::string place = info_.path.string() + ": frame " + std::to_string(index);
    if (const cv::Size size(picture.width, picture.height); size != index_.coded_size)
        throw Error(ErrorKind::input, place + " is " + sizeText(size) + " px, the video began with " +
                                          sizeText(index_.coded_size) + " px; cut the video where its size changes");
    Frame frame;
    frame.index = index;
    frame.time_us = timeOf(index);
    try {
        frame.gray = conversion_.gray(picture);
        if (with_colour) frame.colour = conversion_.colour(picture);
    } catch (const Error& error) {
        throw Error(error.kind(), place + ": " + error.what());
    }
    turn(frame.gray, index_.quarter_turns);
    turn(frame.colour, index_.quarter_turns);
    return frame;
}

}  // namespace eyrie
