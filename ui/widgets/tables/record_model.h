#pragma once

#include <QAbstractTableModel>
#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <utility>
#include <vector>

namespace eyrie::ui {

/// A table with one row per record; a record has an `id` that no other has. New contents keep selection and place where
/// they can: rows that stay are updated, rows that go or come at the end are removed or inserted.
template <class Record>
class RecordModel : public QAbstractTableModel {
 public:
    using QAbstractTableModel::QAbstractTableModel;

    int rowCount(const QModelIndex& parent = {}) const override {
        return parent.isValid() ? 0 : static_cast<int>(records_.size());
    }
    /// The record of a row; null outside of the table. Valid until the contents change.
    const Record* recordAt(int row) const {
        return row >= 0 && row < rowCount() ? &records_[static_cast<std::size_t>(row)] : nullptr;
    }
    /// The row of the record with this id, −1 when there is none.
    int rowOf(int id) const {
        const auto at = std::find_if(records_.begin(), records_.end(), [&](const Record& r) { return r.id == id; });
        return at == records_.end() ? -1 : static_cast<int>(at - records_.begin());
    }

 protected:
    const std::vector<Record>& records() const { return records_; }

    void replaceRecords(std::vector<Record> records) {
        if (!removeMissing(records) || !startsLikeThis(records)) {
            beginResetModel();
            records_ = std::move(records);
            endResetModel();
            return;
        }
        const int old_count = rowCount();
        const int new_count = static_cast<int>(records.size());
        std::copy_n(records.begin(), old_count, records_.begin());
        if (old_count > 0) emit dataChanged(index(0, 0), index(old_count - 1, columnCount() - 1));
        if (new_count == old_count) return;
        beginInsertRows({}, old_count, new_count - 1);
        records_ = std::move(records);
        endInsertRows();
    }

    void changeRecord(int row, Record record) {
        records_[static_cast<std::size_t>(row)] = std::move(record);
        emit dataChanged(index(row, 0), index(row, columnCount() - 1));
    }
    /// Where only one column is another: what is being written in others stays.
    void changeRecord(int row, Record record, int column) {
        records_[static_cast<std::size_t>(row)] = std::move(record);
        emit dataChanged(index(row, column), index(row, column));
    }

 private:
    /// More rows than that are quicker shown anew.
    static constexpr std::ptrdiff_t kMostRemovals = 16;

    /// Removes the rows that `records` does not have, if they are few. Answers whether it did.
    bool removeMissing(const std::vector<Record>& records) {
        if (startsLikeThis(records)) return true;
        std::unordered_set<int> ids;
        for (const Record& record : records) ids.insert(record.id);
        const auto is_missing = [&](const Record& mine) { return !ids.contains(mine.id); };
        if (std::count_if(records_.begin(), records_.end(), is_missing) > kMostRemovals) return false;
        for (int row = rowCount() - 1; row >= 0; --row) {
            if (!is_missing(records_[static_cast<std::size_t>(row)])) continue;
            beginRemoveRows({}, row, row);
            records_.erase(records_.begin() + row);
            endRemoveRows();
        }
        return true;
    }

    bool startsLikeThis(const std::vector<Record>& records) const {
        return records_.size() <= records.size() &&
               std::equal(records_.begin(), records_.end(), records.begin(),
                          [](const Record& a, const Record& b) { return a.id == b.id; });
    }

    std::vector<Record> records_;
};

}  // namespace eyrie::ui
