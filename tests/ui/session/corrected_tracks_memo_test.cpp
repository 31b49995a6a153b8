#include "session/project/corrected_tracks_memo.h"

#include <QTest>

#include "correction/corrected_run.h"
#include "correction/made_corrections.h"
#include "store/runs/result_writer.h"
#include "support/temporary_folder.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::corrected_tracks_memo_test {

class CorrectedTracksMemoTest : public QObject {
    Q_OBJECT

    static constexpr int kFrames = 20;

    /// A run with one track that drives to the right.
    static RunRecord writtenRun(const std::filesystem::path& path) {
        RunRecord run;
        run.sequence.path = "/videos/street.mp4";
        run.sequence.size = {400, 300};
        run.sequence.frame_count = kFrames;
        run.sequence.frame_rate_hz = 25;
        run.last_frame = kFrames - 1;
        int id = 0;
        {
            ResultWriter writer(path, run, {});
            id = writer.runId();
            for (int i = 0; i < kFrames; ++i) {
                FrameResult frame;
                frame.motion.frame = i;
                frame.tracks.resize(1);
                frame.tracks.front().id = 1;
                frame.tracks.front().status = TrackStatus::confirmed;
                frame.tracks.front().box = {{50.0 + 5 * i, 100}, 20, 10, 0};
                writer.write(frame);
            }
            writer.finish(RunState::finished, {});
        }
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        return *RunStore(project).run(id);
    }

 private slots:
    void theSameCorrectionsOfTheSameRunAreComputedOnce() {
        const eyrie::test::TemporaryFolder folder;
        const std::filesystem::path path = folder / "clip.eyrie";
        ProjectFile::create(path);
        RunRecord run = writtenRun(path);
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        const RunStore store(project);
        TrackCorrection split = splitOf(store.trackStates(run.id, 1), 8);
        split.id = 1;
        CorrectedTracksMemo memo;
        const auto first = memo.of(store, path, run, {{1, split}});
        QCOMPARE(first->states.at(1), CorrectionState::applied);
        QCOMPARE(first->tracks.size(), std::size_t(2));
        split.person = "somebody";
        split.when_utc = "2026-11-25T10:00:00Z";
        QVERIFY2(memo.of(store, path, run, {{1, split}}) == first, "who says so makes no difference");
        split.frame = 12;
        const auto later = memo.of(store, path, run, {{1, split}});
        QVERIFY(later != first);
        QCOMPARE(later->tracks.at(1).states.size(), std::size_t(12));
        QVERIFY(memo.of(store, path, run, {})->empty());
        run.frames_done = 10;
        QCOMPARE(memo.of(store, path, run, {{1, split}})->states.at(1), CorrectionState::not_searched);
    }
};

}  // namespace eyrie::ui::corrected_tracks_memo_test

EYRIE_UI_TEST(QCoreApplication, corrected_tracks_memo_test, CorrectedTracksMemoTest)
#include "corrected_tracks_memo_test.moc"
