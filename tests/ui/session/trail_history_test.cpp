#include "session/frames/trail_history.h"

#include <QTest>

#include "ui/support/ui_test.h"

namespace eyrie::ui::trail_history_test {

class TrailHistoryTest : public QObject {
    Q_OBJECT

    /// The camera moves so that the ground shifts by `dx` px a frame.
    static TrailStep step(FrameIndex frame, double dx, std::vector<std::pair<TrackId, cv::Point2f>> centres) {
        TrailStep step;
        step.frame = frame;
        step.current_from_previous.matrix(0, 2) = dx;
        step.centres = std::move(centres);
        return step;
    }

 private slots:
    void aStandingObjectHasNoTrailUnderAMovingCamera() {
        TrailHistory history(10);
        for (int f = 0; f < 5; ++f) history.add(step(f, f == 0 ? 0 : -3, {{1, {100.F - 3 * f, 50}}}));
        const auto trails = history.trails();
        QCOMPARE(trails.size(), std::size_t(1));
        QCOMPARE(trails[0].points.size(), std::size_t(5));
        for (const cv::Point2f& p : trails[0].points) {
            QVERIFY(std::abs(p.x - 88) < 1e-4);
            QVERIFY(std::abs(p.y - 50) < 1e-4);
        }
    }

    void trailsRunFromOldToNewAndAreLimited() {
        TrailHistory history(3);
        for (int f = 0; f < 8; ++f) history.add(step(f, 0, {{4, {10.F * f, 0}}}));
        const auto trails = history.trails();
        QCOMPARE(trails[0].points.size(), std::size_t(3));
        QCOMPARE(trails[0].points.front().x, 50.F);
        QCOMPARE(trails[0].points.back().x, 70.F);
    }

    void onlyTracksAliveNowHaveTrails() {
        TrailHistory history(10);
        history.add(step(0, 0, {{1, {0, 0}}, {2, {5, 5}}}));
        history.add(step(1, 0, {{2, {6, 5}}, {3, {9, 9}}}));  // 1 is gone, 3 is new
        const auto trails = history.trails();
        QCOMPARE(trails.size(), std::size_t(1));
        QCOMPARE(trails[0].id, 2);
    }

    void aJumpBeginsAnew() {
        TrailHistory history(10);
        history.add(step(0, 0, {{1, {0, 0}}}));
        history.add(step(7, 0, {{1, {50, 0}}}));
        QVERIFY(history.trails().empty());
    }
};

}  // namespace eyrie::ui::trail_history_test

EYRIE_UI_TEST(QCoreApplication, trail_history_test, TrailHistoryTest)
#include "trail_history_test.moc"
