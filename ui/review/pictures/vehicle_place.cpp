#include "review/pictures/vehicle_place.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <tuple>

#include "review/events/found_events.h"

namespace eyrie::ui {

namespace {

constexpr double kShownSizes = 1.8;    ///< length and width that are shown, of the vehicle's
constexpr double kLeastShown_px = 24;  ///< wide, so that a tiny one is not a few squares

const EventTrack* trackIn(const StoredTracks& run, TrackId track) {
    const auto found = std::lower_bound(run.tracks.begin(), run.tracks.end(), track,
                                        [](const EventTrack& one, TrackId id) { return one.id < id; });
    return found != run.tracks.end() && found->id == track && !found->boxes.empty() ? &*found : nullptr;
}

VehiclePlace placeAt(const TrackedBox& box) {
    return {box.frame, box.box};
}

}  // namespace

bool VehiclePlace::operator<(const VehiclePlace& other) const {
    return std::tie(frame, box.centre.x, box.centre.y, box.length, box.width, box.heading) <
           std::tie(other.frame, other.box.centre.x, other.box.centre.y, other.box.length, other.box.width,
                    other.box.heading);
}

std::optional<VehiclePlace> placeOfTrack(const StoredTracks& run, TrackId track) {
    const EventTrack* found = trackIn(run, track);
    if (found == nullptr) return std::nullopt;
    return placeAt(found->boxes[found->boxes.size() / 2]);
}

std::optional<VehiclePlace> placeOfEvent(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    if (event == nullptr || event->tracks.empty()) return std::nullopt;
    const EventTrack* track = trackIn(*found.run, event->tracks.front());
    if (track == nullptr) return std::nullopt;
    const auto nearest =
        std::min_element(track->boxes.begin(), track->boxes.end(), [event](const TrackedBox& a, const TrackedBox& b) {
            return std::abs(a.frame - event->frame) < std::abs(b.frame - event->frame);
        });
    return placeAt(*nearest);
}

cv::Mat pictureOfVehicle(const cv::Mat& picture, const OrientedBox& box, cv::Size size) {
    const bool finite = std::isfinite(box.centre.x) && std::isfinite(box.centre.y) && std::isfinite(box.heading) &&
                        std::isfinite(box.length) && std::isfinite(box.width);
    if (picture.empty() || size.empty() || !finite || !(box.length > 0) || !(box.width > 0)) return {};
    const double reach = (box.length + box.width) / 2;
    if (box.centre.x < -reach || box.centre.y < -reach || box.centre.x > picture.cols + reach ||
        box.centre.y > picture.rows + reach)
        return {};
    // Pixels of the picture for one of the result.
    const double step = std::max(
        {kShownSizes * box.length / size.width, kShownSizes * box.width / size.height, kLeastShown_px / size.width});
    const double c = step * std::cos(box.heading);
    const double s = step * std::sin(box.heading);
    const cv::Point2d middle((size.width - 1) / 2.0, (size.height - 1) / 2.0);
    const cv::Matx23d picture_from_result(c, -s, box.centre.x - c * middle.x + s * middle.y,  //
                                          s, c, box.centre.y - s * middle.x - c * middle.y);
    cv::Mat result;
    cv::warpAffine(picture, result, picture_from_result, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    return result;
}

}  // namespace eyrie::ui
