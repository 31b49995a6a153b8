#include "window/docks/inspection_on_canvas.h"

#include <QDockWidget>
#include <algorithm>

#include "canvas/layers/stages/image_stack_layer.h"
#include "canvas/overlay_settings.h"
#include "canvas/video_view.h"
#include "session/project_session.h"
#include "tune/inspect/inspection.h"
#include "tune/inspect/stacks_panel.h"
#include "tune/inspect/stage_chips.h"
#include "tune/parameters/parameter_binding.h"
#include "widgets/wiring.h"
#include "window/docks/review_docks.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

void joinInspection(const InspectionParts& parts) {
    Inspection& inspection = parts.inspection;
    VideoView& canvas = parts.canvas;
    QObject::connect(&canvas, &VideoView::placeClicked, &inspection,
                     [&session = parts.session, &inspection](QPointF place, double margin) {
                         if (!session.selectedTrack()) inspection.choose(place, margin);
                     });
    const auto show_stacks = [&inspection, &canvas] {
        const ReplayView& view = *inspection.view();
        canvas.setStacks(view.wish.frame, stackMarks(view));
    };
    // Where neither is open, as for operators, a box of the chain would only puzzle.
    const QList<QDockWidget*> explaining{parts.docks.dock(DockId::stages), parts.docks.dock(DockId::stacks)};
    const auto show_area = [&inspection, &canvas, explaining] {
        const bool explained = std::any_of(explaining.begin(), explaining.end(),
                                           [](const QDockWidget* dock) { return !dock->isHidden(); });
        canvas.setInspectedArea(explained ? inspection.area() : std::nullopt);
    };
    whenChanged(inspection, &canvas, {{InspectionChange::choice, show_area}, {InspectionChange::view, show_stacks}});
    for (const DockId dock : {DockId::stages, DockId::stacks})
        parts.docks.watch(dock, &canvas, [show_area](bool /*visible*/) { show_area(); });
    const auto want_stacks = [&inspection, &overlays = parts.overlays] {
        inspection.wantStackOverlay(overlays.isVisible(ImageStackLayer::kKind));
    };
    whenAny(&parts.overlays, &inspection, want_stacks, &OverlaySettings::changed);
    ParameterBinding& parameters = parts.review.parameters();
    parts.review.stacks().setCommands({
        .show_place =
            [&canvas, &inspection](QPointF place) {
                canvas.centreOn(place);
                inspection.choose(place);
            },
        .run_with_stacking =
            [&parameters, start_run = parts.start_run] {
                parameters.adoptRunParameters();
                parameters.setValue("stacking.enabled", "true");
                start_run();
            },
    });
}

}  // namespace eyrie::ui
