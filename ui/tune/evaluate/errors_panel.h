#pragma once

#include <QMap>
#include <QSet>
#include <functional>
#include <utility>

#include "tune/evaluate/errors_model.h"
#include "widgets/delayed_call.h"
#include "widgets/tables/table_panel.h"

class QLabel;
class QToolButton;

namespace eyrie::ui {

/// What the list of errors does with one of them.
struct ErrorCommands {
    std::function<void(int id)> go_to = [](int) {};
    std::function<void(int id)> ask_why = [](int) {};
    std::function<void(int id)> correct_truth = [](int) {};
    /// Rows have come into view that may lack their chips.
    std::function<void()> want_chips = [] {};
};

/// The list of errors: filtered by kind and cause, sorted, stepped through in the order shown.
class ErrorsPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit ErrorsPanel(ErrorsModel* model, QWidget* parent = nullptr);
    void setCommands(ErrorCommands commands) { commands_ = std::move(commands); }
    const ErrorCommands& commands() const { return commands_; }

    /// Only errors of this kind or cause; empty: all.
    void setShownKind(const QString& kind);
    void setShownCause(const QString& cause);
    /// The next or previous row in the order shown, from the selected one; 0 when there is none.
    int neighbour(int step) const;
    /// A line below the list, about the error that is looked at or what a correction changed.
    void setStatus(const QString& text);
    QString status() const;
    /// Ids of the rows in view that have no chip yet.
    QList<int> rowsWithoutChip() const;
    static constexpr int kChipHeight = 36;

 protected:
    void rowSelected(int id) override { commands_.go_to(id); }
    void rowClicked(int id, int /*column*/) override { commands_.go_to(id); }
    void rowDoubleClicked(int id) override { commands_.go_to(id); }
    void fillMenu(QMenu& menu, int id) override;
    void resizeEvent(QResizeEvent* event) override;

 private:
    void applyFilter();
    void rebuildMenus();
    void wantChips();
    QToolButton* filterButton(const QString& title);

    ErrorsModel* errors_;
    ErrorCommands commands_;
    QString kind_;
    QString cause_;
    QToolButton* kinds_;
    QToolButton* causes_;
    DelayedCall chips_due_;
    QLabel* status_;
};

}  // namespace eyrie::ui
