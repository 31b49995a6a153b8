#pragma once

#include <cstddef>
#include <map>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "tracking/finishing/track_finishing.h"
#include "tracking/finishing/track_paths.h"
#include "tracking/ground_motion.h"
#include "tracking/silhouettes/extent_grid.h"
#include "tracking/silhouettes/silhouette_grid.h"

namespace eyrie {

/// What a track's box shows in one picture against the same ground without it.
struct SilhouetteLook {
    TrackId track = 0;
    bool sure = true;  ///< its track is surely a vehicle by its score
    FrameIndex frame = 0;
    OrientedBox box;                       ///< of its state
    double shaded = 0;                     ///< share of the box in which it is as a shadow on the ground would be
    double beam = 0;                       ///< share of its length that is lit ground ahead of its lamps
    double darkness = 0;                   ///< of the picture, see darknessOf
    std::optional<Silhouette> silhouette;  ///< of its vehicle, where one stands out by itself
    std::optional<VehicleExtent> extent;   ///< of its vehicle, of which the box may hold a part; not at night
};

/// By track: the median of what its looks say of it, of those that were looked at so often at least.
std::map<TrackId, double> usualByTrack(const std::vector<SilhouetteLook>& looks, double SilhouetteLook::*figure,
                                       std::size_t fewest_looks);

/// Looks at what tracks follow, surely vehicles or not, each at some moments of its life spread over it, beside
/// pictures from before and after in which no track covers the ground there. It is shown each picture that it needs
/// once, in ascending order, and keeps of them what it compares only.
class SilhouetteSearch {
 public:
    SilhouetteSearch(const std::vector<TrackPath>& paths, const GroundMotion& ground, const SceneScale& scale);

    /// Shows it a picture, CV_8UC1; an empty one shows nothing. Of frames that it does not need nothing is taken.
    void show(FrameIndex frame, const cv::Mat& gray);
    /// Reads all pictures that it needs before a frame and was not shown.
    void readUpTo(FrameIndex frame, const GrayOfFrame& gray_at);
    /// Reads what is missing. All looks, in the order in which their last pictures came.
    std::vector<SilhouetteLook> finish(const GrayOfFrame& gray_at);

 private:
    /// A picture of the same ground without the vehicle's box.
    struct Ground {
        FrameIndex frame = 0;
        cv::Matx33d way;    ///< from the picture with the vehicle
        bool near = false;  ///< among the nearest ones, with which the box is compared …
        bool far = false;   ///< … and those that the vehicle is so far from that no part of it is there
    };
    /// A look of which not all pictures have come.
    struct Planned {
        SilhouetteLook look;
        SilhouetteGrid grid;
        ExtentGrid extents;
        std::vector<Ground> grounds = {};
        FrameIndex last = 0;  ///< the last picture of all
        cv::Mat vehicle = {};
        std::vector<cv::Mat> seen = {};
        ExtentGrid::Sample vehicle_about = {};
        std::vector<ExtentGrid::Sample> near_seen = {};
        std::vector<ExtentGrid::Sample> far_seen = {};
    };
    /// A box of a track in some frame.
    struct TrackBox {
        TrackId track = 0;
        float score = 0;
        PathBox box;
    };
    class Plan;

    void take(Planned& planned, FrameIndex frame, const cv::Mat& gray, const std::vector<TrackBox>& boxes,
              double darkness);
    void look(Planned& planned);
    /// Whether a track may be of the vehicle of another.
    bool mayBePart(TrackId vehicle, TrackId track) const;

    PartsByTrack parts_;  ///< tracks that may be of the same vehicle, as they were before anything was made of looks
    std::vector<Planned> planned_;
    std::map<FrameIndex, std::vector<std::size_t>> wanting_;  ///< looks, by the pictures that have not come
    /// What tracks cover there, as they were before anything was made of looks.
    std::map<FrameIndex, std::vector<TrackBox>> boxes_;
    std::vector<SilhouetteLook> looks_;
};

}  // namespace eyrie
