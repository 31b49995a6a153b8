#include "events/ground/ground_path.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core/utility.hpp>

namespace eyrie {
namespace {

constexpr double kSure = 3;                 ///< deviations
constexpr std::size_t kFewestInWindow = 3;  ///< samples that tell a speed
constexpr double kSeenOfStandstill = 0.4;   ///< share of the least time that a track must show that is lost in it
constexpr double kUnseen_s = 0.1;           ///< between the last that was seen of a vehicle and its standstill

/// Places and velocities by a straight line through the samples of a window around each; near the ends of the path the
/// window is cut off.
void measure(GroundPath& path, const std::vector<cv::Point2d>& raw, double half_window, double rate_hz) {
    const std::vector<GroundSample>& s = path.samples;
    std::size_t begin = 0, end = 0;
    for (std::size_t i = 0; i < s.size(); ++i) {
        while (s[i].frame - s[begin].frame > half_window) ++begin;
        while (end < s.size() && s[end].frame - s[i].frame <= half_window) ++end;
        const double n = static_cast<double>(end - begin);
        double mean_time = 0;
        cv::Point2d mean(0, 0);
        for (std::size_t k = begin; k < end; ++k) {
            mean_time += (s[k].frame - s[i].frame) / n;
            mean += raw[k] * (1 / n);
        }
        double spread = 0;
        cv::Point2d slope(0, 0);
        for (std::size_t k = begin; k < end; ++k) {
            const double time = s[k].frame - s[i].frame - mean_time;
            spread += time * time;
            slope += raw[k] * time;
        }
        GroundSample& sample = path.samples[i];
        if (end - begin < kFewestInWindow) continue;
        slope *= 1 / spread;
        sample.at = mean - slope * mean_time;
        sample.velocity = slope * (rate_hz * sample.by_place);
        sample.speed = std::hypot(sample.velocity.x, sample.velocity.y);
    }
}

/// How fast noise alone lets a standing vehicle seem, m/s.
double speedOfNoise(double noise_m, double half_window, double rate_hz) {
    const double n = 2 * std::floor(half_window) + 1;
    return kSure * noise_m * std::sqrt(12 / (n * (n * n - 1))) * rate_hz;
}

/// What moves, by two thresholds; a start is dated back to where the lower one was passed.
void tellMoving(GroundPath& path, double standing, double moving) {
    std::vector<GroundSample>& s = path.samples;
    bool now = s.front().speed >= (standing + moving) / 2;
    std::size_t slow_until = 0;  // the last sample below the lower threshold, plus one
    for (std::size_t i = 0; i < s.size(); ++i) {
        if (s[i].speed < standing) {
            slow_until = i + 1;
            now = false;
        } else if (!now && s[i].speed > moving) {
            now = true;
            for (std::size_t k = slow_until; k < i; ++k) s[k].moving = true;
        }
        s[i].moving = now;
    }
}

void set(GroundPath& path, const SampleSpan& span, bool moving) {
    for (std::size_t i = span.first; i <= span.last; ++i) path.samples[i].moving = moving;
}

/// Whether a track is lost in its last standstill, having been seen until it stood. Where it was not, its prediction
/// may have come to rest instead; and where the video ends nobody knows how it went on.
bool isLostStanding(const GroundPath& path, const SampleSpan& span, const Footage& footage) {
    return path.ends && span.last + 1 == path.samples.size() && path.samples[span.last].frame < footage.last_frame &&
           path.samples[span.first].frame <= path.track->seen_until + kUnseen_s * footage.scale.frame_rate_hz;
}

void removeShortSpans(GroundPath& path, double min_way, const EventOptions& options, const Footage& footage) {
    const auto isWhole = [&](const SampleSpan& span) {
        return span.first == 0 && span.last + 1 == path.samples.size();
    };
    for (const SampleSpan& span : spansOf(path, true)) {
        const double moved = metresBetween(path.samples[span.first], path.samples[span.last]);
        if (!isWhole(span) && moved < min_way) set(path, span, false);
    }
    for (const SampleSpan& span : spansOf(path, false)) {
        // Tracks are lost where nothing moves any more: a stop is often the last that they show.
        const double least = options.min_standing_s * (isLostStanding(path, span, footage) ? kSeenOfStandstill : 1);
        if (!isWhole(span) && secondsBetween(path, span.first, span.last, footage.scale) < least) set(path, span, true);
    }
}

/// Boxes of the track from `first` on that lie on one ground.
GroundPath pieceFrom(const EventTrack& track, std::size_t first, const GroundStretches& ground,
                     std::vector<cv::Point2d>& raw) {
    GroundPath path;
    path.track = &track;
    path.first_box = first;
    path.stretch = ground.indexOf(track.boxes[first].frame);
    path.begins = first == 0;
    const FrameIndex last = ground.all()[static_cast<std::size_t>(path.stretch)].last_frame;
    const auto begin = track.boxes.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end =
        std::partition_point(begin, track.boxes.end(), [last](const TrackedBox& box) { return box.frame <= last; });
    raw.reserve(static_cast<std::size_t>(end - begin));
    path.samples.reserve(static_cast<std::size_t>(end - begin));
    for (auto box = begin; box != end; ++box) {
        GroundSample sample;
        sample.frame = box->frame;
        sample.at = ground.toGround(box->frame, box->box.centre);
        sample.by_place = ground.metresByPlace(box->frame, box->box.centre);
        raw.push_back(sample.at);
        path.samples.push_back(sample);
    }
    path.ends = end == track.boxes.end();
    return path;
}

/// The paths of one track, a piece for each ground.
std::vector<GroundPath> piecesOf(const EventTrack& track, const GroundStretches& ground, const EventOptions& options) {
    const SceneScale& scale = ground.footage().scale;
    const double half_window = std::max(2.0, options.smooth_s * scale.frame_rate_hz / 2);
    std::vector<GroundPath> pieces;
    for (std::size_t i = 0; i < track.boxes.size();) {
        if (ground.indexOf(track.boxes[i].frame) < 0) {
            ++i;
            continue;
        }
        std::vector<cv::Point2d> raw;
        GroundPath path = pieceFrom(track, i, ground, raw);
        i += path.samples.size();
        path.measured = path.samples.size() >= kFewestInWindow &&
                        path.samples.back().frame - path.samples.front().frame >= half_window;
        if (path.measured) {
            measure(path, raw, half_window, scale.frame_rate_hz);
            const TrackedBox& middle = path.box(path.samples.size() / 2);
            const double noise_m = options.noise * ground.metresHere(middle.frame, middle.box.centre);
            const double noise = speedOfNoise(noise_m, half_window, scale.frame_rate_hz);
            const double standing = std::max(options.standing_speed_kmh / 3.6, noise);
            tellMoving(path, standing, std::max({options.moving_speed_kmh / 3.6, standing, 1.5 * noise}));
            removeShortSpans(path, std::max(options.min_way_m, 2 * kSure * noise_m), options, ground.footage());
        }
        pieces.push_back(std::move(path));
    }
    return pieces;
}

}  // namespace

std::vector<SampleSpan> spansOf(const GroundPath& path, bool moving) {
    std::vector<SampleSpan> spans;
    if (!path.measured) return spans;
    for (std::size_t i = 0; i < path.samples.size(); ++i) {
        if (path.samples[i].moving != moving) continue;
        if (i == 0 || path.samples[i - 1].moving != moving) spans.push_back({i, i});
        spans.back().last = i;
    }
    return spans;
}

double secondsBetween(const GroundSample& a, const GroundSample& b, const SceneScale& scale) {
    return (b.frame - a.frame) / scale.frame_rate_hz;
}

double secondsBetween(const GroundPath& path, std::size_t from, std::size_t to, const SceneScale& scale) {
    return secondsBetween(path.samples[from], path.samples[to], scale);
}

double metresBetween(const GroundSample& a, const GroundSample& b) {
    return std::hypot(b.at.x - a.at.x, b.at.y - a.at.y) * (a.by_place + b.by_place) / 2;
}

double wayBetween(const GroundPath& path, std::size_t from, std::size_t to) {
    double way = 0;
    for (std::size_t i = from + 1; i <= to; ++i) {
        if (path.samples[i].moving) way += metresBetween(path.samples[i - 1], path.samples[i]);
    }
    return way;
}

std::size_t sampleAt(const GroundPath& path, FrameIndex frame) {
    const auto found = std::lower_bound(path.samples.begin(), path.samples.end(), frame,
                                        [](const GroundSample& sample, FrameIndex at) { return sample.frame < at; });
    return static_cast<std::size_t>(found - path.samples.begin());
}

std::vector<GroundPath> groundPaths(const std::vector<EventTrack>& tracks, const GroundStretches& ground,
                                    const EventOptions& options) {
    std::vector<std::vector<GroundPath>> of_track(tracks.size());
    cv::parallel_for_({0, static_cast<int>(tracks.size())}, [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto number = static_cast<std::size_t>(i);
            of_track[number] = piecesOf(tracks[number], ground, options);
        }
    });
    std::vector<GroundPath> paths;
    paths.reserve(tracks.size());
    for (std::vector<GroundPath>& pieces : of_track)
        paths.insert(paths.end(), std::make_move_iterator(pieces.begin()), std::make_move_iterator(pieces.end()));
    return paths;
}

}  // namespace eyrie
