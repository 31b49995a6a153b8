#include "widgets/tables/record_model.h"

#include <QAbstractItemModelTester>
#include <QPersistentModelIndex>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "ui/support/ui_test.h"
#include "widgets/tables/table_roles.h"
#include "widgets/tables/table_sort_proxy.h"

namespace eyrie::ui::record_model_test {

namespace {

struct Numbered {
    int id = 0;
    int value = 0;
    bool operator==(const Numbered&) const = default;
};

class NumberedModel : public RecordModel<Numbered> {
 public:
    using RecordModel::mergeRecords;
    using RecordModel::RecordModel;
    using RecordModel::records;
    using RecordModel::replaceRecords;
    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : 2; }
    QVariant data(const QModelIndex& index, int role) const override {
        const Numbered* record = recordAt(index.row());
        if (record == nullptr) return {};
        if (role == id_role) return record->id;
        return role == Qt::DisplayRole || role == sort_role ? QVariant(record->value) : QVariant();
    }
};

}  // namespace

/// New contents of a table, against a plain list and what a view holds on to.
class RecordModelTest : public QObject {
    Q_OBJECT

    std::mt19937 random_{4711};
    int next_id_ = 1;

    int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }
    /// Some go, some come, some change places, and each may hold something else.
    std::vector<Numbered> changed(std::vector<Numbered> records) {
        const int share = 1 + below(6);
        std::erase_if(records, [&](const Numbered&) { return below(share + 2) == 0; });
        for (int swaps = below(3); swaps > 0 && records.size() > 1; --swaps)
            std::swap(records[static_cast<std::size_t>(below(static_cast<int>(records.size())))],
                      records[static_cast<std::size_t>(below(static_cast<int>(records.size())))]);
        for (int fresh = below(8); fresh > 0 && records.size() < 60; --fresh)
            records.insert(records.begin() + below(static_cast<int>(records.size()) + 1), Numbered{next_id_++, 0});
        for (Numbered& record : records) record.value = below(100);
        return records;
    }

 private slots:
    void whatStaysIsHeldOnToWhateverComesAndGoes() {
        NumberedModel model;
        TableSortProxy sorted;
        sorted.setSourceModel(&model);
        sorted.sort(0);
        const auto kStrict = QAbstractItemModelTester::FailureReportingMode::QtTest;
        const QAbstractItemModelTester tester(&model, kStrict);
        const QAbstractItemModelTester sorted_tester(&sorted, kStrict);
        QSignalSpy resets(&model, &QAbstractItemModel::modelReset);
        int kept = 0;
        for (int step = 0; step < 400; ++step) {
            const std::vector<Numbered> next = changed(model.records());
            std::map<int, QPersistentModelIndex> held;
            std::map<int, QPersistentModelIndex> held_sorted;
            for (int row = 0; row < model.rowCount(); ++row) {
                held[model.recordAt(row)->id] = model.index(row, row % 2);
                held_sorted[sorted.index(row, 0).data(id_role).toInt()] = sorted.index(row, 0);
            }
            std::set<int> ids;
            for (const Numbered& record : next) ids.insert(record.id);
            const auto gone =
                std::count_if(held.begin(), held.end(), [&](const auto& each) { return !ids.contains(each.first); });
            resets.clear();
            const bool merges = step % 3 != 0;
            merges ? model.mergeRecords(next) : model.replaceRecords(next);
            QVERIFY(model.records() == next);
            QCOMPARE(sorted.rowCount(), model.rowCount());
            for (int row = 1; row < sorted.rowCount(); ++row)
                QVERIFY(sorted.index(row - 1, 0).data().toInt() <= sorted.index(row, 0).data().toInt());
            if (merges) QCOMPARE(resets.isEmpty(), gone <= 16);
            if (!resets.isEmpty()) continue;
            for (const auto& holds : {held, held_sorted}) {
                for (const auto& [id, index] : holds) {
                    QCOMPARE(index.isValid(), ids.contains(id));
                    if (index.isValid()) QCOMPARE(index.data(id_role).toInt(), id);
                }
            }
            ++kept;
        }
        QVERIFY2(kept > 200, "most of them are small changes");
    }

    void whoHearsThatRowsGoSeesTheOthersAsTheyWillBe() {
        NumberedModel model;
        model.mergeRecords({{1, 10}, {2, 20}, {3, 30}});
        std::vector<int> seen;
        connect(&model, &QAbstractItemModel::rowsAboutToBeRemoved, this, [&] {
            for (const Numbered& record : model.records()) seen.push_back(record.value);
        });
        model.mergeRecords({{1, 11}, {3, 31}});
        QCOMPARE(seen, std::vector<int>({11, 20, 31}));
        seen.clear();
        model.replaceRecords({{3, 32}, {4, 40}});
        QCOMPARE(seen, std::vector<int>({11, 32}));
    }
};

}  // namespace eyrie::ui::record_model_test

EYRIE_UI_TEST(QApplication, record_model_test, RecordModelTest)
#include "record_model_test.moc"
