#pragma once

#include <QList>
#include <QObject>
#include <array>
#include <functional>

#include "workspace/workspace_kind.h"

class QDockWidget;
class QMainWindow;

namespace eyrie::ui {

/// Every dock of the window.
enum class DockId {
    runs,
    tracks,
    events,
    inspector,
    errors,
    evaluation,
    parameters,
    stages,
    stacks,
    why,
    stage_times,
    statistics,
    sweeps,
    objects,
    object,
    object_chips,
    mosaic,
    card,
    bookmarks,
    metadata
};
inline constexpr int kDockCount = 20;

constexpr std::array<DockId, kDockCount> allDocks() {
    std::array<DockId, kDockCount> ids{};
    for (int i = 0; i < kDockCount; ++i) ids[static_cast<std::size_t>(i)] = static_cast<DockId>(i);
    return ids;
}

/// The docks of a window, found by what they are, and where each lies in a workspace that is opened for the first time.
class DockRegistry : public QObject {
    Q_OBJECT

 public:
    /// `window` owns the docks.
    explicit DockRegistry(QMainWindow& window);

    /// Makes a dock around `content`, hidden until a workspace shows it.
    QDockWidget* add(DockId id, const QString& title, QWidget* content);
    /// Tells `looked_at` whenever the dock comes into view, and goes, as long as `watcher` lives.
    void watch(DockId id, QObject* watcher, const std::function<void(bool)>& looked_at);
    /// Null until it was added.
    QDockWidget* dock(DockId id) const { return docks_[static_cast<std::size_t>(id)]; }
    /// Those that a workspace shows at first, and besides in review and tune all that the chain has: for menus.
    QList<QDockWidget*> docksFor(WorkspaceKind workspace) const;
    /// Shows a dock and brings it to the front; one that the workspace does not show comes to the column where it
    /// lies in others.
    void raise(DockId id);
    /// Shows the docks of a workspace in their first places, and no others. In a narrow window the
    /// video comes first.
    void arrange(WorkspaceKind workspace);

 private:
    void tidySoon();
    void tidy();

    QMainWindow& window_;
    std::array<QDockWidget*, kDockCount> docks_{};
    WorkspaceKind arranged_ = WorkspaceKind::review;
    bool tidying_ = false;  ///< it will be done when the event loop is free
};

}  // namespace eyrie::ui
