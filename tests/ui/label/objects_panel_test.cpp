#include "label/lists/objects_panel.h"

#include <QApplication>
#include <QDoubleSpinBox>
#include <QTableView>
#include <QTest>
#include <memory>

#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::objects_panel_test {

/// The list of labelled objects by itself: what its filters leave.
class ObjectsPanelTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static ObjectRow objectWithSpeed(int id, double speed_px) {
        ObjectRow row;
        row.id = id;
        row.last_frame = 10;
        row.speed_px = speed_px;
        return row;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void speedsAreFilteredInTheUnitOfTheirColumn() {
        ObjectsModel model;
        ObjectsPanel panel(&model);
        QDoubleSpinBox* slowest = nullptr;
        for (auto* box : panel.findChildren<QDoubleSpinBox*>())
            if (box->prefix().startsWith(QLatin1Char('v'))) slowest = box;
        QVERIFY(slowest != nullptr);
        QCOMPARE(slowest->suffix(), QStringLiteral(" px/frame"));
        SceneScale scale;
        scale.gsd_m_per_px = 0.5;
        scale.frame_rate_hz = 10;
        scale.gsd_known = true;
        model.setObjects({objectWithSpeed(1, 1), objectWithSpeed(2, 4)}, scale);  // 18 and 72 km/h
        QCOMPARE(slowest->suffix(), QStringLiteral(" km/h"));
        slowest->setValue(50);
        const auto& listed = *panel.table()->model();
        QTRY_COMPARE(listed.rowCount(), 1);
        QCOMPARE(listed.data(listed.index(0, ObjectsModel::id_column)).toInt(), 2);
    }
};

}  // namespace eyrie::ui::objects_panel_test

EYRIE_UI_TEST(QApplication, objects_panel_test, ObjectsPanelTest)
#include "objects_panel_test.moc"
