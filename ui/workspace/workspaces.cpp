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

/// Counts up when what was stored of a workspace no longer fits its docks, or they are arranged otherwise.
int layoutVersionOf(WorkspaceKind kind) {
    return kind == WorkspaceKind::label ? 7 : 5;  // 7: its runs can be chosen
}
const QString kCurrent = QStringLiteral("current");
const QString kLayout = QStringLiteral("/layout");
const QString kOverlays = QStringLiteral("/overlays");
const QString kDetail = QStringLiteral("/overlay_detail");
const QString kVectorLength = QStringLiteral("vector_length");

/// What of an overlay's detail is on or off, by the word under which settings keep it.
struct DetailSwitch {
    QString word;
    bool OverlayDetail::*shown;
};
const DetailSwitch kDetailSwitches[] = {{QStringLiteral("captions"), &OverlayDetail::labels},
                                        {QStringLiteral("trails"), &OverlayDetail::trails},
                                        {QStringLiteral("rejected"), &OverlayDetail::rejected_detections},
                                        {QStringLiteral("tentative"), &OverlayDetail::tentative_tracks}};

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

QVariantMap overlaysIn(const OverlayProfile& profile) {
    QVariantMap shown;
    for (const OverlayRow& row : overlayTable()) shown[wordOf(row.kind)] = profile.visible.contains(row.kind);
    return shown;
}

QVariantMap detailIn(const OverlayProfile& profile) {
    QVariantMap detail{{kVectorLength, profile.detail.vector_length_factor}};
    for (const DetailSwitch& each : kDetailSwitches) detail[each.word] = profile.detail.*each.shown;
    return detail;
}

/// What settings do not know, which the version before did not have, is as at the first start.
OverlayProfile profileFrom(WorkspaceKind kind, const QVariantMap& overlays, const QVariantMap& detail) {
    OverlayProfile profile = firstProfile(kind);
    for (const OverlayRow& row : overlayTable())
        if (overlays.contains(wordOf(row.kind))) profile.set(row.kind, overlays[wordOf(row.kind)].toBool());
    for (const DetailSwitch& each : kDetailSwitches)
        if (detail.contains(each.word)) profile.detail.*each.shown = detail[each.word].toBool();
    const double length = detail.value(kVectorLength).toDouble();
    if (length >= kShortestVectors && length <= kLongestVectors) profile.detail.vector_length_factor = length;
    return profile;
}

}  // namespace

Workspaces::Workspaces(QMainWindow& window, DockRegistry& docks, OverlaySettings& overlays)
    : QObject(&window), window_(window), docks_(docks), overlays_(overlays) {
    for (const WorkspaceKind kind : allWorkspaces()) look(kind).overlays = firstProfile(kind);
}

void Workspaces::remember() {
    look(current_) = {alone_ ? layout_to_return_ : window_.saveState(layoutVersionOf(current_)), overlays_.profile()};
}

void Workspaces::showBars(bool shown) {
    for (QToolBar* bar : window_.findChildren<QToolBar*>(QString(), Qt::FindDirectChildrenOnly)) bar->setVisible(shown);
    window_.statusBar()->setVisible(shown);
}

void Workspaces::showPictureAlone(bool alone) {
    if (alone == std::exchange(alone_, alone)) return;
    if (alone) layout_to_return_ = window_.saveState(layoutVersionOf(current_));
    showBars(!alone);
    if (!alone) {
        window_.restoreState(layout_to_return_, layoutVersionOf(current_));
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
    // One of an earlier arrangement is as good as none.
    if (!window_.restoreState(look(kind).layout, layoutVersionOf(kind))) look(kind).layout.clear();
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
        state[wordOf(kind) + kLayout] = look(kind).layout;
        state[wordOf(kind) + kOverlays] = overlaysIn(look(kind).overlays);
        state[wordOf(kind) + kDetail] = detailIn(look(kind).overlays);
    }
    return state;
}

void Workspaces::restore(const QVariantMap& state) {
    for (const WorkspaceKind kind : allWorkspaces()) {
        look(kind).layout = state.value(wordOf(kind) + kLayout).toByteArray();
        look(kind).overlays = profileFrom(kind, state.value(wordOf(kind) + kOverlays).toMap(),
                                          state.value(wordOf(kind) + kDetail).toMap());
    }
    show(workspaceOf(state.value(kCurrent).toString()).value_or(WorkspaceKind::review));
}

}  // namespace eyrie::ui

#include "moc_workspaces.cpp"
