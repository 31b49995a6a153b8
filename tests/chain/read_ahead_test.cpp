#include "chain/live/read_ahead.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "io/live/live_stream.h"

namespace eyrie::read_ahead_test {
namespace {

/// A source that insists on its order, as a live one does, and ends.
class InOrder : public FrameSource {
 public:
    explicit InOrder(int frames) : frames_(frames) { info_.frame_count = 1'000'000; }
    const VideoInfo& info() const override { return info_; }
    std::int64_t timeOf(FrameIndex index) const override { return index * 40'000; }
    Frame read(FrameIndex index, bool with_colour) override {
        if (index != next_++) throw Error(ErrorKind::internal, "out of order");
        if (index >= frames_) throw StreamEnded{};
        Frame frame;
        frame.index = index;
        frame.time_us = timeOf(index);
        if (with_colour) frame.colour = cv::Mat(2, 2, CV_8UC3);
        return frame;
    }

 private:
    VideoInfo info_;
    int frames_;
    FrameIndex next_ = 0;
};

TEST(ReadAhead, FramesThatWereLookedAtComeAgainInTheirOrder) {
    InOrder source(8);
    ReadAhead ahead(source);
    const auto first = ahead.first(5);
    EXPECT_EQ(first->info().frame_count, 5);
    for (const FrameIndex index : {4, 0, 4}) EXPECT_EQ(first->read(index, false).index, index);
    EXPECT_EQ(first->timeOf(2), 80'000);
    for (FrameIndex index = 0; index < 8; ++index) {
        const Frame frame = ahead.read(index, true);
        EXPECT_EQ(frame.index, index);
        EXPECT_FALSE(frame.colour.empty()) << "the run may ask for it";
    }
    EXPECT_THROW(ahead.read(8, true), StreamEnded);
}

TEST(ReadAhead, OfASourceThatEndsBeforeWhatCameIsLookedAt) {
    InOrder source(3);
    ReadAhead ahead(source);
    EXPECT_EQ(ahead.first(5)->info().frame_count, 3);
    for (FrameIndex index = 0; index < 3; ++index) EXPECT_EQ(ahead.read(index, true).index, index);
}

}  // namespace
}  // namespace eyrie::read_ahead_test
