#include "panels/tracks_panel.h"

#include <QHBoxLayout>
#include <QMenu>
#include <QTableView>
#include <QToolButton>

#include "panels/empty_state.h"

namespace eyrie::ui {

TracksPanel::TracksPanel(TracksModel* model, QWidget* parent)
    : TablePanel(model, QStringLiteral("tracks"), parent), tracks_(model), tentative_(new QToolButton(this)) {
    table()->setAccessibleName(tr("Tracks"));
    emptyState()->setTexts(
        tr("The tracks of a run are listed here: one row for each moving vehicle, with its life, speed and size."));
    tentative_->setText(tr("Tentative"));
    tentative_->setCheckable(true);
    tentative_->setToolTip(tr("Also list tracks that were never confirmed and are no part of the result"));
    toolRow()->addWidget(tentative_);
    connect(tentative_, &QToolButton::toggled, this, &TracksPanel::setTentativeShown);
    setTentativeShown(false);

    connect(this, &TablePanel::idSelected, this, &TracksPanel::trackSelected);
    connect(this, &TablePanel::idClicked, this, &TracksPanel::activate);
    connect(this, &TablePanel::idDoubleClicked, this,
            [this](int track) { activate(track, TracksModel::first_column); });
}

void TracksPanel::setTentativeShown(bool shown) {
    tentative_->setChecked(shown);
    proxy().setRowFilter([this, shown](int row) {
        const TrackSummary* track = tracks_->recordAt(row);
        return shown || (track != nullptr && track->confirmed);
    });
}

void TracksPanel::activate(int track, int column) {
    const TrackSummary* summary = tracks_->recordAt(tracks_->rowOf(track));
    if (summary == nullptr) return;
    emit trackActivated(track, column == TracksModel::last_column ? summary->last_frame : summary->first_frame);
}

void TracksPanel::fillMenu(QMenu& menu, int track) {
    menu.addAction(tr("Go to its first frame"), this, [this, track] { activate(track, TracksModel::first_column); });
    menu.addAction(tr("Go to its last frame"), this, [this, track] { activate(track, TracksModel::last_column); });
}

}  // namespace eyrie::ui
