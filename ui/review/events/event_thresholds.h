#pragma once

#include <QScrollArea>
#include <array>
#include <vector>

#include "events/event_options.h"
#include "review/events/event_kinds_button.h"

namespace eyrie::ui {

class CollapsibleSection;
class ParameterRow;

/// The thresholds of events, those of each kind together, with the counts of the kinds. They are the person's: kept
/// from one start to the next.
class EventThresholds : public QScrollArea {
    Q_OBJECT

 public:
    explicit EventThresholds(QWidget* parent = nullptr);

    const EventOptions& options() const { return options_; }
    void setCounts(const EventKindsButton::Counts& counts);
    /// Thresholds of kinds that are not listed are not shown.
    void setKindsShown(const EventKindsButton& kinds);
    /// As if a person did; a value that is none changes nothing.
    void setValue(const QString& name, const QString& value);
    void resetAll();

 signals:
    void edited();

 private:
    struct Group {
        QString title;
        std::vector<int> kinds;  ///< none: it holds for all
        CollapsibleSection* section = nullptr;
    };

    void makeGroups();
    void restoreValues();
    void keepValues() const;

    EventOptions options_;
    std::vector<Group> groups_;
    std::vector<ParameterRow*> rows_;
};

}  // namespace eyrie::ui
