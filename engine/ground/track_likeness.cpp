#include "ground/track_likeness.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/error.h"
#include "core/robust_statistics.h"
#include "events/ground/ground_path.h"

namespace eyrie {
namespace {

constexpr double kLane_m = 3;
constexpr double kFarthest = 4;            ///< lanes, further away is nowhere near
constexpr double kLeastStep_m = 2;         ///< between compared places of a path
constexpr int kMostSteps = 128;            ///< of one path; longer ones are compared in longer steps
constexpr double kSpeedSpread = 0.4;       ///< of the logarithm
constexpr double kSizeSpread = 0.3;        ///< of the logarithm
constexpr double kSpeedFloor_mps = 1;      ///< what differs by less is hardly another speed
constexpr double kPartialWayPower = 0.25;  ///< how much it counts that one path is shorter

struct LikenessPart {
    const char* name;
    bool LikenessChoice::*counts;
};
constexpr std::array<LikenessPart, 4> kLikenessParts{{{"path", &LikenessChoice::path},
                                                      {"speed", &LikenessChoice::speed},
                                                      {"size", &LikenessChoice::size},
                                                      {"looks", &LikenessChoice::looks}}};

/// A place of a path, in metres on its ground.
struct PathPlace {
    cv::Point2d at;
    double speed = 0;     ///< m/s by the scale there
    double by_place = 1;  ///< metres by the scale there, of one on the ground
};

/// The part of a drive on one ground at places of even distances. A single place: it stands.
struct DrivenPath {
    std::vector<PathPlace> places;
    double way = 0;  ///< m on the ground
    double margin = 0;
    cv::Rect2d bounds;  ///< with the margin around them

    bool drives() const { return places.size() > 1; }
    double step() const { return way / static_cast<double>(places.size() - 1); }
};

struct LikenessFacts {
    std::map<int, DrivenPath> paths;  ///< by stretch
    double way = 0;                   ///< m on the ground
    double metres = 0;                ///< the same by the scale of its places
    double seconds = 0;               ///< driven
    double length = 0;                ///< m by the scale there, median
    double width = 0;
    bool drives() const { return way > 0; }
    double speed() const { return seconds > 0 ? metres / seconds : 0; }
};

double medianOrNone(std::vector<double> values) {
    return values.empty() ? 0 : medianOf(std::move(values));
}

double bell(double deviations) {
    return std::exp(-0.5 * deviations * deviations);
}

double speedLikeness(double a, double b) {
    return bell(std::log((a + kSpeedFloor_mps) / (b + kSpeedFloor_mps)) / kSpeedSpread);
}

/// Differences of logarithms make length and width independent of the scale.
double sizeLikeness(const LikenessFacts& a, const LikenessFacts& b) {
    if (!(a.length > 0 && b.length > 0 && a.width > 0 && b.width > 0)) return 0;
    return bell(std::hypot(std::log(a.length / b.length), std::log(a.width / b.width)) / kSizeSpread);
}

/// Measures the drives of tracks. `unit`: metres of a metre of the run's scale.
class PathMaker {
 public:
    PathMaker(const StoredTracks& run, const GroundStretches& ground, double unit)
        : run_(run), ground_(ground), unit_(unit) {}

    void add(const GroundPath& path, LikenessFacts& facts) const {
        std::vector<PathPlace> driven;
        std::vector<double> way;  // up to each
        double total = 0;
        double metres = 0;
        double seconds = 0;
        for (std::size_t i = 0; i < path.samples.size(); ++i) {
            const GroundSample& sample = path.samples[i];
            if (path.measured && !sample.moving && !driven.empty()) continue;
            if (!driven.empty()) {
                const double step = cv::norm(sample.at * unit_ - driven.back().at);
                total += step;
                metres += step * sample.by_place;
                if (i > 0) seconds += secondsBetween(path, i - 1, i, run_.footage.scale);
            }
            driven.push_back({sample.at * unit_, sample.speed * unit_, sample.by_place});
            way.push_back(total);
        }
        if (driven.empty()) return;
        if (!path.measured && seconds > 0)
            for (PathPlace& place : driven) place.speed = total / seconds * place.by_place;
        DrivenPath& made = facts.paths[path.stretch];
        const double length = ground_.toGround(path.samples.front().frame, path.box(0).box).length * unit_;
        if (total < std::max(kLeastStep_m, length)) {
            made.places = {driven.front()};
        } else {
            made.places = atEvenSteps(driven, way);
            made.way = total;
            facts.way += total;
            facts.metres += metres;
            facts.seconds += seconds;
        }
        setBounds(made);
    }

    void addSize(const EventTrack& track, LikenessFacts& facts) const {
        std::vector<double> lengths, widths;
        for (const TrackedBox& box : track.boxes) {
            if (ground_.of(box.frame) == nullptr) continue;
            const OrientedBox there = ground_.toGround(box.frame, box.box);
            const double metres = unit_ * ground_.metresByPlace(box.frame, box.box.centre);
            lengths.push_back(there.length * metres);
            widths.push_back(there.width * metres);
        }
        facts.length = medianOrNone(std::move(lengths));
        facts.width = medianOrNone(std::move(widths));
    }

 private:
    static std::vector<PathPlace> atEvenSteps(const std::vector<PathPlace>& driven, const std::vector<double>& way) {
        const int steps = std::clamp(static_cast<int>(way.back() / kLeastStep_m), 1, kMostSteps);
        std::vector<PathPlace> places;
        places.reserve(static_cast<std::size_t>(steps) + 1);
        for (int i = 0; i <= steps; ++i) {
            const double at = way.back() * i / steps;
            const auto after = std::lower_bound(way.begin() + 1, way.end() - 1, at);
            const auto next = static_cast<std::size_t>(after - way.begin());
            const double span = way[next] - way[next - 1];
            const double share = span > 0 ? std::clamp((at - way[next - 1]) / span, 0.0, 1.0) : 0;
            const PathPlace& a = driven[next - 1];
            const PathPlace& b = driven[next];
            places.push_back({a.at + (b.at - a.at) * share, a.speed + (b.speed - a.speed) * share,
                              a.by_place + (b.by_place - a.by_place) * share});
        }
        return places;
    }

    static void setBounds(DrivenPath& path) {
        cv::Point2d least = path.places.front().at;
        cv::Point2d most = least;
        double by_place = path.places.front().by_place;
        for (const PathPlace& place : path.places) {
            least = {std::min(least.x, place.at.x), std::min(least.y, place.at.y)};
            most = {std::max(most.x, place.at.x), std::max(most.y, place.at.y)};
            by_place = std::min(by_place, place.by_place);
        }
        const double margin = kFarthest * kLane_m / std::max(by_place, 1e-6);
        path.bounds = cv::Rect2d(least - cv::Point2d(margin, margin), most + cv::Point2d(margin, margin));
    }

    const StoredTracks& run_;
    const GroundStretches& ground_;
    double unit_;
};

/// Where a path comes nearest to a place.
struct NearestPlace {
    double distance = 0;    ///< on the ground
    cv::Point2d direction;  ///< of length 1
    double speed = 0;
};

/// Nothing for a place before the path's beginning or behind its end.
std::optional<NearestPlace> nearestOn(const DrivenPath& path, cv::Point2d place) {
    double least = std::numeric_limits<double>::max();
    std::size_t segment = 0;
    double share = 0;
    for (std::size_t i = 0; i + 1 < path.places.size(); ++i) {
        const cv::Point2d from = path.places[i].at;
        const cv::Point2d along = path.places[i + 1].at - from;
        const double t = along.dot(place - from) / std::max(along.dot(along), 1e-12);
        const cv::Point2d off = place - from - along * std::clamp(t, 0.0, 1.0);
        const double square = off.dot(off);
        if (square >= least) continue;
        least = square;
        segment = i;
        share = t;
    }
    const bool before = segment == 0 && share < 0;
    const bool behind = segment + 2 == path.places.size() && share > 1;
    if (before || behind) return std::nullopt;
    const PathPlace& a = path.places[segment];
    const PathPlace& b = path.places[segment + 1];
    const cv::Point2d along = b.at - a.at;
    return NearestPlace{std::sqrt(least), along * (1 / std::max(cv::norm(along), 1e-6)),
                        a.speed + (b.speed - a.speed) * std::clamp(share, 0.0, 1.0)};
}

/// What is summed up over the stretches that two tracks drove beside each other, seen from either.
struct CommonWay {
    double way = 0;
    double agreement = 0;  ///< times way
    double speed = 0;      ///< likeness of speeds, times that

    void add(const DrivenPath& path, const DrivenPath& other) {
        const double step = path.step();
        for (std::size_t i = 0; i < path.places.size(); ++i) {
            const PathPlace& place = path.places[i];
            const auto nearest = nearestOn(other, place.at);
            if (!nearest) continue;
            const cv::Point2d along = path.places[std::min(i + 1, path.places.size() - 1)].at -
                                      path.places[i + 1 < path.places.size() ? i : i - 1].at;
            const double cosine = along.dot(nearest->direction) / std::max(cv::norm(along), 1e-6);
            const double closeness = bell(nearest->distance * place.by_place / kLane_m) * std::max(0.0, cosine);
            way += step;
            agreement += closeness * step;
            speed += closeness * step * speedLikeness(place.speed, nearest->speed);
        }
    }
};

TrackLikeness likenessOf(const LikenessFacts& chosen, const LikenessFacts& other) {
    TrackLikeness found;
    found.size = sizeLikeness(chosen, other);
    found.speed = speedLikeness(chosen.speed(), other.speed());
    CommonWay common;
    for (const auto& [stretch, path] : chosen.paths) {
        const auto there = other.paths.find(stretch);
        if (there == other.paths.end() || (path.bounds & there->second.bounds).empty()) continue;
        if (!chosen.drives() && !other.drives()) {
            const PathPlace& a = path.places.front();
            const double apart = cv::norm(a.at - there->second.places.front().at) * a.by_place;
            found.path = std::max(found.path, bell(apart / kLane_m));
        } else if (path.drives() && there->second.drives()) {
            common.add(path, there->second);
            common.add(there->second, path);
        }
    }
    if (common.way > 0) {
        const double share = std::min(1.0, common.way / 2 / std::max(chosen.way, other.way));
        found.path = common.agreement / common.way * std::pow(share, kPartialWayPower);
    }
    if (common.agreement > 0) found.speed = common.speed / common.agreement;
    return found;
}

/// Metres of a metre of the run's scale: 1, or what makes the median vehicle as long as usual.
double unitOf(const StoredTracks& run, const GroundStretches& ground) {
    if (hasMetricLimits(run.footage.scale)) return 1;
    std::vector<double> lengths;
    for (const EventTrack& track : run.tracks) {
        const TrackedBox& middle = track.boxes[track.boxes.size() / 2];
        if (ground.of(middle.frame) != nullptr)
            lengths.push_back(ground.toGround(middle.frame, middle.box).length *
                              ground.metresByPlace(middle.frame, middle.box.centre));
    }
    const double median = medianOrNone(std::move(lengths));
    return median > 0 ? kCarLength_m / median : 1;
}

}  // namespace

LikenessChoice LikenessChoice::named(const std::vector<std::string>& names) {
    LikenessChoice counts{false, false, false, false};
    for (const std::string& name : names) {
        const auto* part = std::find_if(kLikenessParts.begin(), kLikenessParts.end(),
                                        [&](const LikenessPart& each) { return name == each.name; });
        if (part == kLikenessParts.end())
            throw Error(ErrorKind::parameter,
                        "there is no likeness by \"" + name + "\"; there are: path, speed, size, looks");
        counts.*(part->counts) = true;
    }
    if (!counts.any())
        throw Error(ErrorKind::parameter, "something has to count for likeness: path, speed, size, looks");
    return counts;
}

std::vector<std::string> LikenessChoice::names() const {
    std::vector<std::string> names;
    for (const LikenessPart& each : kLikenessParts)
        if (this->*(each.counts)) names.emplace_back(each.name);
    return names;
}

void orderBy(const LikenessChoice& counts, std::vector<TrackLikeness>& found) {
    for (TrackLikeness& each : found) each.likeness = likenessBy(each, counts);
    std::stable_sort(found.begin(), found.end(), [](const TrackLikeness& a, const TrackLikeness& b) {
        return std::tuple(-a.likeness, -a.speed * a.size, a.track) <
               std::tuple(-b.likeness, -b.speed * b.size, b.track);
    });
}

double likenessBy(const TrackLikeness& parts, const LikenessChoice& counts) {
    double product = 1;
    double weights = 0;
    const auto take = [&](bool counted, double value, double weight) {
        if (!counted) return;
        product *= std::pow(value, weight);
        weights += weight;
    };
    take(counts.path, parts.path, 2);
    take(counts.speed, parts.speed, 1);
    take(counts.size, parts.size, 1);
    take(counts.looks && parts.looks, parts.looks.value_or(0), 2);
    return weights > 0 ? std::pow(product, 1 / weights) : 0;
}

void compareLooks(std::vector<TrackLikeness>& found, const LooksByTrack& looks, TrackId chosen) {
    const auto mine = looks.find(chosen);
    if (mine == looks.end()) return;
    for (TrackLikeness& each : found) {
        const auto other = looks.find(each.track);
        if (other != looks.end()) each.looks = lookLikeness(mine->second, other->second);
    }
}

std::vector<TrackLikeness> tracksLike(const StoredTracks& run, const GroundStretches& ground, TrackId chosen,
                                      const EventOptions& options) {
    const bool is_there =
        std::any_of(run.tracks.begin(), run.tracks.end(), [&](const EventTrack& each) { return each.id == chosen; });
    if (!is_there) throw Error(ErrorKind::parameter, "the run's result has no track " + std::to_string(chosen));
    const PathMaker maker(run, ground, unitOf(run, ground));
    std::map<TrackId, LikenessFacts> facts;
    for (const EventTrack& track : run.tracks) maker.addSize(track, facts[track.id]);
    for (const GroundPath& path : groundPaths(run.tracks, ground, options)) maker.add(path, facts[path.id()]);
    std::vector<TrackLikeness> found;
    for (const auto& [id, of_track] : facts) {
        if (id == chosen) continue;
        found.push_back(likenessOf(facts.at(chosen), of_track));
        found.back().track = id;
    }
    orderBy({}, found);
    return found;
}

}  // namespace eyrie
