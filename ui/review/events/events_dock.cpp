#include "review/events/events_dock.h"

#include <algorithm>
#include <utility>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "review/bookmarks/bookmarks.h"
#include "review/bookmarks/bookmarks_panel.h"
#include "review/correct/track_correcting.h"
#include "review/events/event_kind_marks.h"
#include "review/events/event_review.h"
#include "review/events/event_text.h"
#include "review/events/event_thresholds.h"
#include "review/events/events_panel.h"
#include "review/events/left_list.h"
#include "review/pictures/picture_column.h"
#include "review/pictures/rows_ahead.h"
#include "review/runs/run_text.h"
#include "review/zones/zone_review.h"
#include "review/zones/zones_panel.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/message_bar.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"
#include "workspace/first_step.h"
#include "workspace/session_reactions.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

const QString kEventsTopic = QStringLiteral("events");
/// Of shorter videos the whole timeline tells more.
constexpr std::int64_t kLongVideo_us = 120'000'000;
constexpr std::int64_t kAroundEvent_us = 5'000'000;

/// What of several events in one place is to be seen: what is to be judged, what matters, what is doubtful.
int weightOf(Judgement judgement) {
    switch (judgement) {
        case Judgement::open:
            return 3;
        case Judgement::relevant:
            return 2;
        case Judgement::unsure:
            return 1;
        case Judgement::not_relevant:
            break;
    }
    return 0;
}

}  // namespace

EventsDock::EventsDock(const EventsParts& parts)
    : QObject(&parts.docks), parts_(parts), marks_due_(0, [this] { showMarks(); }) {
    review_ = new EventReview(parts_.session, reviewAnswers(), this);
    model_ = new EventsModel(this);
    panel_ = new EventsPanel(model_, parts_.actions);
    zones_ = new ZoneReview({parts_.session, parts_.canvas, parts_.actions, parts_.messages, *review_}, this);
    bookmarks_ = new Bookmarks(parts_.session, parts_.actions, *review_, this);
    correcting_ = new TrackCorrecting({parts_.session, parts_.canvas, parts_.actions, parts_.messages, *review_}, this);
    panel_->setZones(&zones_->panel());
    connect(zones_, &ZoneReview::listWanted, this, [this] {
        parts_.docks.raise(DockId::events);
        panel_->showZones(true);
    });
    parts_.docks.add(DockId::events, tr("Events"), panel_);
    followSession(parts_.session, this,
                  {{{SessionChange::video, SessionChange::current_run, SessionChange::run_preparing,
                     SessionChange::run_started, SessionChange::run_ended},
                    [this] { explainNothing(); }}});
    explainNothing();
    parts_.docks.watch(DockId::events, panel_, [this](bool visible) {
        if (visible) review_->setWanted();
    });
    parts_.docks.add(DockId::bookmarks, tr("Bookmarks"), &bookmarks_->panel());
    parts_.docks.watch(DockId::bookmarks, panel_, [this](bool visible) {
        if (visible) review_->setWanted();
    });
    new PictureColumn(*panel_, EventsModel::picture_column, parts_.session, [this](int id) {
        const auto place = placeOf(id);
        return place && model_->found() ? placeOfEvent(*model_->found(), *place) : std::nullopt;
    });
    new RowsAhead(*panel_, parts_.session, [this](int id) {
        const auto place = placeOf(id);
        return place && model_->found() ? std::optional(model_->found()->frameAt(*place)) : std::nullopt;
    });
    wireLists();
    bindCommands();
    review_->setOptions(panel_->thresholds().options());
    showEvents();
}

EventReviewAnswers EventsDock::reviewAnswers() {
    return {
        .show_events = [this] { showEvents(); },
        .show_verdicts = [this](const std::vector<std::size_t>& places) { showVerdicts(places); },
        .show_zones =
            [this] {
                if (zones_ == nullptr) return;
                zones_->showZones();
                marks_due_.start();
                enableActions();
                emit tracksRead();
            },
        .go_back_to =
            [this](const std::vector<std::size_t>& places) {
                if (!places.empty() && model_->recordAt(static_cast<int>(places.front())) != nullptr)
                    chooseAndShow(model_->recordAt(static_cast<int>(places.front()))->id);
            },
        .tell_problem =
            [this](const QString& text) { parts_.messages.showTopic(kEventsTopic, MessageKind::error, text); },
        .tell_notice =
            [this](const QString& text) {
                parts_.messages.showTopic(kEventsTopic, MessageKind::warning, capitalised(text));
            },
    };
}

void EventsDock::wireLists() {
    panel_->setCommands({.show = [this](int id) { show(id); },
                         .listing_changed = [this] { marks_due_.start(); },
                         .show_left = [this] { showLeft(); }});
    connect(&panel_->thresholds(), &EventThresholds::edited, this,
            [this] { review_->setOptions(panel_->thresholds().options()); });
    connect(model_, &EventsModel::noteEdited, this, &EventsDock::writeNote);
    connect(&parts_.timeline, &TimelineView::markClicked, this, [this](int id) {
        if (Bookmarks::isBookmark(id)) {
            bookmarks_->goTo(id);
            return;
        }
        parts_.docks.raise(DockId::events);
        chooseAndShow(id);
    });
}

void EventsDock::bindCommands() {
    const WindowActions& actions = parts_.actions;
    eyrie::ui::bindCommands(
        this, {
                  {actions.next_event, [this] { chooseAndShow(panel_->neighbour(1)); }},
                  {actions.previous_event, [this] { chooseAndShow(panel_->neighbour(-1)); }},
                  {actions.next_open_event, [this] { chooseAndShow(panel_->nextOpen(panel_->selectedIds())); }},
                  {actions.relevant, [this] { judge(Judgement::relevant); }},
                  {actions.not_relevant, [this] { judge(Judgement::not_relevant); }},
                  {actions.unsure, [this] { judge(Judgement::unsure); }},
                  {actions.take_back,
                   [this] {
                       if (anySelected()) review_->judge(placesInRows(), Judgement::open);
                   }},
                  {actions.star,
                   [this] {
                       if (anySelected()) toggleStars();
                   }},
                  {actions.note,
                   [this] {
                       parts_.docks.raise(DockId::events);
                       if (anySelected()) panel_->editNote(panel_->currentId());
                   }},
                  {actions.report_events,
                   [this] {
                       parts_.docks.raise(DockId::events);
                       panel_->chooseReport();
                   }},
                  {actions.undo_verdict, [this] { review_->undo(); }},
                  {actions.redo_verdict, [this] { review_->redo(); }},
              });
}

void EventsDock::setClock(const ClockOfFrames& clock) {
    model_->setClock(clock);
    bookmarks_->setClock(clock);
    if (left_list_ != nullptr) showCounts();
}

void EventsDock::setActive(bool active) {
    active_ = active;
    zones_->setActive(active);
    correcting_->setActive(active);
    enableActions();
    showMarks();
}

// ---- showing --------------------------------------------------------------------------------------------------------

void EventsDock::showEvents() {
    explainNothing();
    const auto& found = review_->found();
    // While a live run works it is read again and again; what was found before is the same still.
    const bool goes_on = found && model_->found() && found->former.lock() == model_->found();
    if (found && found->run != listed_run_ && !goes_on) model_->forgetIds();
    listed_run_ = found ? found->run : nullptr;
    panel_->showAsOf(review_->asOf());
    if (review_->state() != EventReview::State::failed) parts_.messages.dismissTopic(kEventsTopic);
    panel_->keepPlace(
        [&] { model_->setEvents(found, [this](std::size_t place) { return review_->verdictAt(place); }); });
    showCounts();
    zones_->showZones();
    showMarks();
    enableActions();
    emit eventsShown();
}

void EventsDock::showCounts() {
    const std::vector<LeftRow> left = leftRows(*review_, model_->clock());
    panel_->showCounts(review_->leftCount(), leftCorrections(left));
    if (left_list_ != nullptr) left_list_->setRows(left);
}

void EventsDock::showLeft() {
    if (left_list_ == nullptr)
        left_list_ = new LeftList(
            [this](FrameIndex frame) {
                parts_.session.playback().pause();
                parts_.session.goToFrame(frame);
            },
            panel_);
    showCounts();
    left_list_->show();
    left_list_->raise();
}

void EventsDock::explainNothing() {
    QString text;
    switch (review_->state()) {
        case EventReview::State::nothing:
            text = afterFirstStep(
                parts_.session,
                tr("What happened to the vehicles of a run is listed here: stops, turns back, lost in mid-picture "
                   "and more, what matters most first."));
            break;
        case EventReview::State::at_work:
            if (review_->asOf())
                text = tr("Nothing so far counts as an event with these limits.");
            else
                text = parts_.session.liveSource() != nullptr ? tr("Looking for events…")
                                                              : tr("Events are listed when the run ends.");
            break;
        case EventReview::State::searching:
            text = tr("Looking for events…");
            break;
        case EventReview::State::failed:
            text = tr("Events could not be read; the message over the video says why.");
            break;
        case EventReview::State::found: {
            const QString no_event = tr("Nothing that happened counts as an event with these limits.");
            text = !review_->found()->run->tracks.empty() ? no_event
                   : !review_->found()->run->corrections.rejected.empty()
                       ? tr("All tracks are rejected; the list of tracks still has them.")
                   : parts_.session.runData() ? whyNoTracks(parts_.session.runData()->facts)
                                              : no_event;
            break;
        }
    }
    panel_->emptyState()->setTexts(text);
}

void EventsDock::showVerdicts(const std::vector<std::size_t>& positions) {
    // One row after the other is cheap for a few; many at once are shown anew.
    constexpr std::size_t kFew = 64;
    if (positions.size() > kFew)
        model_->setEvents(review_->found(), [this](std::size_t place) { return review_->verdictAt(place); });
    else
        for (const std::size_t place : positions) model_->setVerdict(place, review_->verdictAt(place));
    showCounts();
    marks_due_.start();
    enableActions();
}

void EventsDock::showMarks() {
    marks_due_.stop();
    std::vector<TimelineMark> marks;
    std::vector<TimelineKind> kinds(kListedKinds);
    const auto& found = model_->found();
    const bool dark = isDark(parts_.timeline.palette());
    for (int row = 0; active_ && found && row < model_->rowCount(); ++row) {
        const EventEntry& entry = *model_->recordAt(row);
        if (!panel_->isShown(entry)) continue;
        marks.push_back({entry.id, found->frameAt(entry.position), judgementColour(entry.judgement, dark),
                         weightOf(entry.judgement)});
        const FrameSpan frames = found->framesAt(entry.position);
        kinds[static_cast<std::size_t>(listedKindAt(*found, entry.position))].happenings.push_back(
            {entry.id, frames.first, frames.last});
    }
    for (int kind = 0; kind < kListedKinds; ++kind) {
        TimelineKind& row = kinds[static_cast<std::size_t>(kind)];
        const EventKindMark& mark = markOf(kind);
        row.name = listedKindText(kind);
        row.on_light = groupColour(mark.group, false);
        row.on_dark = groupColour(mark.group, true);
        row.shape = mark.shape;
    }
    parts_.timeline.setKinds(std::move(kinds));
    if (active_)
        for (TimelineMark& mark : bookmarks_->marks(dark)) marks.push_back(std::move(mark));
    parts_.timeline.setMarks(tr("Events"), std::move(marks), [this](int id) { return markText(id); });
}

QString EventsDock::markText(int id) const {
    if (Bookmarks::isBookmark(id)) return bookmarks_->markText(id);
    const auto place = placeOf(id);
    if (!place || !model_->found()) return {};
    return model_->tipOf(*model_->recordAt(static_cast<int>(*place)));
}

void EventsDock::enableActions() {
    const WindowActions& actions = parts_.actions;
    const bool any = active_ && review_->count() > 0;
    const bool judgeable = any && !review_->asOf();
    for (QAction* action : {actions.next_event, actions.previous_event, actions.next_open_event})
        action->setEnabled(any);
    for (QAction* action :
         {actions.relevant, actions.not_relevant, actions.unsure, actions.take_back, actions.star, actions.note})
        action->setEnabled(judgeable);
    actions.report_events->setEnabled(active_ && review_->found());
    bookmarks_->enableActions(active_);
    correcting_->enableActions();
    actions.undo_verdict->setEnabled(active_ && review_->canUndo());
    actions.redo_verdict->setEnabled(active_ && review_->canRedo());
    const auto named = [](const QString& verb, const QString& step) {
        return step.isEmpty() ? verb : QStringLiteral("%1: %2").arg(verb, step);
    };
    setTip(*actions.undo_verdict, named(tr("Undo"), review_->undoName()));
    setTip(*actions.redo_verdict, named(tr("Redo"), review_->redoName()));
}

// ---- going ----------------------------------------------------------------------------------------------------------

std::optional<std::size_t> EventsDock::placeOf(int id) const {
    const EventEntry* entry = model_->recordAt(model_->rowOf(id));
    return entry != nullptr ? std::optional(entry->position) : std::nullopt;
}

std::optional<std::size_t> EventsDock::currentPlace() const {
    return placeOf(panel_->currentId());
}

void EventsDock::chooseAndShow(std::optional<int> id) {
    if (!id) return;
    panel_->selectId(model_->rowIdOf(*id));
    show(*id);
}

void EventsDock::show(int id) {
    const auto place = placeOf(id);
    if (!place) return;
    const FoundEvents& found = *model_->found();
    const Event* event = found.eventAt(*place);
    parts_.session.playback().pause();
    tell_shown_(model_->rowIdOf(id));  // first: what shows it need not show its track alone before
    if (event != nullptr && !event->tracks.empty())
        parts_.session.selectTrack(event->tracks.front());
    else
        parts_.session.selectTrack(std::nullopt);
    parts_.session.goToFrame(found.frameAt(*place));
    zoomTimelineTo(found.framesAt(*place));
    if (event != nullptr) bringIntoView(QPointF(event->place.x, event->place.y));
}

void EventsDock::writeNote(int id, const QString& note) {
    if (const auto place = placeOf(id)) review_->setNote(*place, note);
}

void EventsDock::writeTags(int id, const QString& tags) {
    if (const auto place = placeOf(id)) review_->setTags(*place, tags);
}

QString EventsDock::tagsOn(int id) const {
    const auto place = placeOf(id);
    const Verdict* verdict = place ? review_->verdictAt(*place) : nullptr;
    return verdict == nullptr ? QString() : QString::fromStdString(tagText(verdict->tags));
}

void EventsDock::zoomTimelineTo(FrameSpan frames) {
    const auto& times = parts_.session.timesUs();
    if (times.empty() || times.back() - times.front() <= kLongVideo_us) return;
    parts_.timeline.showAround(frames.first, frames.last, kAroundEvent_us);
}

void EventsDock::bringIntoView(QPointF place) {
    constexpr int kMargin = 40;  // px: what lies nearer to the edge is hardly seen
    VideoView& canvas = parts_.canvas;
    const QRectF seen = QRectF(canvas.rect()).adjusted(kMargin, kMargin, -kMargin, -kMargin);
    if (seen.contains(canvas.transform().viewFromImage(place))) return;
    // Where the whole picture is shown there is nothing to bring nearer.
    const QSizeF size = canvas.frame().image.size();
    const QRectF pixels(canvas.transform().viewFromImage({0, 0}),  // centres of the outermost ones
                        canvas.transform().viewFromImage({size.width() - 1, size.height() - 1}));
    if (!size.isEmpty() && QRectF(canvas.rect()).contains(pixels.normalized())) return;
    canvas.centreOn(place);
}

// ---- judging --------------------------------------------------------------------------------------------------------

std::vector<std::size_t> EventsDock::selectedPlaces() const {
    std::vector<std::size_t> places;
    for (const int id : panel_->selectedIds())
        if (const auto place = placeOf(id)) places.push_back(*place);
    return places;
}

std::vector<std::size_t> EventsDock::placesInRows() const {
    std::vector<std::size_t> places;
    for (const std::size_t place : selectedPlaces()) {
        const std::vector<std::size_t>& others = model_->recordAt(static_cast<int>(place))->others;
        places.push_back(place);
        places.insert(places.end(), others.begin(), others.end());
    }
    return places;
}

/// Tells where none is.
bool EventsDock::anySelected() {
    const bool any = !panel_->selectedIds().isEmpty();
    if (!any) parts_.messages.showTopic(kEventsTopic, MessageKind::info, tr("Select an event first."));
    return any;
}

void EventsDock::judge(Judgement judgement) {
    const QList<int> ids = panel_->selectedIds();
    if (ids.isEmpty()) {
        chooseAndShow(panel_->nextOpen({}));
        return;
    }
    // Asked for before: judged, rows may vanish from the list.
    const std::optional<int> next = panel_->nextOpen(ids);
    const std::vector<std::size_t> places = placesInRows();
    const bool all_so = std::all_of(places.begin(), places.end(), [&](std::size_t place) {
        const Verdict* verdict = review_->verdictAt(place);
        return verdict != nullptr && verdict->judgement == judgement;
    });
    if (!all_so && !review_->judge(places, judgement)) return;
    chooseAndShow(next);
}

void EventsDock::toggleStars() {
    const std::vector<std::size_t> places = selectedPlaces();
    const bool all_starred = std::all_of(places.begin(), places.end(), [&](std::size_t place) {
        const Verdict* verdict = review_->verdictAt(place);
        return verdict != nullptr && verdict->starred;
    });
    review_->setStarred(places, !all_starred);
}

}  // namespace eyrie::ui

#include "moc_events_dock.cpp"
