#include <QComboBox>
#include <QSpinBox>
#include <QTableWidget>
#include <fstream>

#include "label/files/label_files.h"
#include "label/files/label_files_export.h"
#include "ui/label/labelling.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::label_files_test {

using test::kPatience_ms;

/// Labels from and to files, through the dialogs of the window.
class LabelFilesTest : public QObject, test::Labelling {
    Q_OBJECT

 private slots:
    void init() { begin(); }
    void cleanup() { end(); }

    void importShowsWhatItFoundAndExportWhatWasLost() {
        const auto window = labellingWindow(10);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const auto file = home() / "truth.txt";
        {
            std::ofstream out(file);
            for (int frame = 1; frame <= 6; ++frame)
                out << frame << ",4," << 20 + 3 * frame << ",30,20,10,1,1,1\n" << frame << ",9,100,80,20,10,1,1,1\n";
        }
        LabelImportDialog import(labels);
        QSignalSpy read(&import, &LabelImportDialog::fileRead);
        import.setFile(file);
        QVERIFY(read.wait(kPatience_ms));
        QVERIFY2(import.readyToImport(), qPrintable(import.report()));
        QVERIFY2(import.report().contains(QStringLiteral("12 boxes in 6 frames")), qPrintable(import.report()));
        QVERIFY(labels.annotations().objects.empty());
        QSignalSpy accepted(&import, &QDialog::accepted);
        import.accept();
        QVERIFY(accepted.wait(kPatience_ms));
        QCOMPARE(labels.annotations().objects.size(), std::size_t(2));
        QVERIFY(import.summary().contains(QStringLiteral("2 objects")));

        ExportDialog exported(labelExport(labels));
        QSignalSpy finished(&exported, &ExportDialog::finishedExport);
        exported.setFormat(QStringLiteral("mot"));
        exported.setTarget(home() / "out.txt");
        exported.startExport();
        QVERIFY(finished.wait(kPatience_ms));
        QVERIFY2(finished.front().front().toBool(), qPrintable(exported.report()));
        QVERIFY(exported.report().contains(QStringLiteral("12 boxes")));

        key(*window, Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(labels.annotations().objects.empty());
    }

    void importShiftsFramesAndRenamesClasses() {
        const auto window = labellingWindow(10);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const auto file = home() / "truth.txt";
        {
            std::ofstream out(file);
            for (int frame = 1; frame <= 6; ++frame) out << frame << ",4," << 20 + 3 * frame << ",30,20,10,1,3,1\n";
        }
        LabelImportDialog import(labels);
        QSignalSpy read(&import, &LabelImportDialog::fileRead);
        import.setFile(file);
        QVERIFY(read.wait(kPatience_ms));
        QVERIFY2(import.report().contains(QStringLiteral("frames 0 to 5")), qPrintable(import.report()));
        import.findChild<QSpinBox*>()->setValue(2);
        QVERIFY(read.wait(kPatience_ms));
        QVERIFY2(import.report().contains(QStringLiteral("frames 2 to 7")), qPrintable(import.report()));
        auto* becomes = qobject_cast<QComboBox*>(import.findChild<QTableWidget*>()->cellWidget(0, 2));
        QVERIFY(becomes != nullptr);
        QCOMPARE(becomes->currentText(), QStringLiteral("car"));
        becomes->setCurrentText(QStringLiteral("van"));
        import.accept();
        QVERIFY(waitFor([&] { return !labels.annotations().objects.empty(); }));
        const LabelledObject& object = labels.annotations().objects.begin()->second;
        QCOMPARE(object.object_class, std::string("van"));
        QCOMPARE(object.keyframes.front().frame, 2);
    }

    void aFileImportedTwiceSaysSoAndAddsNothingUnlessAsked() {
        const auto window = labellingWindow(10);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const auto file = home() / "truth.txt";
        {
            std::ofstream out(file);
            for (int frame = 1; frame <= 6; ++frame) out << frame << ",4," << 20 + 3 * frame << ",30,20,10,1,1,1\n";
        }
        for (const bool second : {false, true}) {
            LabelImportDialog import(labels);
            QSignalSpy read(&import, &LabelImportDialog::fileRead);
            import.setFile(file);
            QVERIFY(read.wait(kPatience_ms));
            QCOMPARE(import.report().contains(QStringLiteral("1 of its objects are labelled here already")), second);
            import.accept();
            QVERIFY(waitFor([&] { return !labels.annotations().objects.empty(); }));
            QVERIFY(waitFor([&] { return import.isEnabled(); }));
            QCOMPARE(labels.annotations().objects.size(), std::size_t(1));
            if (!second) continue;
            QVERIFY2(import.report().contains(QStringLiteral("Nothing was imported")), qPrintable(import.report()));
            import.setAddDoubles(true);
            import.accept();
            QVERIFY(waitFor([&] { return labels.annotations().objects.size() == 2; }));
        }
    }

    void boxesWithoutIdAreImportedOneByOneOrLinked() {
        const auto file = home() / "detections.txt";
        {
            std::ofstream out(file);
            for (int frame = 1; frame <= 6; ++frame)
                out << frame << ",-1," << 20 + 3 * frame << ",30,20,10,0.9,-1,-1,-1\n";
        }
        for (const bool link : {false, true}) {
            const auto window = labellingWindow(10);
            QVERIFY(window);
            LabelSession& labels = window->labelling().labels();
            const std::size_t before = labels.annotations().objects.size();
            LabelImportDialog import(labels);
            QSignalSpy read(&import, &LabelImportDialog::fileRead);
            import.setFile(file);
            QVERIFY(read.wait(kPatience_ms));
            QVERIFY2(import.report().contains(QStringLiteral("6 boxes have no id")), qPrintable(import.report()));
            if (link) {
                read.clear();
                import.setLink(true);
                QVERIFY(read.wait(kPatience_ms));
                import.setAddDoubles(true);
            }
            QSignalSpy accepted(&import, &QDialog::accepted);
            import.accept();
            QVERIFY(accepted.wait(kPatience_ms));
            QCOMPARE(labels.annotations().objects.size() - before, std::size_t(link ? 1 : 6));
        }
    }

    void nothingIsImportedIntoLabelsThatAreOpenedMeanwhile() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        LabelSession& labels = window->labelling().labels();
        const auto file = home() / "truth.txt";
        std::ofstream(file) << "1,4,20,30,20,10,1,1,1\n2,4,22,30,20,10,1,1,1\n";
        LabelImportDialog import(labels);
        import.open();
        QSignalSpy read(&import, &LabelImportDialog::fileRead);
        import.setFile(file);
        QVERIFY(read.wait(kPatience_ms));
        QVERIFY(import.readyToImport());
        QSignalSpy rejected(&import, &QDialog::rejected);
        QSignalSpy opened(&labels, &LabelSession::opened);
        import.accept();  // the plan is being made while other labels take the place of these
        window->session().open(test::writeScene(home() / "others", 5));
        QVERIFY(opened.wait(kPatience_ms));
        if (import.result() != QDialog::Accepted) QCOMPARE(rejected.count(), 1);
        QVERIFY(!import.isVisible());
        import.accept();
        QVERIFY(!import.readyToImport() || import.result() == QDialog::Accepted);
        QVERIFY(labels.annotations().objects.empty());
    }

    void aBrokenFileIsRefusedAndNothingChanges() {
        const auto window = labellingWindow(5);
        QVERIFY(window);
        const auto file = home() / "broken.txt";
        std::ofstream(file) << "1,2,not a number\n";
        LabelImportDialog import(window->labelling().labels());
        QSignalSpy read(&import, &LabelImportDialog::fileRead);
        import.setFile(file);
        QVERIFY(read.wait(kPatience_ms));
        QVERIFY(!import.readyToImport());
        QVERIFY(import.report().contains(QStringLiteral("broken.txt")));
    }
};

}  // namespace eyrie::ui::label_files_test

EYRIE_UI_TEST(QApplication, label_files_test, LabelFilesTest)
#include "label_files_test.moc"
