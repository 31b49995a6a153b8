#pragma once

#include <QString>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "review/events/found_events.h"
#include "widgets/clock_of_frames.h"
#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// An event, or a stretch that could not be searched, with what is said about it. Each is a row, but for events of the
/// same stop of which the same is said: the first of them has a row for all.
struct EventEntry {
    int id = 0;                ///< the same event keeps it when thresholds change, and while a live run goes on
    std::size_t position = 0;  ///< in the queue
    Judgement judgement = Judgement::open;
    bool starred = false;
    QString note;
    QString person;                             ///< who said it last; empty: nobody, or nobody knows
    std::string judged_utc;                     ///< and when, ISO 8601
    QString tags;                               ///< "gate 3, lorry"
    std::vector<std::size_t> others = {};       ///< places in the queue of events that stand in its row, too
    std::optional<std::size_t> in_row_of = {};  ///< the place of the event in whose row it stands; nothing: its own
};

/// The events of a run in the order of the queue, one row each. Texts are made when they are shown.
class EventsModel : public RecordModel<EventEntry> {
    Q_OBJECT

 public:
    enum Column {
        number_column,
        time_column,
        kind_column,
        tracks_column,
        figure_column,
        verdict_column,
        note_column,
        duration_column,
        lowest_column,
        highest_column,
        picture_column,  ///< PictureColumn paints it
        tags_column,
        column_count
    };

    explicit EventsModel(QObject* parent = nullptr) : RecordModel(parent) {}

    /// Other events; null for none. `verdict_at` answers what is said about each, null for nothing.
    void setEvents(const std::shared_ptr<const FoundEvents>& found,
                   const std::function<const Verdict*(std::size_t)>& verdict_at);
    /// What is said about one event.
    void setVerdict(std::size_t position, const Verdict* verdict);
    /// Who tells which events are listed, so that none that is stands in a row of one that is not; to be followed by
    /// joinStops() whenever that changes.
    void setListed(std::function<bool(const EventEntry&)> is_listed) { is_listed_ = std::move(is_listed); }
    /// Puts events of one stop in one row where the same is said of them. Not done by setVerdict(), so that several may
    /// be judged one after the other.
    void joinStops();
    /// The id of the row in which an event stands.
    int rowIdOf(int id) const;
    /// Times of the day instead of those of the video, where they are known. To be given again when they are others.
    void setClock(ClockOfFrames clock);
    const ClockOfFrames& clock() const { return clock_; }
    /// Icons for a light or a dark ground.
    void setDark(bool dark);
    const std::shared_ptr<const FoundEvents>& found() const { return found_; }
    /// What an entry is, and what was said about it by whom, for tooltips. Of an entry of found().
    QString tipOf(const EventEntry& entry) const;
    /// Ids are forgotten: what comes belongs to another run.
    void forgetIds();

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
    void noteEdited(int id, const QString& note);

 private:
    /// Kind, tracks, first and last frame, and which of those that have the same.
    using EventIdentity = std::tuple<int, std::vector<TrackId>, FrameIndex, FrameIndex, int>;

    /// By position. Takes over those of the list that is shown, see FoundEvents::former.
    std::vector<int> idsOf(const FoundEvents& found);
    void joinStops(std::vector<EventEntry>& entries) const;
    QString textOf(const EventEntry& entry, int column) const;
    /// The longest of what stands in the row.
    std::optional<double> secondsOf(const EventEntry& entry) const;
    QVariant sortValueOf(const EventEntry& entry, int column) const;
    /// Of the run that is listed; the default where none is.
    SceneScale scale() const { return found_ ? found_->run->footage.scale : SceneScale(); }
    std::optional<double> extremeOf(const EventEntry& entry, int column) const;
    /// What a column holds, for its title's tooltip.
    QString helpOf(int column) const;

    std::shared_ptr<const FoundEvents> found_;
    std::map<EventIdentity, int> ids_;
    int next_id_ = 1;
    std::function<bool(const EventEntry&)> is_listed_ = [](const EventEntry&) { return true; };
    bool dark_ = false;
    ClockOfFrames clock_;
};

}  // namespace eyrie::ui
