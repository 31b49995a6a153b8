#include "widgets/charts/focus_ring.h"

#include <QEvent>
#include <QPainter>

namespace eyrie::ui {

FocusRing::FocusRing(QWidget& around) : QWidget(&around) {
    setObjectName(QStringLiteral("focus_ring"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setFocusPolicy(Qt::NoFocus);
    hide();
    around.installEventFilter(this);
}

bool FocusRing::eventFilter(QObject* watched, QEvent* event) {
    switch (event->type()) {
        case QEvent::FocusIn:
            follow(true);
            break;
        case QEvent::FocusOut:
            follow(false);
            break;
        case QEvent::Resize:
            setGeometry(parentWidget()->rect());
            break;
        default:
            break;
    }
    return QWidget::eventFilter(watched, event);
}

void FocusRing::follow(bool focused) {
    setGeometry(parentWidget()->rect());
    raise();
    setVisible(focused);
}

void FocusRing::paintEvent(QPaintEvent*) {
    constexpr double kWidth = 2;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(palette().color(QPalette::Highlight), kWidth));
    const double inset = kWidth / 2;
    painter.drawRoundedRect(QRectF(rect()).adjusted(inset, inset, -inset, -inset), 2, 2);
}

}  // namespace eyrie::ui

#include "moc_focus_ring.cpp"
