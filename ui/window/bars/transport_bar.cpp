#include "window/bars/transport_bar.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSpinBox>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

TransportBar::TransportBar(ProjectSession& session, const WindowActions& actions, QWidget* parent)
    : QWidget(parent), session_(session) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(6, 2, 6, 2);
    layout->setSpacing(2);
    const auto button = [&](QAction* action, bool with_text = false) {
        auto* widget = new QToolButton(this);
        widget->setDefaultAction(action);
        widget->setAutoRaise(true);
        widget->setFocusPolicy(Qt::NoFocus);
        widget->setToolButtonStyle(with_text ? Qt::ToolButtonTextBesideIcon : Qt::ToolButtonIconOnly);
        layout->addWidget(widget);
        return widget;
    };
    auto* frame_label = new QLabel(tr("Frame"), this);
    frame_ = new QSpinBox(this);
    frame_->setKeyboardTracking(false);
    frame_->setToolTip(tr("Go to frame (%1)").arg(actions.go_to_frame->shortcut().toString(QKeySequence::NativeText)));
    frame_->setAccessibleName(tr("Frame"));
    frame_label->setBuddy(frame_);
    layout->addWidget(frame_label);
    layout->addWidget(frame_);
    layout->addStretch(1);
    button(actions.first);
    button(actions.step_back);
    button(actions.play)->setIconSize({24, 24});
    button(actions.step_on);
    button(actions.last);
    layout->addSpacing(8);
    speed_ = new QComboBox(this);
    speed_->setToolTip(tr("Speed of playback"));
    speed_->setAccessibleName(speed_->toolTip());
    speed_->setFocusPolicy(Qt::NoFocus);
    for (const double speed : {Playback::kSlowest, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, Playback::kFastest})
        speed_->addItem(tr("%1×").arg(locale().toString(speed)), speed);
    layout->addWidget(speed_);
    button(actions.loop);
    layout->addStretch(1);
    button(actions.follow, true);

    bindCommands(this, {{speed_, [this](int index) {
                             session_.playback().setSpeed(speed_->itemData(index).toDouble(), session_.currentFrame());
                         }}});
    connect(&session_.playback(), &Playback::speedChanged, this, &TransportBar::showSpeed);
    showSpeed(session_.playback().speed());
    whenChanged(session_, this,
                {{{SessionChange::video, SessionChange::length}, [this] { frame_->setRange(0, session_.lastFrame()); }},
                 {{SessionChange::video, SessionChange::picture}, [this] {
                      if (!frame_->hasFocus()) frame_->setValue(session_.shownFrame());
                  }}});
    onFinished(this, &TransportBar::frameEdited, frame_);
}

void TransportBar::frameEdited() {
    if (frame_->value() != session_.shownFrame()) session_.goToFrame(frame_->value());
    if (frame_->hasFocus()) emit editingDone();
}

void TransportBar::focusFrameField() {
    frame_->setFocus(Qt::ShortcutFocusReason);
    frame_->selectAll();
}

void TransportBar::showSpeed(double speed) {
    int nearest = 0;
    for (int i = 1; i < speed_->count(); ++i)
        if (std::abs(speed_->itemData(i).toDouble() - std::abs(speed)) <
            std::abs(speed_->itemData(nearest).toDouble() - std::abs(speed)))
            nearest = i;
    speed_->setCurrentIndex(nearest);
}

}  // namespace eyrie::ui

#include "moc_transport_bar.cpp"
