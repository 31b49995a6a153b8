#pragma once

namespace eyrie::ui {

class DockRegistry;
class EventsDock;
class ProjectSession;
class ReviewDocks;

/// Joins the list of tracks and the queue of events, which know nothing of each other: what tracks did is asked of the
/// events found, the filter of tracks narrows events, and tracks have pictures of where they are seen best. All must
/// outlive the window's docks.
void joinTracksAndEvents(ReviewDocks& review, EventsDock& events, DockRegistry& docks, ProjectSession& session);

}  // namespace eyrie::ui
