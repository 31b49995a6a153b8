#pragma once

#include <vector>

#include "store/runs/run_store.h"
#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// The runs of a project, one row each, oldest first. The name can be edited; the change is asked for by a signal and
/// shown at once.
class RunsModel : public RecordModel<RunRecord> {
    Q_OBJECT
 public:
    enum Column {
        name_column,
        started_column,
        state_column,
        frames_column,
        length_column,
        preset_column,
        gsd_column,
        video_column,
        column_count
    };

    explicit RunsModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setRuns(std::vector<RunRecord> runs) { replaceRecords(std::move(runs)); }
    /// Updates or appends one run, e.g. with its frames done so far.
    void updateRun(const RunRecord& run);
    /// The run that works now; others found as `running` were killed and show as stopped. 0: none.
    void setLiveRun(int run_id);

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
    void renameRequested(int run_id, const QString& name);

 private:
    QString textOf(const RunRecord& run, int column) const;
    /// What a column holds, for its title's tooltip.
    QString helpOf(int column) const;
    QVariant sortValueOf(const RunRecord& run, int column) const;
    QString stateText(const RunRecord& run) const;
    QString toolTipOf(const RunRecord& run) const;
    int live_run_ = 0;
};

/// The run's name, or "Run 3" when it has none.
QString shownName(const RunRecord& run);

}  // namespace eyrie::ui
