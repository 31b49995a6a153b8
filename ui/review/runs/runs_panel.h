#pragma once

#include <functional>
#include <utility>

#include "review/runs/runs_model.h"
#include "widgets/tables/table_panel.h"

namespace eyrie::ui {

/// What the list of runs leads to.
struct RunListCommands {
    std::function<void(int run_id)> show = [](int) {};
    /// From the empty state: run with the present parameters.
    std::function<void()> run = [] {};
    std::function<void(int run_id)> remove = [](int) {};
    std::function<void(int run_id)> go_on = [](int) {};
    /// Which runs can be gone on with; asked when the menu of one opens.
    std::function<bool(int run_id)> can_go_on = [](int) { return false; };
    /// Take the run's parameters over into the form.
    std::function<void(int run_id)> use_parameters = [](int) {};
};

/// The runs of the project: choosing one shows its results.
class RunsPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit RunsPanel(RunsModel* model, QWidget* parent = nullptr);
    void setCommands(RunListCommands commands) { commands_ = std::move(commands); }

 protected:
    void rowSelected(int run_id) override { commands_.show(run_id); }
    void rowDoubleClicked(int run_id) override { commands_.show(run_id); }
    void fillMenu(QMenu& menu, int run_id) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void editName();
    RunListCommands commands_;
};

}  // namespace eyrie::ui
