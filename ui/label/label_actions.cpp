#include "label/label_actions.h"

#include <QIcon>
#include <QSet>
#include <QWidget>

#include "label/label_classes.h"

namespace eyrie::ui {

LabelActions::LabelActions(KeyBindings& keys, QWidget& window, QWidget& canvas)
    : QObject(&window), keys_(keys), window_(window), canvas_(canvas) {
    section(tr("Labels"));
    undo = add(tr("&Undo"), {QKeySequence(Qt::Key_Z), QKeySequence(tr("Ctrl+Z"))});
    redo = add(tr("&Redo"), {QKeySequence(tr("Ctrl+Shift+Z")), QKeySequence(tr("Ctrl+Y"))});
    undo->setIcon(QIcon::fromTheme(QStringLiteral("edit-undo")));
    redo->setIcon(QIcon::fromTheme(QStringLiteral("edit-redo")));
    import_labels = add(tr("&Import labels…"), {QKeySequence(tr("Ctrl+I"))});
    export_labels = add(tr("&Export labels…"), {QKeySequence(tr("Ctrl+Shift+E"))});
    import_labels->setIcon(QIcon::fromTheme(QStringLiteral("document-import")));
    export_labels->setIcon(QIcon::fromTheme(QStringLiteral("document-export")));
    try_to_write = add(tr("Try again to label in this window"), {});

    section(tr("Box"));
    draw =
        addToggle(tr("&Draw: click the rear, then the front (Shift: then a side)"), {QKeySequence(Qt::Key_B)}, false);
    draw->setIcon(QIcon::fromTheme(QStringLiteral("draw-rectangle")));
    draw->setIconText(tr("Draw"));
    redraw = add(tr("Redraw the selected object's box in this frame"), {QKeySequence(tr("Ctrl+B"))});
    region = addToggle(tr("Draw an ignore region: click its corners, double-click to finish"),
                       {QKeySequence(tr("Ctrl+G"))}, false);
    delete_region = add(tr("Delete the ignore region under the cursor"), {QKeySequence(tr("Ctrl+Shift+G"))});
    region_begins = add(tr("Begin the ignore region under the cursor here"), {QKeySequence(tr("Ctrl+["))});
    region_ends = add(tr("End the ignore region under the cursor here"), {QKeySequence(tr("Ctrl+]"))});
    region_anchor =
        add(tr("Fix the ignore region under the cursor to the ground or to the image"), {QKeySequence(tr("Alt+G"))});
    keyframe = add(tr("Set a keyframe here"), {QKeySequence(Qt::Key_R)});
    spread_size = add(tr("Apply this size to all keyframes of the object"), {QKeySequence(tr("Shift+K"))});
    spread_correction = add(tr("Apply this correction to all keyframes of the object"), {QKeySequence(tr("Ctrl+K"))});
    fit_pictures =
        add(tr("Refine the object's computed boxes, guided by those set by hand"), {QKeySequence(tr("Ctrl+F"))});
    carry_corrections = addToggle(tr("Carry corrections over to computed keyframes"), {}, true);
    copy_on = add(tr("Copy the box to the next frame and go there"), {QKeySequence(Qt::Key_C)});
    copy_back = add(tr("Copy the box to the previous frame and go there"), {QKeySequence(tr("Shift+C"))});
    delete_keyframe = add(tr("Delete this keyframe"), {QKeySequence(Qt::Key_Delete)});
    delete_object = add(tr("Delete the object"), {QKeySequence(tr("Shift+Delete"))});
    end_here = add(tr("The object ends here"), {QKeySequence(Qt::Key_T)});
    occluded = add(tr("Occluded: no, partly, fully"), {QKeySequence(Qt::Key_O)});
    outside = add(tr("Outside the image from here"), {QKeySequence(tr("Shift+L"))});
    ignore = add(tr("Ignore from here"), {QKeySequence(tr("Shift+I"))});
    spread_flags =
        add(tr("Set these flags on the selected objects in the toolbar's frame range"), {QKeySequence(tr("Shift+O"))});
    turn_left = add(tr("Turn by 1° counter-clockwise"), {QKeySequence(Qt::Key_BracketLeft)});
    turn_right = add(tr("Turn by 1° clockwise"), {QKeySequence(Qt::Key_BracketRight)});
    const Qt::Key arrows[] = {Qt::Key_Left, Qt::Key_Right, Qt::Key_Up, Qt::Key_Down};
    const Qt::KeyboardModifier steps[] = {Qt::NoModifier, Qt::ControlModifier, Qt::ShiftModifier};
    const QString names[] = {tr("left"), tr("right"), tr("up"), tr("down")};
    const QString amounts[] = {tr("1 px"), tr("0.1 px"), tr("5 px")};
    for (std::size_t i = 0; i < nudge.size(); ++i)
        nudge[i] = add(tr("Move the box %1 by %2").arg(names[i % 4], amounts[i / 4]),
                       {QKeySequence(QKeyCombination(steps[i / 4], arrows[i % 4]))}, true);
    loupe = addToggle(tr("Loupe beside the cursor"), {QKeySequence(Qt::Key_M)}, true);
    stack_loupe = addToggle(tr("The object's image stack beside the loupe"), {QKeySequence(tr("Shift+M"))}, true);

    section(tr("Class"));
    for (std::size_t i = 0; i < object_class.size(); ++i)
        object_class[i] = add(classText(builtInClasses()[i].name), {QKeySequence(Qt::Key_1 + static_cast<int>(i))});

    section(tr("Go"));
    next_frame = add(tr("Next frame"), {QKeySequence(Qt::Key_D)});
    previous_frame = add(tr("Previous frame"), {QKeySequence(Qt::Key_A)});
    ten_on = add(tr("10 frames forward"), {QKeySequence(tr("Shift+D"))});
    ten_back = add(tr("10 frames back"), {QKeySequence(tr("Shift+A"))});
    next_object = add(tr("Next object"), {QKeySequence(Qt::Key_N)});
    previous_object = add(tr("Previous object"), {QKeySequence(tr("Shift+N"))});
    next_keyframe = add(tr("Next keyframe"), {QKeySequence(Qt::Key_E)});
    previous_keyframe = add(tr("Previous keyframe"), {QKeySequence(Qt::Key_Q)});
    next_attention = add(tr("Next frame that needs attention"), {QKeySequence(Qt::Key_W)});
    next_unchecked = add(tr("Next unchecked object"), {QKeySequence(Qt::Key_U)});
    follow = addToggle(tr("Keep the object centred"), {QKeySequence(Qt::Key_S)}, false);
    follow_upright = addToggle(tr("When centred, turn the picture so that the object points up"), {}, true);
    this_frame = addToggle(tr("List objects of this frame only"), {QKeySequence(tr("Shift+H"))}, false);
    deselect = add(tr("Stop drawing, clear the selection"), {QKeySequence(Qt::Key_Escape)});

    section(tr("Review"));
    checked = add(tr("Mark as checked"), {QKeySequence(Qt::Key_V)});
    questionable = add(tr("Mark as questionable"), {QKeySequence(Qt::Key_X)});
    unseen = add(tr("Mark as not checked"), {QKeySequence(tr("Shift+V"))});

    section(tr("Proposals"));
    proposals = addToggle(tr("Show tracks of the run as proposals"), {QKeySequence(Qt::Key_P)}, false);
    proposals->setIconText(tr("Proposals"));
    proposals->setIcon(QIcon::fromTheme(QStringLiteral("tools-wizard")));
    next_proposal = add(tr("Next proposal"), {QKeySequence(tr("Shift+P"))});
    accept = add(tr("Accept the selected proposals, or the one under the cursor"),
                 {QKeySequence(Qt::Key_Return), QKeySequence(Qt::Key_Enter)}, true);
    reject =
        add(tr("Reject the selected proposals, or the one under the cursor"), {QKeySequence(Qt::Key_Backspace)}, true);
    accept_all = add(tr("Accept all proposals of this frame"), {QKeySequence(tr("Shift+Return"))}, true);
    accept_range =
        add(tr("Accept all proposals in the toolbar's frame range"), {QKeySequence(tr("Ctrl+Return"))}, true);
    offer_again = add(tr("Offer rejected proposals again"), {});
    proposal_tolerance = add(tr("Keyframes of proposals…"), {});
    track_on = add(tr("Track the box forward"), {QKeySequence(tr("Shift+F"))});
    track_back = add(tr("Track the box backward"), {QKeySequence(tr("Shift+B"))});
    stop_tracking = add(tr("Stop tracking"), {});

    section(tr("Identity"));
    join = add(tr("&Join in time with…"), {QKeySequence(tr("Shift+J"))});
    fuse = add(tr("&Fuse in parallel with…"), {QKeySequence(tr("Ctrl+Shift+J"))});
    split = add(tr("&Split here"), {QKeySequence(tr("Shift+Y"))});
    swap = add(tr("S&wap the two selected from here"), {QKeySequence(tr("Shift+S"))});
    renumber = add(tr("&Renumber from here"), {QKeySequence(tr("Shift+R"))});
    delete_before = add(tr("Delete &before this frame"), {QKeySequence(tr("Ctrl+Backspace"))});
    delete_after = add(tr("Delete &after this frame"), {QKeySequence(tr("Ctrl+Delete"))});

    keys_.add({tr("Label"), sections_});
    connect(&keys_, &KeyBindings::keysChanged, this, &LabelActions::lendKeys);
}

void LabelActions::section(const QString& title) {
    sections_.append({title, {}});
}

QAction* LabelActions::add(const QString& text, const QList<QKeySequence>& keys, bool canvas_only) {
    auto* action = new QAction(text, this);
    setTip(*action, QString(text).remove(QLatin1Char('&')).remove(QStringLiteral("…")));
    setKeys(*action, keys);
    action->setEnabled(false);
    if (canvas_only) {
        action->setShortcutContext(Qt::WidgetShortcut);
        canvas_.addAction(action);
    } else {
        window_.addAction(action);
    }
    sections_.back().actions.append(action);
    return action;
}

QAction* LabelActions::addToggle(const QString& text, const QList<QKeySequence>& keys, bool on) {
    QAction* action = add(text, keys);
    action->setCheckable(true);
    action->setChecked(on);
    return action;
}

void LabelActions::setActive(bool active) {
    if (active == active_) return;
    active_ = active;
    for (const ActionSection& group : sections_)
        for (QAction* action : group.actions) action->setEnabled(active);
    lendKeys();
}

void LabelActions::lendKeys() {
    QSet<QKeySequence> taken;
    for (const ActionSection& group : sections_)
        for (QAction* action : group.actions)
            for (const QKeySequence& key : keys_.keysOf(action)) taken.insert(key);
    for (const KeyBindings::Group& other : keys_.groups()) {
        if (!other.title.isEmpty()) continue;
        for (const ActionSection& section : other.sections)
            for (QAction* action : section.actions) {
                QList<QKeySequence> kept;
                for (const QKeySequence& key : keys_.keysOf(action))
                    if (!active_ || !taken.contains(key)) kept << key;
                if (kept != action->shortcuts()) setKeys(*action, kept);
            }
    }
}

}  // namespace eyrie::ui

#include "moc_label_actions.cpp"
