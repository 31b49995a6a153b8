#pragma once

#include <QImage>
#include <QString>
#include <map>
#include <vector>

#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// An error as the list shows it.
struct ErrorRow {
    int id = 0;  ///< from 1, in the order of time
    QString kind;
    QString cause;
    QString detail;       ///< the numbers behind the cause
    QString explanation;  ///< of the cause, one sentence
    int first_frame = 0;
    int last_frame = 0;
    int count = 0;
    QString objects;
    QString tracks;
    int kind_order = 0;
    int object_order = 0;  ///< to sort by; 0 without an object
};

/// Every error of an evaluation, one row each.
class ErrorsModel : public RecordModel<ErrorRow> {
    Q_OBJECT
 public:
    enum Column {
        chip_column,
        kind_column,
        cause_column,
        frame_column,
        count_column,
        object_column,
        track_column,
        detail_column,
        column_count
    };

    explicit ErrorsModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setErrors(std::vector<ErrorRow> rows);
    void setChip(int id, const QImage& chip);
    bool hasChip(int id) const { return chips_.contains(id); }
    void clearChips();

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
    QString textOf(const ErrorRow& row, int column) const;
    /// What a column holds, for its title's tooltip.
    QString helpOf(int column) const;
    QVariant sortValueOf(const ErrorRow& row, int column) const;
    std::map<int, QImage> chips_;
};

}  // namespace eyrie::ui
