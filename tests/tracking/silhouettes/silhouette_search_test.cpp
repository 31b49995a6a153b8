// Which pictures are looked at to see vehicles without and with what lies about them, and what is seen.
#include "tracking/silhouettes/silhouette_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tracking/frame_summaries.h"

namespace eyrie::silhouette_search_test {
namespace {

const SceneScale kScale{0.2, 25, true};  // 5 px are 1 m; every third frame is looked at
constexpr int kFrames = 121;

/// Bright cars of 24 × 12 px on plain ground, which goes a number of px to the right each frame.
struct PlainRoad {
    int shift = 0;
    double rate = 25;
    std::vector<TrackPath> paths;
    std::set<FrameIndex> cut;         ///< frames that are not registered
    std::set<FrameIndex> unreadable;  ///< …
    std::set<FrameIndex> dusky;       ///< in which the road is darker
    std::vector<FrameIndex> asked;

    /// A car in some frames; `x`, `y`: the pixel of its rear left corner.
    void add(TrackId id, const std::vector<FrameIndex>& frames, const std::function<cv::Point(FrameIndex)>& corner,
             double score = 0.9) {
        TrackPath path{id, {}};
        for (const FrameIndex frame : frames) {
            TrackState state;
            state.id = id;
            state.score = score;
            state.box = {cv::Point2d(corner(frame)) + cv::Point2d(11.5, 5.5), 24, 12, 0};
            path.states.emplace_back(frame, PathState(state));
        }
        paths.push_back(path);
    }
    cv::Mat pictureOf(FrameIndex frame) {
        asked.push_back(frame);
        if (unreadable.contains(frame)) return {};
        cv::Mat picture(200, 640, CV_8UC1, cv::Scalar(dusky.contains(frame) ? 46 : 150));
        for (const TrackPath& path : paths) {
            const TimedPathState* state = path.at(frame);
            if (state == nullptr) continue;
            const cv::Point2d centre = state->second.box.centre;
            picture(cv::Rect(cvRound(centre.x - 11.5), cvRound(centre.y - 5.5), 24, 12)).setTo(230);
        }
        return picture;
    }
    GroundMotion ground() const {
        GroundMotion motion;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            FrameMotionSummary summary = test::summaryOfFrame(frame, shift);
            if (cut.contains(frame)) summary.registration.state = RegistrationState::failed;
            motion.add(summary);
        }
        return motion;
    }
    std::vector<SilhouetteLook> looks() {
        asked.clear();
        SceneScale scale = kScale;
        scale.frame_rate_hz = rate;
        const GroundMotion motion = ground();
        SilhouetteSearch search(paths, motion, scale);
        auto looks = search.finish([this](FrameIndex frame) { return pictureOf(frame); });
        for (std::size_t i = 1; i < asked.size(); ++i) EXPECT_LT(asked[i - 1], asked[i]);
        return looks;
    }
};

std::vector<FrameIndex> range(FrameIndex first, FrameIndex last) {
    std::vector<FrameIndex> frames;
    for (FrameIndex frame = first; frame <= last; ++frame) frames.push_back(frame);
    return frames;
}

std::function<cv::Point(FrameIndex)> at(int x, int y) {
    return [=](FrameIndex) { return cv::Point(x, y); };
}

using Frames = std::vector<FrameIndex>;

}  // namespace

TEST(SilhouetteSearch, LooksADozenTimesSpreadOverTheLifeOfATrack) {
    PlainRoad road;
    road.shift = 1;
    road.add(7, range(0, 120), [](FrameIndex frame) { return cv::Point(40 + 4 * frame, 90); });
    const auto looks = road.looks();
    ASSERT_EQ(looks.size(), 12U);
    std::set<FrameIndex> frames;
    for (const SilhouetteLook& look : looks) {
        EXPECT_EQ(look.track, 7);
        frames.insert(look.frame);
        EXPECT_EQ(OrientedBox(road.paths[0].at(look.frame)->second.box).centre, look.box.centre);
        EXPECT_NEAR(look.silhouette->whole.rear, -12, 0.6);
        EXPECT_NEAR(look.silhouette->whole.front, 12, 0.6);
        EXPECT_NEAR(look.silhouette->whole.left, -6, 0.6);
        EXPECT_NEAR(look.silhouette->whole.right, 6, 0.6);
        EXPECT_TRUE(look.silhouette->lit_vehicle);
    }
    ASSERT_EQ(frames.size(), 12U);
    EXPECT_EQ(*frames.begin(), 0);
    EXPECT_EQ(*frames.rbegin(), 120);
    for (auto frame = std::next(frames.begin()); frame != frames.end(); ++frame)
        EXPECT_NEAR(*frame - *std::prev(frame), 120.0 / 11, 3);
    for (const FrameIndex frame : road.asked) EXPECT_EQ(frame % 3, 0) << "so that few pictures are read";
}

TEST(SilhouetteSearch, TellsHowDarkThePictureOfTheVehicleIs) {
    PlainRoad road;
    road.add(7, {30, 33, 36}, [](FrameIndex frame) { return cv::Point(40 + 10 * (frame - 30), 90); });
    road.dusky = {33, 39};  // a vehicle's, and one that shows the bare ground alone
    const auto looks = road.looks();
    ASSERT_EQ(looks.size(), 3U);
    for (const SilhouetteLook& look : looks)
        EXPECT_NEAR(look.darkness, look.frame == 33 ? 0.4 : 0, 1e-12) << look.frame;
}

TEST(SilhouetteSearch, ComparesWithTheNearestTwoPicturesBeforeAndAfter) {
    PlainRoad road;
    road.add(1, range(29, 31), at(300, 90));
    EXPECT_EQ(road.looks().size(), 1U);
    EXPECT_EQ(road.asked, (Frames{24, 27, 30, 33, 36}));
    road.rate = 2;  // every frame then
    EXPECT_EQ(road.looks().size(), 3U);
    EXPECT_EQ(road.asked, (Frames{27, 28, 29, 30, 31, 32, 33}));
}

TEST(SilhouetteSearch, LooksAtTracksWhereTheyWereDetectedAndTellsWhichAreSurelyVehicles) {
    PlainRoad road;
    road.add(1, range(29, 31), at(100, 90), 0.45);
    road.add(2, range(29, 31), at(300, 90), 0.55);
    road.add(3, range(29, 31), at(500, 90));
    road.add(4, range(29, 31), at(100, 30), 0.15);
    road.paths[2].states[1].second.origin = StateOrigin::reconstructed;
    const auto looks = road.looks();
    ASSERT_EQ(looks.size(), 2U);
    EXPECT_EQ(looks[0].track, 1);
    EXPECT_FALSE(looks[0].sure);
    EXPECT_EQ(looks[1].track, 2);
    EXPECT_TRUE(looks[1].sure);
}

TEST(SilhouetteSearch, SeesALorryThatIsFollowedInPartsAsOne) {
    // Both ends of 14 m are followed; what lies between them is as bright. The rear may be a part by its score, or not.
    const auto lengthSeen = [](double score_of_rear) {
        PlainRoad road;
        const auto drives = [](int ahead) {
            return [=](FrameIndex frame) { return cv::Point(40 + ahead + 4 * frame, 90); };
        };
        road.add(1, range(30, 90), drives(46));
        road.add(2, range(30, 90), drives(0), score_of_rear);
        road.add(9, range(30, 90), drives(23), 0.1);
        for (TrackPath& path : road.paths) {
            for (auto& [frame, state] : path.states) state.velocity = {4, 0};
        }
        std::vector<double> lengths;
        for (const SilhouetteLook& look : road.looks()) {
            if (look.track == 1 && look.extent) lengths.push_back(look.extent->whole.length());
        }
        EXPECT_GE(lengths.size(), 10U);
        std::sort(lengths.begin(), lengths.end());
        return lengths.at(lengths.size() / 2);
    };
    EXPECT_NEAR(lengthSeen(0.7), 70, 2);
    EXPECT_LT(lengthSeen(0.9), 50) << "a vehicle of its own ends where it begins";
}

TEST(SilhouetteSearch, ComparesWithNoGroundThatATrackIsNear) {
    // A metre and a fifth is 6 px, of which others stay off seven tenths.
    const auto looksBeside = [](int gap_x, int gap_y) {
        PlainRoad road;
        road.add(1, range(29, 31), at(300, 90));
        road.add(2, range(0, 120), at(gap_x > 0 ? 300 + 24 + gap_x : 300, gap_y > 0 ? 90 + 12 + gap_y : 90), 0.1);
        return road.looks().size();
    };
    EXPECT_EQ(looksBeside(5, 0), 1U);
    EXPECT_EQ(looksBeside(0, 5), 1U);
    EXPECT_EQ(looksBeside(4, 0), 0U);
    EXPECT_EQ(looksBeside(0, 4), 0U);
}

TEST(SilhouetteSearch, ComparesWithNothingLongerAgoThanThreeSeconds) {
    const auto looksWithGround = [](FrameIndex bare) {
        PlainRoad road;
        road.add(1, {90}, at(300, 90));
        Frames others = range(0, 120);
        std::erase(others, bare);
        std::erase(others, 90);
        road.add(2, others, at(300, 90), 0.1);
        return road.looks().size();
    };
    EXPECT_EQ(looksWithGround(15), 1U);
    EXPECT_EQ(looksWithGround(12), 0U);
}

TEST(SilhouetteSearch, GoesNoFurtherThanPicturesAreRegistered) {
    PlainRoad road;
    road.add(1, range(29, 31), at(300, 90));
    road.cut = {29};
    EXPECT_EQ(road.looks().size(), 1U);
    EXPECT_EQ(road.asked, (Frames{30, 33, 36}));
    road.cut = {35};
    EXPECT_EQ(road.looks().size(), 1U);
    EXPECT_EQ(road.asked, (Frames{24, 27, 30, 33}));
    road.cut = {29, 32};
    EXPECT_EQ(road.looks().size(), 0U);
    EXPECT_EQ(road.asked, Frames{});
    // One that has no ground does not keep others from theirs.
    road.cut = {};
    road.paths.clear();
    road.add(1, range(0, 120), at(100, 90));
    road.add(2, range(29, 31), at(300, 90));
    EXPECT_EQ(road.looks().size(), 1U);
}

TEST(SilhouetteSearch, MakesDoWithThePicturesThatCanBeRead) {
    PlainRoad road;
    road.add(1, range(29, 31), at(300, 90));
    road.unreadable = {24, 27, 36};
    EXPECT_EQ(road.looks().size(), 1U);
    road.unreadable = {24, 27, 33, 36};
    EXPECT_EQ(road.looks().size(), 0U);
    road.unreadable = {30};
    EXPECT_EQ(road.looks().size(), 0U);
}

TEST(SilhouetteSearch, NeedsEachPictureOnceWhoeverReadsIt) {
    PlainRoad road;
    road.add(1, range(29, 31), at(300, 90));
    const GroundMotion motion = road.ground();
    SilhouetteSearch search(road.paths, motion, kScale);
    const auto read = [&](FrameIndex frame) { return road.pictureOf(frame); };
    search.readUpTo(27, read);
    EXPECT_EQ(road.asked, (Frames{24}));
    for (const FrameIndex frame : {27, 28, 30}) search.show(frame, road.pictureOf(frame));
    search.readUpTo(34, read);
    EXPECT_EQ(road.asked, (Frames{24, 27, 28, 30, 33}));
    EXPECT_EQ(search.finish(read).size(), 1U);
    EXPECT_EQ(road.asked, (Frames{24, 27, 28, 30, 33, 36}));
}

}  // namespace eyrie::silhouette_search_test
