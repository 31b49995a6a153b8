#include "chain/chain_run.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "chain/progress_meter.h"
#include "chain/recording/chain_state.h"
#include "chain/repeated_pictures.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "core/values/last_frame.h"
#include "io/clock_jumps.h"
#include "io/live/live_stream.h"

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
    std::string motion_state;  ///< of the first half after this frame, where a state is to be kept
};

/// A short queue between the two halves. Either side can close it; the error of the first half travels with it.
class ItemQueue {
 public:
    /// False when the other side has closed the queue.
    bool push(RegisteredItem item) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] { return items_.size() < capacity || unlimited_ || closed_; });
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
    /// The consumer takes no more one by one: the producer never waits from now on.
    void letGo() {
        const std::scoped_lock lock(mutex_);
        unlimited_ = true;
        changed_.notify_all();
    }
    /// What is left after the producer has ended; nothing when it has failed.
    std::optional<std::deque<RegisteredItem>> rest() {
        const std::scoped_lock lock(mutex_);
        if (error_) return std::nullopt;
        return std::move(items_);
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
    bool unlimited_ = false;
    std::exception_ptr error_;
};

/// Says when a state is to be kept, so that keeping takes its share of the time at most.
class StateClock {
 public:
    explicit StateClock(std::optional<StateKeeping> keeping) : keeping_(keeping) {
        if (keeping_) next_s_ = keeping_->every_s / 5;  // the first one sooner: short runs are killed, too
    }
    bool due() {
        const std::scoped_lock lock(mutex_);
        const double now = secondsSince(start_);
        if (!keeping_ || now < next_s_) return false;
        last_s_ = now;
        cost_s_ = 0;
        next_s_ = now + keeping_->every_s;
        return true;
    }
    /// Runs `work` for the state that was due last.
    template <class Work>
    auto timed(Work work) {
        const auto before = Clock::now();
        auto result = work();
        const std::scoped_lock lock(mutex_);
        cost_s_ += secondsSince(before);
        next_s_ = last_s_ + std::max(keeping_->every_s, cost_s_ / keeping_->most_share);
        return result;
    }

 private:
    std::optional<StateKeeping> keeping_;
    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    double last_s_ = 0;
    double next_s_ = 0;
    double cost_s_ = 0;
};

/// Frames with their motion, from where the run was left to its end.
class Producer {
 public:
    Producer(FrameSource& source, FrameRange range, bool with_colour, ChainProgress& progress, StateClock& clock,
             ItemQueue& queue)
        : source_(source),
          range_(range),
          with_colour_(with_colour),
          progress_(progress),
          clock_(clock),
          queue_(queue) {}

    void work(const std::stop_token& stop) {
        try {
            FrameIndex index = range_.first;
            for (; !progress_.waiting.empty() && !stop.stop_requested(); ++index) {
                RegisteredItem item = read(index);
                WaitingMotion& known = progress_.waiting.front();
                item.motion = std::move(known.motion);
                item.times = known.times;
                progress_.waiting.pop_front();
                if (!queue_.push(std::move(item))) return;
            }
            for (; index <= range_.last && !stop.stop_requested(); ++index) {
                RegisteredItem item = read(index);
                item.motion = progress_.motion_half.next(item.frame, item.times);
                // The very picture of the frame before, in place of one that a live source left out: there is nothing
                // in it that is worth the time to look for.
                if (endless_ && item.frame.gray.data == last_.data) item.motion.motion_vectors.clear();
                last_ = item.frame.gray;
                if (clock_.due()) item.motion_state = clock_.timed([&] { return stateBytes(progress_.motion_half); });
                if (!queue_.push(std::move(item))) return;
            }
            queue_.close();
        } catch (const StreamEnded&) {
            queue_.close();
        } catch (...) {
            queue_.close(std::current_exception());
        }
    }

 private:
    RegisteredItem read(FrameIndex index) {
        RegisteredItem item;
        const Stopwatch watch(item.times, Stage::read);
        item.frame = source_.read(index, with_colour_);
        return item;
    }

    FrameSource& source_;
    FrameRange range_;
    bool with_colour_;
    ChainProgress& progress_;
    StateClock& clock_;
    ItemQueue& queue_;
    bool endless_ = source_.info().frame_count > kLastFrame;
    cv::Mat last_;  ///< picture
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

std::string grownText(FrameIndex last) {
    return "the video has grown since it was opened; the run ends with frame " + std::to_string(last) +
           ", which was the last one then; open it again and make a run over the rest";
}

}  // namespace

RunSummary ChainRun::run(FrameSource& source, FrameRange range, ChainObserver& observer, std::stop_token stop,
                         bool with_colour, RunStart from) const {
    const auto start = Clock::now();
    RunSummary summary;
    summary.message.clear();
    std::vector<StageTimes> times;
    const auto fail = [&summary](ErrorKind kind, const std::string& why) {
        summary.outcome = RunOutcome::failed;
        summary.message = why;
        summary.error = kind;
    };
    try {
        const int count = source.info().frame_count;
        if (range.last < 0) range.last = count - 1;
        if (range.first < 0 || range.last >= count || range.first > range.last) {
            throw Error(ErrorKind::parameter,
                        "frames " + std::to_string(range.first) + " to " + std::to_string(range.last) + " are not in " +
                            source.info().path.string() + ", which has frames 0 to " + std::to_string(count - 1));
        }
        summary.frames_total = range.last - range.first + 1;
        summary.unregistered_frames = from.unregistered_frames;
        const bool anew = !from.progress;
        const auto progress = anew ? std::make_shared<ChainProgress>(options_, scale_) : std::move(from.progress);
        if (anew) progress->last_done = range.first - 1;
        summary.frames_done = progress->last_done - range.first + 1;
        ItemQueue queue;
        StateClock clock(observer.stateKeeping());
        ProgressMeter meter(summary.frames_total, summary.frames_done);
        ClockJumps jumps(source.info().frame_rate_hz);
        RepeatedPictures repeats;
        Producer first_half(source, {progress->last_done + 1, range.last}, with_colour, *progress, clock, queue);
        // Frame t+1 is registered on this thread while frame t is segmented and tracked below.
        std::jthread producer([&] { first_half.work(stop); });
        struct Abandon {
            ItemQueue& queue;
            ~Abandon() { queue.abandon(); }
        } abandon_on_exit{queue};
        const auto keepState = [&](std::string motion_half) {
            observer.onState(
                {progress->last_done, packedState({progress->last_done, progress->classifier, std::move(motion_half),
                                                   stateBytes(progress->waiting), stateBytes(progress->track_half)},
                                                  options_, scale_)});
            return true;
        };
        while (!stop.stop_requested()) {
            std::optional<RegisteredItem> item = queue.pop();
            if (!item) break;
            const auto result = std::make_shared<const FrameResult>(
                progress->track_half.next(item->frame, std::move(item->motion), item->times));
            if (!result->motion.registration.reliable() &&
                result->motion.registration.state != RegistrationState::first) {
                ++summary.unregistered_frames;
            }
            observer.onFrame(result, item->frame);
            progress->last_done = item->frame.index;
            jumps.see(item->frame.index, item->frame.time_us);
            repeats.see(result->motion.registration.state);
            times.push_back(result->stage_ms);
            const RunProgress news = meter.frameDone();
            summary.frames_done = news.frames_done;
            if (!item->motion_state.empty()) clock.timed([&] { return keepState(std::move(item->motion_state)); });
            observer.onProgress(news);
        }
        summary.outcome = summary.frames_done == summary.frames_total ? RunOutcome::finished : RunOutcome::stopped;
        if (summary.outcome == RunOutcome::finished) {
            const bool live = count > kLastFrame;  // its gaps are told otherwise
            const auto tell = [&](const std::string& text) {
                if (!text.empty()) summary.message += (summary.message.empty() ? "" : ". Also, ") + text;
            };
            if (!live) tell(jumps.text());
            if (!live) tell(repeats.text(source.info().frame_rate_hz));
            if (range.last == count - 1 && source.hasGrown()) tell(grownText(range.last));
        }
        if (summary.outcome == RunOutcome::stopped && summary.frames_done > 0 && observer.stateKeeping()) {
            // The first half is some frames ahead: these wait until the run goes on.
            queue.letGo();
            producer.join();
            if (auto rest = queue.rest()) {
                for (auto item = rest->rbegin(); item != rest->rend(); ++item) {
                    progress->waiting.push_front({std::move(item->motion), item->times});
                }
                keepState(stateBytes(progress->motion_half));
            }
        }
    } catch (const Error& error) {
        fail(error.kind(), error.what());
    } catch (const std::bad_alloc&) {
        fail(ErrorKind::input,
             source.info().path.string() + ": not enough memory; close other programs or use fewer frames");
    } catch (const std::exception& error) {
        fail(ErrorKind::internal, error.what());
    }
    summary.seconds = secondsSince(start);
    summary.median_ms = medianTimes(times);
    return summary;
}

}  // namespace eyrie
