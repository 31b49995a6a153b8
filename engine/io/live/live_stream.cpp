#include "io/live/live_stream.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/values/last_frame.h"
#include "io/live/live_address.h"
#include "io/live/live_connection.h"
#include "io/live/live_recording.h"
#include "io/video/pixel_conversion.h"

namespace eyrie {
namespace {

using LiveClock = std::chrono::steady_clock;

constexpr double kBetweenAttempts_s = 0.5;
constexpr double kBetweenLooks_s = 1;  ///< at the space that is left

double liveSecondsSince(LiveClock::time_point start) {
    return std::chrono::duration<double>(LiveClock::now() - start).count();
}

/// The disk with the least space of those that are written to.
struct DiskSpace {
    std::filesystem::path path;    ///< what is written there
    std::uint64_t free_bytes = 0;  ///< 0: nothing could be asked
};

DiskSpace leastSpace(const LiveOptions& options) {
    std::vector<std::filesystem::path> written = options.also_written;
    written.push_back(options.recording);
    DiskSpace least;
    for (const std::filesystem::path& path : written) {
        std::error_code unknown;
        const auto space = std::filesystem::space(std::filesystem::absolute(path).parent_path(), unknown);
        if (!unknown && (least.path.empty() || space.available < least.free_bytes)) least = {path, space.available};
    }
    return least;
}

std::string liveSizeText(cv::Size size) {
    return std::to_string(size.width) + "×" + std::to_string(size.height) + " px";
}

/// A frame that waits for the reader; one that was left out has no picture.
struct WaitingFrame {
    FrameIndex index = 0;
    std::int64_t time_us = 0;
    cv::Mat gray;
    cv::Mat colour;  ///< where that is wanted
};

}  // namespace

/// What receives, on a thread of its own.
struct LiveStream::Receiver {
    Receiver(std::string from, LiveOptions wishes, std::stop_token stop)
        : address(std::move(from)),
          options(std::move(wishes)),
          end_with_caller(std::move(stop), [this] { ending.request_stop(); }) {
        thread = std::jthread([this] { work(); });
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return over || facts.frames > 0; });
        if (facts.frames > 0) return;
        lock.unlock();
        thread.join();
        if (error) std::rethrow_exception(error);
        throw Error(ErrorKind::input, shownAddress(address) + ": ended before its first picture: " + facts.ended);
    }
    ~Receiver() { ending.request_stop(); }

    void work() {
        std::exception_ptr failure;
        try {
            receiveAll();
        } catch (...) {
            failure = std::current_exception();
        }
        const std::scoped_lock lock(mutex);
        error = failure;
        over = true;
        changed.notify_all();
    }

    /// Why nothing more may be written; empty while there is room. The receiving thread asks.
    std::string lackOfRoom() {
        looked_at_disk = LiveClock::now();
        const DiskSpace least = leastSpace(options);
        {
            const std::scoped_lock lock(mutex);
            facts.free_bytes = least.free_bytes;
        }
        if (least.path.empty() || least.free_bytes >= options.least_free_bytes) return {};
        return "the disk of " + least.path.string() + " has less than " +
               std::to_string(options.least_free_bytes / 1'000'000) + " MB left";
    }

    void receiveAll() {
        if (const std::string lack = lackOfRoom(); !lack.empty())
            throw Error(ErrorKind::output, lack + "; make room, or choose another place");
        LiveRecording recording(options.recording);
        try {
            receiveInto(recording);
        } catch (...) {
            if (facts.frames == 0) recording.discard();
            throw;
        }
        if (facts.frames == 0) return recording.discard();
        recording.finish();
    }

    std::unique_ptr<LiveConnection> connect(double seconds) const {
        return isCamera(address) ? connectToCamera(address, options.open_camera, {seconds, options.camera_close_s},
                                                   ending.get_token())
                                 : connectToNet(address, seconds, ending.get_token());
    }

    void receiveInto(LiveRecording& recording) {
        auto connection = connect(options.connect_s);
        while (connection) {
            if (!goesOnWith(*connection)) break;
            recording.begin(connection->demuxer(), connection->video());
            const bool goes_on = receive(*connection, recording);
            connection.reset();
            if (goes_on) connection = connectAgain();
        }
    }

    /// Whether a connection sends what those before it sent. Nothing else may lie in one recording.
    bool goesOnWith(const LiveConnection& connection) {
        const AVCodecParameters& video = *connection.videoStream().codecpar;
        const std::string codec = avcodec_get_name(video.codec_id);
        if (!info.codec.empty() && codec != info.codec) return endForChange("codec", info.codec, codec);
        const cv::Size size(video.width, video.height);
        if (facts.frames > 0 && size != info.size)
            return endForChange("picture", liveSizeText(info.size), liveSizeText(size));
        return true;
    }

    /// Null when it is given up, or no longer wanted.
    std::unique_ptr<LiveConnection> connectAgain() {
        std::string why;
        setConnected(false);
        while (!ending.stop_requested()) {
            const double left = options.give_up_s - liveSecondsSince(last_picture);
            if (left <= 0) {
                endFor("no picture came for " + std::to_string(static_cast<int>(options.give_up_s)) + " s" +
                       (why.empty() ? "" : " (" + why + ")") + "; check that the source sends, and start another run");
                return nullptr;
            }
            try {
                auto connection = connect(std::max(0.5, std::min(left, options.connect_s)));
                const std::scoped_lock lock(mutex);
                ++facts.reconnects;
                facts.connected = true;
                return connection;
            } catch (const Error& refused) {
                why = refused.what();
            }
            std::unique_lock lock(mutex);
            changed.wait_for(lock, std::chrono::duration<double>(kBetweenAttempts_s),
                             [&] { return ending.stop_requested(); });
        }
        return nullptr;
    }

    /// Answers whether to connect again.
    bool receive(LiveConnection& connection, LiveRecording& recording) {
        const AVStream& stream = connection.videoStream();
        const AVCodec* decoder = avcodec_find_decoder(stream.codecpar->codec_id);
        if (decoder == nullptr)
            throw Error(ErrorKind::input, shownAddress(address) + ": there is no decoder for its codec (" +
                                              avcodec_get_name(stream.codecpar->codec_id) +
                                              "); let the source send H.264 or HEVC");
        libav::Codec codec(avcodec_alloc_context3(decoder));
        avcodec_parameters_to_context(codec.get(), stream.codecpar);
        codec->thread_count = 1;  // a further thread would hold a further frame back
        if (const int opened = avcodec_open2(codec.get(), decoder, nullptr); opened < 0)
            throw Error(ErrorKind::input, shownAddress(address) + ": the decoder cannot be started (" +
                                              libav::errorText(opened) + "); let the source send H.264 or HEVC");
        tick = stream.time_base;
        learnRate(stream);
        const libav::Packet packet(av_packet_alloc());
        const LiveClock::time_point begin = LiveClock::now();
        bool full = false;
        while (!ending.stop_requested()) {
            if (!connection.read(*packet, options.stall_s)) break;
            const double gap = facts.frames > 0 ? liveSecondsSince(last_picture) : 0;
            noteGap(gap);
            const bool picture = packet->stream_index == connection.video();
            const bool recorded =
                recording.write(*packet, connection.demuxer(), static_cast<std::int64_t>(gap * 1'000'000));
            const bool good = !recorded || !picture || decode(*codec, packet.get(), connection.wasHeldBack());
            av_packet_unref(packet.get());
            if (!good) return false;
            full = !hasRoom(recording.bytes());
            if (full) break;
            if (stalls(begin)) break;
        }
        // What the decoder holds back still counts: the recording has it.
        if (!decode(*codec, nullptr, true) || full || ending.stop_requested()) return false;
        if (connection.hasEnded()) endFor("the source has an end; download it and run over the file");
        return !connection.hasEnded();
    }

    /// Whether a connection brings no pictures, whatever else it brings. Throws Error(input) when none came ever.
    bool stalls(LiveClock::time_point begin) const {
        // The first one is a key frame, which may be longer to come.
        const bool begun = last_picture >= begin;
        if (liveSecondsSince(std::max(last_picture, begin)) <= (begun ? options.stall_s : longestWait())) return false;
        if (facts.frames > 0) return true;
        throw Error(ErrorKind::input, shownAddress(address) + ": no picture that could be shown came within " +
                                          std::to_string(std::lround(longestWait())) +
                                          " s; check that it sends key frames");
    }
    double longestWait() const { return std::max(options.stall_s, options.connect_s); }

    void learnRate(const AVStream& stream) {
        if (info.frame_count > 0) return;
        double rate = av_q2d(stream.avg_frame_rate.num > 0 ? stream.avg_frame_rate : stream.r_frame_rate);
        if (options.frame_rate_hz > 0) rate = options.frame_rate_hz;
        const std::scoped_lock lock(mutex);
        info.path = std::filesystem::absolute(options.recording);
        info.frame_count = kLastFrame + 1;
        info.frame_rate_assumed = !(rate > 1 && rate < 1000);
        info.frame_rate_hz = info.frame_rate_assumed ? 25 : rate;
        info.codec = avcodec_get_name(stream.codecpar->codec_id);
        info.container = "mpegts";
    }

    void setConnected(bool connected) {
        const std::scoped_lock lock(mutex);
        facts.connected = connected;
    }

    /// Takes down what is recorded; false, having ended, once too little space is left.
    bool hasRoom(std::uint64_t recorded) {
        {
            const std::scoped_lock lock(mutex);
            facts.recorded_bytes = recorded;
        }
        if (liveSecondsSince(looked_at_disk) < kBetweenLooks_s) return true;
        const std::string lack = lackOfRoom();
        if (!lack.empty()) endFor(lack + "; make room before the next run");
        return lack.empty();
    }

    void noteGap(double gap_s) {
        const std::scoped_lock lock(mutex);
        facts.longest_gap_s = std::max(facts.longest_gap_s, gap_s);
    }

    void endFor(const std::string& why) {
        const std::scoped_lock lock(mutex);
        facts.ended = why;
    }
    bool endForChange(const std::string& what, const std::string& before, const std::string& now) {
        endFor("the " + what + " changed from " + before + " to " + now +
               (facts.frames > 0 ? " after frame " + std::to_string(facts.frames - 1) : "") +
               "; start another run for it");
        return false;
    }

    /// False when the stream cannot be gone on with. `held_back`: it had come before.
    bool decode(AVCodecContext& codec, const AVPacket* packet, bool held_back) {
        if (avcodec_send_packet(&codec, packet) < 0) return true;  // damaged: the next ones may be better
        const libav::Picture picture(av_frame_alloc());
        while (avcodec_receive_frame(&codec, picture.get()) >= 0) {
            if (!held_back) last_picture = LiveClock::now();
            const bool good = deliver(*picture);
            av_frame_unref(picture.get());
            if (!good) return false;
        }
        return true;
    }

    bool deliver(const AVFrame& picture) {
        const cv::Size size(picture.width, picture.height);
        if (facts.frames > 0 && size != info.size)
            return endForChange("picture", liveSizeText(info.size), liveSizeText(size));
        WaitingFrame frame;
        const std::int64_t ticks = picture.best_effort_timestamp;
        const std::int64_t usual = last_time_us + std::llround(1e6 / info.frame_rate_hz);
        const std::int64_t stamp = ticks == AV_NOPTS_VALUE ? kNoStamp : av_rescale_q(ticks, tick, {1, 1'000'000});
        if (!first_stamp_us && stamp != kNoStamp) first_stamp_us = stamp;
        frame.time_us = stamp == kNoStamp ? usual : stamp - *first_stamp_us;
        if (facts.frames > 0 && frame.time_us <= last_time_us) frame.time_us = usual;
        last_time_us = frame.time_us;
        const bool room = with_picture < options.waiting_frames || facts.frames == 0;
        if (room) frame.gray = conversion.gray(picture);
        if (room && options.with_colour) frame.colour = conversion.colour(picture);
        const std::scoped_lock lock(mutex);
        if (facts.frames == 0) info.size = size;
        frame.index = facts.frames++;
        delivered = last_picture;  // what the decoder held back came then, too
        if (room) {
            ++with_picture;
        } else {
            ++facts.skipped;
        }
        waiting.push_back(std::move(frame));
        changed.notify_all();
        return true;
    }

    std::string address;
    LiveOptions options;
    std::stop_source ending;
    std::stop_callback<std::function<void()>> end_with_caller;

    mutable std::mutex mutex;  ///< of all below that both threads use
    std::condition_variable changed;
    VideoInfo info;
    LiveFacts facts;                                     ///< written by the receiving thread alone
    LiveClock::time_point delivered = LiveClock::now();  ///< when the last picture came
    std::deque<WaitingFrame> waiting;
    std::atomic<int> with_picture{0};  ///< of those waiting
    bool over = false;
    std::exception_ptr error;

    // Of the receiving thread:
    AVRational tick{1, 90000};
    PixelConversion conversion;
    LiveClock::time_point last_picture = LiveClock::now();
    LiveClock::time_point looked_at_disk{};
    std::optional<std::int64_t> first_stamp_us;
    std::int64_t last_time_us = 0;

    // Of the reader:
    WaitingFrame last;

    std::jthread thread;  ///< last: it uses all of it
};

LiveStream::LiveStream(std::string address, LiveOptions options, std::stop_token stop)
    : receiver_(std::make_unique<Receiver>(std::move(address), std::move(options), std::move(stop))) {}

LiveStream::~LiveStream() = default;

const VideoInfo& LiveStream::info() const {
    return receiver_->info;
}

Frame LiveStream::read(FrameIndex index, bool) {
    Receiver& receiver = *receiver_;
    std::unique_lock lock(receiver.mutex);
    receiver.changed.wait(lock, [&] { return receiver.over || !receiver.waiting.empty(); });
    if (receiver.waiting.empty()) {
        if (receiver.error) std::rethrow_exception(receiver.error);
        throw StreamEnded{};
    }
    if (receiver.waiting.front().index != index)
        throw Error(ErrorKind::internal, "a live stream was read out of order");
    WaitingFrame next = std::move(receiver.waiting.front());
    receiver.waiting.pop_front();
    if (next.gray.empty()) {
        next.gray = receiver.last.gray;
        next.colour = receiver.last.colour;
    } else {
        --receiver.with_picture;
    }
    receiver.last = next;
    Frame frame;
    frame.index = next.index;
    frame.time_us = next.time_us;
    frame.gray = std::move(next.gray);
    frame.colour = std::move(next.colour);
    return frame;
}

std::int64_t LiveStream::timeOf(FrameIndex index) const {
    const std::scoped_lock lock(receiver_->mutex);
    const WaitingFrame& last = receiver_->last;
    return last.time_us + std::llround((index - last.index) * 1e6 / receiver_->info.frame_rate_hz);
}

double LiveStream::backlog() const {
    return static_cast<double>(receiver_->with_picture) / std::max(1, receiver_->options.waiting_frames);
}

LiveFacts LiveStream::facts() const {
    const std::scoped_lock lock(receiver_->mutex);
    LiveFacts facts = receiver_->facts;
    facts.silent_s = liveSecondsSince(receiver_->delivered);
    return facts;
}

void LiveStream::finish() {
    receiver_->ending.request_stop();
    if (receiver_->thread.joinable()) receiver_->thread.join();
}

}  // namespace eyrie
