#pragma once

#include <QString>
#include <vector>

#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// A row: a tag and what it says at the frame shown, or what follows from the tags together.
struct MetadataRow {
    int id = 0;  ///< number of the tag; below 0 for what was worked out
    bool is_tag = true;
    bool has_number = true;  ///< in the standard; false for what only the older universal set has
    QString name;            ///< "platform heading"
    QString value;           ///< with its unit; empty: nothing is stated near the frame
    double sets = 0;         ///< share of the stream's sets that hold it
    QString tip;
};

/// What a stream of metadata says at a frame, one row each.
class MetadataModel : public RecordModel<MetadataRow> {
    Q_OBJECT

 public:
    enum Column { tag_column, name_column, value_column, sets_column, column_count };

    explicit MetadataModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setRows(std::vector<MetadataRow> rows) { replaceRecords(std::move(rows)); }

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
};

}  // namespace eyrie::ui
