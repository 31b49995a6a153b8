#include "review/earth/metadata_rows.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include "core/geometry/place_text.h"
#include "core/time/utc_time.h"
#include "metadata/metadata_text.h"
#include "widgets/display_text.h"

namespace eyrie::ui {

namespace {

QString tell(const char* text) {
    return QCoreApplication::translate("Metadata", text);
}

QString fromEngine(const std::string& text) {
    return QString::fromStdString(text);
}

/// "48.1371541°", "1054.4 m".
QString withUnit(const QString& value, const QString& unit) {
    const bool apart = !unit.isEmpty() && unit != QStringLiteral("°");
    return value + (apart ? QStringLiteral(" ") : QString()) + unit;
}

/// Where the top of the picture points to, degrees clockwise from north.
double courseOfTop(double north_deg) {
    const double course = std::fmod(-90 - north_deg, 360);
    return course < 0 ? course + 360 : course;
}

void addWorkedOut(std::vector<MetadataRow>& rows, const GroundView& view) {
    int id = 0;
    const auto add = [&](const QString& name, const QString& value, const QString& unit, const QString& tip) {
        rows.push_back({--id, false, false, name, withUnit(value, unit), 0, tip});
    };
    if (view.gsd())
        add(tell("scale"), QString::number(*view.gsd(), 'g', 4), QStringLiteral("m/px"),
            tell("In the middle of the picture, by %1").arg(tell(nameOf(view.scale_source))));
    if (view.north_deg)
        add(tell("the picture's top points to"), QString::number(courseOfTop(*view.north_deg), 'f', 1),
            QStringLiteral("°"), tell("Clockwise from north, by %1").arg(tell(nameOf(view.source))));
    if (!view.footprint) return;
    static constexpr const char* kCornerNames[] = {QT_TRANSLATE_NOOP("Metadata", "footprint, upper left"),
                                                   QT_TRANSLATE_NOOP("Metadata", "footprint, upper right"),
                                                   QT_TRANSLATE_NOOP("Metadata", "footprint, lower right"),
                                                   QT_TRANSLATE_NOOP("Metadata", "footprint, lower left")};
    for (std::size_t i = 0; i < view.footprint->size(); ++i)
        add(tell(kCornerNames[i]), fromEngine(placeText((*view.footprint)[i])), QStringLiteral("°"),
            tell("Where this corner of the picture lies on the ground: latitude, longitude; by %1")
                .arg(tell(nameOf(view.source))));
}

}  // namespace

std::vector<MetadataRow> metadataRows(const VideoMetadata& stream, const MetadataState& state,
                                      const std::vector<MetadataPacket::Text>& texts, const GroundView& view) {
    std::vector<MetadataRow> rows;
    addWorkedOut(rows, view);
    const double sets = static_cast<double>(std::max<std::size_t>(1, stream.stream().packets.size()));
    for (const auto& [number, summary] : stream.stream().tags) {
        if (number == tag::kChecksum || number <= 0) continue;
        MetadataRow row;
        row.id = number;
        row.has_number = number < tag::kAngleToNorth;
        row.name = fromEngine(nameOfTag(number));
        row.sets = std::min(1.0, summary.packets / sets);
        if (number == tag::kTime) {
            if (state.utc_us) row.value = fromEngine(utcTextToMilliseconds(*state.utc_us));
        } else if (const auto value = state.number(number)) {
            row.value = withUnit(fromEngine(valueText(number, *value)), fromEngine(unitText(number)));
        } else {
            const auto text = std::find_if(texts.begin(), texts.end(),
                                           [number = number](const auto& each) { return each.tag == number; });
            if (text != texts.end()) row.value = fromEngine(text->value);
        }
        QStringList tips;
        if (summary.unreadable > 0)
            tips << tell("Without a value in %1 of %2 sets").arg(summary.unreadable).arg(summary.packets);
        if (!summary.has_numbers && summary.text.empty() && number != tag::kTime)
            tips << tell("A set or pack within the set, or a tag that is not known: not looked into");
        else if (summary.has_numbers && number != tag::kTime)
            tips << tell("In this stream from %1 to %2")
                        .arg(fromEngine(valueText(number, summary.least)),
                             fromEngine(valueText(number, summary.greatest)));
        row.tip = tips.join(QLatin1Char('\n'));
        rows.push_back(std::move(row));
    }
    return rows;
}

QString streamName(const VideoMetadata& stream, std::size_t number) {
    const DataStream& track = stream.stream().track;
    return tell("Stream %1 (track %2, PID 0x%3): %4 sets")
        .arg(number)
        .arg(track.number)
        .arg(track.id, 0, 16)
        .arg(stream.stream().packets.size());
}

QString streamSummary(const VideoMetadata& stream, std::int64_t last_us) {
    const MetadataStream& sets = stream.stream();
    QStringList lines;
    // Less than all is never shown as all.
    const int covered = static_cast<int>(std::floor(100 * stream.timeline().coveredShare(0, last_us) + 1e-6));
    lines << (sets.packets.size() == 1 ? tell("1 set, %1 % of the video covered").arg(covered)
                                       : tell("%1 sets, %2 % of the video covered")
                                             .arg(QLocale().toString(qlonglong(sets.packets.size())))
                                             .arg(covered));
    if (sets.damaged() > 0)
        lines << tell("%1 damaged, skipped: %2").arg(sets.damaged()).arg(fromEngine(damageText(sets)));
    if (sets.targetSets() > 0)
        lines << tell("%1 sets of moving targets (VMTI) beside them, not read").arg(sets.targetSets());
    std::optional<std::int64_t> first, last;
    for (const MetadataPacket& packet : sets.packets) {
        if (!packet.utc_us) continue;
        if (!first) first = packet.utc_us;
        last = packet.utc_us;
    }
    if (first)
        lines << tell("Clock: %1 to %2")
                     .arg(fromEngine(utcTextToMilliseconds(*first)), fromEngine(utcTextToMilliseconds(*last)));
    if (sets.steps_back > 0 || sets.leaps > 0)
        lines << tell("The clock goes back %1×, leaps ahead by more than 10 s %2×%3")
                     .arg(sets.steps_back)
                     .arg(sets.leaps)
                     .arg(fromEngine(firstPlaceText(sets.first_jump)));
    return lines.join(QLatin1Char('\n'));
}

}  // namespace eyrie::ui
