#pragma once

#include <memory>
#include <vector>

#include "core/values/scene_scale.h"
#include "review/tracks/track_filter.h"
#include "store/runs/run_store.h"
#include "widgets/clock_of_frames.h"
#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// Whether a person said that a track is of nothing that drives.
inline bool isRejected(const TrackSummary& track) {
    return track.corrected == CorrectionKind::reject;
}

/// The tracks of a run, one row each, ascending id; those that a person rejected are grey. Metres and km/h when the GSD
/// is known, pixels otherwise.
class TracksModel : public RecordModel<TrackSummary> {
    Q_OBJECT
 public:
    enum Column {
        id_column,
        first_column,
        last_column,
        life_column,
        speed_column,
        length_column,
        width_column,
        status_column,
        score_column,
        class_column,
        like_column,    ///< empty unless setLikeness()
        lowest_column,  ///< empty until setDoings(), as the next
        highest_column,
        stood_column,
        picture_column,  ///< PictureColumn paints it
        column_count
    };

    explicit TracksModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setTracks(std::vector<TrackSummary> tracks, const SceneScale& scale);
    /// Tracks that the run left out have rows from this score on: of an hour there may be many times as many as of the
    /// result, and nobody sees them until they are asked for. At first all have.
    void setLeastScore(double score);
    /// How like the tracks are to one of them; null: nobody asked, or it is not known yet.
    void setLikeness(std::shared_ptr<const LikenessByTrack> likeness);
    /// What the tracks did, for how fast they were and how long they stood; null while nobody knows.
    void setDoings(std::shared_ptr<const DoingsByTrack> doings);
    /// Times of the day instead of numbers of frames, where they are known. To be given again when they are others.
    void setClock(ClockOfFrames clock);
    const ClockOfFrames& clock() const { return clock_; }
    const SceneScale& scale() const { return scale_; }

    /// Those that have a row, ascending id.
    const std::vector<TrackSummary>& tracks() const { return records(); }

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
    QString textOf(const TrackSummary& track, int column) const;
    QString tipOf(const TrackSummary& track) const;
    /// What a column holds, for its title's tooltip.
    QString helpOf(int column) const;
    /// In the unit shown; nothing where it is not known.
    std::optional<double> extremeOf(const TrackSummary& track, int column) const;
    /// For how long it stood; nothing where that is not known.
    std::optional<double> stoodSecondsOf(const TrackSummary& track) const;
    QVariant sortValueOf(const TrackSummary& track, int column) const;
    double secondsOf(const TrackSummary& track) const;
    /// What has a row.
    std::vector<TrackSummary> given() const;

    std::vector<TrackSummary> all_;
    double least_score_ = 0;
    SceneScale scale_;
    std::shared_ptr<const LikenessByTrack> likeness_;
    std::shared_ptr<const DoingsByTrack> doings_;
    ClockOfFrames clock_;
};

}  // namespace eyrie::ui
