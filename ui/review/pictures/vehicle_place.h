#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"
#include "events/stored_events.h"

namespace eyrie::ui {

struct FoundEvents;

/// A vehicle in a frame, where a picture of it can be taken.
struct VehiclePlace {
    FrameIndex frame = 0;
    OrientedBox box;

    /// By frame, then place and size.
    bool operator<(const VehiclePlace& other) const;
};

/// Where a track shows what it is of: in the middle of its life. Nothing for one that the run's result does not hold.
std::optional<VehiclePlace> placeOfTrack(const StoredTracks& run, TrackId track);
/// The first of an event's vehicles at the frame to look at, or as near to it as it was seen. Nothing for a stretch
/// that could not be searched.
std::optional<VehiclePlace> placeOfEvent(const FoundEvents& found, std::size_t position);

/// The vehicle with a little around it, turned so that it heads to the right, in `size` px. `picture`: CV_8UC1 or
/// CV_8UC3; beyond it its border is repeated. Empty where nothing of the vehicle can be in the picture.
cv::Mat pictureOfVehicle(const cv::Mat& picture, const OrientedBox& box, cv::Size size);

}  // namespace eyrie::ui
