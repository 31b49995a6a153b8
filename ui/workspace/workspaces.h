#pragma once

#include <QObject>
#include <QVariantMap>
#include <array>

#include "canvas/overlay_settings.h"
#include "workspace/workspace_kind.h"

class QMainWindow;

namespace eyrie::ui {

class DockRegistry;

/// The workspaces of the window, one shown at a time: each with its own places of the docks and its own overlays, kept
/// while others are shown and from one start to the next.
class Workspaces : public QObject {
    Q_OBJECT

 public:
    /// Everything named must outlive it. Nothing is shown before restore().
    Workspaces(QMainWindow& window, DockRegistry& docks, OverlaySettings& overlays);

    WorkspaceKind current() const { return current_; }
    void open(WorkspaceKind kind);
    /// Arranges the docks for the size of the window, unless a person has arranged them before.
    void fit();
    /// Makes the workspace that is shown what it was when it was opened for the first time.
    void reset();

    /// Whether the picture is shown without docks, tool bars and status bar, also that of a workspace that is opened
    /// then. What is kept of a workspace, and comes back, is its layout with them.
    void showPictureAlone(bool alone);

    /// All workspaces, for settings.
    QVariantMap state();
    /// Shows the workspace that was shown when state() was asked for; with an empty map review, as at the first start.
    void restore(const QVariantMap& state);

 signals:
    /// Another workspace is about to be shown; what was switched for the moment is to be put back.
    void leaving();
    void opened(WorkspaceKind kind);

 private:
    struct Look {
        QByteArray layout;  ///< empty: never opened
        OverlayProfile overlays;
    };
    Look& look(WorkspaceKind kind) { return looks_[static_cast<std::size_t>(kind)]; }
    void remember();
    void showBars(bool shown);
    void show(WorkspaceKind kind);

    QMainWindow& window_;
    DockRegistry& docks_;
    OverlaySettings& overlays_;
    WorkspaceKind current_ = WorkspaceKind::review;
    std::array<Look, kWorkspaceCount> looks_;
    bool alone_ = false;           ///< the picture is
    QByteArray layout_to_return_;  ///< while it is
};

}  // namespace eyrie::ui
