#include "io/video/ahead/expected_frames.h"

#include <gmock/gmock.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>

#include "core/error.h"
#include "io/video/frame_cache.h"

namespace eyrie::expected_frames_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::Not;

constexpr int kFrames = 1000;
constexpr std::size_t kFrameBytes = std::size_t{400} * 300 * 4;
constexpr int kOfDecoder = 7;  ///< frames that a second decoder takes the room of

bool waitUntil(const std::function<bool()>& holds) {
    for (int tries = 0; tries < 10'000; ++tries) {
        if (holds()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
}

/// What a source did, outliving it; and how it does it.
struct Reads {
    std::mutex mutex;
    std::vector<FrameIndex> frames;
    std::atomic<FrameIndex> slow = -1;  ///< decoded until it is given up, or is slow no more
    std::atomic<FrameIndex> broken = -1;
    std::atomic<int> given_up = 0;
    std::atomic<int> opened = 0;

    std::vector<FrameIndex> copy() {
        const std::lock_guard lock(mutex);
        return frames;
    }
    bool has(FrameIndex index) {
        const std::lock_guard lock(mutex);
        return std::find(frames.begin(), frames.end(), index) != frames.end();
    }
};

class PatientSource : public FrameSource {
 public:
    PatientSource(Reads& reads, int frames) : reads_(reads) {
        info_.size = {400, 300};
        info_.frame_count = frames;
    }
    const VideoInfo& info() const override { return info_; }
    std::int64_t timeOf(FrameIndex index) const override { return index * 40'000; }
    void giveUpWhen(std::function<bool()> given_up) override { given_up_ = std::move(given_up); }
    Frame read(FrameIndex index, bool with_colour) override {
        {
            const std::lock_guard lock(reads_.mutex);
            reads_.frames.push_back(index);
        }
        while (reads_.slow == index) {
            if (given_up_ && given_up_()) {
                ++reads_.given_up;
                throw ReadingGivenUp();
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        if (reads_.broken == index) throw Error(ErrorKind::input, "broken");
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(info_.size, CV_8UC1, cv::Scalar(index % 256));
        if (with_colour) frame.colour = cv::Mat(info_.size, CV_8UC3, cv::Scalar::all(index % 256));
        return frame;
    }

 private:
    Reads& reads_;
    VideoInfo info_;
    std::function<bool()> given_up_;
};

/// A cache with room for so many frames, and who reads what it expects.
struct Stage {
    explicit Stage(std::size_t room, int ahead = 0, int frames_found = kFrames) {
        FrameCacheOptions options;
        options.max_bytes = room * kFrameBytes;
        options.ahead = ahead;
        options.behind = 0;
        cache = std::make_unique<FrameCache>(std::make_unique<PatientSource>(asked, kFrames), options);
        ahead_reader = std::make_unique<ExpectedFrames>(*cache, [this, frames_found](const std::stop_token&) {
            ++expected.opened;
            return std::make_unique<PatientSource>(expected, frames_found);
        });
    }
    bool waitForExpected(std::size_t count) {
        return waitUntil([&] { return expected.copy().size() >= count; });
    }

    Reads asked;
    Reads expected;
    std::unique_ptr<FrameCache> cache;
    std::unique_ptr<ExpectedFrames> ahead_reader;
};

TEST(ExpectedFramesTest, AreReadInTheirOrderAndNeedNoReadingWhenTheyAreAskedFor) {
    Stage stage(30);
    stage.cache->get(10);
    stage.cache->expect({400, 300, 500});
    ASSERT_TRUE(stage.waitForExpected(3));
    EXPECT_THAT(stage.expected.copy(), ElementsAre(400, 300, 500));
    ASSERT_TRUE(waitUntil([&] { return stage.cache->bytes() == 4 * kFrameBytes; }));
    for (const int index : {300, 500, 400}) EXPECT_EQ(stage.cache->get(index)->gray.at<uchar>(0, 0), index % 256);
    EXPECT_THAT(stage.asked.copy(), ElementsAre(10));
    EXPECT_EQ(stage.expected.opened, 1);
}

TEST(ExpectedFramesTest, WhatIsKeptAlreadyIsNotReadAgain) {
    Stage stage(30);
    stage.cache->get(10);
    stage.cache->get(11);
    stage.cache->expect({11, 10, -3, kFrames, 400});
    ASSERT_TRUE(stage.waitForExpected(1));
    EXPECT_THAT(stage.expected.copy(), ElementsAre(400));
}

TEST(ExpectedFramesTest, NothingIsOpenedBeforeSomethingIsExpected) {
    Stage stage(30);
    stage.cache->get(10);
    stage.cache->expect({});
    stage.cache->get(12);
    EXPECT_EQ(stage.expected.opened, 0);
}

TEST(ExpectedFramesTest, ARequestOvertakes) {
    Stage stage(30);
    stage.expected.slow = 400;
    stage.cache->get(10);
    stage.cache->expect({400, 300});
    ASSERT_TRUE(stage.waitForExpected(1));
    EXPECT_EQ(stage.cache->get(600)->index, 600);  // while the other is being read
    stage.asked.slow = 700;
    auto waiting = std::async(std::launch::async, [&] { return stage.cache->get(700)->index; });
    ASSERT_TRUE(waitUntil([&] { return stage.expected.given_up > 0; })) << "it goes on beside the request";
    stage.asked.slow = -1;
    EXPECT_EQ(waiting.get(), 700);
    stage.expected.slow = -1;
    ASSERT_TRUE(waitUntil([&] { return stage.expected.has(300); })) << "it goes on after the request";
    EXPECT_EQ(stage.expected.copy().back(), 300);
}

TEST(ExpectedFramesTest, NothingIsReadWhileSomethingIsAskedFor) {
    Stage stage(30, 2);
    stage.asked.slow = 12;  // is read ahead after 10
    stage.cache->get(10);
    ASSERT_TRUE(waitUntil([&] { return stage.asked.has(12); }));
    stage.cache->expect({400});
    EXPECT_TRUE(stage.expected.copy().empty());
    stage.asked.slow = -1;
    EXPECT_TRUE(stage.waitForExpected(1));
}

TEST(ExpectedFramesTest, OthersThatAreExpectedInsteadEndTheReadingOfTheFormer) {
    Stage stage(30);
    stage.expected.slow = 400;
    stage.cache->get(10);
    stage.cache->expect({400});
    ASSERT_TRUE(stage.waitForExpected(1));
    stage.cache->expect({300, 400});
    stage.cache->expect({300});
    ASSERT_TRUE(stage.waitForExpected(2));
    EXPECT_EQ(stage.expected.copy().back(), 300);
    stage.expected.slow = 500;
    stage.cache->expect({500});
    ASSERT_TRUE(waitUntil([&] { return stage.expected.has(500); }));
    const int before = stage.expected.given_up;
    stage.cache->expect({});
    EXPECT_TRUE(waitUntil([&] { return stage.expected.given_up > before; }));
}

TEST(ExpectedFramesTest, AsManyAreReadAsFitBesideWhatIsReadAheadAndTheDecoder) {
    constexpr int kRoom = 15;
    constexpr int kAhead = 3;
    Stage stage(kRoom, kAhead);
    stage.cache->get(10);
    constexpr int kFit = kRoom - kOfDecoder - kAhead - 1;
    std::vector<FrameIndex> wished;
    wished.reserve(20);
    for (int i = 0; i < 20; ++i) wished.push_back(400 + 10 * i);
    stage.cache->expect(wished);
    ASSERT_TRUE(stage.waitForExpected(kFit));
    ASSERT_TRUE(waitUntil([&] { return stage.cache->bytes() == (kRoom - kOfDecoder) * kFrameBytes; }));
    // Playing on, nothing is pushed out before it was seen, and the room is kept.
    for (int i = 11; i < 60; ++i) {
        EXPECT_EQ(stage.cache->get(i)->index, i);
        EXPECT_LE(stage.cache->bytes(), (kRoom - kOfDecoder + 1) * kFrameBytes);
    }
    EXPECT_TRUE(stage.waitForExpected(kFit));
    std::vector<FrameIndex> reads = stage.asked.copy();
    std::sort(reads.begin(), reads.end());
    EXPECT_EQ(std::adjacent_find(reads.begin(), reads.end()), reads.end()) << "a frame near by was read twice";
    wished.resize(kFit);
    EXPECT_THAT(stage.expected.copy(), ElementsAreArray(wished));
    for (const FrameIndex index : wished) EXPECT_EQ(stage.cache->get(index)->index, index);
    for (const FrameIndex index : wished) EXPECT_THAT(stage.asked.copy(), Not(Contains(index)));
}

TEST(ExpectedFramesTest, WithoutRoomForADecoderThereAreNone) {
    Stage stage(kOfDecoder + 2, 2);
    stage.cache->get(10);
    stage.cache->expect({400});
    for (int i = 11; i < 40; ++i) stage.cache->get(i);
    EXPECT_EQ(stage.expected.opened, 0);
}

TEST(ExpectedFramesTest, OneThatCannotBeReadHoldsUpNothing) {
    Stage stage(30);
    stage.expected.broken = 400;
    stage.cache->get(10);
    stage.cache->expect({400, 300});
    ASSERT_TRUE(stage.waitForExpected(2));
    EXPECT_THAT(stage.expected.copy(), ElementsAre(400, 300));
    EXPECT_EQ(stage.cache->get(400)->index, 400) << "who asks for it tries by himself";
}

TEST(ExpectedFramesTest, AnotherVideoAtThatPlaceIsNotShown) {
    Stage stage(30, 0, kFrames - 1);
    stage.cache->get(10);
    stage.cache->expect({400});
    ASSERT_TRUE(waitUntil([&] { return stage.expected.opened > 0; }));
    stage.ahead_reader.reset();
    EXPECT_TRUE(stage.expected.copy().empty());
}

TEST(ExpectedFramesTest, ClosingGivesUpWhatIsBeingRead) {
    Stage stage(30);
    stage.expected.slow = 400;
    stage.cache->get(10);
    stage.cache->expect({400});
    ASSERT_TRUE(stage.waitForExpected(1));
    stage.ahead_reader.reset();
    EXPECT_EQ(stage.expected.given_up, 1);
    stage.asked.slow = 701;
    stage.cache->tryGet(701);
    ASSERT_TRUE(waitUntil([&] { return stage.asked.has(701); }));
    stage.cache.reset();
    EXPECT_EQ(stage.asked.given_up, 1);
}

TEST(FrameCache, ReadingAheadIsGivenUpForARequestElsewhereAndNotForOneOnItsWay) {
    Stage stage(30, 3);
    stage.asked.slow = 12;
    stage.cache->get(10);
    ASSERT_TRUE(waitUntil([&] { return stage.asked.has(12); }));
    EXPECT_EQ(stage.cache->get(11)->index, 11);  // 12 is read for whoever goes on
    EXPECT_EQ(stage.asked.given_up, 0);
    EXPECT_EQ(stage.cache->get(700)->index, 700);
    EXPECT_EQ(stage.asked.given_up, 1);
    // What somebody waits for is not.
    stage.asked.slow = 300;
    auto waiting = std::async(std::launch::async, [&] { return stage.cache->get(300)->index; });
    ASSERT_TRUE(waitUntil([&] { return stage.asked.has(300); }));
    stage.cache->tryGet(800);
    stage.asked.slow = -1;
    EXPECT_EQ(waiting.get(), 300);
    EXPECT_EQ(stage.asked.given_up, 1);
}

}  // namespace
}  // namespace eyrie::expected_frames_test
