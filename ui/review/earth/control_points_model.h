#pragma once

#include <optional>
#include <vector>

#include "core/geometry/control_point.h"
#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// A row: a control point with what the fit says of it.
struct ControlPointRow {
    int id = 0;  ///< its number in the list, from 1
    ControlPoint point;
    std::optional<double> off_m;  ///< from where the fit puts it; nothing without a fit
    bool suspect = false;         ///< contradicts the others
};

/// The control points of a video. Changes nothing itself: what a person writes is told.
class ControlPointsModel : public RecordModel<ControlPointRow> {
    Q_OBJECT

 public:
    enum Column { number_column, frame_column, place_column, off_column, column_count };

    explicit ControlPointsModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setRows(std::vector<ControlPointRow> rows) { replaceRecords(std::move(rows)); }

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
    /// Somebody wrote another place; it may be none.
    void placeEdited(int number, const QString& text);
};

}  // namespace eyrie::ui
