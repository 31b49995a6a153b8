#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "review/events/event_kinds_button.h"
#include "review/events/events_model.h"
#include "widgets/tables/table_panel.h"

class QComboBox;
class QLabel;
class QToolButton;

namespace eyrie::ui {

class EventThresholds;
class TrackQuery;
class WindowActions;

/// Which events a report is about.
enum class ReportedEvents { judged, all, listed };  ///< judged: relevant or unsure

/// What the list of events asks for.
struct EventsPanelCommands {
    /// A person wants to see an event.
    std::function<void(int id)> show = [](int) {};
    /// Other events are listed than before.
    std::function<void()> listing_changed = [] {};
    /// A person wants to see what could not be carried over.
    std::function<void()> show_left = [] {};
};

/// The queue of events: how many are judged and shown, the list, the keys that judge as buttons, and the thresholds.
class EventsPanel : public TablePanel {
    Q_OBJECT

 public:
    /// `model` and `actions` must outlive the panel.
    EventsPanel(EventsModel* model, const WindowActions& actions, QWidget* parent = nullptr);

    void setCommands(EventsPanelCommands commands) { commands_ = std::move(commands); }
    EventKindsButton& kinds() { return *kinds_; }
    EventThresholds& thresholds() { return *thresholds_; }
    /// Takes the list of zones into the panel, below the events, hidden until it is wanted.
    void setZones(QWidget* zones);
    /// Shows the thresholds, or the zones, below the events; one of the two has room.
    void showThresholds(bool shown);
    void showZones(bool shown);
    /// Which verdicts are listed: all, to judge, relevant, not relevant, unsure, starred, with a note.
    QComboBox& verdicts() { return *verdicts_; }

    /// Lists only events whose tracks pass; null: all. `clear` takes the query back.
    void setQuery(std::shared_ptr<const TrackQuery> query, std::function<void()> clear);

    /// Counts kinds and verdicts anew; `left`: verdicts without an event in this run; `corrections`: what could not be
    /// carried over to it of what was done to tracks, for people.
    void showCounts(std::size_t left, const QStringList& corrections = {});
    /// The list is that of a run that works still, up to this frame; nothing: of a whole run.
    void showAsOf(std::optional<FrameIndex> frame);
    /// The share of the run's frames that was watched, 0 … 1; nothing: not known.
    void showSeen(std::optional<double> share);
    /// "214 of 380 judged", "61 % of the time seen", "38 of 380 shown, all judged", "12 hidden by the filter on tracks"
    /// and what could not be carried over; "as of frame 1,234" of a run that works still.
    QString headerText() const;
    /// Whether an event of the model is shown, in a row of its own or in that of its stop: by kind, verdict, the query
    /// and the words in the filter line.
    bool isShown(const EventEntry& entry) const;

    /// Id of the row `rows` below (above) the current one in the order shown, the first one if none is current;
    /// nothing at the end.
    std::optional<int> neighbour(int rows) const;
    /// The next row below `ids` and around that is not judged, in the order shown.
    std::optional<int> nextOpen(const QList<int>& ids) const;
    /// Numbers of the events that are listed, as the run counts them.
    std::vector<int> listedNumbers() const;
    /// Opens the choice of what a report is to hold.
    void chooseReport();
    /// Starts writing the note of an event.
    void editNote(int id);

 signals:
    void reportWanted(eyrie::ui::ReportedEvents which);

 protected:
    void rowSelected(int id) override { commands_.show(id); }
    void rowClicked(int id, int /*column*/) override { commands_.show(id); }
    void rowDoubleClicked(int id) override;
    void fillMenu(QMenu& menu, int id) override;
    std::optional<int> mostCharacters(int column) const override;
    QString hiddenText() const override;
    bool canShowHidden() const override { return true; }
    void showHidden() override;
    bool eventFilter(QObject* watched, QEvent* event) override;
    void changeEvent(QEvent* event) override;

 private:
    void buildFilters();
    void buildButtons();
    void filterEvents();
    void showHeader();
    void rowsFiltered();
    /// By kind, verdict and the query; words in the filter line are not asked.
    bool isListed(const EventEntry& entry) const;
    bool isWanted(const EventEntry& entry) const;
    bool passesQuery(const EventEntry& entry) const;
    QString countedText() const;
    QString leftText() const;
    /// Row in the order shown, −1 for none.
    const EventEntry* shownAt(int row) const;

    EventsModel* events_;
    const WindowActions& actions_;
    EventsPanelCommands commands_;
    std::shared_ptr<const TrackQuery> query_;
    std::function<void()> clear_query_ = [] {};
    QLabel* header_;
    EventKindsButton* kinds_;
    QComboBox* verdicts_;
    EventThresholds* thresholds_;
    QWidget* zones_ = nullptr;
    QToolButton* report_button_ = nullptr;
    QToolButton* limits_button_ = nullptr;
    QToolButton* zones_button_ = nullptr;
    std::size_t left_ = 0;
    QStringList left_corrections_;
    std::optional<double> seen_;
    std::optional<FrameIndex> as_of_;
};

}  // namespace eyrie::ui
