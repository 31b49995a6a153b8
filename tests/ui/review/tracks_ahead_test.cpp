#include "review/events/tracks_ahead.h"

#include <QTest>

#include "support/temporary_folder.h"
#include "support/written_run.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::tracks_ahead_test {

/// Tracks of a run that are read before they are asked for.
class TracksAheadTest : public QObject {
    Q_OBJECT

    const eyrie::test::TemporaryFolder folder_;
    const std::filesystem::path project_ = folder_ / "p.eyrie";
    RunRecord run_;

 private slots:
    void initTestCase() {
        run_ = eyrie::test::writeRun(project_, 5, [](int frame, FrameResult& result) {
            TrackState track;
            track.id = 4;
            track.box = {{10.0 + frame, 60}, 22, 9, 0};
            track.status = TrackStatus::confirmed;
            result.tracks.push_back(track);
        });
    }

    void theyAreHandedOutOnce() {
        TracksAhead ahead;
        QVERIFY2(ahead.take(project_, run_).wait() == nullptr, "nothing was begun");
        ahead.begin(project_, run_);
        const auto tracks = ahead.take(project_, run_).wait();
        QVERIFY(tracks != nullptr);
        QCOMPARE(tracks->tracks.size(), std::size_t(1));
        QCOMPARE(tracks->tracks.front().boxes.size(), std::size_t(5));
        ahead.begin(project_, run_);
        QVERIFY2(ahead.take(project_, run_).wait() == nullptr, "who asks again wants what the run holds by then");
        ahead.forget();
        ahead.begin(project_, run_);
        QVERIFY(ahead.take(project_, run_).wait() != nullptr);
    }

    void theyAreOfThisRunInThisState() {
        TracksAhead ahead;
        ahead.begin(project_, run_);
        RunRecord other = run_;
        other.frames_done = 4;
        QVERIFY2(ahead.take(project_, other).wait() == nullptr, "frames were added since");
        other = run_;
        ++other.id;
        QVERIFY(ahead.take(project_, other).wait() == nullptr);
        QVERIFY(ahead.take(folder_ / "q.eyrie", run_).wait() == nullptr);
        QVERIFY(ahead.take(project_, run_).wait() != nullptr);
    }

    void whatCannotBeReadIsLeftToWhoAsks() {
        TracksAhead ahead;
        ahead.begin(folder_ / "none.eyrie", run_);
        QVERIFY(ahead.take(folder_ / "none.eyrie", run_).wait() == nullptr);
    }
};

}  // namespace eyrie::ui::tracks_ahead_test

EYRIE_UI_TEST(QCoreApplication, tracks_ahead_test, TracksAheadTest)
#include "tracks_ahead_test.moc"
