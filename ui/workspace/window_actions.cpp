#include "workspace/window_actions.h"

#include <QActionGroup>
#include <QIcon>
#include <QMenu>
#include <QWidget>
#include <utility>

#include "canvas/layers/overlay_table.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

/// Overlays have Alt and a letter in every workspace: letters alone belong to what a workspace is there for.
QKeySequence onOverlay(Qt::Key key) {
    return QKeySequence(QKeyCombination(Qt::AltModifier, key));
}

}  // namespace

WindowActions::WindowActions(OverlaySettings& overlays, QWidget* parent) : QObject(parent), parent_(parent) {
    section(tr("&File"));
    open_video = add(tr("Open &video…"), {"document-open", {QKeySequence::Open}});
    open_folder = add(tr("Open folder of &images…"), {"document-open-folder", {QKeySequence(tr("Ctrl+Shift+O"))}});
    watch_live = add(tr("Watch a &live source…"),
                     {"camera-video", {}, QT_TR_NOOP("A camera or stream on the net, recorded as it comes")});
    open_project = add(tr("Open &project…"), {"project-open", {QKeySequence(tr("Ctrl+P"))}});
    save_as = add(tr("&Save project as…"), {"document-save-as",
                                            {QKeySequence(tr("Ctrl+Shift+S"))},
                                            QT_TR_NOOP("Save under another name, and go on working there")});
    save_copy = add(tr("Save a &copy…"), {"document-save", {}, QT_TR_NOOP("Save a copy, and go on working here")});
    restore_state = add(tr("Restore an &earlier state…"),
                        {"document-revert", {}, QT_TR_NOOP("What the project held on earlier days")});
    group();
    export_tracks = add(tr("E&xport tracks…"),
                        {"document-export",
                         {QKeySequence(tr("Ctrl+Shift+X"))},
                         QT_TR_NOOP("Write the tracks of this run for other programs, or into a copy of the video")});
    start_time =
        add(tr("Start &time…"),
            {nullptr, {}, QT_TR_NOOP("When the video was taken, so that clock times stand beside its frames")});
    report = add(tr("Evaluation &report…"), {"document-export",
                                             {QKeySequence(tr("Ctrl+Shift+R"))},
                                             QT_TR_NOOP("Write the evaluation as one HTML or PDF file")});
    group();
    demo = add(tr("Watch the &demo scene"), {"media-playback-start", {QKeySequence(tr("Ctrl+D"))}});
    your_name = add(tr("Your &name…"),
                    {"user-identity", {}, QT_TR_NOOP("The name that is kept with what you judge, check and correct")});
    group();
    quit = add(tr("&Quit"), {"application-exit", {QKeySequence(tr("Ctrl+Q"))}});

    section(tr("Ru&n"));
    run = add(tr("&Run"), {"media-record",
                           {QKeySequence(tr("Ctrl+R"))},
                           QT_TR_NOOP("Find and follow the moving vehicles, with the parameters shown")});
    stop = add(tr("S&top the run"), {"media-playback-stop",
                                     {QKeySequence(tr("Ctrl+."))},
                                     QT_TR_NOOP("Stop the run; the frames done so far are kept")});
    continue_run =
        add(tr("&Continue the run"), {"media-playback-start",
                                      {QKeySequence(tr("Ctrl+Shift+."))},
                                      QT_TR_NOOP("Continue the run that is shown from where it was stopped")});
    follow = addToggle(tr("&Follow the run"),
                       {"go-last", {QKeySequence(tr("Ctrl+L"))}, QT_TR_NOOP("Show each frame as the run finishes it")},
                       false);

    group();
    restore_run =
        add(tr("Bring back the re&moved run"), {"edit-undo", {}, QT_TR_NOOP("Possible until the project is closed")});
    train =
        add(tr("Train from &labels…"), {nullptr, {}, QT_TR_NOOP("Train your own classifier for the sliding window")});

    section(tr("&Playback"));
    play = add(tr("&Play"), {"media-playback-start", {QKeySequence(Qt::Key_Space)}});
    group();
    step_back =
        add(tr("Step back"), {"media-skip-backward", {QKeySequence(Qt::Key_Left), QKeySequence(Qt::Key_Comma)}});
    step_on =
        add(tr("Step forward"), {"media-skip-forward", {QKeySequence(Qt::Key_Right), QKeySequence(Qt::Key_Period)}});
    jump_back = add(tr("10 frames back"), {"media-seek-backward", {QKeySequence(tr("Shift+Left"))}});
    jump_on = add(tr("10 frames forward"), {"media-seek-forward", {QKeySequence(tr("Shift+Right"))}});
    first = add(tr("First frame"), {"go-first", {QKeySequence(Qt::Key_Home)}});
    last = add(tr("Last frame"), {"go-last", {QKeySequence(Qt::Key_End)}});
    go_to_frame = add(tr("&Go to frame…"), {"go-jump", {QKeySequence(Qt::Key_G)}});
    group();
    shuttle_back = add(tr("Play backwards, again: faster"), {nullptr, {QKeySequence(Qt::Key_J)}});
    shuttle_stop = add(tr("Pause"), {"media-playback-pause", {QKeySequence(Qt::Key_K)}});
    shuttle_on = add(tr("Play forwards, again: faster"), {nullptr, {QKeySequence(Qt::Key_L)}});
    slower = add(tr("Slower"), {nullptr, {QKeySequence(tr("<"))}});
    faster = add(tr("Faster"), {nullptr, {QKeySequence(tr(">"))}});
    group();
    loop = addToggle(tr("Play in a loop"), {"media-playlist-repeat", {QKeySequence(tr("Shift+Space"))}}, false);

    only_moving =
        addToggle(tr("Play only where something &moves"),
                  {"media-skip-forward",
                   {QKeySequence(tr("Ctrl+Space"))},
                   QT_TR_NOOP("Skip stretches in which nothing drives; what could not be searched is played")},
                  false);

    addEvents();

    section(tr("Evaluat&ion"));
    next_error = add(tr("&Next error"), {"go-next", {QKeySequence(Qt::Key_F8)}});
    previous_error = add(tr("&Previous error"), {"go-previous", {QKeySequence(tr("Shift+F8"))}});
    why_error = add(tr("Wh&y this error?"), {"help-contextual",
                                             {QKeySequence(tr("Ctrl+Shift+W"))},
                                             QT_TR_NOOP("What decided at the place of the selected error")});
    wrong_truth =
        add(tr("The ground &truth is wrong here…"),
            {"document-edit",
             {QKeySequence(tr("Ctrl+T"))},
             QT_TR_NOOP("Open the object in the label workspace; the run is scored again after each change")});

    section(tr("Vie&w"));
    fit = add(tr("&Fit the window"), {"zoom-fit-best", {QKeySequence(Qt::Key_F)}});
    one_to_one = add(tr("Actual size (1:1)"), {"zoom-original", {QKeySequence(Qt::Key_0)}});
    zoom_in = add(tr("Zoom in"), {"zoom-in", {QKeySequence(Qt::Key_Plus), QKeySequence(Qt::Key_Equal)}});
    zoom_out = add(tr("Zoom out"), {"zoom-out", {QKeySequence(Qt::Key_Minus)}});
    look_left = addForKeys(tr("Look further left"), {QKeySequence(tr("Alt+Left"))});
    look_right = addForKeys(tr("Look further right"), {QKeySequence(tr("Alt+Right"))});
    look_up = addForKeys(tr("Look further up"), {QKeySequence(tr("Alt+Up"))});
    look_down = addForKeys(tr("Look further down"), {QKeySequence(tr("Alt+Down"))});
    timeline_in = addForKeys(tr("Zoom into the timeline"), {QKeySequence(tr("Ctrl++")), QKeySequence(tr("Ctrl+="))});
    timeline_out = addForKeys(tr("Zoom out of the timeline"), {QKeySequence(tr("Ctrl+-"))});
    group();
    steady = addToggle(tr("&Hold the ground still"),
                       {nullptr,
                        {QKeySequence(tr("Shift+G"))},
                        QT_TR_NOOP("Lay every frame on the ground as this one shows it: only what moves, moves")},
                       false);
    // The key has the same meaning in Label.
    follow_object = addToggle(tr("Keep the object centred"),
                              {nullptr,
                               {QKeySequence(Qt::Key_S)},
                               QT_TR_NOOP("Follow the selected vehicle: in the middle, heading up, and near")},
                              false);
    measure = addToggle(tr("&Measure"),
                        {nullptr,
                         {QKeySequence(tr("Ctrl+M"))},
                         QT_TR_NOOP("Click two places to measure the distance and, across two frames, the speed")},
                        false);
    even_picture = addToggle(tr("&Even out the contrast"),
                             {nullptr,
                              {QKeySequence(tr("Ctrl+H"))},
                              QT_TR_NOOP("Shows what lies in the dark or in haze; changes no result")},
                             false);
    group();
    show_mosaic =
        add(tr("M&osaic of the ground"),
            {nullptr,
             {QKeySequence(tr("Ctrl+Shift+M"))},
             QT_TR_NOOP("All ground that was seen, with the paths over it; click a place to see what happened there")});
    snapshot =
        add(tr("&Save what is seen…"),
            {"camera-photo", {QKeySequence(Qt::Key_F12)}, QT_TR_NOOP("The view with all overlays, as a PNG file")});
    snapshot_plain =
        add(tr("Save the &picture alone…"),
            {nullptr, {QKeySequence(tr("Shift+F12"))}, QT_TR_NOOP("The whole frame without overlays, as a PNG file")});
    group();
    deselect = add(tr("Clear the selection"), {nullptr, {QKeySequence(Qt::Key_Escape)}});
    why = add(tr("&Why?"), {"help-contextual",
                            {QKeySequence(tr("Shift+W"))},
                            QT_TR_NOOP("What decided about the place under the cursor")});
    live_preview = addToggle(tr("Live &preview of parameters"),
                             {nullptr,
                              {QKeySequence(tr("Ctrl+Shift+P"))},
                              QT_TR_NOOP("Show the current frame with the parameters of the form")},
                             true);
    compare = add(tr("&Compare A and B…"),
                  {nullptr,
                   {QKeySequence(tr("Ctrl+Shift+B"))},
                   QT_TR_NOOP("Two runs or sets of parameters on the same frames, side by side or with a wipe")});
    group();
    event_rows =
        addToggle(tr("Rows of event &kinds in the timeline"),
                  {nullptr, {}, QT_TR_NOOP("A thin row of the timeline for each kind of event that occurs")}, true);
    full_screen = addToggle(tr("Full screen"), {"view-fullscreen", {QKeySequence(Qt::Key_F11)}}, false);

    group();
    const QString workspace_names[] = {tr("&Review"), tr("&Label"), tr("&Tune")};
    const char* workspace_tips[] = {QT_TR_NOOP("Review what moved"), QT_TR_NOOP("Draw and check ground truth"),
                                    QT_TR_NOOP("Look into every stage of the chain and set its parameters")};
    auto* workspaces = new QActionGroup(this);
    for (std::size_t i = 0; i < workspace.size(); ++i) {
        workspace[i] =
            addToggle(workspace_names[i],
                      {nullptr, {QKeySequence(QStringLiteral("Ctrl+%1").arg(i + 1))}, workspace_tips[i]}, i == 0);
        workspaces->addAction(workspace[i]);
    }

    addOverlays(overlays);

    section(tr("&Help"));
    keys = add(tr("&Keys"), {"help-keybord-shortcuts", {QKeySequence(Qt::Key_F1), QKeySequence(tr("?"))}});
    about = add(tr("&About Eyrie"), {"help-about", {}});
}

void WindowActions::section(const QString& title) {
    sections_.append({title, {}});
}

void WindowActions::group() {
    group_begins_ = true;
}

void WindowActions::fill(QMenu& menu, const ActionSection& section) const {
    for (QAction* action : section.actions) {
        if (for_keys_.contains(action)) continue;
        if (group_starts_.contains(action)) menu.addSeparator();
        menu.addAction(action);
    }
}

QAction* WindowActions::add(const QString& text, const Look& look) {
    auto* action = new QAction(text, this);
    if (look.icon != nullptr) action->setIcon(QIcon::fromTheme(QString::fromLatin1(look.icon)));
    setTip(*action,
           look.tip != nullptr ? tr(look.tip) : QString(text).remove(QLatin1Char('&')).remove(QStringLiteral("…")));
    setKeys(*action, look.keys);
    parent_->addAction(action);
    sections_.back().actions.append(action);
    if (std::exchange(group_begins_, false)) group_starts_.insert(action);
    return action;
}

QAction* WindowActions::addToggle(const QString& text, const Look& look, bool checked) {
    QAction* action = add(text, look);
    action->setCheckable(true);
    action->setChecked(checked);
    return action;
}

QAction* WindowActions::addForKeys(const QString& text, const QList<QKeySequence>& shortcuts) {
    QAction* action = add(text, {nullptr, shortcuts});
    for_keys_.insert(action);
    return action;
}

void WindowActions::addEvents() {
    section(tr("&Events"));
    next_event = add(tr("&Next event"), {"go-next", {QKeySequence(tr("Ctrl+Down"))}});
    previous_event = add(tr("&Previous event"), {"go-previous", {QKeySequence(tr("Ctrl+Up"))}});
    next_open_event = add(tr("Next event to &judge"), {nullptr, {QKeySequence(tr("Ctrl+J"))}});
    group();
    relevant = add(
        tr("&Relevant"),
        {nullptr, {QKeySequence(Qt::Key_Y)}, QT_TR_NOOP("Judge the selected events relevant, and go on to the next")});
    not_relevant =
        add(tr("Not rele&vant"),
            {nullptr, {QKeySequence(Qt::Key_I)}, QT_TR_NOOP("Judge the selected events not relevant, and go on")});
    unsure =
        add(tr("&Unsure"),
            {nullptr, {QKeySequence(Qt::Key_H)}, QT_TR_NOOP("Look at the selected events again later, and go on")});
    take_back = add(tr("&Take the verdict back"), {nullptr, {QKeySequence(tr("Shift+Backspace"))}});
    star = add(tr("&Star or unstar"), {nullptr, {QKeySequence(tr("*"))}, QT_TR_NOOP("Star the selected events")});
    note = add(tr("&Write a note"), {nullptr, {QKeySequence(tr("Ctrl+E"))}});
    group();
    like_track = add(tr("Trac&ks like this one"),
                     {"edit-find",
                      {QKeySequence(tr("Ctrl+Shift+T"))},
                      QT_TR_NOOP("List tracks like the selected one, by path over the ground, speed and size")});
    add_track =
        addToggle(tr("&Add a vehicle that was missed"),
                  {"list-add",
                   {QKeySequence(Qt::Key_Insert)},
                   QT_TR_NOOP("Drag a box around a vehicle without a track; it is followed forwards and backwards "
                              "from there")},
                  false);
    // These keys have the same meaning in Label.
    join_tracks = addToggle(tr("Join in ti&me with…"),
                            {nullptr,
                             {QKeySequence(tr("Shift+J"))},
                             QT_TR_NOOP("The selected track and the one that is clicked next are the same vehicle")},
                            false);
    split_track = add(tr("Spl&it here"), {nullptr,
                                          {QKeySequence(tr("Shift+Y"))},
                                          QT_TR_NOOP("From this frame on, the selected track is another vehicle")});
    reject_tracks =
        add(tr("R&eject the selected tracks"),
            {nullptr,
             {QKeySequence(Qt::Key_Backspace)},
             QT_TR_NOOP("Nothing drives where the selected tracks are: leave them out of everything but the list of "
                        "tracks")});
    remove_correction =
        add(tr("Rem&ove the correction"),
            {"list-remove",
             {QKeySequence(tr("Shift+Insert"))},
             QT_TR_NOOP("Take back the last correction of each selected track: that it was added, joined, split or "
                        "rejected")});
    group();
    undo_verdict =
        add(tr("U&ndo"),
            {"edit-undo",
             {QKeySequence(Qt::Key_Z), QKeySequence(tr("Ctrl+Z"))},
             QT_TR_NOOP("Undo the last verdict, star, note, bookmark, correction of a track or change of a zone")});
    redo_verdict = add(tr("Re&do"), {"edit-redo", {QKeySequence(tr("Ctrl+Shift+Z")), QKeySequence(tr("Ctrl+Y"))}});
    group();
    report_events = add(tr("Report o&f the events…"),
                        {"document-export",
                         {QKeySequence(tr("Ctrl+Shift+V"))},
                         QT_TR_NOOP("Write events with pictures and verdicts as one HTML or PDF file")});
    clip_event = add(tr("&Clip of the event…"),
                     {"document-export",
                      {QKeySequence(tr("Ctrl+Shift+C"))},
                      QT_TR_NOOP("Save the selected event as a video of its own, with or without the tracks")});
    clip_track = add(tr("Clip of the track…"),
                     {nullptr, {}, QT_TR_NOOP("Save the part of the video in which the selected track lives")});
    bookmark = add(tr("&Bookmark this frame…"), {"bookmark-new",
                                                 {QKeySequence(tr("Ctrl+F9"))},
                                                 QT_TR_NOOP("Mark the frame with a note, or change the note it has")});
    next_bookmark = add(tr("Ne&xt bookmark"), {nullptr, {QKeySequence(Qt::Key_F9)}});
    previous_bookmark = add(tr("Previous boo&kmark"), {nullptr, {QKeySequence(tr("Shift+F9"))}});
    remove_bookmark = add(tr("Re&move the bookmark"), {nullptr, {QKeySequence(tr("Ctrl+Shift+F9"))}});
    group();
    draw_zone =
        addToggle(tr("Draw a &zone"),
                  {nullptr,
                   {QKeySequence(tr("Ctrl+Shift+A"))},
                   QT_TR_NOOP("Click the corners of an area to watch: which vehicles enter it, and which leave")},
                  false);
    draw_line =
        addToggle(tr("Draw a &line"),
                  {nullptr,
                   {QKeySequence(tr("Ctrl+Shift+L"))},
                   QT_TR_NOOP("Click the points of a line to watch: which vehicles cross it, and to which side")},
                  false);
    draw_arrow = addToggle(tr("Draw an arro&w"),
                           {nullptr,
                            {QKeySequence(tr("Ctrl+Shift+D"))},
                            QT_TR_NOOP("Click along a lane in the direction that is right there: who drives the other "
                                       "way drives against the flow")},
                           false);
    control_points = addToggle(tr("Set &ground control points"),
                               {nullptr,
                                {QKeySequence(tr("Ctrl+Shift+K"))},
                                QT_TR_NOOP("Click places that a map also shows, and enter their latitude and "
                                           "longitude, to lay the video on the earth")},
                               false);
}

void WindowActions::addOverlays(OverlaySettings& overlays) {
    section(tr("&Overlays"));
    for (const OverlayRow& row : overlayTable()) {
        QAction* action = addToggle(overlayName(row), {nullptr, {onOverlay(row.key)}}, overlays.isVisible(row.kind));
        overlay[row.kind] = action;
        bindSwitches(this, {{action, [&overlays, kind = row.kind](bool on) { overlays.setVisible(kind, on); }}});
    }
    const OverlayDetail& detail = overlays.style().detail;
    group();
    labels = addToggle(tr("Track la&bels"), {nullptr, {onOverlay(Qt::Key_B)}}, detail.labels);
    trails = addToggle(tr("Tr&ails"), {nullptr, {onOverlay(Qt::Key_A)}}, detail.trails);
    rejected = addToggle(tr("Re&jected detections"), {nullptr, {onOverlay(Qt::Key_X)}}, detail.rejected_detections);
    tentative = addToggle(tr("T&entative tracks"), {nullptr, {onOverlay(Qt::Key_Y)}}, detail.tentative_tracks);
    group();
    longer_vectors = add(tr("Longer vectors"), {nullptr, {onOverlay(Qt::Key_PageUp)}});
    shorter_vectors = add(tr("Shorter vectors"), {nullptr, {onOverlay(Qt::Key_PageDown)}});
    group();
    colour_blind =
        addToggle(tr("Colour-blind safe colours"), {nullptr, {}}, overlays.palette() == PaletteKind::colour_blind);
    hide_overlays =
        addToggle(tr("&Hide all overlays"),
                  {nullptr, {onOverlay(Qt::Key_0)}, QT_TR_NOOP("Show the picture alone; again: what was drawn before")},
                  overlays.hidden());
    const auto scale_vectors = [&overlays](double factor) {
        overlays.setVectorLengthFactor(overlays.style().detail.vector_length_factor * factor);
    };
    bindSwitches(
        this, {
                  {labels, [&overlays](bool on) { overlays.setLabels(on); }},
                  {trails, [&overlays](bool on) { overlays.setTrails(on); }},
                  {rejected, [&overlays](bool on) { overlays.setRejectedDetections(on); }},
                  {tentative, [&overlays](bool on) { overlays.setTentativeTracks(on); }},
                  {hide_overlays, [&overlays](bool on) { overlays.setHidden(on); }},
                  {colour_blind,
                   [&overlays](bool on) { overlays.setPalette(on ? PaletteKind::colour_blind : PaletteKind::thesis); }},
              });
    bindCommands(this, {{longer_vectors, [scale_vectors] { scale_vectors(1.5); }},
                        {shorter_vectors, [scale_vectors] { scale_vectors(1 / 1.5); }}});
    connect(&overlays, &OverlaySettings::changed, this, [this, &overlays] { followOverlays(overlays); });
}

void WindowActions::followOverlays(const OverlaySettings& overlays) {
    for (const OverlayRow& row : overlayTable()) overlay.at(row.kind)->setChecked(overlays.isVisible(row.kind));
    const OverlayDetail& detail = overlays.style().detail;
    labels->setChecked(detail.labels);
    trails->setChecked(detail.trails);
    rejected->setChecked(detail.rejected_detections);
    tentative->setChecked(detail.tentative_tracks);
    colour_blind->setChecked(overlays.palette() == PaletteKind::colour_blind);
    hide_overlays->setChecked(overlays.hidden());
}

}  // namespace eyrie::ui

#include "moc_window_actions.cpp"
