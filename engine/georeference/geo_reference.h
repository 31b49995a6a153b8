#pragma once

#include <functional>
#include <map>
#include <opencv2/core/matx.hpp>
#include <optional>
#include <string>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "core/geometry/control_point.h"
#include "core/geometry/local_plane.h"
#include "georeference/control_fit.h"
#include "metadata/ground_view.h"

namespace eyrie {

/// The frames of a video that are to be laid on the earth.
struct GeoFootage {
    cv::Size image_size;  ///< px
    FrameIndex first_frame = 0;
    FrameIndex last_frame = -1;  ///< included
    double frame_rate_hz = 25;
    std::function<std::int64_t(FrameIndex)> time_us;  ///< µs from the beginning of the video
    CameraMotion camera;                              ///< how a run registered them
    std::vector<ControlPoint> control{};              ///< what a person found; counts more than the metadata
};

/// Where pixels of a video lie on the earth, by the metadata of the camera and the stored registration together.
/// Metadata say it for each frame, but with angles and positions that jitter, and not in every frame; the registration
/// says how frames lie on each other, to a pixel. So the corners of a frame are where the median of the statements of
/// half-second steps within five seconds puts them, each carried over by the registration. The ground is taken for a
/// plane. Used by one thread at a time.
class GeoReference {
 public:
    /// Knows no place.
    GeoReference() = default;
    GeoReference(const MetadataTimeline& timeline, GeoFootage footage);
    /// By the control points of the footage, carried over by the registration as far as that connects frames. `why_not`
    /// tells of points that say nothing.
    static GeoReference byControl(GeoFootage footage, std::vector<std::string>* why_not = nullptr);

    /// Whether any frame has a place.
    bool known() const { return !views_.empty(); }
    /// Whether that is by control points of a person.
    bool isByHand() const { return !control_fits_.empty(); }
    /// What the control points say that it rests on.
    const std::vector<ControlFit>& controlFits() const { return control_fits_; }
    /// What most statements rest on.
    GroundSource source() const { return source_; }
    /// How far statements two seconds apart place the same ground apart, as the registration finds it again: median, m.
    /// Nothing where no two can be compared. Stated places are not better than that.
    std::optional<double> disagreement_m() const { return disagreement_m_; }
    /// Whether that is more than a twentieth of the picture's diagonal: then registration and metadata contradict each
    /// other, and places of different moments cannot be compared.
    bool doubtful() const { return doubtful_; }
    /// For people: where places come from and how well they agree.
    std::string origin() const;
    /// The place under a pixel; nothing where no statement is near, or for a pixel beyond the horizon.
    std::optional<GeoPoint> placeOf(FrameIndex frame, cv::Point2d px) const;
    /// The same in metres east and north of a point of the video's own, for distances and directions.
    std::optional<cv::Point2d> metresOf(FrameIndex frame, cv::Point2d px) const;
    /// The direction of north in the middle of a frame, degrees in [0, 360) clockwise from +x; nothing where its place
    /// is not known.
    std::optional<double> northOf(FrameIndex frame) const;
    /// Where the top of the picture points to there, degrees in [0, 360) clockwise from north.
    std::optional<double> courseOf(FrameIndex frame) const;
    /// Metres per pixel there: the geometric mean of both axes.
    std::optional<double> gsdOf(FrameIndex frame) const;
    /// Height of the ground in the middle of a frame, m: above the ellipsoid where `ellipsoid`, else above the sea.
    struct Elevation {
        double metres = 0;
        bool ellipsoid = false;
    };
    std::optional<Elevation> elevationOf(FrameIndex frame) const;

 private:
    /// What the metadata say of one frame.
    struct Statement {
        cv::Matx33d plane_from_image;  ///< of `plane_`
        std::optional<Elevation> elevation;
    };
    std::optional<cv::Matx33d> mapOf(FrameIndex frame) const;
    /// Metres east and north per pixel of x and y in the middle of a frame.
    std::optional<cv::Matx22d> metresPerPixel(FrameIndex frame) const;
    const Statement* nearest(FrameIndex frame) const;
    void measureDisagreement();

    GeoFootage footage_;
    LocalPlane plane_;
    int reach_ = 0;                          ///< frames
    std::map<FrameIndex, Statement> views_;  ///< every half second
    GroundSource source_ = GroundSource::none;
    std::vector<ControlFit> control_fits_;  ///< that it rests on; none: it rests on metadata
    std::optional<double> disagreement_m_;
    bool doubtful_ = false;
    mutable FrameIndex mapped_frame_ = -1;
    mutable std::optional<cv::Matx33d> mapped_;
};

}  // namespace eyrie
