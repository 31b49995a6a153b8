#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <opencv2/core/parallel/parallel_backend.hpp>
#include <opencv2/core/utility.hpp>
#include <thread>

namespace {

/// Works for cv::parallel_for_() with threads of our own, which the sanitizer sees begin and end, so that it compares
/// what our loops do in several. OpenCV lets one loop at a time in.
class WatchedThreads : public cv::parallel::ParallelForAPI {
 public:
    void parallel_for(int tasks, FN_parallel_for_body_cb_t body, void* data) override {
        if (tasks < 2) return body(0, tasks, data);
        const int step = std::max(1, tasks / kPieces);
        std::atomic<int> next = 0;
        // Nothing but beginning and end may order the threads, or it would hide what they do to each other.
        const auto work = [&] {
            for (int begin; (begin = next.fetch_add(step, std::memory_order_relaxed)) < tasks;)
                body(begin, std::min(tasks, begin + step), data);
        };
        const std::jthread other([&] {
            number_ = 1;
            work();
        });
        work();
    }
    int getThreadNum() const override { return number_; }
    int getNumThreads() const override { return 2; }
    int setNumThreads(int) override { return 2; }
    const char* getName() const override { return "watched threads"; }

 private:
    static constexpr int kPieces = 8;
    static inline thread_local int number_ = 0;
};

/// Part of every program under the thread sanitizer. The pools of OpenCV and TBB are not built with it: what they order
/// by atomics looks like races to it. So that our own threads are all it sees, theirs are not started.
struct LibraryPools {
    LibraryPools() { cv::parallel::setParallelForBackend(std::make_shared<WatchedThreads>()); }
    tbb::global_control limit{tbb::global_control::max_allowed_parallelism, 1};
};

const LibraryPools library_pools;

}  // namespace
