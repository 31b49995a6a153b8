#pragma once

#include <QAbstractTableModel>
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <unordered_map>
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
        if (startsWithWhatStays(records))
            change(std::move(records));
        else
            showAnew(std::move(records));
    }

    /// The same where rows may also come between others and change places: all that stays is kept by the view, but for
    /// very many that come or go.
    void mergeRecords(std::vector<Record> records) {
        if (runsOfNew(records) <= kMostInsertions)
            change(std::move(records));
        else
            showAnew(std::move(records));
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
    static constexpr int kMostInsertions = 64;  ///< each of rows that follow each other

    using RowById = std::unordered_map<int, int>;
    static RowById rowsOf(const std::vector<Record>& records) {
        RowById row_of;
        for (std::size_t row = 0; row < records.size(); ++row) row_of[records[row].id] = static_cast<int>(row);
        return row_of;
    }

    void showAnew(std::vector<Record> records) {
        beginResetModel();
        records_ = std::move(records);
        endResetModel();
    }

    void change(std::vector<Record> records) {
        const RowById row_of = rowsOf(records);
        const auto goes = [&](const Record& mine) { return !row_of.contains(mine.id); };
        if (std::count_if(records_.begin(), records_.end(), goes) > kMostRemovals) return showAnew(std::move(records));
        // First what they hold, so that whoever sorts, filters and selects meanwhile sees nothing of the past.
        for (Record& mine : records_)
            if (!goes(mine)) mine = records[static_cast<std::size_t>(row_of.at(mine.id))];
        if (rowCount() > 0) emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
        for (int row = rowCount() - 1; row >= 0; --row) {
            if (!goes(records_[static_cast<std::size_t>(row)])) continue;
            beginRemoveRows({}, row, row);
            records_.erase(records_.begin() + row);
            endRemoveRows();
        }
        arrange(row_of);
        insertMissing(records);
    }

    /// Whether those that stay come first in `records`, in the order they have.
    bool startsWithWhatStays(const std::vector<Record>& records) const {
        const RowById row_of = rowsOf(records);
        std::size_t next = 0;
        for (const Record& mine : records_) {
            if (!row_of.contains(mine.id)) continue;
            if (records[next].id != mine.id) return false;
            ++next;
        }
        return true;
    }

    /// How often rows that are new follow one that is not.
    int runsOfNew(const std::vector<Record>& records) const {
        std::unordered_set<int> mine;
        for (const Record& record : records_) mine.insert(record.id);
        int runs = 0;
        bool was_new = false;
        for (const Record& record : records) {
            const bool is_new = !mine.contains(record.id);
            runs += is_new && !was_new ? 1 : 0;
            was_new = is_new;
        }
        return runs;
    }

    /// Puts the rows in the order in which they will stand.
    void arrange(const RowById& row_of) {
        const auto later = [&](const Record& a, const Record& b) { return row_of.at(a.id) < row_of.at(b.id); };
        if (std::is_sorted(records_.begin(), records_.end(), later)) return;
        emit layoutAboutToBeChanged();
        std::vector<int> order(records_.size());  // by new row, the old one
        std::iota(order.begin(), order.end(), 0);
        const auto at = [&](int row) -> Record& { return records_[static_cast<std::size_t>(row)]; };
        std::sort(order.begin(), order.end(), [&](int a, int b) { return later(at(a), at(b)); });
        std::vector<int> new_row(order.size());
        std::vector<Record> arranged;
        for (const int row : order) {
            new_row[static_cast<std::size_t>(row)] = static_cast<int>(arranged.size());
            arranged.push_back(std::move(at(row)));
        }
        records_ = std::move(arranged);
        const QModelIndexList before = persistentIndexList();
        QModelIndexList after;
        for (const QModelIndex& each : before)
            after.push_back(index(new_row[static_cast<std::size_t>(each.row())], each.column()));
        changePersistentIndexList(before, after);
        emit layoutChanged();
    }

    /// Inserts what `records` has besides; all others are there, in the same order.
    void insertMissing(const std::vector<Record>& records) {
        for (std::size_t row = 0; row < records.size(); ++row) {
            const auto is_next = [&](const Record& one) { return row < records_.size() && one.id == records_[row].id; };
            if (is_next(records[row])) continue;
            std::size_t end = row + 1;
            while (end < records.size() && !is_next(records[end])) ++end;
            beginInsertRows({}, static_cast<int>(row), static_cast<int>(end) - 1);
            records_.insert(records_.begin() + static_cast<std::ptrdiff_t>(row),
                            records.begin() + static_cast<std::ptrdiff_t>(row),
                            records.begin() + static_cast<std::ptrdiff_t>(end));
            endInsertRows();
            row = end - 1;
        }
    }

    std::vector<Record> records_;
};

}  // namespace eyrie::ui
