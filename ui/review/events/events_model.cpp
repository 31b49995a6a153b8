#include "review/events/events_model.h"

#include <QStringList>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "review/events/event_kind_marks.h"
#include "review/events/event_text.h"
#include "widgets/display_text.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

namespace {

void takeOver(EventEntry& entry, const Verdict* verdict) {
    entry.judgement = verdict != nullptr ? verdict->judgement : Judgement::open;
    entry.starred = verdict != nullptr && verdict->starred;
    entry.note = verdict != nullptr ? QString::fromStdString(verdict->note) : QString();
    entry.person = verdict != nullptr ? QString::fromStdString(verdict->person) : QString();
    entry.judged_utc = verdict != nullptr ? verdict->when_utc : std::string();
    entry.tags = verdict != nullptr ? QString::fromStdString(tagText(verdict->tags)) : QString();
}

/// Whether nothing would be lost in the row of the other.
bool saysNoMore(const EventEntry& entry, const EventEntry& other) {
    return entry.judgement == other.judgement && !entry.starred && entry.tags.isEmpty() && entry.note.isEmpty();
}

}  // namespace

void EventsModel::setEvents(const std::shared_ptr<const FoundEvents>& found,
                            const std::function<const Verdict*(std::size_t)>& verdict_at) {
    std::vector<EventEntry> entries;
    const std::vector<int> ids = found ? idsOf(*found) : std::vector<int>();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        entries.push_back({ids[i], i, Judgement::open, false, {}, {}, {}, {}, {}, {}});
        takeOver(entries.back(), verdict_at(i));
    }
    const bool known_before = scale().gsd_known;
    found_ = found;
    joinStops(entries);
    mergeRecords(std::move(entries));
    if (scale().gsd_known != known_before) emit headerDataChanged(Qt::Horizontal, lowest_column, highest_column);
}

void EventsModel::setVerdict(std::size_t position, const Verdict* verdict) {
    const int row = static_cast<int>(position);
    if (recordAt(row) == nullptr) return;
    EventEntry entry = *recordAt(row);
    takeOver(entry, verdict);
    changeRecord(row, std::move(entry));
}

void EventsModel::joinStops(std::vector<EventEntry>& entries) const {
    std::map<std::pair<std::size_t, Judgement>, std::size_t> first_of_stop;
    for (EventEntry& entry : entries) {
        entry.others.clear();
        entry.in_row_of.reset();
        const auto stop = found_->stopAt(entry.position);
        if (!stop || !is_listed_(entry)) continue;
        const auto [first, is_new] = first_of_stop.try_emplace({*stop, entry.judgement}, entry.position);
        EventEntry& row = entries[first->second];
        if (is_new || !saysNoMore(entry, row)) continue;
        row.others.push_back(entry.position);
        entry.in_row_of = row.position;
    }
}

void EventsModel::joinStops() {
    if (!found_) return;
    std::vector<EventEntry> joined = records();
    joinStops(joined);
    const auto differs = [this](const EventEntry& entry) {
        const EventEntry& now = *recordAt(static_cast<int>(entry.position));
        return entry.others != now.others || entry.in_row_of != now.in_row_of;
    };
    constexpr std::ptrdiff_t kFew = 64;  // told one by one; more at once
    if (std::count_if(joined.begin(), joined.end(), differs) > kFew) {
        mergeRecords(std::move(joined));
        return;
    }
    for (EventEntry& entry : joined)
        if (differs(entry)) changeRecord(static_cast<int>(entry.position), std::move(entry));
}

int EventsModel::rowIdOf(int id) const {
    const EventEntry* entry = recordAt(rowOf(id));
    return entry != nullptr && entry->in_row_of ? recordAt(static_cast<int>(*entry->in_row_of))->id : id;
}

void EventsModel::setDark(bool dark) {
    if (std::exchange(dark_, dark) == dark || rowCount() == 0) return;
    emit dataChanged(index(0, 0), index(rowCount() - 1, column_count - 1), {Qt::DecorationRole});
}

void EventsModel::setClock(ClockOfFrames clock) {
    clock_ = std::move(clock);
    tellClockChanged(*this, time_column, time_column);
}

void EventsModel::forgetIds() {
    ids_.clear();
}

std::vector<int> EventsModel::idsOf(const FoundEvents& found) {
    std::vector<int> ids(found.queue.size(), 0);
    std::set<int> given;
    const auto give = [&](std::size_t place, int id) {
        if (given.insert(id).second) ids[place] = id;
    };
    // What went on meanwhile, or has other tracks since the run is done, is the same still: what it happened to counts
    // for less, since another may have its number by now.
    const bool follows = found_ && found.former.lock() == found_;
    for (std::size_t i = 0; follows && i < ids.size(); ++i) {
        const auto before = found.place_in_former.at(i);
        const EventEntry* listed = before ? recordAt(static_cast<int>(*before)) : nullptr;
        if (listed != nullptr) give(i, listed->id);
    }
    std::map<EventIdentity, int> doubles;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        const Event* event = found.eventAt(i);
        const FrameSpan frames = found.framesAt(i);
        EventIdentity identity{listedKindAt(found, i), event != nullptr ? event->tracks : std::vector<TrackId>(),
                               frames.first, frames.last, 0};
        std::get<4>(identity) = doubles[identity]++;
        const auto known = ids_.find(identity);
        if (ids[i] == 0 && known != ids_.end()) give(i, known->second);
        if (ids[i] == 0) give(i, next_id_++);
        ids_[std::move(identity)] = ids[i];
    }
    return ids;
}

QVariant EventsModel::data(const QModelIndex& index, int role) const {
    const EventEntry* entry = recordAt(index.row());
    if (entry == nullptr || !index.isValid() || !found_ || entry->position >= found_->queue.size()) return {};
    const int column = index.column();
    switch (role) {
        case Qt::DisplayRole:
            return textOf(*entry, column);
        case Qt::EditRole:
            return column == note_column ? QVariant(entry->note) : QVariant();
        case Qt::ToolTipRole:
            return tipOf(*entry);
        case Qt::DecorationRole:
            if (column != kind_column) return {};
            return judgedKindPlate(entry->judgement, listedKindAt(*found_, entry->position), dark_);
        case Qt::TextAlignmentRole:
            return column == kind_column || column == verdict_column || column == note_column || column == tags_column
                       ? QVariant()
                       : QVariant(Qt::AlignRight | Qt::AlignVCenter);
        case sort_role:
            return sortValueOf(*entry, column);
        case id_role:
            return entry->id;
        default:
            return {};
    }
}

QString EventsModel::tipOf(const EventEntry& entry) const {
    QStringList lines{eventTipText(*found_, entry.position)};
    // The column may be too narrow for all of it.
    if (!entry.others.empty()) lines.prepend(eventRowText(*found_, entry.position, entry.others));
    for (const std::size_t place : entry.others)
        lines << tr("Also in this row: %1").arg(eventTipText(*found_, place).section(QLatin1Char('\n'), 0, 0));
    const QString moment = clock_.text(found_->framesAt(entry.position).first);
    if (!moment.isEmpty()) lines << tr("%1, %2 in the video").arg(moment, eventClockText(*found_, entry.position));
    const QString said = judgedText(entry.judgement, entry.person, entry.judged_utc);
    if (!said.isEmpty()) lines << said;
    // In a narrow list their columns are out of view.
    if (!entry.note.isEmpty()) lines << tr("Note: %1").arg(entry.note);
    if (!entry.tags.isEmpty()) lines << tr("Tags: %1").arg(entry.tags);
    return lines.join(QLatin1Char('\n'));
}

std::optional<double> EventsModel::extremeOf(const EventEntry& entry, int column) const {
    const bool lowest = column == lowest_column;
    const auto speed_at = [&](std::size_t place) {
        return eventSpeed(*found_, place, lowest ? &SpeedRange::lowest : &SpeedRange::highest);
    };
    std::optional<double> extreme = speed_at(entry.position);
    for (const std::size_t place : entry.others) {
        const auto speed = speed_at(place);
        if (speed)
            extreme = lowest ? std::min(*speed, extreme.value_or(*speed)) : std::max(*speed, extreme.value_or(0));
    }
    return extreme;
}

std::optional<double> EventsModel::secondsOf(const EventEntry& entry) const {
    std::optional<double> longest = eventSeconds(*found_, entry.position);
    for (const std::size_t place : entry.others) longest = std::max(longest, eventSeconds(*found_, place));
    return longest;
}

QString EventsModel::textOf(const EventEntry& entry, int column) const {
    switch (column) {
        case number_column:
            return (entry.starred ? QStringLiteral("★ ") : QString()) + eventNumberText(*found_, entry.position);
        case time_column:
            return clock_.timeOr(found_->framesAt(entry.position).first, eventClockText(*found_, entry.position));
        case kind_column:
            return eventRowText(*found_, entry.position, entry.others);
        case tracks_column:
            return eventTracksText(*found_, entry.position);
        case figure_column:
            return eventFigureText(*found_, entry.position);
        case verdict_column:
            return judgementText(entry.judgement);
        case note_column:
            return entry.note;
        case tags_column:
            return entry.tags;
        case duration_column: {
            const auto seconds = secondsOf(entry);
            return seconds ? durationText(*seconds) : QString();
        }
        case lowest_column:
        case highest_column: {
            const auto speed = extremeOf(entry, column);
            return speed ? numberText(*speed, scale().gsd_known ? 1 : 2) : QString();
        }
        default:
            return {};
    }
}

QVariant EventsModel::sortValueOf(const EventEntry& entry, int column) const {
    const Event* event = found_->eventAt(entry.position);
    switch (column) {
        case number_column:
            return found_->numberAt(entry.position).value_or(0);
        case time_column:
            return found_->framesAt(entry.position).first;
        case tracks_column:
            return event != nullptr && !event->tracks.empty() ? event->tracks.front() : 0;
        case figure_column:
            // Figures of different units stand apart.
            return event != nullptr ? static_cast<int>(event->unit) * 1e6 + event->figure : -1.0;
        case verdict_column:
            return static_cast<int>(entry.judgement);
        case duration_column:
            return secondsOf(entry).value_or(0);
        case lowest_column:
        case highest_column:
            return extremeOf(entry, column).value_or(-1);
        case picture_column:
            return static_cast<int>(entry.position);
        default:
            return textOf(entry, column);
    }
}

QString EventsModel::helpOf(int column) const {
    switch (column) {
        case number_column:
            return tr(
                "Number of the event, as eyrie-cli lists it with the same limits. ★: starred. The list is "
                "in the order in which to review it; a third click on a heading brings that back");
        case time_column:
            return clock_.known() ? tr("When it begins, by %1").arg(clock_.origin()) : tr("When it begins");
        case kind_column:
            return tr("What happened");
        case tracks_column:
            return tr("Tracks it happened to");
        case figure_column:
            return tr("Speed, duration, angle or distance, depending on the kind");
        case verdict_column:
            return tr("Relevant, not relevant or unsure");
        case note_column:
            return tr("Your note; press F2 or click twice to write");
        case duration_column:
            return tr("How long it lasts; empty for what happens in a moment");
        case lowest_column:
            return tr("Lowest speed of its tracks over the ground while it lasts, in %1; 0 where one stands, empty for "
                      "tracks followed too shortly to tell")
                .arg(speedUnit(scale()));
        case highest_column:
            return tr("Highest speed of its tracks over the ground while it lasts, in %1; empty for tracks followed "
                      "too shortly to tell")
                .arg(speedUnit(scale()));
        case tags_column:
            return tr("Tags, as written on the card");
        case picture_column:
            return tr("The vehicle at the frame to look at, heading to the right");
        default:
            return {};
    }
}

QVariant EventsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation == Qt::Horizontal && role == Qt::ToolTipRole) return helpOf(section);
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return RecordModel::headerData(section, orientation, role);
    switch (section) {
        case number_column:
            return tr("#");
        case time_column:
            return clock_.known() ? tr("Time (UTC)") : tr("Time");
        case kind_column:
            return tr("Kind");
        case tracks_column:
            return tr("Tracks");
        case figure_column:
            return tr("Figure");
        case verdict_column:
            return tr("Verdict");
        case note_column:
            return tr("Note");
        case duration_column:
            return tr("Duration");
        case lowest_column:
            return tr("Lowest (%1)").arg(speedUnit(scale()));
        case highest_column:
            return tr("Highest (%1)").arg(speedUnit(scale()));
        case picture_column:
            return tr("Picture");
        case tags_column:
            return tr("Tags");
        default:
            return {};
    }
}

Qt::ItemFlags EventsModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags flags = RecordModel::flags(index);
    return index.isValid() && index.column() == note_column ? flags | Qt::ItemIsEditable : flags;
}

bool EventsModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const EventEntry* entry = recordAt(index.row());
    if (entry == nullptr || role != Qt::EditRole || index.column() != note_column) return false;
    if (value.toString().trimmed() == entry->note) return false;
    emit noteEdited(entry->id, value.toString());
    return true;
}

}  // namespace eyrie::ui

#include "moc_events_model.cpp"
