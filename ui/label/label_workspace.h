#pragma once

#include <QList>
#include <QObject>
#include <QTimer>
#include <optional>

#include "label/computing/label_proposals.h"
#include "label/label_editor.h"
#include "label/label_session.h"

class QAction;
class QMainWindow;
class QMenu;
class QToolBar;

namespace eyrie::ui {

class ChipGrid;
class DockRegistry;
class KeyBindings;
class LabelActions;
class LabelChips;
class LabelFitting;
class LabelStacks;
class LabelTimeline;
class LabelTool;
class LabelTracking;
class MessageBar;
class ObjectInspector;
class ObjectsModel;
class ObjectsPanel;
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
    WindowActions& actions;
    DockRegistry& docks;
    KeyBindings& keys;
    QMainWindow& window;
};

/// The label workspace: its docks, its tool on the canvas and its keys, joined with the labels of the video shown.
class LabelWorkspace : public QObject {
    Q_OBJECT

 public:
    /// Everything named must outlive it.
    explicit LabelWorkspace(const LabelSurroundings& around);

    /// Gives or takes away the tool, the keys and the bars. Docks and overlays are the window's affair.
    void setActive(bool active);
    bool active() const { return active_; }
    QMenu* menu() const { return menu_; }

    LabelSession& labels() { return *labels_; }
    LabelEditor& editor() { return *editor_; }
    LabelTool& tool() { return *tool_; }
    LabelFitting& fitting() { return *fitting_; }
    LabelProposals& proposals() { return *proposals_; }
    LabelActions& actions() { return *actions_; }
    ObjectsPanel& objects() { return *objects_; }
    ObjectInspector& inspector() { return *inspector_; }
    ChipGrid& chips() { return *grid_; }

 private:
    void buildDocks();
    void buildToolBar();
    void buildMenu();
    void wireLabels();
    void wireTool();
    void wireEditActions();
    void wireGoActions();
    void turnBy(double radians);
    void wireProposals();
    void wireIdentity();
    void wireRanges();
    /// Shows what an identity verb would do; the same key once more does it.
    void offer(QAction* action, const std::function<std::optional<LabelEditor::Plan>()>& make);
    /// The range of frames set above the canvas; the whole video where none is.
    FrameRange markedRange() const;
    void wireFiles();
    void wireChips();
    void wireStacks();
    void showStack();
    void showChips();
    void labelsChanged();
    void showScene();
    void showList();
    void showObject();
    void showRows();
    void enableActions();
    void escape();
    void followObject();
    void selectProposal(const Proposal* proposal);
    void acceptSelected();
    void identityWithOther(bool fuse);
    void tell(const QString& text);
    std::optional<ObjectId> otherSelected() const;

    LabelSurroundings around_;
    bool active_ = false;
    bool refresh_due_ = false;
    /// What was shown and waits for its key.
    struct Planned {
        const QAction* action = nullptr;
        FrameIndex frame = 0;
        std::set<ObjectId> selection;
        std::optional<LabelEditor::Plan> plan;
    };
    Planned planned_;
    LabelSession* labels_;
    LabelProposals* proposals_;
    LabelEditor* editor_;
    LabelTool* tool_;
    LabelActions* actions_;
    LabelTracking* tracking_;
    LabelFitting* fitting_;
    ObjectsModel* model_;
    ObjectsPanel* objects_;
    ObjectInspector* inspector_;
    LabelChips* chips_;
    LabelStacks* stacks_;
    ChipGrid* grid_;
    QTimer chips_due_;
    bool chips_looked_at_ = false;
    QToolBar* bar_;
    QMenu* menu_;
};

}  // namespace eyrie::ui
