#include "tune/inspect/inspection.h"

#include <QSignalSpy>
#include <QTest>

#include "tune/inspect/cluster_choice.h"
#include "tune/inspect/vector_lifetimes.h"
#include "ui/support/ui_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::inspection_test {

using test::kPatience_ms;

namespace {

MotionCluster clusterAtPlace(cv::Point2d centre, std::vector<int> members) {
    MotionCluster cluster;
    cluster.box = {centre, 20, 10, 0};
    cluster.members = std::move(members);
    return cluster;
}

/// Two clusters of three corners each, a detection in the first, a track on it and one on the second cluster alone.
FrameResult twoClusters() {
    FrameResult result;
    for (int i = 0; i < 6; ++i) {
        MotionVector vector;
        vector.id = 10 + i;
        result.motion.motion_vectors.push_back(vector);
    }
    result.clusters = {clusterAtPlace({50, 50}, {0, 1, 2}), clusterAtPlace({150, 50}, {3, 4, 5})};
    result.rois = {{{50, 50}, 60, 20, 0}, {{150, 50}, 60, 20, 0}};
    Detection detection;
    detection.box = {{50, 50}, 18, 8, 0};
    detection.cluster = 0;
    result.detections = {detection};
    TrackState first;
    first.id = 1;
    first.box = {{52, 50}, 18, 8, 0};
    TrackState second;
    second.id = 2;
    second.box = {{155, 50}, 18, 8, 0};
    TrackState lost;
    lost.id = 3;
    lost.box = {{300, 300}, 18, 8, 0};
    result.tracks = {first, second, lost};
    return result;
}

}  // namespace

class InspectionTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    static bool waitFor(const std::function<bool()>& condition) { return QTest::qWaitFor(condition, kPatience_ms); }

    /// A session that shows frame `frame` of a finished run over 60 frames.
    static std::unique_ptr<ProjectSession> sessionWithRun(const ChainOptions& options, FrameIndex frame) {
        auto session = std::make_unique<ProjectSession>();
        QSignalSpy ready(session.get(), &ProjectSession::ready);
        session->openMedia(test::sceneUnderTest(60));
        if (!ready.wait(kPatience_ms)) return nullptr;
        session->settings().options = options;
        session->settings().options.view.oblique = false;
        session->settings().gsd_m_per_px = 0.25;
        QSignalSpy finished(session.get(), &ProjectSession::runFinished);
        session->startRun();
        if (!finished.wait(kPatience_ms)) return nullptr;
        session->goToFrame(frame);
        return waitFor([&] { return session->viewFrame().index == frame && session->viewFrame().result; })
                   ? std::move(session)
                   : nullptr;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void whatIsPointedAtIsTheSmallestThingThere() {
        const FrameResult result = twoClusters();
        QCOMPARE(clusterAt(result, {50, 50}), std::optional(0));
        QCOMPARE(clusterAt(result, {158, 54}), std::optional(1));  // the cluster itself
        QCOMPARE(clusterAt(result, {175, 50}), std::optional(1));  // its search area
        QCOMPARE(clusterAt(result, {100, 150}), std::nullopt);
        QCOMPARE(clusterAt(result, {150, 62}), std::nullopt);
        QCOMPARE(clusterAt(result, {150, 62}, 3), std::optional(1));  // nearly
    }

    void aTrackLeadsToItsDetectionElseToItsCluster() {
        const FrameResult result = twoClusters();
        QCOMPARE(clusterOfTrack(result, 1), std::optional(0));
        QCOMPARE(clusterOfTrack(result, 2), std::optional(1));
        QCOMPARE(clusterOfTrack(result, 3), std::nullopt);
        QCOMPARE(clusterOfTrack(result, 99), std::nullopt);
    }

    void aClusterIsFoundAgainByItsCorners() {
        const FrameResult result = twoClusters();
        QCOMPARE(cornersOf(result, 1), (std::vector<CornerId>{13, 14, 15}));
        QCOMPARE(cornersOf(result, 7), std::vector<CornerId>());
        QCOMPARE(clusterWith(result, {12, 13, 14}), std::optional(1));
        QCOMPARE(clusterWith(result, {77}), std::nullopt);
    }

    void livesOfMotionVectorsFallIntoTheThesisBins() {
        QCOMPARE(lifeBin(1), 0);
        QCOMPARE(lifeBin(10), 0);
        QCOMPARE(lifeBin(11), 1);
        QCOMPARE(lifeBin(50), 1);
        QCOMPARE(lifeBin(51), 2);
        QCOMPARE(lifeBin(100), 2);
        QCOMPARE(lifeBinText(1), QStringLiteral("11–50"));
        QCOMPARE(lifeBinText(2), QStringLiteral("51–100"));
        // One vector for 60 frames, of which 12 in a track's box; another for 5 frames, beside it.
        VectorLifeCounter counter;
        for (int frame = 0; frame < 60; ++frame) {
            FrameResult result;
            MotionVector followed;
            followed.id = 1;
            followed.position = {50, 50};
            followed.age = 9;
            result.motion.motion_vectors.push_back(followed);
            if (frame < 5) {
                MotionVector other;
                other.id = 2;
                other.position = {90, 90};
                other.age = 9;
                result.motion.motion_vectors.push_back(other);
            }
            MotionVector inferred;  // of age 0, without a corner: it has no life
            inferred.id = 1000 + frame;
            result.motion.motion_vectors.push_back(inferred);
            TrackState track;
            track.box = {{50, 50}, 20, 10, 0};
            track.status = frame < 12 ? TrackStatus::coasting : TrackStatus::tentative;
            result.tracks.push_back(track);
            counter.add(result);
        }
        const VectorLifetimes lives = counter.lives();
        QCOMPARE(lives.vectors, 2);
        QCOMPARE(lives.life, (std::vector<int>{1, 0, 1}));
        QCOMPARE(lives.association, (std::vector<int>{0, 1, 0}));
        QCOMPARE(lives.mean_life, 32.5);
        QCOMPARE(lives.mean_association, 12.0);
        QCOMPARE(VectorLifeCounter().lives().vectors, 0);
    }

    void theChosenClusterIsFollowedAndItsStepsAreReplayed() {
        const auto session = sessionWithRun({}, 30);
        QVERIFY(session);
        Inspection inspection(*session);
        inspection.step(1);
        QVERIFY(inspection.cluster());
        QVERIFY(inspection.area());
        QCoreApplication::processEvents();
        QVERIFY(!inspection.view());  // nobody looks
        inspection.wantStages(true);
        QVERIFY(waitFor([&] { return inspection.view() && !inspection.view()->traces.empty(); }));
        const ReplayView& view = *inspection.view();
        QCOMPARE(view.wish.frame, 30);
        QVERIFY(view.exact);
        const FrameResult& stored = *session->viewFrame().result;
        QCOMPARE(view.result.detections.size(), stored.detections.size());
        for (std::size_t i = 0; i < stored.detections.size(); ++i)
            QVERIFY(overlap(view.result.detections[i].box, stored.detections[i].box) > 0.999999);
        const auto corners = cornersOf(stored, *inspection.cluster());
        session->goToFrame(31);
        QVERIFY(waitFor([&] { return inspection.view() && inspection.view()->wish.frame == 31; }));
        QVERIFY(inspection.cluster());
        const auto later = cornersOf(*session->viewFrame().result, *inspection.cluster());
        QVERIFY(std::any_of(later.begin(), later.end(),
                            [&](CornerId id) { return std::binary_search(corners.begin(), corners.end(), id); }));
        inspection.wantGeneralSegmentation(true);
        QVERIFY(waitFor([&] { return inspection.view()->general.has_value(); }));
        QVERIFY(!inspection.view()->general->superpixels.empty());
        inspection.clear();
        QVERIFY(!inspection.hasChoice());
        QVERIFY(!inspection.area());
    }

    void stacksComeWithTheirHeightAndOnlyTheNewestWishIsAnswered() {
        ChainOptions options;
        options.stacking.enabled = true;
        options.stacking.capacity = 12;
        options.stacking.min_height = 6;
        const auto session = sessionWithRun(options, 20);
        QVERIFY(session);
        Inspection inspection(*session);
        inspection.wantStacks(StackPictures::surroundings);
        for (const FrameIndex frame : {10, 50, 21, 40}) session->goToFrame(frame);
        QVERIFY(waitFor([&] { return inspection.view() && inspection.view()->wish.frame == 40; }));
        const ReplayView& view = *inspection.view();
        QVERIFY(!view.stacks.empty());
        QVERIFY(view.stacks.front().height > 6);
        QCOMPARE(view.stacks.front().raw.size(), view.stacks.front().stacked.size());
        const cv::Size near = view.stacks.front().raw.size();
        inspection.wantStacks(StackPictures::whole_area);
        QVERIFY(waitFor([&] { return inspection.view()->wish.stacks == StackPictures::whole_area; }));
        QVERIFY(inspection.view()->stacks.front().raw.rows > near.height);
    }

    void aVideoThatIsGoneIsSaidNotShown() {
        const auto folder = test::writeScene(*home_ / "images", 30);
        ProjectSession session;
        QSignalSpy ready(&session, &ProjectSession::ready);
        session.open(folder);
        QVERIFY(ready.wait(kPatience_ms));
        session.settings().gsd_m_per_px = 0.25;
        session.settings().options.view.oblique = false;
        QSignalSpy finished(&session, &ProjectSession::runFinished);
        session.startRun();
        QVERIFY(finished.wait(kPatience_ms));
        session.goToFrame(20);
        QVERIFY(waitFor([&] { return session.viewFrame().index == 20 && session.viewFrame().result; }));
        Inspection inspection(session);
        std::filesystem::remove_all(folder);
        inspection.step(1);
        inspection.wantStages(true);
        QVERIFY(waitFor([&] { return !inspection.problem().isEmpty(); }));
        QVERIFY(!inspection.view());
    }

    void goingDownInTheMiddleOfAReplayWaitsForNobody() {
        ChainOptions options;
        options.stacking.enabled = true;
        const auto session = sessionWithRun(options, 59);
        QVERIFY(session);
        Inspection inspection(*session);
        inspection.wantStacks(StackPictures::surroundings);
        session->goToFrame(58);
        // Under way; or, on a fast machine, done before anybody could see that.
        QVERIFY(waitFor([&] { return inspection.framesLeft() > 0 || inspection.view(); }));
    }
};

}  // namespace eyrie::ui::inspection_test

EYRIE_UI_TEST(QApplication, inspection_test, InspectionTest)
#include "inspection_test.moc"
