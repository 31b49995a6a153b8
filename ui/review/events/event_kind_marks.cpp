#include "review/events/event_kind_marks.h"

#include <QPainter>
#include <QPixmapCache>
#include <array>

#include "review/events/event_text.h"

namespace eyrie::ui {

namespace {

constexpr int kPlateWidth = 20;  ///< logical px
constexpr int kPlateHeight = 14;
constexpr int kIconSize = 14;
constexpr int kIconGap = 4;
constexpr int kPlateScale = 2;  ///< for screens of twice the density

/// In the order of EventKind; what could not be searched comes last.
constexpr std::array<EventKindMark, kListedKinds> kMarks{{
    {EventGroup::passage, "Ap", BarShape::full_height},    // appears
    {EventGroup::passage, "Le", BarShape::upper_half},     // leaves
    {EventGroup::passage, "Lo", BarShape::edges},          // lost
    {EventGroup::standing, "Sa", BarShape::upper_half},    // starts
    {EventGroup::standing, "So", BarShape::lower_half},    // stops
    {EventGroup::standing, "Sn", BarShape::full_height},   // stands
    {EventGroup::way, "Tb", BarShape::upper_half},         // turns back
    {EventGroup::way, "Af", BarShape::full_height},        // against the flow
    {EventGroup::way, "Lf", BarShape::lower_half},         // leaves the flow
    {EventGroup::speed, "Os", BarShape::full_height},      // over speed
    {EventGroup::speed, "Us", BarShape::lower_half},       // under speed
    {EventGroup::company, "Co", BarShape::full_height},    // convoy
    {EventGroup::company, "Me", BarShape::edges},          // meeting
    {EventGroup::standing, "Li", BarShape::edges},         // loiters
    {EventGroup::zone, "En", BarShape::upper_half},        // enters
    {EventGroup::zone, "Ex", BarShape::lower_half},        // exits
    {EventGroup::zone, "Cr", BarShape::full_height},       // crosses
    {EventGroup::unsearched, "Ns", BarShape::full_height}  // not searched
}};

QPixmap emptyPixmap(int width) {
    QPixmap pixmap(width * kPlateScale, kPlateHeight * kPlateScale);
    pixmap.setDevicePixelRatio(kPlateScale);
    pixmap.fill(Qt::transparent);
    return pixmap;
}

void paintPlate(QPainter& painter, QPointF at, int listed_kind, bool dark) {
    const EventKindMark& mark = markOf(listed_kind);
    const QRectF plate(at, QSizeF(kPlateWidth, kPlateHeight));
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(groupColour(mark.group, dark));
    painter.drawRoundedRect(plate, 3, 3);
    QFont font = painter.font();
    font.setPixelSize(10);
    font.setBold(true);
    painter.setFont(font);
    painter.setPen(dark ? Qt::black : Qt::white);  // the colours are bright on dark grounds, and the other way round
    painter.drawText(plate, Qt::AlignCenter, QString::fromLatin1(mark.letters));
}

}  // namespace

const EventKindMark& markOf(int listed_kind) {
    return kMarks.at(static_cast<std::size_t>(listed_kind));
}

QColor groupColour(EventGroup group, bool dark) {
    // After Okabe and Ito's set, shifted until letters can be read on them and eyes that lack a kind of cone tell them
    // apart; the tests hold both.
    switch (group) {
        case EventGroup::passage:
            return dark ? QColor(75, 168, 222) : QColor(0, 103, 179);
        case EventGroup::standing:
            return dark ? QColor(230, 165, 20) : QColor(59, 37, 24);
        case EventGroup::way:
            return dark ? QColor(255, 116, 110) : QColor(185, 72, 16);
        case EventGroup::speed:
            return dark ? QColor(244, 232, 70) : QColor(66, 64, 0);
        case EventGroup::company:
            return dark ? QColor(238, 181, 215) : QColor(152, 54, 124);
        case EventGroup::zone:
            return dark ? QColor(4, 218, 158) : QColor(18, 101, 66);
        case EventGroup::unsearched:
            break;
    }
    return dark ? QColor(165, 165, 165) : QColor(105, 105, 105);
}

QPixmap kindPlate(int listed_kind, bool dark) {
    QPixmap pixmap = emptyPixmap(kPlateWidth);
    QPainter painter(&pixmap);
    paintPlate(painter, {0, 0}, listed_kind, dark);
    return pixmap;
}

QPixmap judgedKindPlate(Judgement judgement, int listed_kind, bool dark) {
    // A list asks for them at every move.
    const QString key =
        QStringLiteral("judged kind %1 %2 %3").arg(static_cast<int>(judgement)).arg(listed_kind).arg(dark);
    QPixmap pixmap;
    if (QPixmapCache::find(key, &pixmap)) return pixmap;
    pixmap = emptyPixmap(kIconSize + kIconGap + kPlateWidth);
    QPainter painter(&pixmap);
    judgementIcon(judgement, dark).paint(&painter, QRect(0, 0, kIconSize, kIconSize));
    paintPlate(painter, {kIconSize + kIconGap, 0}, listed_kind, dark);
    painter.end();
    QPixmapCache::insert(key, pixmap);
    return pixmap;
}

}  // namespace eyrie::ui
