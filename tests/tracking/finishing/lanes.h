#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/geometry/angle.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie::test {

inline const SceneScale kFourToAMetre{0.25, 25, true};  // 1 m are 4 px, 1 m/s is .16 px/frame
inline constexpr double kRoads[] = {0.0, 0.8, kPi / 2, -2.5};

/// A track along a road: where it is, seen along the road (x) and across it (y), in px.
struct Lane {
    TrackId id = 1;
    double heading = 0;
    cv::Size2d size{20, 8};
    double speed = 1.5;
    int first = 0;
    int count = 40;
    int detected = 40;  ///< of the first frames; those after them are `otherwise`
    StateOrigin otherwise = StateOrigin::reconstructed;
    cv::Point2d offset{0, 0};
    double velocity_factor = 1;                        ///< of what it says of its speed
    std::function<cv::Point2d(int)> wobble = nullptr;  ///< added to the offset in a frame
    std::function<double(int)> turn = nullptr;         ///< of the box from the road, radians

    TrackPath path() const {
        OrientedBox road{{300, 200}, 1, 1, heading};
        TrackPath result{id, {}};
        for (int frame = first; frame < first + count; ++frame) {
            TrackState state;
            state.id = id;
            const cv::Point2d place = offset + cv::Point2d(speed * frame, 0) + (wobble ? wobble(frame) : cv::Point2d());
            state.box = {road.toImage(place), size.width, size.height, heading + (turn ? turn(frame) : 0)};
            state.velocity = speed * velocity_factor * road.direction();
            state.status = TrackStatus::confirmed;
            state.origin = frame - first < detected ? StateOrigin::detected : otherwise;
            result.states.emplace_back(frame, PathState(state));
        }
        return result;
    }
};

/// Calls for two lanes of every road; both go into the order given.
inline void onEveryRoad(Lane one, Lane other, const std::function<void(std::vector<TrackPath>)>& look) {
    other.id = 2;
    for (const double heading : kRoads) {
        SCOPED_TRACE("heading " + std::to_string(heading));
        one.heading = other.heading = heading;
        look({one.path(), other.path()});
    }
}

/// Whether two lanes become one track as parts of one vehicle.
inline void expectParts(bool expected, const Lane& one, const Lane& other, const SceneScale& scale,
                        PartsOfVehicle wanted) {
    onEveryRoad(one, other, [&](std::vector<TrackPath> paths) {
        joinParts(paths, scale, wanted);
        EXPECT_EQ(paths.size() == 1, expected);
    });
}

/// px a frame to either side in turn.
inline std::function<cv::Point2d(int)> shaking(cv::Point2d by) {
    return [by](int frame) { return frame % 2 == 0 ? by : -by; };
}

}  // namespace eyrie::test
