// How a track keeps the places of its vectors and is carried on by them.
#include "tracking/track_vectors.h"

#include <gtest/gtest.h>

#include "tracking/made_tracks.h"

namespace eyrie::track_vectors_test {
namespace {

using test::carAt;
using test::kFiveToAMetre;
using test::kPicture;

TrackerOptions with(const std::string& name, const std::string& value) {
    TrackerOptions options;
    setParameter(describeOf(options), name, value);
    return options;
}

/// A vector that drives as the car does.
MotionVector vectorAt(CornerId id, cv::Point2f place) {
    return {id, place, {1, 0}, 9};
}

}  // namespace

TEST(TrackVectors, StoredPlacesFollowTheBoxByTheirGain) {
    const std::vector<MotionVector> vectors{vectorAt(1, {105, 102})};
    const FrameVectors frame(vectors);
    for (const auto& [gain, along] : {std::pair("0.25", 2.0), {"1", 5.0}}) {
        const TrackerOptions options = with("tracking.relative_position_gain", gain);
        const TrackManager manager(options, kFiveToAMetre);
        MeasurementModel model(options, kFiveToAMetre);
        model.startFrame(kPicture, 0.02);
        std::vector<Track> tracks{carAt({100, 100})};
        tracks[0].origin = StateOrigin::detected;
        tracks[0].vectors = {{1, {1, 2}, 0, 0, 20, 10}};
        TrackVectors(options, manager, model, frame).associateByUpdate(tracks);
        ASSERT_EQ(tracks[0].vectors.size(), 1U);
        EXPECT_NEAR(tracks[0].vectors[0].in_box.x, along, 1e-6) << gain;
        EXPECT_NEAR(tracks[0].vectors[0].in_box.y, 2, 1e-6) << gain;
    }
}

TEST(TrackVectors, AgreementIsTheShareOfTheShorterSideByWhichVectorsMayDiffer) {
    // Of three that are needed one is 2.5 px off; the car is 10 px wide.
    const std::vector<MotionVector> vectors{vectorAt(1, {95, 98}), vectorAt(2, {105, 98}), vectorAt(3, {100, 105.5F})};
    const FrameVectors frame(vectors);
    for (const auto& [share, carried] : {std::pair("0.2", false), {"0.3", true}, {"0", true}}) {
        TrackerOptions options = with("tracking.agreement", share);
        options.min_vectors = 3;
        const TrackManager manager(options, kFiveToAMetre);
        MeasurementModel model(options, kFiveToAMetre);
        model.startFrame(kPicture, 0.02);
        Track track = carAt({100, 100});
        track.vectors = {{1, {-5, -2}, 0, 0, 20, 10}, {2, {5, -2}, 0, 1, 20, 10}, {3, {0, 3}, 0, 2, 20, 10}};
        EXPECT_EQ(TrackVectors(options, manager, model, frame).update(track), carried) << share;
    }
}

}  // namespace eyrie::track_vectors_test
