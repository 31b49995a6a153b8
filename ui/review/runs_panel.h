#pragma once

#include <functional>
#include <utility>

#include "review/runs_model.h"
#include "widgets/tables/table_panel.h"

namespace eyrie::ui {

/// The runs of the project: choosing one shows its results.
class RunsPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit RunsPanel(RunsModel* model, QWidget* parent = nullptr);

    /// Which runs can be gone on with; asked when the menu of one opens.
    void setContinuable(std::function<bool(int run_id)> can_continue) { can_continue_ = std::move(can_continue); }

 signals:
    /// The user chose a run to be shown.
    void runActivated(int run_id);
    /// From the empty state: run with the present parameters.
    void runRequested();
    void removeRequested(int run_id);
    void continueRequested(int run_id);
    /// Take the run's parameters over into the form.
    void parametersRequested(int run_id);

 protected:
    void rowSelected(int run_id) override { emit runActivated(run_id); }
    void rowDoubleClicked(int run_id) override { emit runActivated(run_id); }
    void fillMenu(QMenu& menu, int run_id) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void editName();
    std::function<bool(int)> can_continue_;
};

}  // namespace eyrie::ui
