#include "workspace/workspaces.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QStatusBar>
#include <QToolBar>
#include <utility>

#include "canvas/layers/overlay_table.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

namespace {

constexpr int kLayoutVersion = 5;  ///< counts up when stored layouts no longer fit the docks
const QString kCurrent = QStringLiteral("current");
const QString kLayout = QStringLiteral("/layout");
const QString kOverlays = QStringLiteral("/overlays");

QString wordOf(OverlayKind kind) {
    return QString::fromLatin1(kind.word.data(), static_cast<qsizetype>(kind.word.size()));
}

OverlayProfile firstProfile(WorkspaceKind kind) {
    OverlayProfile profile;
    for (const OverlayRow& row : overlayTable())
        profile.set(row.kind, kind == WorkspaceKind::review  ? row.in_review
                              : kind == WorkspaceKind::label ? row.in_label
                                                             : row.in_tune);
    return profile;
}

}  // namespace

Workspaces::Workspaces(QMainWindow& window, DockRegistry& docks, OverlaySettings& overlays)
    : QObject(&window), window_(window), docks_(docks), overlays_(overlays) {
    for (const WorkspaceKind kind : allWorkspaces()) look(kind).overlays = firstProfile(kind);
}

void Workspaces::remember() {
    look(current_) = {alone_ ? layout_to_return_ : window_.saveState(kLayoutVersion), overlays_.profile()};
}

void Workspaces::showBars(bool shown) {
    for (QToolBar* bar : window_.findChildren<QToolBar*>(QString(), Qt::FindDirectChildrenOnly)) bar->setVisible(shown);
    window_.statusBar()->setVisible(shown);
}

void Workspaces::showPictureAlone(bool alone) {
    if (alone == std::exchange(alone_, alone)) return;
    if (alone) layout_to_return_ = window_.saveState(kLayoutVersion);
    showBars(!alone);
    if (!alone) {
        window_.restoreState(layout_to_return_, kLayoutVersion);
        return;
    }
    for (const DockId id : allDocks())
        if (docks_.dock(id) != nullptr) docks_.dock(id)->hide();
}

void Workspaces::show(WorkspaceKind kind) {
    current_ = kind;
    const bool alone = std::exchange(alone_, false);
    if (alone) showBars(true);
    // Overlays first: docks that come up may switch them for as long as they are looked at.
    overlays_.setProfile(look(kind).overlays);
    docks_.arrange(kind);
    if (!look(kind).layout.isEmpty()) window_.restoreState(look(kind).layout, kLayoutVersion);
    emit opened(kind);
    if (alone) showPictureAlone(true);
}

void Workspaces::open(WorkspaceKind kind) {
    if (kind == current_) return;
    emit leaving();
    remember();
    show(kind);
}

void Workspaces::fit() {
    if (look(current_).layout.isEmpty()) docks_.arrange(current_);
}

void Workspaces::reset() {
    emit leaving();
    look(current_) = {{}, firstProfile(current_)};
    show(current_);
}

QVariantMap Workspaces::state() {
    emit leaving();
    remember();
    QVariantMap state;
    state[kCurrent] = wordOf(current_);
    for (const WorkspaceKind kind : allWorkspaces()) {
        if (look(kind).layout.isEmpty()) continue;
        QVariantMap shown;
        for (const OverlayRow& row : overlayTable())
            shown[wordOf(row.kind)] = look(kind).overlays.visible.contains(row.kind);
        state[wordOf(kind) + kLayout] = look(kind).layout;
        state[wordOf(kind) + kOverlays] = shown;
    }
    return state;
}

void Workspaces::restore(const QVariantMap& state) {
    for (const WorkspaceKind kind : allWorkspaces()) {
        look(kind).layout = state.value(wordOf(kind) + kLayout).toByteArray();
        // What is not known of an overlay, which the version before did not have, is as at the first start.
        look(kind).overlays = firstProfile(kind);
        const QVariantMap shown = state.value(wordOf(kind) + kOverlays).toMap();
        for (const OverlayRow& row : overlayTable())
            if (shown.contains(wordOf(row.kind))) look(kind).overlays.set(row.kind, shown[wordOf(row.kind)].toBool());
    }
    show(workspaceOf(state.value(kCurrent).toString()).value_or(WorkspaceKind::review));
}

}  // namespace eyrie::ui
