#include "widgets/message_bar.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScopedValueRollback>
#include <QStyle>
#include <QTimer>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "widgets/theme_colours.h"
#include "widgets/wiring.h"

namespace eyrie::ui {
namespace {

// More at once would hide the picture; the oldest makes room.
constexpr int kMostMessages = 4;
constexpr int kInfoStays_ms = 15000;

QColor hueOf(MessageKind kind) {
    switch (kind) {
        case MessageKind::info:
            return {0, 114, 178};
        case MessageKind::warning:
            return signalColour(Signal::warning);
        case MessageKind::error:
            return signalColour(Signal::bad);
    }
    return {};
}

QStyle::StandardPixmap iconOf(MessageKind kind) {
    switch (kind) {
        case MessageKind::info:
            return QStyle::SP_MessageBoxInformation;
        case MessageKind::warning:
            return QStyle::SP_MessageBoxWarning;
        case MessageKind::error:
            break;
    }
    return QStyle::SP_MessageBoxCritical;
}

}  // namespace

MessageStrip::MessageStrip(MessageKind kind, const QString& text, QWidget* parent)
    : QFrame(parent), kind_(kind), text_(text), icon_(new QLabel(this)), label_(new QLabel(text, this)) {
    setAutoFillBackground(true);
    setFrameShape(QFrame::StyledPanel);
    label_->setWordWrap(true);
    label_->setTextFormat(Qt::PlainText);
    label_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    auto* close = new QToolButton(this);
    close->setText(QStringLiteral("✕"));
    close->setAutoRaise(true);
    close->setToolTip(tr("Dismiss"));
    close->setAccessibleName(tr("Dismiss this message"));
    bindCommands(this, {{close, [this] { emit dismissed(); }}});
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 4, 4, 4);
    layout->addWidget(icon_);
    layout->addWidget(label_, 1);
    layout->addWidget(close);
    setAccessibleName(text);
    applyColours();
}

void MessageStrip::setAction(const QString& text, std::function<void()> action) {
    auto* button = new QPushButton(text, this);
    auto* row = static_cast<QHBoxLayout*>(layout());
    row->insertWidget(row->count() - 1, button);
    bindCommands(this, {{button, [this, action = std::move(action)] {
                             // The action may show another message; this one is done with by then.
                             emit dismissed();
                             action();
                         }}});
}

void MessageStrip::countUp() {
    label_->setText(tr("%1 (%2 times)").arg(text_).arg(++count_));
}

void MessageStrip::applyColours() {
    const QScopedValueRollback<bool> once(applying_, true);  // setting the palette changes the palette
    // The theme's own text on a tint of the theme's own ground reads in light and in dark.
    QPalette colours = parentWidget() != nullptr ? parentWidget()->palette() : palette();
    colours.setColor(QPalette::Window, blend(colours.color(QPalette::Window), hueOf(kind_), 0.22));
    setPalette(colours);
    const int size = style()->pixelMetric(QStyle::PM_SmallIconSize);
    icon_->setPixmap(style()->standardIcon(iconOf(kind_), nullptr, this).pixmap(size, size));
}

void MessageStrip::changeEvent(QEvent* event) {
    const bool theme_changed = event->type() == QEvent::StyleChange || event->type() == QEvent::PaletteChange;
    if (theme_changed && !applying_) applyColours();
    QFrame::changeEvent(event);
}

MessageBar::MessageBar(QWidget* parent) : QWidget(parent), layout_(new QVBoxLayout(this)) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(1);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Maximum);
    hide();
}

void MessageBar::showMessage(MessageKind kind, const QString& text, const QString& action_text,
                             std::function<void()> action) {
    for (MessageStrip* strip : strips_) {
        if (strip->kind() != kind || strip->text() != text) continue;
        strip->countUp();
        return;
    }
    add(kind, text, action_text, std::move(action));
}

void MessageBar::showTopic(const QString& topic, MessageKind kind, const QString& text, const QString& action_text,
                           std::function<void()> action) {
    dismissTopic(topic);
    add(kind, text, action_text, std::move(action))->setTopic(topic);
}

void MessageBar::dismissTopic(const QString& topic) {
    const QList<MessageStrip*> shown = strips_;
    for (MessageStrip* strip : shown) {
        if (strip->topic() == topic) remove(strip);
    }
}

bool MessageBar::shows(const QString& topic) const {
    return std::any_of(strips_.begin(), strips_.end(),
                       [&](const MessageStrip* strip) { return strip->topic() == topic; });
}

MessageStrip* MessageBar::add(MessageKind kind, const QString& text, const QString& action_text,
                              std::function<void()> action) {
    while (strips_.size() >= kMostMessages) remove(strips_.last());
    auto* strip = new MessageStrip(kind, text, this);
    if (!action_text.isEmpty() && action) strip->setAction(action_text, std::move(action));
    connect(strip, &MessageStrip::dismissed, this, [this, strip] { remove(strip); });
    if (kind == MessageKind::info && action_text.isEmpty())
        QTimer::singleShot(kInfoStays_ms, strip, [strip] { emit strip->dismissed(); });
    strips_.prepend(strip);
    layout_->insertWidget(0, strip);
    strip->show();
    show();
    return strip;
}

void MessageBar::remove(MessageStrip* strip) {
    strips_.removeOne(strip);
    layout_->removeWidget(strip);
    strip->hide();
    strip->deleteLater();  // its own button may be on the call stack
    setVisible(!strips_.isEmpty());
}

void MessageBar::dismiss(MessageKind kind) {
    const QList<MessageStrip*> shown = strips_;
    for (MessageStrip* strip : shown) {
        if (strip->kind() == kind) remove(strip);
    }
}

void MessageBar::dismissAll() {
    while (!strips_.isEmpty()) remove(strips_.first());
}

QStringList MessageBar::texts() const {
    QStringList texts;
    for (const MessageStrip* strip : strips_) texts << strip->text();
    return texts;
}

}  // namespace eyrie::ui

#include "moc_message_bar.cpp"
