#pragma once

#include <QToolButton>
#include <array>

#include "review/events/found_events.h"

class QCheckBox;
class QMenu;

namespace eyrie::ui {

/// Which kinds of events are shown: a button that says how many are hidden, with a list of the kinds and their counts
/// that stays open while kinds are ticked.
class EventKindsButton : public QToolButton {
    Q_OBJECT

 public:
    using Counts = std::array<int, kListedKinds>;

    explicit EventKindsButton(QWidget* parent = nullptr);

    /// How many there are of each kind.
    void setCounts(const Counts& counts);
    bool shows(int listed_kind) const { return shown_.at(static_cast<std::size_t>(listed_kind)); }
    void setShown(int listed_kind, bool shown);
    void showAll(bool shown = true);

 signals:
    void edited();

 protected:
    /// Plates follow the theme.
    void changeEvent(QEvent* event) override;

 private:
    void makeMenu();
    void refresh();

    QMenu* list_;
    std::array<QCheckBox*, kListedKinds> boxes_{};
    std::array<bool, kListedKinds> shown_{};
    Counts counts_{};
};

}  // namespace eyrie::ui
