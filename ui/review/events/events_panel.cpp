#include "review/events/events_panel.h"

#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QLocale>
#include <QMenu>
#include <QTableView>
#include <QToolButton>
#include <QVBoxLayout>

#include "review/events/event_cells.h"
#include "review/events/event_thresholds.h"
#include "review/tracks/track_query.h"
#include "widgets/layout/flow_layout.h"
#include "widgets/tables/table_roles.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

/// Choices of the box of verdicts.
enum VerdictFilter { kAllVerdicts, kToJudge, kRelevant, kNotRelevant, kUnsure, kStarred, kWithNote, kWithTags };

QToolButton* buttonOf(QAction* action, const QString& text) {
    auto* button = new QToolButton;
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonTextOnly);
    button->setText(text);
    button->setFocusPolicy(Qt::NoFocus);  // keys go on working on the list
    // The button takes over the action's text whenever that changes.
    QObject::connect(action, &QAction::changed, button, [button, text] { button->setText(text); });
    return button;
}

}  // namespace

EventsPanel::EventsPanel(EventsModel* model, const WindowActions& actions, QWidget* parent)
    :  // Not "events": there the first column once was the place in the queue, and lists were sorted by it.
      TablePanel(model, QStringLiteral("numbered_events"), parent, std::nullopt),
      events_(model),
      actions_(actions),
      header_(new QLabel(this)),
      kinds_(new EventKindsButton(this)),
      verdicts_(new QComboBox(this)),
      thresholds_(new EventThresholds(this)) {
    table()->setAccessibleName(tr("Events"));
    table()->setItemDelegate(new EventCells(table()));
    events_->setDark(isDark(palette()));
    header_->setContentsMargins(4, 2, 4, 0);
    header_->setTextFormat(Qt::RichText);
    header_->setWordWrap(true);
    whenAny(
        header_, this, [this] { commands_.show_left(); }, &QLabel::linkActivated);
    auto* rows = static_cast<QVBoxLayout*>(layout());
    rows->insertWidget(0, header_);
    rows->setStretch(2, 2);
    placeAtFirst({EventsModel::duration_column}, EventsModel::figure_column);
    hideAtFirst({EventsModel::lowest_column, EventsModel::highest_column}, EventsModel::duration_column);
    hideAtFirst({EventsModel::picture_column}, EventsModel::number_column);
    hideAtFirst({EventsModel::tags_column}, EventsModel::note_column);
    buildFilters();
    buildButtons();
    rows->addWidget(thresholds_, 3);
    thresholds_->hide();
    events_->setListed([this](const EventEntry& entry) { return isListed(entry); });
    whenAny(&proxy(), this, &EventsPanel::rowsFiltered, &TableSortProxy::filtered);
    filterEvents();
}

void EventsPanel::buildFilters() {
    verdicts_->addItems({tr("All verdicts"), tr("To judge"), tr("Relevant"), tr("Not relevant"), tr("Unsure"),
                         tr("Starred"), tr("With a note"), tr("With tags")});
    verdicts_->setAccessibleName(tr("Verdicts that are listed"));
    verdicts_->setToolTip(tr("Which events are listed, by verdict"));
    verdicts_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    verdicts_->setMinimumContentsLength(8);
    toolRow()->addWidget(kinds_);
    toolRow()->addWidget(verdicts_);
    onEdited(this, &EventsPanel::filterEvents, verdicts_);
    connect(kinds_, &EventKindsButton::edited, this, &EventsPanel::filterEvents);
}

void EventsPanel::buildButtons() {
    auto* line = new QWidget(this);
    auto* buttons = new FlowLayout(line, 2);
    buttons->setContentsMargins(2, 0, 2, 2);
    buttons->addWidget(buttonOf(actions_.relevant, tr("Relevant")));
    buttons->addWidget(buttonOf(actions_.not_relevant, tr("Not relevant")));
    buttons->addWidget(buttonOf(actions_.unsure, tr("Unsure")));
    buttons->addWidget(buttonOf(actions_.star, QStringLiteral("★")));
    buttons->addWidget(buttonOf(actions_.undo_verdict, tr("Undo")));
    const auto addSwitch = [buttons](const QString& text, const QString& tip) {
        auto* button = new QToolButton;
        button->setText(text);
        button->setToolTip(tip);
        button->setCheckable(true);
        buttons->addWidget(button);
        return button;
    };
    report_button_ = new QToolButton;
    report_button_->setText(tr("Report…"));
    report_button_->setToolTip(actions_.report_events->toolTip());
    report_button_->setPopupMode(QToolButton::InstantPopup);
    auto* choices = new QMenu(report_button_);
    const std::pair<QString, ReportedEvents> offered[] = {{tr("Relevant and unsure…"), ReportedEvents::judged},
                                                          {tr("Those listed now…"), ReportedEvents::listed},
                                                          {tr("All events…"), ReportedEvents::all}};
    for (const auto& [text, which] : offered)
        choices->addAction(text, this, [this, which = which] { emit reportWanted(which); });
    report_button_->setMenu(choices);
    buttons->addWidget(report_button_);
    limits_button_ = addSwitch(tr("Limits"), tr("What counts as an event"));
    zones_button_ = addSwitch(
        tr("Zones"), tr("Areas and lines that are watched, and arrows for the right way: draw, name, delete them"));
    bindSwitches(this, {{limits_button_, [this](bool on) { showThresholds(on); }},
                        {zones_button_, [this](bool on) { showZones(on); }}});
    layout()->addWidget(line);
}

void EventsPanel::setZones(QWidget* zones) {
    zones_ = zones;
    layout()->addWidget(zones);
    zones_->hide();
}

void EventsPanel::showThresholds(bool shown) {
    limits_button_->setChecked(shown);
    thresholds_->setVisible(shown);
    if (shown) showZones(false);
}

void EventsPanel::showZones(bool shown) {
    zones_button_->setChecked(shown);
    if (zones_ != nullptr) zones_->setVisible(shown);
    if (shown) showThresholds(false);
}

std::optional<int> EventsPanel::mostCharacters(int column) const {
    constexpr int kOfKind = 32;  // with its mark, up to how long one stands; the tracks stay in view
    return column == EventsModel::kind_column ? std::optional(kOfKind) : std::nullopt;
}

// ---- filtering ------------------------------------------------------------------------------------------------------

bool EventsPanel::isListed(const EventEntry& entry) const {
    return isWanted(entry) && passesQuery(entry);
}

bool EventsPanel::passesQuery(const EventEntry& entry) const {
    const auto& found = events_->found();
    if (query_ == nullptr || !found || entry.position >= found->queue.size()) return true;
    static const std::vector<TrackId> none;  // nobody knows what was there
    const Event* event = found->eventAt(entry.position);
    return query_->passes(event != nullptr ? event->tracks : none, found->framesAt(entry.position),
                          found->frameAt(entry.position));
}

void EventsPanel::setQuery(std::shared_ptr<const TrackQuery> query, std::function<void()> clear) {
    query_ = std::move(query);
    clear_query_ = std::move(clear);
    filterEvents();
}

bool EventsPanel::isWanted(const EventEntry& entry) const {
    const auto& found = events_->found();
    if (!found || entry.position >= found->queue.size() || !kinds_->shows(listedKindAt(*found, entry.position)))
        return false;
    switch (verdicts_->currentIndex()) {
        case kToJudge:
            return entry.judgement == Judgement::open;
        case kRelevant:
            return entry.judgement == Judgement::relevant;
        case kNotRelevant:
            return entry.judgement == Judgement::not_relevant;
        case kUnsure:
            return entry.judgement == Judgement::unsure;
        case kStarred:
            return entry.starred;
        case kWithNote:
            return !entry.note.isEmpty();
        case kWithTags:
            return !entry.tags.isEmpty();
        default:
            return true;
    }
}

void EventsPanel::filterEvents() {
    thresholds_->setKindsShown(*kinds_);
    events_->joinStops();
    proxy().setRowFilter([this](int row) {
        const EventEntry* entry = events_->recordAt(row);
        return entry != nullptr && !entry->in_row_of && isListed(*entry);
    });
}

void EventsPanel::rowsFiltered() {
    showHeader();
    commands_.listing_changed();
}

bool EventsPanel::isShown(const EventEntry& entry) const {
    const auto* shown = static_cast<const TableSortProxy*>(table()->model());
    const auto row = static_cast<int>(entry.in_row_of.value_or(entry.position));
    return shown->mapFromSource(events_->index(row, 0)).isValid();
}

QString EventsPanel::hiddenText() const {
    if (query_ != nullptr)
        return events_->rowCount() == 1
                   ? tr("The only event is hidden by the kinds and verdicts chosen above, or by the filter on tracks.")
                   : tr("All %1 events are hidden by the kinds and verdicts chosen above, or by the filter on tracks.")
                         .arg(events_->rowCount());
    return events_->rowCount() == 1
               ? tr("The only event is hidden by the kinds and verdicts chosen above.")
               : tr("All %1 events are hidden by the kinds and verdicts chosen above.").arg(events_->rowCount());
}

void EventsPanel::showHidden() {
    verdicts_->setCurrentIndex(kAllVerdicts);
    kinds_->showAll();
    const auto clear = clear_query_;  // it brings another
    if (query_ != nullptr) clear();
}

// ---- counting -------------------------------------------------------------------------------------------------------

void EventsPanel::showCounts(std::size_t left, const QStringList& corrections) {
    left_ = left;
    left_corrections_ = corrections;
    const int current = currentId();
    events_->joinStops();
    if (current != 0 && events_->rowIdOf(current) != current) selectId(events_->rowIdOf(current));
    EventKindsButton::Counts counts{};
    for (int row = 0; row < events_->rowCount(); ++row)
        ++counts.at(static_cast<std::size_t>(listedKindAt(*events_->found(), events_->recordAt(row)->position)));
    kinds_->setCounts(counts);
    thresholds_->setCounts(counts);
    showHeader();
}

void EventsPanel::showSeen(std::optional<double> share) {
    if (share == seen_) return;
    seen_ = share;
    showHeader();
}

void EventsPanel::showAsOf(std::optional<FrameIndex> frame) {
    if (frame == as_of_) return;
    as_of_ = frame;
    showHeader();
}

QString EventsPanel::countedText() const {
    const int all = events_->rowCount();
    int listed = 0;  // events, of which several may stand in a row
    for (int row = 0; row < table()->model()->rowCount(); ++row)
        listed += 1 + static_cast<int>(shownAt(row)->others.size());
    int judged = 0;
    int hidden_by_query = 0;
    for (int row = 0; row < all; ++row) {
        const EventEntry& entry = *events_->recordAt(row);
        judged += entry.judgement != Judgement::open ? 1 : 0;
        hidden_by_query += isWanted(entry) && !passesQuery(entry) ? 1 : 0;
    }
    if (all == 0 && !as_of_) return {};
    QString text;
    if (as_of_) {
        text = tr("As of frame %1").arg(QLocale().toString(*as_of_));
        if (all > 0) text += tr(" · to be judged when the run has ended");
    } else {
        text = tr("%1 of %2 judged").arg(judged).arg(all);
        if (seen_) text += tr(" · %1 % of the time seen").arg(static_cast<int>(100 * *seen_));
    }
    if (listed < all) text += tr(" · %1 of %2 shown").arg(listed).arg(all);
    if (listed > 0 && listed < all && judged < all && !nextOpen({})) text += tr(", all judged");
    if (hidden_by_query > 0) text += tr(" · %1 hidden by the filter on tracks").arg(hidden_by_query);
    return text;
}

QString EventsPanel::leftText() const {
    QStringList texts;
    if (left_ > 0)
        texts << (left_ == 1 ? tr("1 verdict without an event") : tr("%1 verdicts without an event").arg(left_));
    if (!left_corrections_.isEmpty())
        texts << (left_corrections_.size() == 1 ? tr("1 correction not carried over")
                                                : tr("%1 corrections not carried over").arg(left_corrections_.size()));
    return texts.join(QStringLiteral(" · "));
}

QString EventsPanel::headerText() const {
    QStringList texts{countedText(), leftText()};
    texts.removeAll(QString());
    return texts.join(QStringLiteral(" · "));
}

void EventsPanel::showHeader() {
    QString text = headerText().toHtmlEscaped();
    const QString left = leftText().toHtmlEscaped();
    if (!left.isEmpty())
        text = text.chopped(left.size()) + QStringLiteral("<a href=\"left\">") + left + QStringLiteral("</a>");
    header_->setText(text);
    // Only a link is worth the focus.
    header_->setTextInteractionFlags(left.isEmpty() ? Qt::TextInteractionFlags(Qt::NoTextInteraction)
                                                    : Qt::LinksAccessibleByMouse | Qt::LinksAccessibleByKeyboard);
    QStringList tips;
    if (events_->rowCount() > 0)
        tips << tr(
            "Events are counted, not rows: a vehicle that stops, stands and starts again makes three events in one "
            "row, "
            "which are judged together.");
    if (query_ != nullptr)
        tips << tr(
            "The chips above the list of tracks narrow the events, too: one is listed where one of its tracks "
            "passes.");
    if (seen_)
        tips << tr(
            "Frames count as seen when they were shown at four times the speed or slower, with the window in front.");
    if (!left_corrections_.isEmpty())
        tips << tr("Corrections of tracks that do not fit this run are kept: %1.")
                    .arg(left_corrections_.join(QStringLiteral("; ")));
    if (left_ > 0) tips << tr("Verdicts on this video that match no event of this run, with these limits, are kept.");
    if (!left.isEmpty()) tips << tr("A click lists them.");
    header_->setToolTip(tips.join(QLatin1Char('\n')));
}

// ---- going ----------------------------------------------------------------------------------------------------------

const EventEntry* EventsPanel::shownAt(int row) const {
    const auto* shown = static_cast<const TableSortProxy*>(table()->model());
    return events_->recordAt(shown->mapToSource(shown->index(row, 0)).row());
}

std::vector<int> EventsPanel::listedNumbers() const {
    std::vector<int> numbers;
    for (int row = 0; row < table()->model()->rowCount(); ++row) {
        const EventEntry* entry = shownAt(row);
        if (const auto number = events_->found()->numberAt(entry->position)) numbers.push_back(*number);
        for (const std::size_t place : entry->others) numbers.push_back(*events_->found()->numberAt(place));
    }
    return numbers;
}

std::optional<int> EventsPanel::neighbour(int rows) const {
    const auto* shown = table()->model();
    const int current = shownRowOf(currentId());
    const int row = current < 0 ? 0 : current + rows;
    if (row < 0 || row >= shown->rowCount()) return std::nullopt;
    return shown->index(row, 0).data(id_role).toInt();
}

std::optional<int> EventsPanel::nextOpen(const QList<int>& ids) const {
    const auto* shown = table()->model();
    const int count = shown->rowCount();
    const int from = ids.isEmpty() ? -1 : shownRowOf(ids.back());
    for (int step = 1; step <= count; ++step) {
        const int row = (from + step) % count;
        const int id = shown->index(row, 0).data(id_role).toInt();
        const EventEntry* entry = shownAt(row);
        if (entry != nullptr && entry->judgement == Judgement::open && !ids.contains(id)) return id;
    }
    return std::nullopt;
}

void EventsPanel::chooseReport() {
    QMenu* choices = report_button_->menu();
    choices->setActiveAction(choices->actions().front());  // who came by keys goes on with them
    report_button_->showMenu();
}

void EventsPanel::editNote(int id) {
    const int row = shownRowOf(id);
    if (row < 0) return;
    table()->setColumnHidden(EventsModel::note_column, false);
    const QModelIndex note = table()->model()->index(row, EventsModel::note_column);
    table()->scrollTo(note);  // not sideways: the line to write in comes into view by itself
    table()->edit(note);
}

void EventsPanel::rowDoubleClicked(int id) {
    if (table()->currentIndex().column() == EventsModel::note_column)
        editNote(id);
    else
        commands_.show(id);
}

void EventsPanel::fillMenu(QMenu& menu, int id) {
    menu.addActions({actions_.relevant, actions_.not_relevant, actions_.unsure, actions_.take_back, actions_.star});
    menu.addAction(tr("Write a note"), this, [this, id] { editNote(id); });
    menu.addAction(actions_.clip_event);
}

bool EventsPanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched == table() && event->type() == QEvent::KeyPress &&
        static_cast<QKeyEvent*>(event)->key() == Qt::Key_F2 && currentId() != 0) {
        editNote(currentId());
        return true;
    }
    return TablePanel::eventFilter(watched, event);
}

void EventsPanel::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) events_->setDark(isDark(palette()));
    TablePanel::changeEvent(event);
}

}  // namespace eyrie::ui

#include "moc_events_panel.cpp"
