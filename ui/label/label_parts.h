#pragma once

#include <QString>

class QMainWindow;

namespace eyrie::ui {

class DockRegistry;
class KeyBindings;
class LabelActions;
class LabelEditor;
class LabelFitting;
class LabelProposals;
class LabelSession;
class LabelTimeline;
class LabelTool;
class LabelTracking;
class MessageBar;
class OverlayColumn;
class ProjectSession;
class TimelineView;
class VideoView;
class WindowActions;

/// What the label workspace says it says about this: one message at a time.
inline constexpr char kLabelTopic[] = "labelling";

/// What the label workspace is joined with.
struct LabelSurroundings {
    ProjectSession& session;
    VideoView& canvas;
    TimelineView& timeline;
    LabelTimeline& rows;
    MessageBar& messages;
    OverlayColumn& over_canvas;
    WindowActions& actions;
    DockRegistry& docks;
    KeyBindings& keys;
    QMainWindow& window;
};

/// What those who make up the label workspace work on; all of it outlives them.
struct LabelParts {
    LabelSurroundings around;
    LabelSession& labels;
    LabelProposals& proposals;
    LabelEditor& editor;
    LabelFitting& fitting;
    LabelTracking& tracking;
    LabelTool& tool;
    LabelActions& actions;

    /// Says something above the canvas, in place of what labelling said before.
    void tell(const QString& text) const;
};

}  // namespace eyrie::ui
