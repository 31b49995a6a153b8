#include <QApplication>
#include <QDockWidget>
#include <QLabel>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>

#include "review/tracks/tracks_panel.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "widgets/empty_state.h"
#include "window/docks/review_docks.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui::empty_docks_test {

/// What docks say while there is nothing to show: what to do first.
class EmptyDocksTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool says(MainWindow& window, DockId id, const QString& begin) {
        const auto labels = window.docks().dock(id)->findChildren<QLabel*>();
        return std::any_of(labels.begin(), labels.end(),
                           [&](const QLabel* label) { return label->text().startsWith(begin); });
    }
    static constexpr DockId kDocks[] = {DockId::tracks, DockId::events, DockId::inspector, DockId::mosaic,
                                        DockId::card};

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void everyDockOfReviewSaysWhatToDoFirst() {
        MainWindow window;
        window.show();
        for (const DockId id : kDocks)
            QVERIFY2(says(window, id, QStringLiteral("Open a video first.")),
                     qPrintable(window.docks().dock(id)->windowTitle()));
        QVERIFY(says(window, DockId::metadata, QStringLiteral("Open a video first.")));
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(40)));
        for (const DockId id : kDocks)
            QVERIFY2(says(window, id, QStringLiteral("Run the video first, or choose a run.")),
                     qPrintable(window.docks().dock(id)->windowTitle()));
        // Without a scale it takes some seconds before there is a run.
        window.session().settings().options.view.oblique = false;
        QSignalSpy finished(&window.session(), &ProjectSession::runFinished);
        window.session().startRun();
        for (const DockId id : kDocks)
            QVERIFY2(says(window, id, QStringLiteral("Wait for the first frames of the run.")),
                     qPrintable(window.docks().dock(id)->windowTitle()));
        QVERIFY(finished.wait(test::kPatience_ms));
        const EmptyState* tracks = window.review().tracks().emptyState();
        QTRY_VERIFY(!tracks->explanation().startsWith(QStringLiteral("Run the video first")));
        for (const DockId id : {DockId::card, DockId::mosaic})
            QVERIFY2(!says(window, id, QStringLiteral("Run the video first")),
                     qPrintable(window.docks().dock(id)->windowTitle()));
    }
};

}  // namespace eyrie::ui::empty_docks_test

EYRIE_UI_TEST(QApplication, empty_docks_test, EmptyDocksTest)
#include "empty_docks_test.moc"
