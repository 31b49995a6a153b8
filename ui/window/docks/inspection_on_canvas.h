#pragma once

#include <functional>

namespace eyrie::ui {

class DockRegistry;
class Inspection;
class OverlaySettings;
class ProjectSession;
class ReviewDocks;
class VideoView;

/// What is joined. All must outlive the window's docks.
struct InspectionParts {
    ProjectSession& session;
    Inspection& inspection;
    VideoView& canvas;
    OverlaySettings& overlays;
    DockRegistry& docks;
    ReviewDocks& review;
    std::function<void()> start_run;  ///< with the parameters as they stand in the form
};

/// Lets a click on the canvas choose what is looked into, shows there its search area, while a dock explains it, and
/// the image stacks, and does what the dock Stacks asks for.
void joinInspection(const InspectionParts& parts);

}  // namespace eyrie::ui
