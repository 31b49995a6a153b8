#include "session/frames/stored_frames.h"

#include <QCoreApplication>
#include <QTest>
#include <algorithm>
#include <cmath>

#include "store/runs/result_writer.h"
#include "support/temporary_folder.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::stored_frames_test {

namespace {

constexpr int kFrames = 300;
constexpr int kTrail = 10;

/// The ground shifts by one px to the left a frame; a vehicle stands on it.
FrameResult standing(FrameIndex frame) {
    FrameResult result;
    result.motion.frame = frame;
    result.motion.time_us = frame * std::int64_t{40'000};
    result.motion.image_size = {768, 576};
    result.motion.registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
    Homography& homography = result.motion.registration.current_from_previous;
    homography.from_frame = frame - 1;
    homography.to_frame = frame;
    homography.matrix(0, 2) = frame == 0 ? 0 : -1;
    TrackState state;
    state.id = 1;
    state.status = TrackStatus::confirmed;
    state.score = 1;
    state.box = {{700.0 - frame, 200}, 20, 9, 0};
    result.tracks.push_back(state);
    return result;
}

}  // namespace

/// Frames of a stored run as the canvas shows them.
class StoredFramesTest : public QObject {
    Q_OBJECT

    eyrie::test::TemporaryFolder folder_;
    int run_ = 0;

    std::filesystem::path project() const { return folder_ / "run.eyrie"; }

 private slots:
    void initTestCase() {
        ProjectFile::openOrCreate(project());
        RunRecord run;
        run.sequence.path = "/videos/street.mp4";
        run.sequence.size = {768, 576};
        run.sequence.frame_count = kFrames;
        run.sequence.frame_rate_hz = 25;
        run.scale = {0.25, 25, true};
        run.last_frame = kFrames - 1;
        ResultWriter writer(project(), run, {});
        for (FrameIndex frame = 0; frame < kFrames; ++frame) writer.write(standing(frame));
        writer.finish(RunState::finished, "");
        run_ = writer.runId();
    }

    void framesKnowWhereShadowsFallIfTheRunDoes() {
        const std::filesystem::path lit = folder_ / "lit.eyrie";
        std::filesystem::copy_file(project(), lit);
        {
            ProjectFile file = ProjectFile::open(lit);
            TracksOfRun tracks;
            tracks.light.frames = {{7, 1.5, 12}};
            RunStore(file).replaceTracks(run_, tracks);
        }
        StoredFrames frames(lit, run_, kTrail);
        for (const FrameIndex frame : {6, 7}) {
            ViewFrame view;
            view.index = frame;
            frames.addTo(view);
            QCOMPARE(view.shadow.has_value(), frame == 7);
            if (view.shadow) QVERIFY(std::abs(view.shadow->heading - 1.5) < 1e-9);
        }
    }

    void trailsFollowTheCameraWhereverOneJumps() {
        // As it is, and with so little kept that nearly every jump drops what was read, also within a trail.
        for (const HomographyBlocks& blocks : {HomographyBlocks{}, HomographyBlocks{16, 3}, HomographyBlocks{4, 1}}) {
            StoredFrames frames(project(), run_, kTrail, {}, blocks);
            // On, back, and across what is read at once.
            for (const FrameIndex frame : {280, 259, 100, kFrames - 1, 256, 4, 255, 128, 127, 15, 16, 200, 280}) {
                ViewFrame view;
                view.index = frame;
                frames.addTo(view);
                QVERIFY(view.result != nullptr);
                QCOMPARE(view.trails.size(), std::size_t(1));
                const auto& points = view.trails.front().points;
                QCOMPARE(points.size(), std::size_t(std::min(kTrail, frame + 1)));
                for (const cv::Point2f& point : points) QVERIFY(std::abs(point.x - (700 - frame)) < 1e-3);
            }
        }
    }

    void aFrameThatTheRunDoesNotHaveIsLeftAsItIs() {
        StoredFrames frames(project(), run_, kTrail);
        ViewFrame view;
        view.index = kFrames + 500;
        frames.addTo(view);
        QVERIFY(view.result == nullptr);
        QVERIFY(view.trails.empty());
        QVERIFY(!frames.prepare(kFrames));
        QVERIFY(frames.prepare(kFrames - 1));
    }
};

}  // namespace eyrie::ui::stored_frames_test

EYRIE_UI_TEST(QCoreApplication, stored_frames_test, StoredFramesTest)
#include "stored_frames_test.moc"
