#pragma once

#include <QObject>
#include <QPointF>
#include <QString>
#include <memory>
#include <optional>
#include <vector>

#include "georeference/video_world.h"
#include "session/background/background_query.h"
#include "session/project_session.h"
#include "widgets/clock_of_frames.h"

namespace eyrie {
struct StoredTracks;
}

namespace eyrie::ui {

/// When and where on the earth the video that is shown was taken: by what its metadata say, steadied by the
/// registration of the run shown, or by the control points of its project. Read and worked out in the background; the
/// video never waits for it.
class VideoEarth : public QObject {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit VideoEarth(ProjectSession& session, QObject* parent = nullptr);
    ~VideoEarth() override;

    /// The run shown; null: none, or not read yet.
    void setRun(const std::shared_ptr<const StoredTracks>& run);

    /// The metadata of the video, or why it has none; null until they were read.
    const std::shared_ptr<const FoundMetadata>& metadata() const { return found_; }
    /// How much of the video was looked through for them, 0 … 1.
    double readShare() const { return read_share_; }
    /// What a stream of metadata says of a frame, by itself; nothing for a frame that is none.
    std::optional<MetadataState> stateOf(const VideoMetadata& stream, FrameIndex frame) const;

    /// When a frame was taken, for people: "2026-11-21 08:00:00.000 UTC"; empty where nobody knows.
    QString clockText(FrameIndex frame) const;
    /// What that rests on.
    QString clockOrigin() const { return QString::fromStdString(clock_.origin()); }
    /// These, for whoever shows them beside frames. To be used as long as this object lives.
    ClockOfFrames clock() const;
    /// ClockOfFrames::frame_of_day.
    std::optional<FrameIndex> frameOfDay(double seconds, double near) const;
    /// µs since 1970-01-01 at a moment of the video; nothing where nobody knows.
    std::optional<std::int64_t> utcAt(std::int64_t video_us) const { return clock_.at(video_us); }
    /// When the video began, as a person said and the project keeps it.
    std::optional<std::int64_t> givenStart() const { return given_start_us_; }

    /// The place under a pixel; nothing where nobody knows.
    std::optional<GeoPoint> placeOf(FrameIndex frame, QPointF px) const;
    /// The direction of north in the middle of a frame, degrees clockwise from +x.
    std::optional<double> northOf(FrameIndex frame) const;
    /// Where something at a pixel points to that has this heading (radians clockwise from +x): degrees clockwise from
    /// north, in [0, 360).
    std::optional<double> courseOf(FrameIndex frame, QPointF px, double heading) const;
    /// What a person found on the earth in this video, as it is stored; counts before the metadata.
    const std::vector<ControlPoint>& control() const { return control_; }
    /// What is known of the places; null until that was worked out.
    const VideoWorld* world() const { return world_.get(); }
    /// A pixel of one frame as another shows the same ground; nothing where the run does not connect them.
    std::optional<QPointF> carried(QPointF px, FrameIndex from, FrameIndex to) const;
    /// What places rest on, and how well that agrees; empty where there are none.
    QString origin() const;
    /// Reads again what a person said of the video, its start and control points, and works out the places anew.
    void layOnEarth();

 signals:
    /// The metadata were read, or are those of another video; or places are others.
    void changed();
    /// clock() tells other times than before, or tells some now, or none any more.
    void clockChanged();
    /// Some more of the video was looked through.
    void readOn();

 private:
    void readMetadata();
    void adopt(FoundMetadata found);
    void setClock();
    std::optional<std::int64_t> momentOf(FrameIndex frame) const;
    const GroundView* viewOf(FrameIndex frame) const;

    ProjectSession& session_;
    std::shared_ptr<const StoredTracks> run_;
    std::shared_ptr<const FoundMetadata> found_;
    double read_share_ = 0;
    std::optional<std::int64_t> given_start_us_;
    VideoClock clock_;
    std::vector<ControlPoint> control_;
    std::shared_ptr<const VideoWorld> world_;  ///< asked on this object's thread alone
    mutable FrameIndex viewed_ = -1;           ///< frame of `view_`
    mutable GroundView view_;
    BackgroundQuery metadata_query_;
    BackgroundQuery world_query_;  ///< last: both stop before the rest goes
};

}  // namespace eyrie::ui
