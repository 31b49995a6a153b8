#include <algorithm>
#include <cmath>
#include <map>

#include "core/robust_statistics.h"
#include "tracking/finishing/shared_frames.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

constexpr double kFixedSeconds = 0.4;     ///< tracks that keep their places to each other for this long …
constexpr double kFixedOfShorter = 0.8;   ///< … and for this share of the shorter one's life …
constexpr double kFixedLoose = 0.15;      ///< m, … scattering no more than this …
constexpr double kFixedLoosePx = 0.2;     ///< px, … and this …
constexpr double kFixedShare = 0.35;      ///< … are one vehicle when they share this share of what is allowed
constexpr int kFewestShared = 5;          ///< frames two tracks must share to be compared
constexpr double kSharedOfShorter = 0.3;  ///< … and this share of the shorter one's life
constexpr double kWidestVehicle = 3.2;    ///< m
constexpr double kPlaceMargin = 1;        ///< px
constexpr double kSureSeconds = 0.4;      ///< a track detected for so long altogether is not doubted
constexpr int kPlacesAlong = 6;           ///< of a box that are looked at …
constexpr int kPlacesAcross = 3;          ///< … which are graphics …
constexpr double kMostlyCovered = 0.5;    ///< … where so many of all are covered
constexpr double kSizeQuantile = 0.75;    ///< boxes miss parts more often than they exceed the vehicle

/// `length`, `width`: limits in m.
bool tooSmall(const TrackPath& path, double length, double width, const SceneScale& scale) {
    std::vector<double> lengths;
    std::vector<double> widths;
    for (const auto& [frame, state] : path.states) {
        const SceneScale here = scale.at(frame, state.box.centre);
        lengths.push_back(here.metres(state.box.length));
        widths.push_back(here.metres(state.box.width));
    }
    return quantileOf(std::move(lengths), kSizeQuantile) < length ||
           quantileOf(std::move(widths), kSizeQuantile) < width;
}

/// How two tracks lie on each other in the frames they share.
struct Sharing {
    int frames = 0;
    double share = 0;           ///< mean
    std::vector<double> ahead;  ///< px, of the one's centre in the axes of the other, one a frame
    std::vector<double> aside;
    int too_wide = 0;  ///< frames in which one was wider than a vehicle: it may hold several
};

/// A box that is wider than a vehicle may hold several: then only boxes of like size share a place.
double sharedBy(const OrientedBox& a, const OrientedBox& b, double widest) {
    const double wider = a.area() >= b.area() ? a.width : b.width;
    return wider > widest ? overlap(a, b) : containment(a, b);
}

double widestIn(const SceneScale& here) {
    return here.px(kWidestVehicle) + kPlaceMargin;
}

Sharing sharingOf(const TrackPath& a, const TrackPath& b, const SceneScale& scale) {
    Sharing sharing;
    forSharedFrames(a, b, [&](FrameIndex frame, const MovingState& one, const MovingState& other) {
        const double widest = widestIn(scale.at(frame, one.box.centre));
        sharing.share += sharedBy(one.box, other.box, widest);
        sharing.too_wide += std::max(one.box.width, other.box.width) > widest;
        const cv::Point2d offset = one.box.toBox(other.box.centre);
        sharing.ahead.push_back(offset.x);
        sharing.aside.push_back(offset.y);
        ++sharing.frames;
    });
    if (sharing.frames > 0) sharing.share /= sharing.frames;
    return sharing;
}

/// Whether the two keep their places to each other as if fixed, for so long that they are parts of one vehicle or it
/// and its shadow.
bool areFixed(const Sharing& sharing, const SceneScale& here) {
    if (2 * sharing.too_wide > sharing.frames || sharing.frames < kFixedSeconds * here.frame_rate_hz) return false;
    const double loose = here.px(kFixedLoose) + kFixedLoosePx;
    return spreadOf(sharing.ahead) <= loose && spreadOf(sharing.aside) <= loose;
}

/// Removes the states of `weaker` that lie on `stronger`.
void giveWay(TrackPath& weaker, const TrackPath& stronger, double allowed, DropList& dropped) {
    std::map<FrameIndex, OrientedBox> taken;
    for (const auto& [frame, state] : stronger.states) taken[frame] = state.box;
    TrackPath given{weaker.id, {}};
    std::erase_if(weaker.states, [&](const TimedPathState& state) {
        const auto there = taken.find(state.first);
        const bool lies_on_it = there != taken.end() && containment(there->second, state.second.box) > allowed;
        if (lies_on_it) given.states.push_back(state);
        return lies_on_it;
    });
    drop(given, TrackDrop::shares_place, dropped, stronger.id);
}

}  // namespace

void dropTooSmall(std::vector<TrackPath>& paths, const FinishingOptions& options, const SceneScale& scale,
                  DropList& dropped) {
    if (!hasMetricLimits(scale)) return;
    const double share = scale.gsd_known ? 1 : kEstimatedShare;
    const double length = share * options.min_length_m;
    const double width = share * options.min_width_m;
    std::erase_if(paths, [&](TrackPath& path) {
        if (!tooSmall(path, length, width, scale)) return false;
        drop(path, TrackDrop::too_small, dropped);
        return true;
    });
}

void dropWiderThanLong(std::vector<TrackPath>& paths, double max_aspect, DropList& dropped) {
    if (max_aspect == 0) return;
    std::erase_if(paths, [&](TrackPath& path) {
        std::vector<double> aspects;
        aspects.reserve(path.states.size());
        for (const auto& [frame, state] : path.states) aspects.push_back(state.box.width / state.box.length);
        if (medianOf(std::move(aspects)) <= max_aspect) return false;
        drop(path, TrackDrop::wider_than_long, dropped);
        return true;
    });
}

void dropGraphics(std::vector<TrackPath>& paths, const PictureMask& graphics, DropList& dropped) {
    if (graphics.empty()) return;
    std::erase_if(paths, [&](TrackPath& path) {
        int looked_at = 0;
        int covered = 0;
        for (const auto& [frame, state] : path.states) {
            if (state.origin != StateOrigin::detected) continue;
            const OrientedBox box = state.box;
            for (int i = 0; i < kPlacesAlong; ++i) {
                for (int j = 0; j < kPlacesAcross; ++j) {
                    const double along = ((i + 0.5) / kPlacesAlong - 0.5) * box.length;
                    const double across = ((j + 0.5) / kPlacesAcross - 0.5) * box.width;
                    covered += graphics.marks(box.toImage({along, across}));
                    ++looked_at;
                }
            }
        }
        if (covered < kMostlyCovered * looked_at || covered == 0) return false;
        drop(path, TrackDrop::on_graphics, dropped);
        return true;
    });
}

void dropHardlyDetected(std::vector<TrackPath>& paths, double min_share, const SceneScale& scale, DropList& dropped) {
    std::erase_if(paths, [&](TrackPath& path) {
        const int detected = path.statesOf(StateOrigin::detected);
        const int supposed = path.statesOf(StateOrigin::reconstructed);
        if (detected >= kSureSeconds * scale.frame_rate_hz || detected >= min_share * (detected + supposed))
            return false;
        drop(path, TrackDrop::hardly_detected, dropped);
        return true;
    });
}

void dropSharers(std::vector<TrackPath>& paths, double max_sharing, const SceneScale& scale, DropList& dropped) {
    if (!(max_sharing < 1)) return;
    std::vector<std::size_t> order(paths.size());
    std::vector<int> strength;
    for (std::size_t i = 0; i < paths.size(); ++i) {
        order[i] = i;
        strength.push_back(paths[i].statesOf(StateOrigin::detected));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return strength[a] > strength[b]; });
    LivingTracks stronger_ones;  // by their place in the order
    for (std::size_t k = 0; k < order.size(); ++k) {
        TrackPath& weaker = paths[order[k]];
        if (weaker.states.empty()) continue;
        for (const std::size_t s : stronger_ones.during(weaker.firstFrame(), weaker.lastFrame())) {
            if (weaker.states.empty()) break;
            const TrackPath& stronger = paths[order[s]];
            const Sharing sharing = sharingOf(stronger, weaker, scale);
            const auto shorter = static_cast<double>(std::min(stronger.states.size(), weaker.states.size()));
            if (sharing.frames < kFewestShared || sharing.frames < kSharedOfShorter * shorter) continue;
            const bool fixed = sharing.frames >= kFixedOfShorter * shorter && areFixed(sharing, scaleOf(weaker, scale));
            if (fixed && sharing.share > kFixedShare * max_sharing) {
                drop(weaker, TrackDrop::shares_place, dropped, stronger.id);
                continue;
            }
            if (sharing.share <= max_sharing) continue;
            const std::size_t before = weaker.states.size();
            giveWay(weaker, stronger, max_sharing / 2, dropped);
            if (2 * weaker.states.size() < before) drop(weaker, TrackDrop::shares_place, dropped, stronger.id);
        }
        if (!weaker.states.empty()) stronger_ones.add(k, weaker.firstFrame(), weaker.lastFrame());
    }
    std::erase_if(paths, [](const TrackPath& path) { return path.states.empty(); });
}

}  // namespace eyrie
