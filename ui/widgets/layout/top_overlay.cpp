#include "widgets/layout/top_overlay.h"

#include <QEvent>
#include <QWidget>
#include <algorithm>
#include <utility>

namespace eyrie::ui {

namespace {

constexpr int kMargin_px = 6;
constexpr int kWidest_px = 900;  ///< longer lines are hard to read, and hide more of the area

}  // namespace

TopOverlay::TopOverlay(QWidget& overlay, QWidget& area, QObject* parent)
    : QObject(parent), overlay_(overlay), area_(area) {
    overlay_.installEventFilter(this);
    area_.installEventFilter(this);
    overlay_.raise();
    place();
}

bool TopOverlay::eventFilter(QObject* watched, QEvent* event) {
    const QEvent::Type type = event->type();
    const bool area_moves = type == QEvent::Resize || type == QEvent::Move;
    const bool overlay_changes = type == QEvent::LayoutRequest || type == QEvent::Show;
    if (watched == &area_ ? area_moves : overlay_changes) place();
    if (watched == &overlay_ && type == QEvent::Hide) tell();
    return QObject::eventFilter(watched, event);
}

void TopOverlay::place() {
    const QRect room = area_.geometry().marginsRemoved({kMargin_px, kMargin_px, kMargin_px, 0});
    if (room.isEmpty()) return;
    const int width = std::min(room.width(), kWidest_px);
    const int wanted = overlay_.hasHeightForWidth() ? overlay_.heightForWidth(width) : overlay_.sizeHint().height();
    QRect place(room.topLeft(), QSize(width, std::min(wanted, room.height())));
    place.moveLeft(room.left() + (room.width() - width) / 2);
    overlay_.setGeometry(place);
    tell();
}

void TopOverlay::setCovers(std::function<void(int covered_px)> covers) {
    covers_ = std::move(covers);
    tell();
}

void TopOverlay::tell() const {
    covers_(overlay_.isHidden() ? 0 : overlay_.geometry().bottom() + 1 - area_.geometry().top());
}

}  // namespace eyrie::ui

#include "moc_top_overlay.cpp"
