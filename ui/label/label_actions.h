#pragma once

#include <QAction>
#include <QObject>
#include <array>

#include "workspace/key_bindings.h"

namespace eyrie::ui {

/// Every command of the label workspace as an action with text and key. They work in that workspace only; keys that the
/// window uses for something else elsewhere belong to labelling while it is active.
class LabelActions : public QObject {
    Q_OBJECT

 public:
    /// `window` carries the keys; those of `canvas` work only while it has the focus. `keys` knows the window's
    /// already.
    LabelActions(KeyBindings& keys, QWidget& window, QWidget& canvas);

    const QList<ActionSection>& sections() const { return sections_; }
    void setActive(bool active);
    bool active() const { return active_; }

    QAction *undo, *redo, *import_labels, *export_labels, *try_to_write;
    QAction *draw, *redraw, *region, *delete_region, *region_begins, *region_ends, *region_anchor, *loupe, *stack_loupe,
        *keyframe, *spread_size, *spread_correction, *fit_pictures, *carry_corrections, *copy_on, *copy_back,
        *delete_keyframe, *delete_object, *end_here, *occluded, *outside, *ignore, *spread_flags, *turn_left,
        *turn_right;
    std::array<QAction*, 12> nudge;  ///< left, right, up, down: by 1, then by 0.1, then by 5 px
    std::array<QAction*, 8> object_class;
    QAction *next_frame, *previous_frame, *ten_on, *ten_back, *next_object, *previous_object, *next_keyframe,
        *previous_keyframe, *next_attention, *next_unchecked, *follow, *follow_upright, *this_frame, *deselect;
    QAction *checked, *questionable, *unseen;
    QAction *proposals, *accept, *accept_all, *accept_range, *reject, *next_proposal, *offer_again, *proposal_tolerance;
    QAction *track_on, *track_back, *stop_tracking;
    QAction *join, *fuse, *split, *swap, *renumber, *delete_before, *delete_after;

 private:
    void section(const QString& title);
    QAction* add(const QString& text, const QList<QKeySequence>& keys, bool canvas_only = false);
    QAction* addToggle(const QString& text, const QList<QKeySequence>& keys, bool on);

    /// The window's commands lose the keys that labelling has, or get them back.
    void lendKeys();

    KeyBindings& keys_;
    QWidget& window_;
    QWidget& canvas_;
    QList<ActionSection> sections_;
    bool active_ = false;
};

}  // namespace eyrie::ui
