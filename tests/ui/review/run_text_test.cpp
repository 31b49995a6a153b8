#include "review/runs/run_text.h"

#include <QLocale>
#include <QTest>

#include "ui/support/ui_test.h"

namespace eyrie::ui::run_text_test {

/// What is said about a run that has ended.
class RunTextTest : public QObject {
    Q_OBJECT

    static RunRecord run() {
        RunRecord run;
        run.id = 2;
        run.scale = {0.25, 25, true};
        run.state = RunState::finished;
        return run;
    }
    static RunFacts facts(int tracks) {
        RunFacts facts;
        facts.counts.frames = 500;
        facts.counts.tracks = tracks;
        return facts;
    }

 private slots:
    void initTestCase() { QLocale::setDefault(QLocale::c()); }

    void howLongCouldNotBeSearchedIsToldInTime() {
        RunFacts found = facts(3);
        QVERIFY(!runSummaryText(run(), found).contains(QStringLiteral("could not be searched")));
        found.counts.unregistered = 300;
        found.counts.reasons = {{RegistrationFault::none, PictureQuality::clear, 300}};
        const QString text = runSummaryText(run(), found);
        QVERIFY2(text.contains(QStringLiteral("12.0 s could not be searched: 300 frames")), qPrintable(text));
    }

    void tooFewFramesAreToldWithHowManyATrackTakes() {
        RunFacts found = facts(0);
        found.nothing = NothingFollowed::too_few_frames;
        found.counts.frames = 3;
        found.frames_needed = 6;
        QCOMPARE(whyNoTracks(found), QStringLiteral("3 frames are too few for a track, which needs at least 6 "
                                                    "(tracking.confirm_hits)."));
        found.counts.frames = 1;
        QVERIFY(whyNoTracks(found).startsWith(QStringLiteral("1 frame is too few")));
    }

    void eventsAreCountedBesideTracks() {
        QVERIFY(runSummaryText(run(), facts(3)).contains(QStringLiteral(": 3 tracks.")));
        QVERIFY(runSummaryText(run(), facts(3), 9).contains(QStringLiteral(": 3 tracks, 9 events.")));
        QVERIFY(runSummaryText(run(), facts(1), 1).contains(QStringLiteral(": 1 track, 1 event.")));
    }
};

}  // namespace eyrie::ui::run_text_test

EYRIE_UI_TEST(QCoreApplication, run_text_test, RunTextTest)
#include "run_text_test.moc"
