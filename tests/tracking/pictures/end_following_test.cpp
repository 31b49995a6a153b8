#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>

#include "tracking/finishing/track_finishing.h"
#include "tracking/frame_summaries.h"

namespace eyrie::end_following_test {
namespace {

const SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
constexpr int kFrames = 60;
constexpr int kFound = 20;  ///< frame in which the tracker finds the car …
constexpr int kLost = 40;   ///< … and the last in which it follows it

cv::Mat grain(cv::Size size, std::uint64_t seed) {
    cv::Mat picture(size, CV_8UC1);
    cv::RNG(seed).fill(picture, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(picture, picture, {5, 5}, 1.2);
    return picture;
}

/// A car on ground that goes 3 px/frame to the right. The tracker has it in the middle of its way only.
struct LateCar {
    std::vector<FrameMotionSummary> motion;
    std::vector<TimedState> states;
    FinishingOptions options;
    double decision = 6;                                           ///< what the classifier says of the car
    std::function<bool(int)> there = [](int) { return true; };     ///< whether it is in the picture
    std::function<bool(int)> readable = [](int) { return true; };  ///< whether there is a picture
    int asked = 0;

    LateCar() {
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            motion.push_back(test::summaryOfFrame(frame, 3));
            motion.back().image_size = {640, 200};
            if (frame >= kFound && frame <= kLost) add(1, frame, boxAt(frame));
        }
    }
    static OrientedBox boxAt(FrameIndex frame) { return {{100.0 + 7 * frame, 100}, 24, 12, 0}; }

    void add(TrackId id, FrameIndex frame, const OrientedBox& box) {
        TrackState state;
        state.id = id;
        state.box = box;
        state.velocity = {4, 0};
        state.status = TrackStatus::confirmed;
        states.emplace_back(frame, state);
    }

    cv::Mat pictureOf(FrameIndex frame) {
        ++asked;
        if (!readable(frame)) return {};
        static const cv::Mat ground = grain({900, 200}, 1);
        static const cv::Mat car = grain({24, 12}, 2);
        cv::Mat picture = ground(cv::Rect(200 - 3 * frame, 0, 640, 200)).clone();
        if (there(frame)) car.copyTo(picture(cv::Rect(100 + 7 * frame - 12, 94, 24, 12)));
        return picture;
    }

    std::map<FrameIndex, std::vector<TrackState>> finished(bool with_pictures = true) {
        FoundInFrames found;
        found.classified_at = [this](FrameIndex frame) {
            return std::vector<ClassifiedBox>{{boxAt(frame), decision > 0, decision}};
        };
        if (with_pictures) found.gray_at = [this](FrameIndex frame) { return pictureOf(frame); };
        std::map<FrameIndex, std::vector<TrackState>> result;
        for (const auto& [frame, state] : finishTracks(states, motion, options, kScale, found))
            result[frame].push_back(state);
        return result;
    }
};

std::set<TrackId> idsOf(const std::map<FrameIndex, std::vector<TrackState>>& frames) {
    std::set<TrackId> ids;
    for (const auto& [frame, states] : frames)
        for (const TrackState& state : states) ids.insert(state.id);
    return ids;
}

}  // namespace

TEST(EndFollowing, aSureTrackIsFollowedBothWaysWhileItLooksLikeItself) {
    LateCar car;
    const auto frames = car.finished();
    ASSERT_EQ(frames.begin()->first, 0);
    ASSERT_EQ(frames.rbegin()->first, kFrames - 1);
    for (const auto& [frame, states] : frames) {
        ASSERT_EQ(states.size(), 1U) << frame;
        EXPECT_GT(overlap(states.front().box, LateCar::boxAt(frame)), 0.85) << frame;
        EXPECT_NEAR(states.front().velocity.x, 4, 0.3) << frame;
        EXPECT_EQ(states.front().status, TrackStatus::confirmed);
    }
    EXPECT_EQ(frames.at(5).front().origin, StateOrigin::reconstructed);
    EXPECT_EQ(frames.at(55).front().origin, StateOrigin::reconstructed);
    EXPECT_EQ(frames.at(30).front().origin, StateOrigin::detected);
    EXPECT_LE(car.asked, kFrames) << "every picture is read once";
}

TEST(EndFollowing, withoutPicturesOrSwitchedOffNothingChanges) {
    LateCar car;
    const auto without = car.finished(false);
    EXPECT_EQ(without.begin()->first, kFound - 5) << "as finishing.extend_back guesses it";
    EXPECT_EQ(without.rbegin()->first, kLost);
    car.options.follow_ends_s = 0;
    car.options.trim_shadows = false;
    car.options.whole_lorries = false;
    const auto off = car.finished();
    EXPECT_EQ(off.begin()->first, kFound - 5);
    EXPECT_EQ(off.rbegin()->first, kLost);
    EXPECT_EQ(car.asked, 0);
}

TEST(EndFollowing, atMostAsLongAsAskedFor) {
    LateCar car;
    car.options.follow_ends_s = 0.4;
    const auto frames = car.finished();
    EXPECT_EQ(frames.begin()->first, kFound - 10);
    EXPECT_EQ(frames.rbegin()->first, kLost + 10);
}

// 10 frames a second; it turns right by half a right angle, nears, and is twice as large in the end.
TEST(EndFollowing, aVehicleThatNearsRoundABendIsFollowedByItsCornersAndGrowsWithThem) {
    const SceneScale slow{.gsd_m_per_px = 0.1, .frame_rate_hz = 10, .gsd_known = true};
    constexpr int last = 40;
    std::vector<OrientedBox> boxes;
    cv::Point2d place(120, 90);
    for (int frame = 0; frame <= last; ++frame) {
        const double bend = std::max(0, frame - 26) / 14.0;
        const double larger = 1 + bend;
        const double heading = 0.8 * bend;
        boxes.push_back({place, 56 * larger, 26 * larger, heading});
        place += 7 * larger * cv::Point2d(std::cos(heading), std::sin(heading));
    }
    const auto picture_of = [&](FrameIndex frame) {
        static const cv::Mat car = grain({56, 26}, 2);
        cv::Mat picture = grain({720, 480}, 1);
        const OrientedBox& box = boxes[static_cast<std::size_t>(frame)];
        const double c = std::cos(box.heading) * box.length / 56;
        const double s = std::sin(box.heading) * box.length / 56;
        const cv::Matx23d onto(c, -s, box.centre.x - c * 27.5 + s * 12.5, s, c, box.centre.y - s * 27.5 - c * 12.5);
        cv::warpAffine(car, picture, onto, picture.size(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
        return picture;
    };
    std::vector<FrameMotionSummary> motion;
    std::vector<TimedState> states;
    for (FrameIndex frame = 0; frame <= last; ++frame) {
        motion.push_back(test::summaryOfFrame(frame, 0));
        motion.back().image_size = {720, 480};
        if (frame > 25) continue;
        TrackState state;
        state.id = 1;
        state.box = boxes[static_cast<std::size_t>(frame)];
        state.velocity = {7, 0};
        state.status = TrackStatus::confirmed;
        states.emplace_back(frame, state);
    }
    FoundInFrames found;
    found.classified_at = [&](FrameIndex frame) {
        return std::vector<ClassifiedBox>{{boxes[static_cast<std::size_t>(frame)], true, 6}};
    };
    found.gray_at = picture_of;
    FinishingOptions options;
    options.trim_shadows = false;
    const std::vector<TimedState> finished = finishTracks(states, motion, options, slow, found);
    ASSERT_EQ(finished.back().first, last);
    for (const auto& [frame, state] : finished) {
        const OrientedBox& truth = boxes[static_cast<std::size_t>(frame)];
        EXPECT_NEAR(state.box.centre.x, truth.centre.x, 3) << frame;
        EXPECT_NEAR(state.box.centre.y, truth.centre.y, 3) << frame;
        EXPECT_GT(overlap(state.box, truth), 0.7) << frame;
    }
}

TEST(EndFollowing, aDoubtfulTrackIsLeftAsItIs) {
    LateCar car;
    car.decision = -2;
    car.options.min_score = 0;
    car.options.standing_height = 0;
    const auto frames = car.finished();
    ASSERT_FALSE(frames.empty());
    ASSERT_LT(frames.at(30).front().score, 0.8);
    EXPECT_EQ(frames.begin()->first, kFound - 5);
    EXPECT_EQ(frames.rbegin()->first, kLost);
}

TEST(EndFollowing, endsWhereThePictureDoesNotShowIt) {
    LateCar car;
    car.there = [](int frame) { return frame >= 10 && frame <= 50; };
    const auto frames = car.finished();
    EXPECT_NEAR(frames.begin()->first, 10, 1);
    EXPECT_NEAR(frames.rbegin()->first, 50, 1);
}

TEST(EndFollowing, endsWhereAPictureCannotBeRead) {
    LateCar car;
    car.readable = [](int frame) { return frame != 9 && frame != 51; };
    const auto frames = car.finished();
    EXPECT_EQ(frames.begin()->first, 10);
    EXPECT_EQ(frames.rbegin()->first, 50);
}

TEST(EndFollowing, keepsOffTheVehicleOfAnotherTrack) {
    LateCar car;
    // A lorry, of which the car's picture is a part.
    for (FrameIndex frame = 0; frame < 10; ++frame) car.add(2, frame, {LateCar::boxAt(frame).centre, 60, 14, 0});
    car.options.join_gap_s = 0.1;
    const auto frames = car.finished();
    EXPECT_EQ(idsOf(frames), (std::set<TrackId>{1, 2}));
    for (FrameIndex frame = 0; frame < 10; ++frame) EXPECT_EQ(frames.at(frame).size(), 1U) << frame;
    EXPECT_EQ(frames.at(10).front().id, 1);
}

TEST(EndFollowing, tracksThatMeetBecomeOneUnderTheOlderId) {
    LateCar car;
    for (FrameIndex frame = 0; frame < 10; ++frame) car.add(7, frame, LateCar::boxAt(frame));
    car.options.join_gap_s = 0.1;
    EXPECT_EQ(idsOf(car.finished(false)), (std::set<TrackId>{1, 7})) << "the gap is too long";
    const auto frames = car.finished();
    EXPECT_EQ(idsOf(frames), (std::set<TrackId>{7}));
    for (FrameIndex frame = 0; frame < kFrames; ++frame) {
        ASSERT_EQ(frames.at(frame).size(), 1U) << frame;
        EXPECT_EQ(frames.at(frame).front().score, frames.at(0).front().score) << frame;
        EXPECT_GT(overlap(frames.at(frame).front().box, LateCar::boxAt(frame)), 0.85) << frame;
    }
    EXPECT_EQ(idsOf(car.finished()), (std::set<TrackId>{7}));
}

TEST(EndFollowing, tracksThatMeetWithoutAGapBecomeOneToo) {
    LateCar car;
    // Too large to be taken for the same by its box.
    for (FrameIndex frame = 0; frame < kFound; ++frame) car.add(7, frame, {LateCar::boxAt(frame).centre, 38, 17, 0});
    EXPECT_EQ(idsOf(car.finished(false)), (std::set<TrackId>{1, 7}));
    EXPECT_EQ(idsOf(car.finished()), (std::set<TrackId>{7}));
}

}  // namespace eyrie::end_following_test
