#include "review/tracks/time_limit.h"

#include <QJsonObject>
#include <QJsonValue>
#include <QRegularExpression>
#include <limits>
#include <map>
#include <memory>
#include <utility>

namespace eyrie::ui {

namespace {

const QString kFromWord = QStringLiteral("from");
const QString kToWord = QStringLiteral("to");
constexpr double kDay_s = 86'400;

/// Since midnight; nothing for a frame, or no limit.
std::optional<double> secondsOfDay(const std::optional<TimeLimit>& limit) {
    return limit && limit->of_day ? std::optional<double>(limit->value) : std::nullopt;
}

QJsonValue jsonOf(const TimeLimit& limit) {
    return limit.of_day ? QJsonValue(timeLimitText(limit)) : QJsonValue(limit.value);
}

std::optional<TimeLimit> storedLimitOf(const QJsonValue& json) {
    if (json.isString()) return timeLimitOf(json.toString());
    const int frame = json.toInt(-1);
    return frame < 0 ? std::nullopt : std::optional(TimeLimit{frame, false});
}

}  // namespace

std::optional<TimeLimit> timeLimitOf(const QString& text) {
    static const QRegularExpression of_frame(QStringLiteral("^\\d{1,9}$"));
    static const QRegularExpression of_day(QStringLiteral("^(\\d{1,2}):(\\d{2})(?::(\\d{2}))?$"));
    const QString typed = text.trimmed();
    if (of_frame.match(typed).hasMatch()) return TimeLimit{typed.toInt(), false};
    const QRegularExpressionMatch parts = of_day.match(typed);
    if (!parts.hasMatch()) return std::nullopt;
    const int hours = parts.captured(1).toInt(), minutes = parts.captured(2).toInt();
    const int seconds = parts.captured(3).toInt();  // 0 where there are none
    if (hours > 23 || minutes > 59 || seconds > 59) return std::nullopt;
    return TimeLimit{(hours * 60 + minutes) * 60 + seconds, true};
}

QString timeLimitText(const TimeLimit& limit) {
    if (!limit.of_day) return QString::number(limit.value);
    const auto two = [](int number) { return QStringLiteral("%1").arg(number, 2, 10, QLatin1Char('0')); };
    const QString minutes = two(limit.value / 3600) + QLatin1Char(':') + two(limit.value / 60 % 60);
    return limit.value % 60 == 0 ? minutes : minutes + QLatin1Char(':') + two(limit.value % 60);
}

FrameOfDay remembering(FrameOfDay ask) {
    using Known = std::map<std::pair<double, double>, std::optional<FrameIndex>>;
    return [ask = std::move(ask), known = std::make_shared<Known>()](double seconds, double near) {
        const auto [place, is_new] = known->try_emplace({seconds, near});
        if (is_new) place->second = ask(seconds, near);
        return place->second;
    };
}

FrameSpan framesOf(const TimeRange& range, const FrameOfDay& frame_of_day) {
    FrameSpan frames{std::numeric_limits<FrameIndex>::min(), std::numeric_limits<FrameIndex>::max()};
    if (range.from && !range.from->of_day) frames.first = range.from->value;
    if (range.to && !range.to->of_day) frames.last = range.to->value;
    if (!range.ofDay() || !frame_of_day) return frames;
    const std::optional<double> begin = secondsOfDay(range.from);
    std::optional<double> end = secondsOfDay(range.to);
    // Lists show times without what follows the seconds: what they show as this very one belongs to it.
    if (end) *end += 1;
    if (begin && end && *end <= *begin) *end += kDay_s;
    const double near = begin && end ? (*begin + *end) / 2 : begin ? *begin : *end;
    if (begin) frames.first = frame_of_day(*begin, near).value_or(frames.first);
    if (end)
        if (const auto behind = frame_of_day(*end, near)) frames.last = *behind - 1;
    return frames;
}

QJsonObject jsonOf(const TimeRange& range) {
    QJsonObject json;
    if (range.from) json[kFromWord] = jsonOf(*range.from);
    if (range.to) json[kToWord] = jsonOf(*range.to);
    return json;
}

TimeRange timeRangeOf(const QJsonObject& json) {
    return {storedLimitOf(json[kFromWord]), storedLimitOf(json[kToWord])};
}

}  // namespace eyrie::ui
