#include "review/tracks/track_filter.h"

#include <QCoreApplication>
#include <QJsonArray>
#include <QJsonObject>
#include <algorithm>
#include <string>

#include "store/runs/track_scale.h"
#include "widgets/display_text.h"

namespace eyrie::ui {

namespace {

// Words in settings: they must not change.
constexpr std::array<const char*, kRangedQualities> kRangeWords{"speed", "lowest_speed", "highest_speed",
                                                                "life",  "size",         "score"};
const QString kEighthsWord = QStringLiteral("direction");
const QString kEventsWord = QStringLiteral("events");
const QString kZonesWord = QStringLiteral("zones");
const QString kTimeWord = QStringLiteral("time");
const QString kConditionsWord = QStringLiteral("states");
constexpr std::array<const char*, kTrackConditions> kConditionWords{
    QT_TRANSLATE_NOOP("TrackFilter", "moving now"), QT_TRANSLATE_NOOP("TrackFilter", "standing now"),
    QT_TRANSLATE_NOOP("TrackFilter", "lost"), QT_TRANSLATE_NOOP("TrackFilter", "corrected"),
    QT_TRANSLATE_NOOP("TrackFilter", "rejected")};

QString trackFilterText(const char* text) {
    return QCoreApplication::translate("TrackFilter", text);
}

template <class Value>
bool meet(const std::set<Value>& wanted, const std::set<Value>& there) {
    return wanted.empty() ||
           std::any_of(wanted.begin(), wanted.end(), [&](const Value& value) { return there.contains(value); });
}

QString limitText(double value) {
    return QString::number(value, 'g', 6);
}

/// "a, b, c" of up to two, then "a, b +2".
QString shortList(const QStringList& words) {
    constexpr int kMost = 2;
    const QString first = words.mid(0, kMost).join(QStringLiteral(", "));
    return words.size() <= kMost ? first : QStringLiteral("%1 +%2").arg(first).arg(words.size() - kMost);
}

/// "22:08", or "frame 120".
QString momentText(const TimeLimit& limit) {
    const QString text = timeLimitText(limit);
    return limit.of_day ? text : trackFilterText(QT_TRANSLATE_NOOP("TrackFilter", "frame %1")).arg(text);
}

/// "22:08–22:20 UTC", "≥ frame 120".
QString rangeText(const TimeRange& range) {
    const QString text = range.from && range.to ? QStringLiteral("%1–%2").arg(momentText(*range.from),
                                                                              range.to->of_day == range.from->of_day
                                                                                  ? timeLimitText(*range.to)
                                                                                  : momentText(*range.to))
                         : range.from ? QStringLiteral("≥ %1").arg(momentText(*range.from))
                                                : QStringLiteral("≤ %1").arg(momentText(*range.to));
    return range.ofDay() ? text + QStringLiteral(" UTC") : text;
}

/// Whether it is so; true where nobody knows.
bool isSo(TrackCondition condition, const TrackSummary& track, const TrackFacts& facts, const TrackDoings& did) {
    const bool rejected = track.corrected == CorrectionKind::reject;
    switch (condition) {
        case TrackCondition::moves_now:
        case TrackCondition::stands_now: {
            if (!facts.now) return true;
            if (rejected || *facts.now < track.first_frame || *facts.now > track.last_frame) return false;
            if (facts.doings == nullptr) return true;
            return standsIn(did, *facts.now) == (condition == TrackCondition::stands_now);
        }
        case TrackCondition::lost:
            return facts.doings == nullptr || did.events.contains(EventKind::lost);
        case TrackCondition::corrected:
            return track.corrected && !rejected;
        case TrackCondition::rejected:
            return rejected;
    }
    return true;
}

}  // namespace

QString nameOf(TrackCondition condition) {
    return trackFilterText(kConditionWords.at(static_cast<std::size_t>(condition)));
}

bool needsDoings(TrackQuality quality) {
    return quality == TrackQuality::lowest || quality == TrackQuality::highest || quality == TrackQuality::direction ||
           quality == TrackQuality::event || quality == TrackQuality::zone || quality == TrackQuality::state;
}

bool TrackFilter::has(TrackQuality quality) const {
    switch (quality) {
        case TrackQuality::direction:
            return !eighths.empty();
        case TrackQuality::event:
            return !events.empty();
        case TrackQuality::zone:
            return !zones.empty();
        case TrackQuality::time:
            return time.any();
        case TrackQuality::state:
            return !conditions.empty();
        case TrackQuality::like:
            return like.has_value();
        default:
            return range(quality).any();
    }
}

bool TrackFilter::any() const {
    return *this != TrackFilter{};
}

void TrackFilter::clear(TrackQuality quality) {
    switch (quality) {
        case TrackQuality::direction:
            return eighths.clear();
        case TrackQuality::event:
            return events.clear();
        case TrackQuality::zone:
            return zones.clear();
        case TrackQuality::time:
            time = {};
            return;
        case TrackQuality::state:
            return conditions.clear();
        case TrackQuality::like:
            return like.reset();
        default:
            range(quality) = {};
    }
}

double LikenessByTrack::of(TrackId track) const {
    if (track == chosen) return 1;
    const auto found = likeness.find(track);
    return found == likeness.end() ? 0 : found->second;
}

bool TrackFilter::holds(const TrackSummary& track, const SceneScale& scale, const TrackFacts& facts) const {
    const LikenessByTrack* likeness = facts.likeness;
    if (like && likeness != nullptr && likeness->chosen == like->track && track.id != like->track &&
        likeness->of(track.id) < like->least)
        return false;
    if (time.any() && !overlap(framesOf(time, facts.frame_of_day), {track.first_frame, track.last_frame})) return false;
    const TrackDoings& did = doingsIn(facts.doings, track.id);
    for (int i = 0; i < kRangedQualities; ++i) {
        const auto quality = static_cast<TrackQuality>(i);
        if (!range(quality).any() || (needsDoings(quality) && facts.doings == nullptr)) continue;
        const auto value = valueOf(track, quality, scale, did);
        if (!value || !range(quality).holds(*value)) return false;
    }
    if (!conditions.empty() && std::none_of(conditions.begin(), conditions.end(), [&](TrackCondition condition) {
            return isSo(condition, track, facts, did);
        }))
        return false;
    if (facts.doings == nullptr) return true;
    return (eighths.empty() || (did.eighth && eighths.contains(*did.eighth))) && meet(events, did.events) &&
           meet(zones, did.zones);
}

QJsonObject TrackFilter::json() const {
    QJsonObject json;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        if (!ranges[i].any()) continue;
        QJsonObject limits;
        if (ranges[i].from) limits[QStringLiteral("from")] = *ranges[i].from;
        if (ranges[i].to) limits[QStringLiteral("to")] = *ranges[i].to;
        json[QLatin1String(kRangeWords[i])] = limits;
    }
    QJsonArray directions, kinds, names;
    for (const int eighth : eighths) directions.append(eighth);
    for (const EventKind kind : events) kinds.append(QLatin1String(eyrie::nameOf(kind)));
    for (const std::string& zone : zones) names.append(QString::fromStdString(zone));
    if (!eighths.empty()) json[kEighthsWord] = directions;
    if (!events.empty()) json[kEventsWord] = kinds;
    if (!zones.empty()) json[kZonesWord] = names;
    if (time.any()) json[kTimeWord] = jsonOf(time);
    QJsonArray states;
    for (const TrackCondition condition : conditions)
        states.append(QLatin1String(kConditionWords.at(static_cast<std::size_t>(condition))));
    if (!conditions.empty()) json[kConditionsWord] = states;
    return json;
}

TrackFilter TrackFilter::fromJson(const QJsonObject& json) {
    TrackFilter filter;
    const auto limit = [](const QJsonValue& value) {
        return value.isDouble() ? std::optional(value.toDouble()) : std::nullopt;
    };
    for (std::size_t i = 0; i < filter.ranges.size(); ++i) {
        const QJsonObject limits = json[QLatin1String(kRangeWords[i])].toObject();
        filter.ranges[i] = {limit(limits[QStringLiteral("from")]), limit(limits[QStringLiteral("to")])};
    }
    for (const auto& value : json[kEighthsWord].toArray()) {
        const int eighth = value.toInt(-1);
        if (eighth >= 0 && eighth < kEighths) filter.eighths.insert(eighth);
    }
    for (const auto& value : json[kEventsWord].toArray())
        for (const EventKind kind : allEventKinds())
            if (value.toString() == QLatin1String(eyrie::nameOf(kind))) filter.events.insert(kind);
    for (const auto& value : json[kZonesWord].toArray())
        if (!value.toString().isEmpty()) filter.zones.insert(value.toString().toStdString());
    filter.time = timeRangeOf(json[kTimeWord].toObject());
    for (const auto& value : json[kConditionsWord].toArray())
        for (int i = 0; i < kTrackConditions; ++i)
            if (value.toString() == QLatin1String(kConditionWords.at(static_cast<std::size_t>(i))))
                filter.conditions.insert(static_cast<TrackCondition>(i));
    return filter;
}

std::optional<double> valueOf(const TrackSummary& track, TrackQuality quality, const SceneScale& scale,
                              const TrackDoings& did) {
    const auto shown = [&](double metres_per_second) {
        const SceneScale here = scaleOf(track, scale);
        return shownSpeed(here.pxPerFrame(metres_per_second), here);
    };
    switch (quality) {
        case TrackQuality::speed:
            return shownSpeed(track.mean_speed_px, scaleOf(track, scale));
        case TrackQuality::lowest:
            return did.speeds ? std::optional(shown(did.speeds->lowest)) : std::nullopt;
        case TrackQuality::highest:
            return did.speeds ? std::optional(shown(did.speeds->highest)) : std::nullopt;
        case TrackQuality::life:
            return scale.frame_rate_hz > 0 ? (track.last_frame - track.first_frame + 1) / scale.frame_rate_hz : 0;
        case TrackQuality::size:
            return shownLength(track.mean_length_px, scaleOf(track, scale));
        case TrackQuality::score:
            return track.score;
        default:
            return 0;
    }
}

QString nameOf(TrackQuality quality) {
    static constexpr std::array<const char*, kTrackQualities> names{
        QT_TRANSLATE_NOOP("TrackFilter", "Speed"),         QT_TRANSLATE_NOOP("TrackFilter", "Lowest speed"),
        QT_TRANSLATE_NOOP("TrackFilter", "Highest speed"), QT_TRANSLATE_NOOP("TrackFilter", "Life"),
        QT_TRANSLATE_NOOP("TrackFilter", "Length"),        QT_TRANSLATE_NOOP("TrackFilter", "Score"),
        QT_TRANSLATE_NOOP("TrackFilter", "Direction"),     QT_TRANSLATE_NOOP("TrackFilter", "Events"),
        QT_TRANSLATE_NOOP("TrackFilter", "Zone"),          QT_TRANSLATE_NOOP("TrackFilter", "Time"),
        QT_TRANSLATE_NOOP("TrackFilter", "State"),         QT_TRANSLATE_NOOP("TrackFilter", "Like")};
    return trackFilterText(names.at(static_cast<std::size_t>(quality)));
}

QString unitOf(TrackQuality quality, const SceneScale& scale) {
    switch (quality) {
        case TrackQuality::speed:
        case TrackQuality::lowest:
        case TrackQuality::highest:
            return speedUnit(scale);
        case TrackQuality::life:
            return QStringLiteral("s");
        case TrackQuality::size:
            return lengthUnit(scale);
        default:
            return {};
    }
}

QString arrowOf(int eighth) {
    static const QString arrows = QStringLiteral("→↘↓↙←↖↑↗");
    return arrows.mid(eighth, 1);
}

QString chipText(const TrackFilter& filter, TrackQuality quality, const SceneScale& scale) {
    QString text = nameOf(quality);
    if (!filter.has(quality)) return text;
    text += QLatin1Char(' ');
    QStringList words;
    switch (quality) {
        case TrackQuality::direction:
            for (const int eighth : filter.eighths) words << arrowOf(eighth);
            return text + words.join(QLatin1Char(' '));
        case TrackQuality::event:
            for (const EventKind kind : filter.events) words << QLatin1String(eyrie::nameOf(kind));
            return text + shortList(words);
        case TrackQuality::zone:
            for (const std::string& zone : filter.zones) words << QString::fromStdString(zone);
            return text + shortList(words);
        case TrackQuality::time:
            return text + rangeText(filter.time);
        case TrackQuality::state:
            for (const TrackCondition condition : filter.conditions) words << nameOf(condition);
            return text + shortList(words);
        default:
            break;
    }
    if (quality == TrackQuality::like) {
        text += QString::number(filter.like->track);
        return filter.like->least == LikeLimit().least
                   ? text
                   : QStringLiteral("%1 ≥ %2").arg(text, limitText(filter.like->least));
    }
    const TrackRange& range = filter.range(quality);
    text += range.from && range.to ? QStringLiteral("%1–%2").arg(limitText(*range.from), limitText(*range.to))
            : range.from           ? QStringLiteral("≥ %1").arg(limitText(*range.from))
                                   : QStringLiteral("≤ %1").arg(limitText(*range.to));
    const QString unit = unitOf(quality, scale);
    return unit.isEmpty() ? text : text + QLatin1Char(' ') + unit;
}

}  // namespace eyrie::ui
