#include "review/tracks/tracks_model.h"

#include <QGuiApplication>
#include <algorithm>
#include <iterator>
#include <utility>

#include "store/runs/track_scale.h"
#include "widgets/display_text.h"
#include "widgets/tables/table_roles.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

void TracksModel::setTracks(std::vector<TrackSummary> tracks, const SceneScale& scale) {
    const bool other_units = scale.gsd_known != scale_.gsd_known;
    scale_ = scale;
    all_ = std::move(tracks);
    replaceRecords(given());
    if (other_units) emit headerDataChanged(Qt::Horizontal, 0, column_count - 1);
}

void TracksModel::setLeastScore(double score) {
    const double before = std::exchange(least_score_, score);
    const double lower = std::min(before, score), higher = std::max(before, score);
    const bool any_between = std::any_of(all_.begin(), all_.end(), [&](const TrackSummary& track) {
        return track.doubtful && track.score >= lower && track.score < higher;
    });
    if (any_between) mergeRecords(given());
}

std::vector<TrackSummary> TracksModel::given() const {
    std::vector<TrackSummary> tracks;
    std::copy_if(all_.begin(), all_.end(), std::back_inserter(tracks),
                 [this](const TrackSummary& track) { return !track.doubtful || track.score >= least_score_; });
    return tracks;
}

void TracksModel::setLikeness(std::shared_ptr<const LikenessByTrack> likeness) {
    if (likeness_ == likeness) return;
    likeness_ = std::move(likeness);
    if (rowCount() > 0) emit dataChanged(index(0, like_column), index(rowCount() - 1, like_column));
}

void TracksModel::setDoings(std::shared_ptr<const DoingsByTrack> doings) {
    if (doings_ == doings) return;
    doings_ = std::move(doings);
    if (rowCount() > 0) emit dataChanged(index(0, lowest_column), index(rowCount() - 1, stood_column));
}

std::optional<double> TracksModel::extremeOf(const TrackSummary& track, int column) const {
    return valueOf(track, column == lowest_column ? TrackQuality::lowest : TrackQuality::highest, scale_,
                   doingsIn(doings_.get(), track.id));
}

std::optional<double> TracksModel::stoodSecondsOf(const TrackSummary& track) const {
    const TrackDoings& did = doingsIn(doings_.get(), track.id);
    // Of one that was followed too shortly nobody knows whether it stood.
    if (did.standing.empty() && !did.speeds) return std::nullopt;
    return scale_.frame_rate_hz > 0 ? std::optional(framesStood(did) / scale_.frame_rate_hz) : std::nullopt;
}

void TracksModel::setClock(ClockOfFrames clock) {
    clock_ = std::move(clock);
    tellClockChanged(*this, first_column, last_column);
}

QString TracksModel::tipOf(const TrackSummary& track) const {
    const QString tip = tr("Track %1%2: frames %3 to %4, %5 states. Click to go to its first frame.")
                            .arg(QString::number(track.id),
                                 track.corrected ? QStringLiteral(" (%1)").arg(shownName(*track.corrected)) : QString())
                            .arg(track.first_frame)
                            .arg(track.last_frame)
                            .arg(track.frames);
    const QString first = clock_.text(track.first_frame), last = clock_.text(track.last_frame);
    return first.isEmpty() || last.isEmpty() ? tip : tip + QLatin1Char('\n') + tr("%1 to %2").arg(first, last);
}

double TracksModel::secondsOf(const TrackSummary& track) const {
    const int frames = track.last_frame - track.first_frame + 1;
    return scale_.frame_rate_hz > 0 ? frames / scale_.frame_rate_hz : 0;
}

QVariant TracksModel::data(const QModelIndex& index, int role) const {
    const TrackSummary* track = recordAt(index.row());
    if (track == nullptr || !index.isValid()) return {};
    switch (role) {
        case Qt::DisplayRole:
            return textOf(*track, index.column());
        case Qt::ToolTipRole:
            return tipOf(*track);
        case Qt::ForegroundRole:
            return isRejected(*track) ? QVariant(quietText(QGuiApplication::palette())) : QVariant();
        case Qt::TextAlignmentRole:
            if (index.column() == status_column || index.column() == class_column) return {};
            return QVariant(Qt::AlignRight | Qt::AlignVCenter);
        case sort_role:
            return sortValueOf(*track, index.column());
        case id_role:
            return track->id;
        default:
            return {};
    }
}

QString TracksModel::textOf(const TrackSummary& track, int column) const {
    switch (column) {
        case id_column:
            return QString::number(track.id);
        case first_column:
            return clock_.timeOr(track.first_frame, QString::number(track.first_frame));
        case last_column:
            return clock_.timeOr(track.last_frame, QString::number(track.last_frame));
        case life_column:
            return numberText(secondsOf(track), 1);
        case speed_column:
            return numberText(shownSpeed(track.mean_speed_px, scaleOf(track, scale_)), scale_.gsd_known ? 1 : 2);
        case length_column:
            return numberText(shownLength(track.mean_length_px, scaleOf(track, scale_)), 1);
        case width_column:
            return numberText(shownLength(track.mean_width_px, scaleOf(track, scale_)), 1);
        case status_column:
            if (track.corrected) return shownName(*track.corrected);
            return track.doubtful ? tr("left out") : track.confirmed ? tr("confirmed") : tr("tentative");
        case score_column:
            return numberText(track.score, 2);
        case class_column:
            return shownName(track.track_class);
        case like_column:
            return likeness_ ? numberText(likeness_->of(track.id), 2) : QString();
        case lowest_column:
        case highest_column: {
            const auto speed = extremeOf(track, column);
            return speed ? numberText(*speed, scale_.gsd_known ? 1 : 2) : QString();
        }
        case stood_column: {
            const auto seconds = stoodSecondsOf(track);
            return seconds ? numberText(*seconds, 1) : QString();
        }
        default:
            return {};
    }
}

QVariant TracksModel::sortValueOf(const TrackSummary& track, int column) const {
    switch (column) {
        case id_column:
            return track.id;
        case first_column:
            return track.first_frame;
        case last_column:
            return track.last_frame;
        case life_column:
            return track.last_frame - track.first_frame;
        // As they are shown: in an oblique view the same number of px is more in the distance.
        case speed_column:
            return shownSpeed(track.mean_speed_px, scaleOf(track, scale_));
        case length_column:
            return shownLength(track.mean_length_px, scaleOf(track, scale_));
        case width_column:
            return shownLength(track.mean_width_px, scaleOf(track, scale_));
        case score_column:
            return track.score;
        case like_column:
            // Before those that are as like as can be, the one that they are like.
            return !likeness_ ? 0.0 : track.id == likeness_->chosen ? 2.0 : likeness_->of(track.id);
        case lowest_column:
        case highest_column:
            return extremeOf(track, column).value_or(-1);
        case stood_column:
            return stoodSecondsOf(track).value_or(-1);
        case picture_column:
            return track.id;
        default:
            return textOf(track, column);
    }
}

QString TracksModel::helpOf(int column) const {
    switch (column) {
        case id_column:
            return tr("Number of the track");
        case first_column:
            return clock_.known() ? tr("When it was first seen, by %1").arg(clock_.origin()) : tr("First frame");
        case last_column:
            return clock_.known() ? tr("When it was last seen, by %1").arg(clock_.origin()) : tr("Last frame");
        case life_column:
            return tr("From first to last frame, in seconds");
        case speed_column:
            return tr("Mean speed over the ground, in %1").arg(speedUnit(scale_));
        case length_column:
            return tr("Mean length, in %1").arg(lengthUnit(scale_));
        case width_column:
            return tr("Mean width, in %1").arg(lengthUnit(scale_));
        case status_column:
            return tr(
                "Confirmed: relied on. Tentative: too new to be relied on, and not part of the result. By hand, "
                "joined, split: what a person made of it. Rejected: left out of everything but this list");
        case score_column:
            return tr("Probability that the track is a moving vehicle, from 0 to 1");
        case class_column:
            return tr(
                "What the track is, by its mean size and speed over the ground (classes.*); a dash where they do not "
                "decide it");
        case like_column:
            return tr("Likeness to the chosen track, from 0 to 1, in what its chip says that counts");
        case lowest_column:
            return tr("Lowest speed over the ground, in %1, as events measure it: 0 where it stands; empty until "
                      "events "
                      "are found, and for tracks followed too shortly to tell")
                .arg(speedUnit(scale_));
        case highest_column:
            return tr("Highest speed over the ground, in %1, as events measure it; empty until events are found, and "
                      "for tracks followed too shortly to tell")
                .arg(speedUnit(scale_));
        case stood_column:
            return tr(
                "For how long it stood, in seconds, as the events stops, starts and stands tell; empty until "
                "events are found, and for tracks followed too shortly to tell");
        case picture_column:
            return tr(
                "The vehicle in the middle of its life, heading to the right; none of tracks that are not part "
                "of the result");
        default:
            return {};
    }
}

QVariant TracksModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation == Qt::Horizontal && role == Qt::ToolTipRole) return helpOf(section);
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) {
        return RecordModel::headerData(section, orientation, role);
    }
    switch (section) {
        case id_column:
            return tr("Id");
        case first_column:
            return clock_.known() ? tr("First (UTC)") : tr("First");
        case last_column:
            return clock_.known() ? tr("Last (UTC)") : tr("Last");
        case life_column:
            return tr("Life (s)");
        case speed_column:
            return tr("Speed (%1)").arg(speedUnit(scale_));
        case length_column:
            return tr("Length (%1)").arg(lengthUnit(scale_));
        case width_column:
            return tr("Width (%1)").arg(lengthUnit(scale_));
        case status_column:
            return tr("Status");
        case score_column:
            return tr("Score");
        case class_column:
            return tr("Class");
        case like_column:
            return tr("Like");
        case lowest_column:
            return tr("Lowest (%1)").arg(speedUnit(scale_));
        case highest_column:
            return tr("Highest (%1)").arg(speedUnit(scale_));
        case stood_column:
            return tr("Stood (s)");
        case picture_column:
            return tr("Picture");
        default:
            return {};
    }
}

}  // namespace eyrie::ui

#include "moc_tracks_model.cpp"
