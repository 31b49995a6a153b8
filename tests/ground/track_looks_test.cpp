#include "ground/track_looks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <stop_token>

#include "core/error.h"
#include "ground/look_reading.h"
#include "ground/track_likeness.h"

namespace eyrie::track_looks_test {
namespace {

const cv::Scalar kRed(40, 40, 200), kBlue(200, 60, 40), kWhite(235, 235, 235);

/// A picture of painted vehicles, each the only box of a track.
class PaintedStreet {
 public:
    explicit PaintedStreet(double light = 0) : light_(light) {
        colour_ = cv::Mat(300, 500, CV_8UC3, cv::Scalar::all(100 + light));
    }
    /// A body in one colour with a dark windscreen, which may be missing.
    void park(TrackId id, cv::Point2d at, double heading, const cv::Scalar& paint, double length = 30,
              bool windscreen = true) {
        const OrientedBox box{at, length, length * 0.45, heading};
        fill(box, paint);
        const cv::Point2d ahead = box.direction() * (length * 0.2);
        if (windscreen) fill({at + ahead, length * 0.15, length * 0.4, heading}, cv::Scalar::all(20));
        tracks_.push_back({id, {{0, box}}});
    }
    LooksByTrack looks(bool with_colour = true) const {
        LookTaker taker(tracks_);
        Frame frame;
        frame.colour = with_colour ? colour_ : cv::Mat();
        cv::cvtColor(colour_, frame.gray, cv::COLOR_BGR2GRAY);
        taker.look(frame);
        return taker.looks();
    }

 private:
    void fill(const OrientedBox& box, const cv::Scalar& paint) {
        std::vector<cv::Point> corners;
        for (const cv::Point2d& corner : box.corners()) corners.emplace_back(cvRound(corner.x), cvRound(corner.y));
        cv::fillConvexPoly(colour_, corners, paint + cv::Scalar::all(light_), cv::LINE_AA);
    }
    double light_;
    cv::Mat colour_;
    std::vector<EventTrack> tracks_;
};

EventTrack trackOver(TrackId id, FrameIndex first, FrameIndex last) {
    EventTrack track{id, {}};
    for (FrameIndex frame = first; frame <= last; ++frame)
        track.boxes.push_back({frame, {{50. + frame, 40}, 20, 9, 0}});
    return track;
}

}  // namespace

TEST(TrackLooks, ColourTellsVehiclesApartAndPlaceHeadingAndSizeDoNot) {
    PaintedStreet street;
    street.park(1, {100, 100}, 0, kRed);
    street.park(2, {300, 200}, 1.1, kRed);
    street.park(3, {200, 80}, -2.5, kRed, 48);
    street.park(4, {400, 80}, 0, kBlue);
    street.park(5, {100, 220}, 0, kWhite);
    const LooksByTrack looks = street.looks();
    ASSERT_EQ(looks.size(), 5U);
    EXPECT_NEAR(lookLikeness(looks.at(1), looks.at(1)), 1, 1e-3);
    EXPECT_GT(lookLikeness(looks.at(1), looks.at(2)), 0.6);
    EXPECT_GT(lookLikeness(looks.at(1), looks.at(3)), 0.6);
    EXPECT_LT(lookLikeness(looks.at(1), looks.at(4)), 0.3);
    EXPECT_LT(lookLikeness(looks.at(1), looks.at(5)), 0.3);
    EXPECT_EQ(lookLikeness(looks.at(1), looks.at(4)), lookLikeness(looks.at(4), looks.at(1)));
}

TEST(TrackLooks, TheLightOfTheDayDoesNotMatterAndGreyPicturesTellBrightness) {
    const auto parked = [](double light) {
        PaintedStreet street(light);
        street.park(1, {100, 100}, 0, cv::Scalar::all(150));
        street.park(2, {300, 200}, 0, cv::Scalar::all(60));
        return street;
    };
    const LooksByTrack noon = parked(30).looks(false);
    const LooksByTrack evening = parked(-15).looks(false);
    EXPECT_GT(lookLikeness(noon.at(1), evening.at(1)), 0.6);
    EXPECT_LT(lookLikeness(noon.at(1), evening.at(2)), 0.4);
}

TEST(TrackLooks, OutlinesTellVehiclesOfOneColourApart) {
    PaintedStreet street;
    street.park(1, {100, 100}, 0, kWhite);
    street.park(2, {300, 100}, 0.4, kWhite);
    street.park(3, {100, 220}, 0, kWhite, 30, false);
    const LooksByTrack looks = street.looks();
    EXPECT_GT(lookLikeness(looks.at(1), looks.at(2)), lookLikeness(looks.at(1), looks.at(3)));
}

TEST(TrackLooks, TracksShareTheFewFramesInWhichTheyAreLookedAt) {
    std::vector<EventTrack> tracks;
    for (TrackId id = 1; id <= 50; ++id) tracks.push_back(trackOver(id, 0, 400 + id % 5));
    tracks.push_back(trackOver(51, 1001, 1003));
    const std::vector<FrameIndex> frames = LookTaker(tracks).frames();
    EXPECT_TRUE(std::is_sorted(frames.begin(), frames.end()));
    EXPECT_LE(frames.size(), 9U) << "three for all that live together, and those of the short one";
    EXPECT_GE(frames.back(), 1001);
    // However many there are.
    std::vector<EventTrack> hour;
    for (TrackId id = 1; id <= 3000; ++id) hour.push_back(trackOver(id, 30 * id, 30 * id + 500));
    EXPECT_LE(LookTaker(hour).frames().size(), 400U);
    EXPECT_TRUE(LookTaker({}).frames().empty());
}

TEST(TrackLooks, WhatNoFrameShowsHasNone) {
    LookTaker taker({trackOver(1, 0, 100), {2, {{25, {{-90, 40}, 20, 9, 0}}}}});
    Frame frame;
    frame.gray = cv::Mat(100, 200, CV_8UC1, cv::Scalar(90));
    frame.index = 3;
    taker.look(frame);
    EXPECT_TRUE(taker.looks().empty()) << "nobody asked for this frame";
    for (const FrameIndex index : taker.frames()) {
        frame.index = index;
        taker.look(frame);
    }
    EXPECT_THAT(taker.looks(), testing::ElementsAre(testing::Key(1))) << "the other one is out of the picture";
}

TEST(TrackLooks, LikenessIsByHistogramsAndGradientsAsTheFormulaSays) {
    TrackLook look;
    for (auto& histogram : look.colours) histogram[2] = 1;
    look.gradients = {1, 0};
    EXPECT_DOUBLE_EQ(lookLikeness(look, look), 1);
    TrackLook other = look;
    other.colours[1] = {0, 0.75, 0.25, 0, 0, 0, 0, 0};  // a coefficient of ½
    EXPECT_NEAR(lookLikeness(look, other), std::exp(-0.5 * 4 * 0.5), 1e-9);
    other.colours[0] = {0, 0, 0, 1, 0, 0, 0, 0};  // and nothing in common
    EXPECT_NEAR(lookLikeness(look, other), std::exp(-0.5 * 4 * 1.5), 1e-9);
    other = look;
    other.gradients = {0.7F, std::sqrt(0.51F)};  // one deviation
    EXPECT_NEAR(lookLikeness(look, other), std::exp(-0.25), 1e-6);
    other.gradients = {1};
    EXPECT_EQ(lookLikeness(look, other), 0) << "of another kind";
}

TEST(TrackLooks, ColoursAreThoseOfTheBoxAgainstTheGroundAroundIt) {
    // A box that fills three quarters of the window pixel by pixel, heading up.
    const cv::Scalar paint(60, 110, 190);
    Frame frame;
    frame.colour = cv::Mat(150, 200, CV_8UC3, cv::Scalar::all(100));
    frame.colour(cv::Rect(45, 49, 12, 24)).setTo(paint);
    cv::cvtColor(frame.colour, frame.gray, cv::COLOR_BGR2GRAY);
    LookTaker taker({{1, {{0, {{50.5, 60.5}, 24, 12, -CV_PI / 2}}}}});
    taker.look(frame);
    const TrackLook look = taker.looks().at(1);
    cv::Mat lab(1, 2, CV_8UC3, paint);
    lab.at<cv::Vec3b>(0, 1) = {100, 100, 100};
    cv::cvtColor(lab, lab, cv::COLOR_BGR2Lab);
    const cv::Vec3b vehicle = lab.at<cv::Vec3b>(0, 0), ground = lab.at<cv::Vec3b>(0, 1);
    const double values[] = {128.0 + vehicle[0] - ground[0], 128 + 2 * (vehicle[1] - 128.0),
                             128 + 2 * (vehicle[2] - 128.0)};
    for (std::size_t i = 0; i < 3; ++i) {
        const double at = values[i] / 32 - 0.5;  // bins of 32, counted from the middle of the first
        const auto lower = static_cast<std::size_t>(at);
        EXPECT_NEAR(look.colours[i].at(lower), 1 - (at - static_cast<double>(lower)), 1e-9) << i;
        EXPECT_NEAR(look.colours[i].at(lower + 1), at - static_cast<double>(lower), 1e-9) << i;
    }
}

TEST(TrackLooks, ATrackIsLookedAtInThreeFramesThatDivideByEight) {
    EXPECT_THAT(LookTaker({trackOver(1, 0, 100)}).frames(), testing::ElementsAre(24, 48, 72));
    EXPECT_THAT(LookTaker({trackOver(1, 0, 9)}).frames(), testing::ElementsAre(0, 8));
    EXPECT_THAT(LookTaker({trackOver(1, 3, 5)}).frames(), testing::ElementsAre(4)) << "in the middle, if in none";
}

TEST(TrackLooks, WhoseMiddleIsInThePictureIsSeen) {
    const auto isSeen = [](cv::Point2d centre, double length = 20) {
        LookTaker taker({{1, {{0, {centre, length, 9, 0}}}}});
        Frame frame;
        frame.gray = cv::Mat(100, 200, CV_8UC1, cv::Scalar(90));
        taker.look(frame);
        return !taker.looks().empty();
    };
    EXPECT_TRUE(isSeen({0, 0}));
    EXPECT_TRUE(isSeen({199, 99}));
    EXPECT_FALSE(isSeen({200, 50}));
    EXPECT_FALSE(isSeen({100, 100}));
    EXPECT_FALSE(isSeen({-1, 50}));
    EXPECT_FALSE(isSeen({50, -1}));
    EXPECT_FALSE(isSeen({100, 50}, 0)) << "a box without an area";
}

TEST(TrackLooks, PicturesThatCannotBeReadAreCountedAndTheOthersLookedAt) {
    const std::vector<EventTrack> tracks{trackOver(1, 0, 100)};
    const std::vector<FrameIndex> frames = LookTaker(tracks).frames();
    ASSERT_EQ(frames.size(), 3U);
    double share = 0;
    const auto readWith = [&](const ReadPicture& picture) {
        return readLooks(
            tracks, [&] { return picture; }, [&](double done) { share = done; }, {});
    };
    const auto good = [](FrameIndex index) {
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(100, 200, CV_8UC1, cv::Scalar(90));
        return frame;
    };
    const LooksRead all = readWith(good);
    EXPECT_EQ(all.missing(), "");
    EXPECT_EQ(all.looks.size(), 1U);
    EXPECT_EQ(share, 1);
    const LooksRead some = readWith([&](FrameIndex index) {
        if (index == frames[1]) throw std::runtime_error("a hole in the tape");
        return good(index);
    });
    EXPECT_EQ(some.missing(), "1 of 3 pictures could not be read: a hole in the tape");
    EXPECT_EQ(some.looks.size(), 1U);
    const LooksRead none = readLooks(
        tracks, []() -> ReadPicture { throw std::runtime_error("no such tape"); }, [](double) {}, {});
    EXPECT_EQ(none.missing(), "3 of 3 pictures could not be read: no such tape");
    EXPECT_TRUE(none.looks.empty());
    std::stop_source stop;
    stop.request_stop();
    EXPECT_TRUE(readLooks(
                    tracks, [&] { return ReadPicture(good); }, [](double) {}, stop.get_token())
                    .looks.empty());
}

TEST(TrackLooks, AReadingThatIsStoppedGoesOnWhereItWasAndReadsNothingTwice) {
    const std::vector<EventTrack> tracks{trackOver(1, 0, 100), trackOver(2, 200, 300)};
    const auto picture = [](FrameIndex index) {
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(100, 400, CV_8UC1, cv::Scalar(90));
        cv::rectangle(frame.gray, {index + 42, 36, 16, 8}, cv::Scalar(200), cv::FILLED);
        return frame;
    };
    std::vector<FrameIndex> seen;
    std::stop_source stop;
    const auto open = [&]() -> ReadPicture {
        return [&](FrameIndex index) {
            seen.push_back(index);
            if (seen.size() == 2) stop.request_stop();
            return picture(index);
        };
    };
    LookReading reading;
    double share = 0;
    const auto tell = [&](double done) { share = done; };
    reading.goOn(tracks, open, tell, stop.get_token());
    EXPECT_EQ(seen.size(), 2U);
    // Stopped while it is opened: nothing counts as unreadable.
    const auto interrupted = []() -> ReadPicture { throw std::runtime_error("stopped"); };
    EXPECT_EQ(reading.goOn(tracks, interrupted, tell, stop.get_token()).missing(), "");
    const LooksRead all = reading.goOn(tracks, open, tell, {});
    EXPECT_EQ(seen, LookTaker(tracks).frames());
    EXPECT_EQ(share, 1);
    EXPECT_EQ(all.missing(), "");
    const LooksRead at_once = readLooks(
        tracks, [&] { return ReadPicture(picture); }, [](double) {}, {});
    ASSERT_EQ(all.looks.size(), at_once.looks.size());
    for (const auto& [track, look] : at_once.looks) {
        EXPECT_EQ(all.looks.at(track).colours, look.colours);
        EXPECT_EQ(all.looks.at(track).gradients, look.gradients);
    }
    // Another ranking opens nothing.
    EXPECT_EQ(reading.goOn(tracks, interrupted, tell, {}).looks.size(), 2U);
}

TEST(LikenessChoice, IsNamedInWords) {
    EXPECT_EQ(LikenessChoice::named({"looks", "path"}), (LikenessChoice{true, false, false, true}));
    EXPECT_THAT(LikenessChoice().names(), testing::ElementsAre("path", "speed", "size"));
    for (const LikenessChoice& each : {LikenessChoice{}, LikenessChoice{false, true, false, true}})
        EXPECT_EQ(LikenessChoice::named(each.names()), each);
    EXPECT_THROW(LikenessChoice::named({"path", "colour"}), Error);
    EXPECT_THROW(LikenessChoice::named({}), Error) << "something has to count";
}

TEST(LikenessChoice, OrdersTheMostLikeFirstThenBySpeedAndSizeThenByNumber) {
    std::vector<TrackLikeness> found{{.track = 2, .path = 0.5, .speed = 0.2, .size = 1},
                                     {.track = 3, .path = 0.9, .speed = 0.1, .size = 1},
                                     {.track = 4, .path = 0.5, .speed = 0.8, .size = 1},
                                     {.track = 1, .path = 0.5, .speed = 0.2, .size = 1}};
    const auto order = [&](const LikenessChoice& counts) {
        orderBy(counts, found);
        std::vector<TrackId> ids;
        for (const TrackLikeness& each : found) ids.push_back(each.track);
        return ids;
    };
    EXPECT_THAT(order({true, false, false, false}), testing::ElementsAre(3, 4, 1, 2));
    EXPECT_EQ(found.front().likeness, 0.9);
    EXPECT_THAT(order({false, true, false, false}), testing::ElementsAre(4, 1, 2, 3));
}

TEST(LikenessChoice, WhatCountsIsAGeometricMeanWithPathAndLooksTwice) {
    const TrackLikeness parts{.track = 1, .path = 0.5, .speed = 0.9, .size = 0.8, .looks = 0.3};
    EXPECT_NEAR(likenessBy(parts, {}), std::sqrt(0.5 * std::sqrt(0.9 * 0.8)), 1e-12);
    EXPECT_NEAR(likenessBy(parts, {.looks = true}), std::pow(0.25 * 0.9 * 0.8 * 0.09, 1 / 6.0), 1e-12);
    EXPECT_NEAR(likenessBy(parts, {false, false, false, true}), 0.3, 1e-12);
    TrackLikeness unseen = parts;
    unseen.looks.reset();
    EXPECT_EQ(likenessBy(unseen, {.looks = true}), likenessBy(unseen, {})) << "the rest counts";
    EXPECT_EQ(likenessBy(unseen, {false, false, false, true}), 0);
}

TEST(LikenessChoice, LooksAreComparedWithThoseOfTheChosenOne) {
    PaintedStreet street;
    street.park(1, {100, 100}, 0, kRed);
    street.park(2, {300, 200}, 0, kRed);
    street.park(3, {400, 80}, 0, kBlue);
    std::vector<TrackLikeness> found{{.track = 2}, {.track = 3}, {.track = 4}};
    compareLooks(found, street.looks(), 1);
    ASSERT_TRUE(found[0].looks && found[1].looks);
    EXPECT_GT(*found[0].looks, *found[1].looks);
    EXPECT_FALSE(found[2].looks) << "no picture showed it";
    std::vector<TrackLikeness> unknown{{.track = 2}};
    compareLooks(unknown, street.looks(), 9);
    EXPECT_FALSE(unknown[0].looks);
}

}  // namespace eyrie::track_looks_test
