#include <tbb/global_control.h>

#include <opencv2/core/utility.hpp>

namespace {

/// Part of every program under the thread sanitizer. The pools of OpenCV and TBB are not built with it: what they order
/// by atomics looks like races to it. So that our own threads are all it sees, theirs are not started.
struct LibraryPools {
    LibraryPools() { cv::setNumThreads(1); }
    tbb::global_control limit{tbb::global_control::max_allowed_parallelism, 1};
};

const LibraryPools library_pools;

}  // namespace
