#include "chain/chain_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "chain/chain.h"
#include "chain/stopwatch.h"
#include "core/error.h"

namespace eyrie {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What the first half hands to the second.
struct RegisteredItem {
    Frame frame;
    FrameMotion motion;
    StageTimes times{};
};

/// A short queue between the two halves. Either side can close it; the error of the first half travels with it.
class ItemQueue {
 public:
    /// False when the other side has closed the queue.
    bool push(RegisteredItem item) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return items_.size() < capacity || closed_; });
        if (closed_) return false;
        items_.push_back(std::move(item));
        changed_.notify_all();
        return true;
    }
    /// Nothing when the queue is closed and empty; rethrows the producer's error then.
    std::optional<RegisteredItem> pop() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return !items_.empty() || closed_; });
        if (items_.empty()) {
            if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
            return std::nullopt;
        }
        RegisteredItem item = std::move(items_.front());
        items_.pop_front();
        changed_.notify_all();
        return item;
    }
    void close(std::exception_ptr error = nullptr) {
        const std::scoped_lock lock(mutex_);
        closed_ = true;
        if (error) error_ = std::move(error);
        changed_.notify_all();
    }
    /// The consumer is gone: nothing more is wanted.
    void abandon() {
        const std::scoped_lock lock(mutex_);
        closed_ = true;
        items_.clear();
        changed_.notify_all();
    }

 private:
    static constexpr std::size_t capacity = 3;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<RegisteredItem> items_;
    bool closed_ = false;
    std::exception_ptr error_;
};

void produce(FrameSource& source, FrameIndex first, FrameIndex last, bool with_colour, MotionHalf& half,
             ItemQueue& queue, const std::stop_token& stop) {
    try {
        for (FrameIndex index = first; index <= last && !stop.stop_requested(); ++index) {
            RegisteredItem item;
            {
                const Stopwatch watch(item.times, Stage::read);
                item.frame = source.read(index, with_colour);
            }
            item.motion = half.next(item.frame, item.times);
            if (!queue.push(std::move(item))) return;
        }
        queue.close();
    } catch (...) {
        queue.close(std::current_exception());
    }
}

/// Frames per second over the last seconds, and what is left.
class ProgressMeter {
 public:
    explicit ProgressMeter(int total) : total_(total) {}
    RunProgress frameDone() {
        const auto now = Clock::now();
        recent_.push_back(now);
        while (recent_.size() > 2 && now - recent_.front() > std::chrono::seconds(5)) recent_.pop_front();
        RunProgress progress;
        progress.frames_done = ++done_;
        progress.frames_total = total_;
        const double span = std::chrono::duration<double>(recent_.back() - recent_.front()).count();
        if (recent_.size() > 1 && span > 0) {
            progress.frames_per_second = static_cast<double>(recent_.size() - 1) / span;
            progress.seconds_left = (total_ - done_) / progress.frames_per_second;
        }
        return progress;
    }

 private:
    int total_;
    int done_ = 0;
    std::deque<Clock::time_point> recent_;
};

StageTimes medianTimes(const std::vector<StageTimes>& frames) {
    StageTimes median{};
    std::vector<float> values(frames.size());
    for (std::size_t stage = 0; stage < median.size() && !frames.empty(); ++stage) {
        std::transform(frames.begin(), frames.end(), values.begin(), [&](const StageTimes& t) { return t[stage]; });
        const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), middle, values.end());
        median[stage] = *middle;
    }
    return median;
}

}  // namespace

RunSummary ChainRun::run(FrameSource& source, FrameRange range, ChainObserver& observer, std::stop_token stop,
                         bool with_colour) const {
    const auto start = Clock::now();
    RunSummary summary;
    summary.message.clear();
    std::vector<StageTimes> times;
    try {
        const int count = source.info().frame_count;
        const FrameIndex last = range.last < 0 ? count - 1 : range.last;
        if (range.first < 0 || last >= count || range.first > last) {
            throw Error(ErrorKind::parameter, "frames " + std::to_string(range.first) + " to " + std::to_string(last) +
                                                  " are not in " + source.info().path.string() +
                                                  ", which has frames 0 to " + std::to_string(count - 1));
        }
        summary.frames_total = last - range.first + 1;
        MotionHalf motion_half(options_, scale_);
        TrackHalf track_half(options_, scale_);
        ItemQueue queue;
        ProgressMeter meter(summary.frames_total);
        // Frame t+1 is registered on this thread while frame t is segmented and tracked below.
        std::jthread producer([&] { produce(source, range.first, last, with_colour, motion_half, queue, stop); });
        struct Abandon {
            ItemQueue& queue;
            ~Abandon() { queue.abandon(); }
        } abandon_on_exit{queue};
        while (!stop.stop_requested()) {
            std::optional<RegisteredItem> item = queue.pop();
            if (!item) break;
            const auto result =
                std::make_shared<const FrameResult>(track_half.next(item->frame, std::move(item->motion), item->times));
            if (!result->motion.registration.reliable() &&
                result->motion.registration.state != RegistrationState::first) {
                ++summary.unregistered_frames;
            }
            observer.onFrame(result, item->frame);
            times.push_back(result->stage_ms);
            const RunProgress progress = meter.frameDone();
            summary.frames_done = progress.frames_done;
            observer.onProgress(progress);
        }
        summary.outcome = summary.frames_done == summary.frames_total ? RunOutcome::finished : RunOutcome::stopped;
    } catch (const std::exception& error) {
        summary.outcome = RunOutcome::failed;
        summary.message = error.what();
    }
    summary.seconds = secondsSince(start);
    summary.median_ms = medianTimes(times);
    return summary;
}

}  // namespace eyrie
