#include <QComboBox>
#include <QTest>
#include <algorithm>

#include "store/details/recording_options.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "window/main_window.h"

namespace eyrie::ui::keep_choice_test {

using test::kPatience_ms;

/// What a run keeps beside its tracks, as it is chosen beside Run.
class KeepChoiceTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// As a person chooses it.
    static void choose(QComboBox& box, KeptDetails details) {
        box.setCurrentIndex(box.findData(static_cast<int>(details)));
        emit box.activated(box.currentIndex());
    }
    /// Of how many frames of a new run the details are there; −1 where it takes too long.
    static int keptByARun(ProjectSession& session) {
        if (!test::runAndWait(session)) return -1;
        const auto read = [&] {
            const auto& data = session.runData();
            return data && data->record.id == session.currentRun() && data->record.state == RunState::finished &&
                   static_cast<int>(data->frames.size()) == session.lastFrame() + 1;
        };
        if (!QTest::qWaitFor(read, kPatience_ms)) return -1;
        int kept = 0;
        for (FrameIndex frame = 0; frame <= session.lastFrame(); ++frame) kept += session.detailsKept(frame) ? 1 : 0;
        return kept;
    }
    static bool stores(const ProjectSession& session, const char* value) {
        const auto& parameters = session.runData()->parameters;
        return std::find(parameters.begin(), parameters.end(),
                         std::pair<std::string, std::string>("recording.details", value)) != parameters.end();
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void theChoiceBesideRunIsWhatTheNextRunKeepsAndStores() {
        MainWindow window;
        window.show();
        auto* box = window.findChild<QComboBox*>(QStringLiteral("kept_details"));
        QVERIFY(box != nullptr);
        QVERIFY2(box->isEnabled(), "a live source needs no video to begin with");
        for (const char* needs_it : {"Why?", "Stages", "kB"}) QVERIFY(box->toolTip().contains(QLatin1String(needs_it)));
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(30)));
        QVERIFY(box->isEnabled());
        QCOMPARE(box->currentData().toInt(), static_cast<int>(KeptDetails::automatic));
        QCOMPARE(keptByARun(window.session()), 30);
        choose(*box, KeptDetails::none);
        QCOMPARE(keptByARun(window.session()), 0);
        QVERIFY(stores(window.session(), "none"));
        choose(*box, KeptDetails::sampled);
        QCOMPARE(keptByARun(window.session()), 2);  // frames 0 and 25
        QVERIFY(stores(window.session(), "sampled"));
        choose(*box, KeptDetails::all);
        QCOMPARE(keptByARun(window.session()), 30);
        QVERIFY(stores(window.session(), "all"));
    }

    void theChoiceIsThatOfTheDayBefore() {
        const auto boxOf = [](MainWindow& window) {
            return window.findChild<QComboBox*>(QStringLiteral("kept_details"));
        };
        {
            MainWindow window;
            QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(30)));
            choose(*boxOf(window), KeptDetails::none);
        }
        MainWindow window;
        QCOMPARE(boxOf(window)->currentData().toInt(), static_cast<int>(KeptDetails::none));
        QCOMPARE(window.session().settings().recording.details, KeptDetails::none);
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(30)));
        QCOMPARE(window.session().settings().recording.details, KeptDetails::none);
    }
};

}  // namespace eyrie::ui::keep_choice_test

EYRIE_UI_TEST(QApplication, keep_choice_test, KeepChoiceTest)
#include "keep_choice_test.moc"
