#include "io/video/frame_cache.h"

#include <gmock/gmock.h>

#include <atomic>
#include <future>
#include <latch>
#include <random>
#include <semaphore>

#include "core/error.h"

namespace eyrie::frame_cache_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kFrames = 100;
constexpr std::size_t kFrameBytes = std::size_t{40} * 30 * 4;

/// What a source did, outliving it.
struct Log {
    std::mutex mutex;
    std::vector<FrameIndex> reads;
    std::atomic<bool> busy{false};
    std::atomic<bool> overlapped{false};

    std::vector<FrameIndex> copy() {
        const std::lock_guard lock(mutex);
        return reads;
    }
};

class LoggingSource : public FrameSource {
 public:
    explicit LoggingSource(Log& log, FrameIndex broken = -1) : log_(log), broken_(broken) {
        info_.size = {40, 30};
        info_.frame_count = kFrames;
    }
    const VideoInfo& info() const override { return info_; }
    std::int64_t timeOf(FrameIndex index) const override { return index * 40'000; }
    Frame read(FrameIndex index, bool with_colour) override {
        if (log_.busy.exchange(true)) log_.overlapped = true;
        {
            const std::lock_guard lock(log_.mutex);
            log_.reads.push_back(index);
        }
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(info_.size, CV_8UC1, cv::Scalar(index));
        if (with_colour) frame.colour = cv::Mat(info_.size, CV_8UC3, cv::Scalar::all(index));
        log_.busy = false;
        if (index == broken_) throw Error(ErrorKind::input, "frame " + std::to_string(index) + " is broken");
        return frame;
    }

 private:
    Log& log_;
    FrameIndex broken_;
    VideoInfo info_;
};

FrameCacheOptions roomFor(std::size_t frames, int ahead = 0, int behind = 0) {
    FrameCacheOptions options;
    options.max_bytes = frames * kFrameBytes;
    options.ahead = ahead;
    options.behind = behind;
    return options;
}

std::unique_ptr<FrameCache> cacheOf(Log& log, const FrameCacheOptions& options, FrameCache::Arrived arrived = {},
                                    FrameIndex broken = -1) {
    return std::make_unique<FrameCache>(std::make_unique<LoggingSource>(log, broken), options, std::move(arrived));
}

TEST(FrameCache, DeliversFramesAndTimes) {
    Log log;
    const auto cache = cacheOf(log, roomFor(10));
    for (const int i : {0, 5, 99}) {
        const auto frame = cache->get(i);
        EXPECT_EQ(frame->index, i);
        EXPECT_EQ(frame->gray.at<uchar>(0, 0), i);
        EXPECT_FALSE(frame->colour.empty());
    }
    EXPECT_EQ(cache->timeOf(3), 120'000);
    EXPECT_EQ(cache->info().frame_count, kFrames);
}

TEST(FrameCache, ReadsAFrameOnceWhileItIsKept) {
    Log log;
    const auto cache = cacheOf(log, roomFor(10));
    for (int k = 0; k < 3; ++k)
        for (const int i : {4, 5, 6}) cache->get(i);
    EXPECT_THAT(log.copy(), ElementsAre(4, 5, 6));
}

TEST(FrameCache, DoesNotWaitAndTellsOfTheArrival) {
    Log log;
    std::promise<FrameIndex> arrived;
    const auto cache = cacheOf(log, roomFor(10), [&](FrameIndex index) { arrived.set_value(index); });
    EXPECT_EQ(cache->tryGet(7), nullptr);
    EXPECT_EQ(arrived.get_future().get(), 7);
    ASSERT_NE(cache->tryGet(7), nullptr);
    EXPECT_EQ(cache->tryGet(7)->index, 7);
}

TEST(FrameCache, ReadsAheadInTheDirectionOfTheSteps) {
    Log log;
    auto cache = cacheOf(log, roomFor(50, 4, 0));
    cache->get(10);
    for (int i = 11; i <= 14; ++i) cache->get(i);  // these are read ahead, or about to be
    cache.reset();
    const auto reads = log.copy();
    EXPECT_TRUE(std::is_sorted(reads.begin(), reads.end()));
    EXPECT_EQ(reads.front(), 10);
    EXPECT_LE(reads.back(), 18);
}

TEST(FrameCache, SteppingBackReadsARunOnceAndInOrder) {
    Log log;
    const auto cache = cacheOf(log, roomFor(60, 0, 10));
    cache->get(50);
    cache->get(49);
    const auto reads = log.copy();
    // Decoders only go forward: on the first step back all frames from a little before are read, ascending.
    ASSERT_GE(reads.size(), 12U);
    EXPECT_EQ(std::vector<FrameIndex>(reads.begin(), reads.begin() + 12),
              (std::vector<FrameIndex>{50, 39, 40, 41, 42, 43, 44, 45, 46, 47, 48, 49}));
    for (int i = 48; i >= 0; --i) EXPECT_EQ(cache->get(i)->index, i);
    std::vector<FrameIndex> all = log.copy();
    std::sort(all.begin(), all.end());
    EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end()) << "a frame was read twice";
}

TEST(FrameCache, StaysWithinItsMemory) {
    Log log;
    for (const std::size_t room : {1U, 2U, 3U, 7U, 20U}) {
        const auto cache = cacheOf(log, roomFor(room, 8, 12));
        std::mt19937 random(3);
        for (int k = 0; k < 200; ++k) {
            const int i = k < 100 ? k % 40 : static_cast<int>(random() % kFrames);
            EXPECT_EQ(cache->get(i)->index, i);
            EXPECT_LE(cache->bytes(), (room + 1) * kFrameBytes);
        }
        for (int i = 60; i > 20; --i) EXPECT_EQ(cache->get(i)->index, i);
    }
}

TEST(FrameCache, AFrameLargerThanTheMemoryIsDeliveredAllTheSame) {
    Log log;
    FrameCacheOptions options = roomFor(1, 8, 12);
    options.max_bytes = 10;
    const auto cache = cacheOf(log, options);
    for (const int i : {3, 4, 3}) EXPECT_EQ(cache->get(i)->index, i);
}

TEST(FrameCache, ErrorsBelongToTheirFrame) {
    Log log;
    std::promise<FrameIndex> arrived;
    const auto cache = cacheOf(
        log, roomFor(20, 0, 0),
        [&](FrameIndex index) {
            if (index == 5) arrived.set_value(index);
        },
        5);
    EXPECT_EQ(cache->tryGet(5), nullptr);
    EXPECT_EQ(arrived.get_future().get(), 5);
    EXPECT_EQ(cache->tryGet(5), nullptr);
    EXPECT_THROW(cache->get(5), Error);
    EXPECT_EQ(cache->get(6)->index, 6);
    EXPECT_EQ(cache->get(4)->index, 4);
}

TEST(FrameCache, FramesOutsideAreRefused) {
    Log log;
    const auto cache = cacheOf(log, roomFor(20, 8, 12));
    for (const int i : {-1, kFrames}) {
        EXPECT_EQ(cache->tryGet(i), nullptr);
        EXPECT_THROW(cache->get(i), Error);
        EXPECT_THROW(cache->timeOf(i), Error);
    }
    EXPECT_EQ(cache->get(kFrames - 1)->index, kFrames - 1);
}

TEST(FrameCache, ManyThreadsGetWhatTheyAskFor) {
    Log log;
    std::atomic<int> arrivals{0};
    auto cache = cacheOf(
        log, roomFor(12, 4, 6), [&](FrameIndex) { ++arrivals; }, 33);
    {
        std::vector<std::jthread> threads;
        for (unsigned t = 0; t < 4; ++t)
            threads.emplace_back([&cache, t] {
                std::mt19937 random(t);
                for (int k = 0; k < 300; ++k) {
                    const int i = static_cast<int>(random() % kFrames);
                    if (k % 3 == 0) {
                        const auto frame = cache->tryGet(i);
                        EXPECT_EQ(frame ? frame->index : i, i);
                    } else if (i == 33) {
                        EXPECT_THROW(cache->get(i), Error);
                    } else {
                        EXPECT_EQ(cache->get(i)->index, i);
                    }
                }
            });
    }
    cache.reset();
    EXPECT_FALSE(log.overlapped) << "the source was used by two threads";
}

TEST(FrameCache, ClosingAmidWorkIsSafe) {
    Log log;
    for (int k = 0; k < 50; ++k) {
        const auto cache = cacheOf(log, roomFor(20, 8, 12), [](FrameIndex) {});
        cache->tryGet(k);
        cache->tryGet(kFrames - 1 - k);
    }
}

}  // namespace
}  // namespace eyrie::frame_cache_test
