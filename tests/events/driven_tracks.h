#pragma once

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "core/geometry/angle.h"
#include "core/geometry/homography_jacobian.h"
#include "events/event_search.h"

namespace eyrie::test {

/// A part of a drive: the speed changes evenly, and so does the heading.
struct Leg {
    double seconds = 0;
    double from_kmh = 0;
    double to_kmh = 0;
    double turn_deg_per_s = 0;  ///< to the right
};

/// Tracks that are driven leg by leg over a ground in metres (x right, y down) under a camera of one's choice.
class DrivenTracks {
 public:
    using Camera = std::function<cv::Matx33d(int frame)>;  ///< px from metres

    SceneScale scale{0.2, 25, true};
    cv::Size size{1000, 600};  ///< 200 m by 120 m, seen by the camera that stands
    int frames = 1000;
    double noise_px = 0.3;
    Camera camera = standing(0.2);
    std::vector<EventTrack> tracks;
    std::set<TrackId> left;  ///< tracks that drove out of the picture

    /// Looks straight down with its first pixel over the origin.
    static Camera standing(double gsd) {
        return [gsd](int) { return cv::Matx33d(1 / gsd, 0, 0, 0, 1 / gsd, 0, 0, 0, 1); };
    }
    /// Drifts, turns and climbs over the same ground.
    static Camera moving(double gsd) {
        return [gsd](int frame) {
            const double t = frame / 25.0;
            const double turn = 0.15 * std::sin(t / 6);
            const double zoom = (1 + 0.1 * std::sin(t / 9)) / gsd;
            const cv::Point2d centre(100 + 6 * std::sin(t / 5), 60 + 4 * (std::cos(t / 4) - 1));
            const double c = zoom * std::cos(turn), s = zoom * std::sin(turn);
            return cv::Matx33d(c, s, 500 - c * centre.x - s * centre.y,  //
                               -s, c, 300 + s * centre.x - c * centre.y, 0, 0, 1);
        };
    }

    /// Adds the part of a drive that is in the picture; answers the track's id.
    TrackId drive(cv::Point2d start, double heading_deg, const std::vector<Leg>& legs, int first_frame = 0) {
        std::vector<std::pair<cv::Point2d, double>> poses;
        double heading = radiansFromDegrees(heading_deg);
        const double step = 1 / scale.frame_rate_hz;
        for (const Leg& leg : legs) {
            const int count = static_cast<int>(std::lround(leg.seconds * scale.frame_rate_hz));
            for (int i = 0; i < count; ++i) {
                poses.emplace_back(start, heading);
                const double speed = leg.from_kmh + (leg.to_kmh - leg.from_kmh) * (i + 0.5) / count;
                heading += radiansFromDegrees(leg.turn_deg_per_s) * step;
                start += cv::Point2d(std::cos(heading), std::sin(heading)) * (speed / 3.6 * step);
            }
        }
        return follow(poses, first_frame);
    }
    /// The same of poses on the ground, one a frame: m and radians.
    TrackId follow(const std::vector<std::pair<cv::Point2d, double>>& poses, int first_frame = 0, double length = 4.5) {
        EventTrack track;
        track.id = static_cast<TrackId>(tracks.size()) + 1;
        for (std::size_t i = 0; i < poses.size(); ++i) {
            const int frame = first_frame + static_cast<int>(i);
            if (frame < 0 || frame >= frames) continue;
            const HomographyJacobian local(camera(frame), poses[i].first);
            OrientedBox box{local.point(), length * local.scale(), 1.8 * local.scale(), local.turned(poses[i].second)};
            const bool inside =
                box.centre.x >= 0 && box.centre.y >= 0 && box.centre.x < size.width && box.centre.y < size.height;
            if (!inside && !track.boxes.empty()) {
                left.insert(track.id);
                break;
            }
            if (!inside) continue;
            box.centre += {random_.gaussian(noise_px), random_.gaussian(noise_px)};
            track.boxes.push_back({frame, box});
        }
        tracks.push_back(track);
        return track.id;
    }
    /// Ends the newest track after so many seconds of its life, as if it had been lost.
    void cutAfter(double seconds) {
        const auto count = static_cast<std::size_t>(seconds * scale.frame_rate_hz);
        if (tracks.back().boxes.size() > count) tracks.back().boxes.resize(count);
    }

    Footage footage() const {
        std::vector<Homography> steps;
        for (int frame = 1; frame < frames; ++frame) {
            Homography step;
            step.from_frame = frame - 1;
            step.to_frame = frame;
            step.matrix = camera(frame) * camera(frame - 1).inv();
            step.matrix = step.matrix * (1 / step.matrix(2, 2));
            steps.push_back(step);
        }
        Footage footage;
        footage.camera = CameraMotion(steps);
        footage.image_size = size;
        footage.last_frame = frames - 1;
        footage.scale = scale;
        return footage;
    }
    std::vector<Event> events(const EventOptions& options = {}, const std::vector<Zone>& zones = {}) const {
        return findEvents(tracks, footage(), options, zones);
    }
    std::vector<Event> events(EventKind kind, const EventOptions& options = {},
                              const std::vector<Zone>& zones = {}) const {
        std::vector<Event> found = events(options, zones);
        std::erase_if(found, [kind](const Event& event) { return event.kind != kind; });
        return found;
    }
    /// Where an event was, on the ground, m.
    cv::Point2d placeOf(const Event& event) const {
        return HomographyJacobian(camera(event.frame).inv(), event.place).point();
    }

 private:
    cv::RNG random_{4711};
};

inline std::vector<TrackId> tracksOf(const std::vector<Event>& events) {
    std::vector<TrackId> ids;
    for (const Event& event : events) ids.insert(ids.end(), event.tracks.begin(), event.tracks.end());
    return ids;
}

}  // namespace eyrie::test

namespace eyrie {

/// For messages of failed tests.
inline void PrintTo(const Event& event, std::ostream* out) {
    *out << nameOf(event.kind) << " of";
    for (const TrackId id : event.tracks) *out << ' ' << id;
    *out << " in " << event.first_frame << " to " << event.last_frame << ", " << figureText(event) << ' ' << event.zone;
}

}  // namespace eyrie
