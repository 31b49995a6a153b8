#include "sweep/sweep_runner.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "core/error.h"
#include "evaluation/evaluate.h"

namespace eyrie {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One sweep at work: threads that take points until none is left.
class Work {
 public:
    Work(const SweepPlan& plan, const std::vector<SweepInput>& inputs, const std::vector<int>& positions,
         const std::stop_token& stop, const SweepRunOptions& options)
        : plan_(plan), inputs_(inputs), positions_(positions), options_(options) {
        progress_.points_total = static_cast<int>(positions.size());
        outer_.emplace(stop, [this] { stop_.request_stop(); });
    }

    int run() {
        for (const SweepInput& input : inputs_) {
            input.cache->tellProgress([this](ChainStage stage, int done, int total) { tellStage(stage, done, total); });
        }
        tell();
        const auto cores = static_cast<std::size_t>(std::max(1U, std::thread::hardware_concurrency()));
        const std::size_t wanted = options_.threads > 0 ? static_cast<std::size_t>(options_.threads) : cores;
        {
            std::vector<std::jthread> threads;
            for (std::size_t i = 0; i < std::min(wanted, positions_.size()); ++i)
                threads.emplace_back([this] { work(); });
        }
        for (const SweepInput& input : inputs_) input.cache->tellProgress({});
        if (error_) std::rethrow_exception(error_);
        return progress_.points_done;
    }

 private:
    void work() {
        try {
            while (!stop_.stop_requested()) {
                const std::size_t at = next_.fetch_add(1);
                if (at >= positions_.size()) return;
                const std::optional<SweepPoint> point = measure(positions_[at]);
                if (!point) return;
                finish(*point);
            }
        } catch (...) {
            const std::scoped_lock lock(mutex_);
            if (!error_) error_ = std::current_exception();
            stop_.request_stop();
        }
    }

    std::optional<SweepPoint> measure(int position) {
        const auto start = Clock::now();
        const ChainOptions options = plan_.optionsOf(position);
        SweepPoint point;
        point.position = position;
        for (std::size_t c = 0; c < inputs_.size(); ++c) {
            const std::optional<ClipResult> result = inputs_[c].cache->run(options, stop_.get_token());
            if (!result) return std::nullopt;
            const int clip = static_cast<int>(c);
            // Detections are the same wherever only tracking changes.
            const std::string same = std::to_string(c) + "\n" + signatureUpTo(options, ChainStage::removal);
            const auto detections = detections_.get(same, [&] {
                return std::make_shared<const std::vector<SweepFigures>>(score(clip, *result->detections, false));
            });
            point.figures.insert(point.figures.end(), detections->begin(), detections->end());
            for (SweepFigures& figures : score(clip, *result->tracks, true))
                point.figures.push_back(std::move(figures));
        }
        point.seconds = secondsSince(start);
        return point;
    }

    std::vector<SweepFigures> score(int clip, const BoxesByFrame& boxes, bool tracks) const {
        const Scoring& scoring = inputs_[static_cast<std::size_t>(clip)].scoring;
        std::vector<SweepFigures> figures;
        for (const Measures& measures : evaluateAt(plan_.overlaps, scoring.truth.boxes, boxes, scoring.options))
            figures.push_back(figuresOf(measures, clip, tracks));
        return figures;
    }

    void finish(const SweepPoint& point) {
        const std::scoped_lock lock(mutex_);
        if (error_) return;
        try {
            if (options_.on_point) options_.on_point(point);
        } catch (...) {
            error_ = std::current_exception();  // before another thread comes with its point
            stop_.request_stop();
            return;
        }
        ++progress_.points_done;
        progress_.doing.clear();
        const double now = secondsSince(start_);
        if (progress_.points_done == 1) {
            first_done_ = now;
        } else {
            progress_.points_per_second = (progress_.points_done - 1) / std::max(now - first_done_, 1e-6);
            progress_.seconds_left = (progress_.points_total - progress_.points_done) / progress_.points_per_second;
        }
        tell();
    }

    void tellStage(ChainStage stage, int done, int total) {
        const std::scoped_lock lock(mutex_);
        progress_.doing =
            std::string(nameOf(stage)) + ", frame " + std::to_string(done) + " of " + std::to_string(total);
        tell();
    }

    void tell() {
        progress_.seconds = secondsSince(start_);
        if (options_.on_progress) options_.on_progress(progress_);
    }

    const SweepPlan& plan_;
    const std::vector<SweepInput>& inputs_;
    const std::vector<int>& positions_;
    const SweepRunOptions& options_;
    std::stop_source stop_;
    std::optional<std::stop_callback<std::function<void()>>> outer_;
    Clock::time_point start_ = Clock::now();
    double first_done_ = 0;
    std::atomic<std::size_t> next_{0};
    Memo<std::vector<SweepFigures>> detections_{16};
    std::mutex mutex_;
    SweepProgress progress_;
    std::exception_ptr error_;
};

}  // namespace

int runSweep(const SweepPlan& plan, const std::vector<SweepInput>& inputs, const std::vector<int>& positions,
             const std::stop_token& stop, const SweepRunOptions& options) {
    if (inputs.size() != plan.clips.size())
        throw Error(ErrorKind::internal, "the opened sequences are not those of the sweep's plan");
    return Work(plan, inputs, positions, stop, options).run();
}

}  // namespace eyrie
