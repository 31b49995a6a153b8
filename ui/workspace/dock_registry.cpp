#include "workspace/dock_registry.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QTabBar>
#include <QTimer>
#include <algorithm>
#include <utility>

#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

// Widths in px.
constexpr int kNarrow = 1500;  ///< below, the video comes first
constexpr int kOnlyColumn = 340;
constexpr int kOnlyTuneColumn = 430;   ///< all its tabs are seen
constexpr int kOnlyLabelColumn = 260;  ///< its bar and rows take from the video already
constexpr int kLeftColumn = 380;
constexpr int kRightColumn = 440;

/// The name of a dock in stored layouts: these words must not change.
const char* nameOf(DockId id) {
    switch (id) {
        case DockId::runs:
            return "runs";
        case DockId::tracks:
            return "tracks";
        case DockId::events:
            return "events";
        case DockId::inspector:
            return "inspector";
        case DockId::errors:
            return "errors";
        case DockId::evaluation:
            return "evaluation";
        case DockId::parameters:
            return "parameters";
        case DockId::stages:
            return "stages";
        case DockId::stacks:
            return "stacks";
        case DockId::why:
            return "why";
        case DockId::stage_times:
            return "stage_times";
        case DockId::statistics:
            return "statistics";
        case DockId::sweeps:
            return "sweeps";
        case DockId::objects:
            return "objects";
        case DockId::object:
            return "object";
        case DockId::object_chips:
            return "object_chips";
        case DockId::mosaic:
            return "mosaic";
        case DockId::card:
            return "card";
        case DockId::bookmarks:
            return "bookmarks";
        case DockId::metadata:
            return "metadata";
    }
    return "";
}

/// The docks of a workspace in two columns of tabs; the first of each is in front.
struct Columns {
    QList<DockId> left;
    QList<DockId> right;
};

Columns columnsOf(WorkspaceKind workspace) {
    switch (workspace) {
        case WorkspaceKind::review:
            return {{DockId::events, DockId::tracks, DockId::runs, DockId::bookmarks},
                    {DockId::card, DockId::inspector, DockId::mosaic, DockId::metadata}};
        case WorkspaceKind::label:
            return {{DockId::objects, DockId::runs}, {DockId::object, DockId::object_chips}};
        case WorkspaceKind::tune:
            break;
    }
    return {{DockId::runs, DockId::tracks, DockId::events, DockId::evaluation, DockId::errors, DockId::sweeps},
            {DockId::inspector, DockId::stages, DockId::stacks, DockId::parameters, DockId::why, DockId::stage_times,
             DockId::statistics}};
}

int onlyColumnOf(WorkspaceKind workspace) {
    switch (workspace) {
        case WorkspaceKind::label:
            return kOnlyLabelColumn;
        case WorkspaceKind::tune:
            return kOnlyTuneColumn;
        case WorkspaceKind::review:
            break;
    }
    return kOnlyColumn;
}

}  // namespace

DockRegistry::DockRegistry(QMainWindow& window) : QObject(&window), window_(window) {
    window_.setDockNestingEnabled(true);
    window_.setTabPosition(Qt::AllDockWidgetAreas, QTabWidget::North);
}

QDockWidget* DockRegistry::add(DockId id, const QString& title, QWidget* content) {
    auto* made = new QDockWidget(title, &window_);
    made->setObjectName(QString::fromLatin1(nameOf(id)));
    made->setWidget(content);
    window_.addDockWidget(Qt::LeftDockWidgetArea, made);
    made->hide();
    whenAny(made, this, &DockRegistry::tidySoon, &QDockWidget::visibilityChanged, &QDockWidget::topLevelChanged,
            &QDockWidget::dockLocationChanged);
    docks_[static_cast<std::size_t>(id)] = made;
    return made;
}

void DockRegistry::watch(DockId id, QObject* watcher, const std::function<void(bool)>& looked_at) {
    connect(dock(id), &QDockWidget::visibilityChanged, watcher, looked_at);
}

QList<QDockWidget*> DockRegistry::docksFor(WorkspaceKind workspace) const {
    // Whoever watches and whoever tunes look at the same runs.
    QList<DockId> ids;
    for (const WorkspaceKind kind : {WorkspaceKind::label, WorkspaceKind::tune, WorkspaceKind::review}) {
        if ((kind == WorkspaceKind::label) != (workspace == WorkspaceKind::label)) continue;
        const Columns columns = columnsOf(kind);
        for (const DockId id : columns.left + columns.right)
            if (!ids.contains(id)) ids.append(id);
    }
    QList<QDockWidget*> found;
    for (const DockId id : ids)
        if (dock(id) != nullptr) found.append(dock(id));
    return found;
}

void DockRegistry::raise(DockId id) {
    QDockWidget* wanted = dock(id);
    if (wanted == nullptr) return;
    if (wanted->isHidden()) {
        const Columns here = columnsOf(arranged_);
        if (!(here.left + here.right).contains(id)) {
            const bool on_left =
                columnsOf(WorkspaceKind::tune).left.contains(id) || columnsOf(WorkspaceKind::review).left.contains(id);
            QDockWidget* beside = dock(on_left ? here.left.back() : here.right.back());
            if (beside != nullptr && !beside->isHidden()) window_.tabifyDockWidget(beside, wanted);
        }
        wanted->show();
    }
    wanted->raise();
}

void DockRegistry::arrange(WorkspaceKind workspace) {
    arranged_ = workspace;
    for (QDockWidget* each : docks_)
        if (each != nullptr) each->hide();
    const bool narrow = window_.width() < kNarrow;
    const Columns columns = columnsOf(workspace);
    const auto present = [this](const QList<DockId>& ids) {
        QList<QDockWidget*> found;
        for (const DockId id : ids)
            if (dock(id) != nullptr) found << dock(id);
        return found;
    };
    const QList<QDockWidget*> left_docks = present(columns.left);
    const QList<QDockWidget*> right_docks = present(columns.right);
    if (left_docks.isEmpty() || right_docks.isEmpty()) return;
    QDockWidget* left = left_docks.front();
    QDockWidget* right = right_docks.front();
    for (QDockWidget* each : left_docks + right_docks) each->setFloating(false);
    window_.addDockWidget(Qt::LeftDockWidgetArea, left);
    // Before anything is tabbed: among tabs there is no splitting.
    if (narrow)
        window_.splitDockWidget(left, right, Qt::Vertical);
    else
        window_.addDockWidget(Qt::RightDockWidgetArea, right);
    for (const QList<QDockWidget*>& column : {left_docks, right_docks}) {
        for (QDockWidget* each : column.mid(1)) window_.tabifyDockWidget(column.front(), each);
        for (QDockWidget* each : column) each->show();
        column.front()->raise();
    }
    if (narrow) {
        window_.resizeDocks({left}, {onlyColumnOf(workspace)}, Qt::Horizontal);
        window_.resizeDocks({left, right}, {100, 100}, Qt::Vertical);
    } else {
        window_.resizeDocks({left, right}, {kLeftColumn, kRightColumn}, Qt::Horizontal);
    }
}

void DockRegistry::tidySoon() {
    if (std::exchange(tidying_, true)) return;
    QTimer::singleShot(0, this, [this] {
        tidying_ = false;
        tidy();
    });
}

/// A dock among tabs needs no title beside its tab. Tabs keep their whole names: cut down to a letter nobody knows
/// which is which, so that narrow docks scroll them instead.
void DockRegistry::tidy() {
    for (QDockWidget* each : docks_) {
        if (each == nullptr || each->isHidden()) continue;
        const QList<QDockWidget*> others = window_.tabifiedDockWidgets(each);
        const bool tabbed = !each->isFloating() && std::any_of(others.begin(), others.end(), [](QDockWidget* other) {
            return !other->isHidden() && !other->isFloating();
        });
        QWidget* bar = each->titleBarWidget();
        if (tabbed && bar == nullptr) each->setTitleBarWidget(new QWidget(each));
        if (!tabbed && bar != nullptr) {
            each->setTitleBarWidget(nullptr);
            delete bar;
        }
    }
    for (QTabBar* bar : window_.findChildren<QTabBar*>()) {
        bar->setElideMode(Qt::ElideNone);
        bar->setUsesScrollButtons(true);
    }
}

}  // namespace eyrie::ui

#include "moc_dock_registry.cpp"
