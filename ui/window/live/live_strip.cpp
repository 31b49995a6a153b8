#include "window/live/live_strip.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QIcon>
#include <QLabel>
#include <QToolButton>
#include <algorithm>

#include "io/live/live_address.h"
#include "widgets/display_text.h"
#include "widgets/elided_label.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"
#include "window/live/live_text.h"

namespace eyrie::ui {
namespace {

constexpr int kRefresh_ms = 250;

/// Of a small window the texts give way, not the window.
QLabel* liveField(QHBoxLayout& row, QWidget* parent) {
    auto* label = new ElidedLabel(Qt::ElideRight, parent);
    row.addWidget(label);
    return label;
}

}  // namespace

LiveStrip::LiveStrip(ProjectSession& session, QWidget* parent)
    : QFrame(parent), session_(session), again_(kRefresh_ms, [this] { refresh(); }) {
    setFrameShape(QFrame::StyledPanel);
    setAccessibleName(tr("Live source"));
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(8, 3, 4, 3);
    row->setSpacing(14);
    dot_ = new QLabel(QStringLiteral("●"), this);
    row->addWidget(dot_);
    state_ = liveField(*row, this);
    load_ = liveField(*row, this);
    recording_ = liveField(*row, this);
    address_ = new ElidedLabel(Qt::ElideMiddle, this);
    address_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);  // what the others leave
    address_->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    row->addWidget(address_, 1);
    stop_ = new QToolButton(this);
    stop_->setText(tr("Stop watching"));
    stop_->setIcon(QIcon::fromTheme(QStringLiteral("media-playback-stop")));
    stop_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    stop_->setToolTip(tr("Ends recording and run; what was recorded and found is kept"));
    row->addWidget(stop_);
    bindCommands(this, {{stop_, [this] {
                             session_.stopRun();
                             refresh();
                         }}});
    whenChanged(
        session_, this,
        {{{SessionChange::run_preparing, SessionChange::run_started, SessionChange::run_ended}, [this] { follow(); }}});
    hide();
}

void LiveStrip::follow() {
    const bool shown = session_.liveSource() != nullptr && session_.ownRun() != nullptr;
    setVisible(shown);
    if (!shown) {
        again_.stop();
        return;
    }
    address_->setText(QString::fromStdString(shownAddress(session_.liveSource()->address)));
    address_->setToolTip(
        tr("Recorded in %1")
            .arg(QString::fromStdString(session_.video() ? session_.video()->path.string() : std::string())));
    refresh();
    again_.start();
}

void LiveStrip::refresh() {
    const auto status = session_.liveStatus();
    if (!status || session_.liveSource() == nullptr) return;
    const LiveFacts& facts = status->load.facts;
    stop_->setEnabled(!session_.stopping());
    state_->setText(session_.stopping() ? tr("stopping: what came in before is still being processed, %1 behind")
                                              .arg(durationText(status->behind_s))
                                        : liveStateText(*status, session_.liveSource()->stream.give_up_s));
    // What matters most keeps its room, unless that were all there is.
    state_->setMinimumWidth(std::min(state_->sizeHint().width(), width() / 2));
    load_->setText(liveLoadText(*status));
    load_->setToolTip(
        tr("Where the chain is slower than the source, it takes fewer corners first; where that is not "
           "enough, frames are left out of it. The recording has all of them."));
    recording_->setText(liveRecordingText(facts));
    recording_->setMinimumWidth(std::min(recording_->sizeHint().width(), width() / 4));
    recording_->setToolTip(liveSpaceText(facts));
    QPalette coloured = palette();
    coloured.setColor(QPalette::WindowText, signalColour(signalOf(*status)));
    dot_->setPalette(coloured);
}

void LiveStrip::changeEvent(QEvent* event) {
    QFrame::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && isVisible()) refresh();
}

QString LiveStrip::text() const {
    return QStringList{state_->text(), load_->text(), recording_->text(), address_->text()}.join(QStringLiteral(" | "));
}

}  // namespace eyrie::ui

#include "moc_live_strip.cpp"
