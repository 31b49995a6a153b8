#include "review/earth/earth_dock.h"

#include <QHeaderView>
#include <QTableView>
#include <QVBoxLayout>

#include "canvas/video_view.h"
#include "review/earth/control_points_panel.h"
#include "review/earth/ground_control.h"
#include "review/earth/metadata_panel.h"
#include "review/earth/start_time.h"
#include "review/earth/video_earth.h"
#include "widgets/layout/scrolled.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
constexpr int kLeastRows = 5;  // of the table that can be seen at once
}

EarthDock::EarthDock(const EarthParts& parts) : QObject(&parts.docks), parts_(parts) {
    earth_ = new VideoEarth(parts_.session, this);
    metadata_ = new MetadataPanel(parts_.session, *earth_);
    control_ = new GroundControl({parts_.session, parts_.canvas, parts_.actions, parts_.messages, *earth_}, this);
    start_time_ = new StartTime({parts_.session, parts_.actions, parts_.messages, *earth_}, this);
    auto* content = new QWidget;
    auto* rows = new QVBoxLayout(content);
    rows->setContentsMargins(0, 0, 0, 0);
    rows->setSpacing(4);
    rows->addWidget(metadata_, 1);
    rows->addWidget(&control_->panel());
    metadata_->table()->setMinimumHeight(kLeastRows * metadata_->table()->verticalHeader()->defaultSectionSize());
    parts_.docks.add(DockId::metadata, tr("Metadata"), scrolled(content));
    bindCommands(this, {{parts_.actions.control_points, [this] { parts_.docks.raise(DockId::metadata); }}});
    parts_.docks.watch(DockId::metadata, metadata_, [this](bool visible) { metadata_->setLookedAt(visible); });
    whenAny(earth_, this, &EarthDock::showNorth, &VideoEarth::changed);
    whenAny(&parts_.canvas, this, &EarthDock::showNorth, &VideoView::frameGiven);
}

void EarthDock::showNorth() {
    const FrameIndex frame = parts_.canvas.frame().index;
    parts_.canvas.setNorth(frame, earth_->northOf(frame));
}

}  // namespace eyrie::ui

#include "moc_earth_dock.cpp"
