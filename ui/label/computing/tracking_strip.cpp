#include "label/computing/tracking_strip.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <utility>

#include "widgets/display_text.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

TrackingStrip::TrackingStrip(std::function<void()> stop, QWidget* parent) : QWidget(parent) {
    setAutoFillBackground(true);  // it lies over the picture
    text_ = new QLabel;
    bar_ = new QProgressBar;
    bar_->setTextVisible(false);
    bar_->setMaximumHeight(14);
    auto* stop_button = new QPushButton(tr("Stop"));
    stop_button->setToolTip(tr("Stops tracking and keeps what is certain so far"));
    stop_button->setFocusPolicy(Qt::NoFocus);
    auto* line = new QHBoxLayout(this);
    line->setContentsMargins(8, 3, 8, 3);
    line->addWidget(text_);
    line->addWidget(bar_, 1);
    line->addWidget(stop_button);
    bindCommands(this, {{stop_button, std::move(stop)}});
    hide();
}

void TrackingStrip::showAdvance(const TrackingAdvance& advance) {
    QString text = tr("Tracking %1").arg(advance.object);
    text += advance.done > 0
                ? tr(": frame %1, %2 of at most %3 frames").arg(advance.frame).arg(advance.done).arg(advance.most)
                : tr(" from frame %1, at most %2 frames").arg(advance.frame).arg(advance.most);
    if (advance.seconds_left >= 0) text += tr(", at most %1").arg(leftText(advance.seconds_left));
    text_->setText(text);
    bar_->setRange(0, advance.done > 0 ? advance.most : 0);
    bar_->setValue(advance.done);
    show();
}

QString TrackingStrip::text() const {
    return isVisible() ? text_->text() : QString();
}

}  // namespace eyrie::ui

#include "moc_tracking_strip.cpp"
