#pragma once

#include <QAction>
#include <QList>
#include <QObject>
#include <QSet>
#include <array>
#include <map>

#include "canvas/overlay_settings.h"
#include "workspace/key_bindings.h"
#include "workspace/workspace_kind.h"

class QMenu;

namespace eyrie::ui {

/// Every command of the window as an action with text, icon and key. Knows nothing of what they do, except that the
/// overlay actions switch the overlays.
class WindowActions : public QObject {
    Q_OBJECT

 public:
    /// `overlays` and `parent` must outlive the actions. The actions are added to `parent`, so that their keys work.
    WindowActions(OverlaySettings& overlays, QWidget* parent);

    QAction* workspaceAction(WorkspaceKind kind) const { return workspace[static_cast<std::size_t>(kind)]; }
    /// In the order of the menus.
    const QList<ActionSection>& sections() const { return sections_; }
    /// Adds the actions of a section, with a line between groups of them.
    void fill(QMenu& menu, const ActionSection& section) const;

    QAction *open_video, *open_folder, *watch_live, *open_project, *save_as, *save_copy, *restore_state, *start_time,
        *export_tracks, *demo, *your_name, *quit;
    QAction *run, *stop, *continue_run, *follow, *restore_run;
    QAction *play, *step_back, *step_on, *jump_back, *jump_on, *first, *last, *go_to_frame, *shuttle_back,
        *shuttle_stop, *shuttle_on, *slower, *faster, *loop, *only_moving;
    QAction *fit, *one_to_one, *zoom_in, *zoom_out, *look_left, *look_right, *look_up, *look_down, *timeline_in,
        *timeline_out, *steady, *follow_object, *measure, *even_picture, *snapshot, *snapshot_plain, *show_mosaic,
        *event_rows, *full_screen, *deselect;
    QAction *next_error, *previous_error, *why_error, *wrong_truth, *report;
    QAction *next_event, *previous_event, *next_open_event, *relevant, *not_relevant, *unsure, *take_back, *star, *note,
        *like_track, *add_track, *join_tracks, *split_track, *reject_tracks, *remove_correction, *undo_verdict,
        *redo_verdict, *report_events, *clip_event, *clip_track, *draw_zone, *draw_line, *draw_arrow, *control_points,
        *bookmark, *next_bookmark, *previous_bookmark, *remove_bookmark;
    QAction *why, *live_preview, *compare, *train;
    std::array<QAction*, kWorkspaceCount> workspace;
    std::map<OverlayKind, QAction*> overlay;
    QAction *labels, *trails, *rejected, *tentative, *longer_vectors, *shorter_vectors, *colour_blind, *hide_overlays;
    QAction *keys, *about;

 private:
    struct Look {
        const char* icon = nullptr;
        QList<QKeySequence> keys;
        const char* tip = nullptr;
    };
    void section(const QString& title);
    /// The next action begins a group of its section.
    void group();
    QAction* add(const QString& text, const Look& look);
    QAction* addToggle(const QString& text, const Look& look, bool checked);
    /// What only who has no mouse needs: it stands on the sheet of keys, not in the menu.
    QAction* addForKeys(const QString& text, const QList<QKeySequence>& shortcuts);
    void addEvents();
    void addOverlays(OverlaySettings& overlays);
    void followOverlays(const OverlaySettings& overlays);

    QWidget* parent_;
    QList<ActionSection> sections_;
    QSet<const QAction*> group_starts_;
    QSet<const QAction*> for_keys_;
    bool group_begins_ = false;
};

}  // namespace eyrie::ui
