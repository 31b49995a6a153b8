#include "review/events/event_text.h"

#include <QCoreApplication>
#include <QPainter>
#include <QPixmap>
#include <array>
#include <cmath>

#include "core/time/time_text.h"
#include "widgets/display_text.h"

namespace eyrie::ui {

namespace {

QString eventWord(const char* text) {
    return QCoreApplication::translate("Events", text);
}

QString kindText(int listed_kind, const std::string& zone, CrossingSense sense) {
    QString text = listedKindText(listed_kind);
    if (!zone.empty()) text += QLatin1Char(' ') + QString::fromStdString(zone);
    if (sense != CrossingSense::none) text += QLatin1Char(' ') + QString::fromLatin1(nameOf(sense));
    return text;
}

/// From the beginning of the first frame to the end of the last.
double secondsOf(const FoundEvents& found, FrameSpan frames) {
    return found.run->secondsOf(frames.last) - found.run->secondsOf(frames.first) +
           1 / found.run->footage.scale.frame_rate_hz;
}

QPixmap judgementPixmap(Judgement judgement, bool dark) {
    constexpr int kSize = 14;
    constexpr int kScale = 2;
    QPixmap pixmap(kSize * kScale, kSize * kScale);
    pixmap.setDevicePixelRatio(kScale);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(judgementColour(judgement, dark), 2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    switch (judgement) {
        case Judgement::open:
            painter.drawEllipse(QPointF(7, 7), 2, 2);
            break;
        case Judgement::relevant:
            painter.drawPolyline(QPolygonF({QPointF(2.5, 7.5), QPointF(5.5, 10.5), QPointF(11.5, 3.5)}));
            break;
        case Judgement::not_relevant:
            painter.drawLine(QPointF(3.5, 3.5), QPointF(10.5, 10.5));
            painter.drawLine(QPointF(3.5, 10.5), QPointF(10.5, 3.5));
            break;
        case Judgement::unsure: {
            QFont font = painter.font();
            font.setPixelSize(13);
            font.setBold(true);
            painter.setFont(font);
            painter.drawText(QRectF(0, 0, kSize, kSize), Qt::AlignCenter, QStringLiteral("?"));
            break;
        }
    }
    return pixmap;
}

}  // namespace

QString listedKindText(int listed_kind) {
    if (listed_kind >= kEventKinds) return eventWord(QT_TRANSLATE_NOOP("Events", "Not searched"));
    return capitalised(QString::fromLatin1(nameOf(static_cast<EventKind>(listed_kind))));
}

QString eventKindText(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    return event != nullptr ? kindText(listedKindAt(found, position), event->zone, event->sense)
                            : listedKindText(listedKindAt(found, position));
}

QString eventRowText(const FoundEvents& found, std::size_t position, const std::vector<std::size_t>& others) {
    if (others.empty()) return eventKindText(found, position);
    std::array<const Event*, 3> steps{};  // as they happen, whatever their order in the queue
    const auto take = [&](std::size_t place) {
        const Event* event = found.eventAt(place);
        if (event == nullptr) return;
        steps[event->kind == EventKind::stops ? 0 : event->kind == EventKind::stands ? 1 : 2] = event;
    };
    take(position);
    for (const std::size_t place : others) take(place);
    QStringList words;
    if (steps[0] != nullptr) words << eventWord(QT_TRANSLATE_NOOP("Events", "stops"));
    if (steps[1] != nullptr)
        words << eventWord(QT_TRANSLATE_NOOP("Events", "stands %1")).arg(QString::fromStdString(figureText(*steps[1])));
    if (steps[2] != nullptr)
        words << (steps[0] != nullptr ? eventWord(QT_TRANSLATE_NOOP("Events", "starts again"))
                                      : eventWord(QT_TRANSLATE_NOOP("Events", "starts")));
    return capitalised(words.join(QStringLiteral(", ")));
}

QString eventKindText(const ReviewSubject& subject) {
    return kindText(subject.kind ? static_cast<int>(*subject.kind) : kEventKinds, subject.zone, subject.sense);
}

QString eventNumberText(const FoundEvents& found, std::size_t position) {
    const auto number = found.numberAt(position);
    return number ? QString::number(*number) : QString();
}

QString eventClockText(const FoundEvents& found, std::size_t position) {
    const double seconds = found.run->secondsOf(found.framesAt(position).first);
    return QString::fromStdString(timeText(std::llround(seconds * 1e6), 1));
}

QString eventTracksText(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    QStringList ids;
    if (event != nullptr)
        for (const TrackId id : event->tracks) ids << QString::number(id);
    return ids.join(QStringLiteral(", "));
}

QString eventFigureText(const FoundEvents& found, std::size_t position) {
    const Event* event = found.eventAt(position);
    if (event != nullptr) return QString::fromStdString(figureText(*event));
    return durationText(secondsOf(found, found.framesAt(position)));
}

QString countedFigureText(const FoundEvents& found, std::size_t position) {
    const QString figure = eventFigureText(found, position);
    const Event* event = found.eventAt(position);
    if (event == nullptr || figure.isEmpty()) return figure;
    return QString::fromLatin1(figureNameOf(event->kind)) + QLatin1Char(' ') + figure;
}

std::optional<double> eventSeconds(const FoundEvents& found, std::size_t position) {
    const FrameSpan frames = found.framesAt(position);
    if (found.eventAt(position) != nullptr && frames.first == frames.last) return std::nullopt;
    return secondsOf(found, frames);
}

std::optional<double> eventSpeed(const FoundEvents& found, std::size_t position, double SpeedRange::*which) {
    const Event* event = found.eventAt(position);
    const auto speeds = found.speedsAt(position);
    if (event == nullptr || !speeds) return std::nullopt;
    const SceneScale& scale = found.run->footage.scale;
    const SceneScale here = scale.at(event->frame, event->place);
    return shownSpeed(here.pxPerFrame((*speeds).*which), here);
}

QString eventTipText(const FoundEvents& found, std::size_t position) {
    const FrameSpan frames = found.framesAt(position);
    const Event* event = found.eventAt(position);
    QString text = eventKindText(found, position);
    if (const auto number = found.numberAt(position)) text = QStringLiteral("%1. ").arg(*number) + text;
    text += frames.first == frames.last
                ? eventWord(QT_TRANSLATE_NOOP("Events", ": frame %1")).arg(frames.first)
                : eventWord(QT_TRANSLATE_NOOP("Events", ": frames %1 to %2")).arg(frames.first).arg(frames.last);
    if (event == nullptr)
        return text + QLatin1Char('\n') +
               eventWord(QT_TRANSLATE_NOOP(
                   "Events", "The camera's motion is unknown here, so no event is found. Look for yourself."));
    const QString figure = countedFigureText(found, position);
    if (!figure.isEmpty()) text += QLatin1Char('\n') + figure;
    return text + QLatin1Char('\n') +
           eventWord(QT_TRANSLATE_NOOP("Events", "Place in the queue: %1"))
               .arg(QString::fromLatin1(nameOf(found.queue.at(position).group)));
}

QString judgementText(Judgement judgement) {
    if (judgement == Judgement::open) return {};
    return capitalised(QString::fromLatin1(nameOf(judgement)));
}

QString judgedText(Judgement judgement, const QString& person, const std::string& utc) {
    QStringList by;
    if (!person.isEmpty()) by << person;
    if (!utc.empty()) by << localTimeText(utc);
    const QString who = by.join(QStringLiteral(", "));
    const QString verdict = judgementText(judgement);
    return verdict.isEmpty() || who.isEmpty() ? verdict + who : verdict + QStringLiteral(": ") + who;
}

QColor judgementColour(Judgement judgement, bool dark) {
    switch (judgement) {
        case Judgement::open:
            break;
        case Judgement::relevant:
            return dark ? QColor(88, 200, 110) : QColor(24, 128, 56);
        case Judgement::not_relevant:
            return dark ? QColor(150, 150, 150) : QColor(128, 128, 128);
        case Judgement::unsure:
            return dark ? QColor(240, 180, 60) : QColor(178, 112, 0);
    }
    return dark ? QColor(110, 170, 245) : QColor(30, 100, 200);
}

QIcon judgementIcon(Judgement judgement, bool dark) {
    static std::array<std::array<QIcon, 4>, 2> icons;
    QIcon& icon = icons.at(dark ? 1 : 0).at(static_cast<std::size_t>(judgement));
    if (icon.isNull()) icon = QIcon(judgementPixmap(judgement, dark));
    return icon;
}

}  // namespace eyrie::ui
