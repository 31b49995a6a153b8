#pragma once

#include <QObject>
#include <optional>

#include "label/computing/label_proposals.h"
#include "label/editor/label_editor.h"
#include "label/label_parts.h"
#include "label/label_session.h"

class QAction;
class QMainWindow;
class QMenu;
class QToolBar;

namespace eyrie::ui {

class ChipGrid;
class IdentityCommands;
class ObjectInspector;
class ObjectPictures;
class ObjectsModel;
class ObjectsPanel;
class TrackingStrip;
struct ObjectEdits;

/// The label workspace: its docks, its bars and its tool on the canvas, which show the labels of the video. What its
/// commands do is told by LabelCommands and IdentityCommands, what objects look like by ObjectPictures.
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
    LabelTracking& tracking() { return *tracking_; }
    LabelProposals& proposals() { return *proposals_; }
    LabelActions& actions() { return *actions_; }
    ObjectsPanel& objects() { return *objects_; }
    ObjectInspector& inspector() { return *inspector_; }
    ChipGrid& chips();

 private:
    LabelParts parts();
    void buildDocks();
    void buildToolBar();
    void buildMenu();
    void wireLabels();
    void wireTool();
    void showDrawing(QAction& action, bool drawing);
    void chooseObject(std::optional<ObjectId> id, bool add);
    void chooseProposal(TrackId track, bool add);
    void buildWork();
    void wireObjects();
    ObjectEdits inspectorEdits();
    void labelsOpened();
    /// Says that labels are read-only here, and why, where they are.
    void tellRight();
    void selectionChanged();
    void pictureChanged();
    void labelsChanged();
    void showScene();
    void showList();
    void showObject();
    void showRows();
    /// Shows another object beside the selected one where they would be joined.
    void showCandidate(ObjectId other);
    void enableActions();
    void followObject();

    LabelSurroundings around_;
    bool active_ = false;
    bool refresh_due_ = false;
    LabelSession* labels_;
    LabelProposals* proposals_;
    LabelEditor* editor_;
    LabelTool* tool_;
    LabelActions* actions_;
    LabelTracking* tracking_;
    TrackingStrip* strip_;
    LabelFitting* fitting_;
    ObjectsModel* model_;
    ObjectsPanel* objects_;
    ObjectInspector* inspector_;
    IdentityCommands* identity_;
    ObjectPictures* pictures_;
    QToolBar* bar_;
    QMenu* menu_;
};

}  // namespace eyrie::ui
