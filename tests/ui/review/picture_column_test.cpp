#include "review/pictures/picture_column.h"

#include <QHeaderView>
#include <QScrollBar>
#include <QTableView>
#include <QTest>
#include <limits>
#include <numbers>

#include "canvas/drawing/image_convert.h"
#include "core/error.h"
#include "review/events/found_events.h"
#include "review/tracks/tracks_panel.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::picture_column_test {

using test::kPatience_ms;

namespace {

constexpr int kFrames = 60;
constexpr int kTracks = 40;
constexpr int kFirst = 10;  ///< frame of track 0
constexpr TrackId kUnreadable = 3;

/// The first vehicle of the scene under test: track n is seen n frames later than `kFirst`.
VehiclePlace placeOf(int track) {
    const int frame = kFirst + track;
    return {frame, {{30.5 + 3 * frame, 55}, 22, 11, 0}};
}

EventTrack driven(TrackId id, FrameIndex first, int frames) {
    EventTrack track;
    track.id = id;
    for (int i = 0; i < frames; ++i) track.boxes.push_back({first + i, {{10.0 + i, 50}, 20, 10, 0}});
    return track;
}

}  // namespace

/// Pictures of vehicles in lists: what they show, that only rows in view are read, and that none stay of another video.
class PictureColumnTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// A list of forty tracks over a session, with pictures.
    struct Stage {
        ProjectSession session;
        TracksModel model;
        TracksPanel panel{&model};
        PictureColumn* pictures = nullptr;

        void showPictures(bool shown = true) { panel.table()->setColumnHidden(TracksModel::picture_column, !shown); }
        int rowHeight() const { return panel.table()->rowHeight(0); }
        bool isRead(int track) const { return pictures->pictureOf(track) != nullptr; }
    };
    static std::unique_ptr<Stage> stageWithScene() {
        auto stage = std::make_unique<Stage>();
        const auto scratch = [](FrameIndex frame) {
            if (frame == kFirst + kUnreadable) throw Error(ErrorKind::input, "a scratch");
        };
        if (!test::openAndWait(stage->session, test::sceneUnderTest(kFrames, scratch))) return nullptr;
        stage->pictures = new PictureColumn(stage->panel, TracksModel::picture_column, stage->session,
                                            [](int id) { return id == 2 ? std::nullopt : std::optional(placeOf(id)); });
        std::vector<TrackSummary> tracks(kTracks);
        for (int i = 0; i < kTracks; ++i) {
            tracks[static_cast<std::size_t>(i)].id = i + 1;
            tracks[static_cast<std::size_t>(i)].confirmed = true;
            tracks[static_cast<std::size_t>(i)].score = 1;
        }
        stage->model.setTracks(std::move(tracks), {});
        stage->panel.resize(500, 400);
        stage->panel.show();
        return QTest::qWaitForWindowExposed(&stage->panel) ? std::move(stage) : nullptr;
    }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void theVehicleHeadsToTheRightInItsPicture() {
        // It drives down; its front is bright.
        cv::Mat picture(200, 200, CV_8UC1, cv::Scalar(0));
        picture(cv::Rect(92, 80, 17, 41)) = 120;
        picture(cv::Rect(92, 111, 17, 10)) = 250;
        const OrientedBox box{{100, 100}, 40, 16, std::numbers::pi / 2};
        const cv::Mat chip = pictureOfVehicle(picture, box, {84, 48});
        QCOMPARE(chip.cols, 84);
        QCOMPARE(chip.rows, 48);
        const auto grey = [&](int x, int y) { return static_cast<int>(chip.at<uchar>(y, x)); };
        QVERIFY2(grey(59, 23) > 230, "the front is on the right");
        QVERIFY(std::abs(grey(24, 23) - 120) < 20);
        QCOMPARE(grey(2, 2), 0);
        // Colours stay.
        const cv::Mat blue(50, 50, CV_8UC3, cv::Scalar(200, 20, 10));
        QCOMPARE(pictureOfVehicle(blue, {{25, 25}, 8, 4, 0.3}, {84, 48}).at<cv::Vec3b>(20, 40), cv::Vec3b(200, 20, 10));
    }

    void whatIsNotInThePictureHasNone() {
        const cv::Mat picture(100, 100, CV_8UC1, cv::Scalar(80));
        QVERIFY(pictureOfVehicle(picture, {{1e9, 50}, 20, 10, 0}, {84, 48}).empty());
        QVERIFY(pictureOfVehicle(picture, {{50, 50}, 0, 10, 0}, {84, 48}).empty());
        QVERIFY(
            pictureOfVehicle(picture, {{std::numeric_limits<double>::quiet_NaN(), 50}, 20, 10, 0}, {84, 48}).empty());
        QVERIFY(pictureOfVehicle({}, {{50, 50}, 20, 10, 0}, {84, 48}).empty());
        QVERIFY(!pictureOfVehicle(picture, {{-3, 50}, 20, 10, 0}, {84, 48}).empty());  // half of it is seen
    }

    void tracksAreShownInTheMiddleOfTheirLivesAndEventsWhereTheyHappen() {
        auto run = std::make_shared<StoredTracks>();
        run->footage.camera = CameraMotion::standing(0, 99);
        run->footage.image_size = {240, 180};
        run->footage.last_frame = 99;
        run->tracks = {driven(1, 10, 21), driven(4, 40, 11)};
        QCOMPARE(placeOfTrack(*run, 1)->frame, 20);
        QCOMPARE(placeOfTrack(*run, 1)->box.centre.x, 20.0);
        QCOMPARE(placeOfTrack(*run, 4)->frame, 45);
        QVERIFY(!placeOfTrack(*run, 2));

        TrackFindings findings;
        for (const auto& [track, frame] : {std::pair(1, 12), std::pair(4, 90), std::pair(2, 30)}) {
            Event event;
            event.kind = EventKind::stops;
            event.tracks = {track};
            event.first_frame = event.frame = event.last_frame = frame;
            findings.events.push_back(event);
        }
        const auto found = inOrder(run, std::move(findings), {});
        const auto frame_of = [&](TrackId track) -> std::optional<FrameIndex> {
            for (std::size_t position = 0; position < found->queue.size(); ++position) {
                if (found->eventAt(position) == nullptr || found->eventAt(position)->tracks.front() != track) continue;
                const auto place = placeOfEvent(*found, position);
                return place ? std::optional(place->frame) : std::nullopt;
            }
            return std::nullopt;
        };
        QCOMPARE(frame_of(1), std::optional(12));
        QCOMPARE(frame_of(4), std::optional(50));  // as near to it as it was seen
        QCOMPARE(frame_of(2), std::nullopt);
    }

    void aColumnThatIsHiddenCostsNothing() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        QVERIFY(stage->panel.table()->isColumnHidden(TracksModel::picture_column));
        const int plain = stage->rowHeight();
        QVERIFY(plain < PictureColumn::kShownHeight);
        stage->showPictures();
        QTRY_VERIFY_WITH_TIMEOUT(stage->rowHeight() >= PictureColumn::kShownHeight, kPatience_ms);
        QTRY_VERIFY_WITH_TIMEOUT(stage->isRead(1), kPatience_ms);
        stage->showPictures(false);
        QTRY_COMPARE_WITH_TIMEOUT(stage->rowHeight(), plain, kPatience_ms);
    }

    void onlyRowsInViewAreRead() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        stage->showPictures();
        QTRY_VERIFY_WITH_TIMEOUT(stage->isRead(1) && stage->isRead(4), kPatience_ms);
        const cv::Mat expected = pictureOfVehicle(test::sceneFrame(kFirst + 4), placeOf(4).box,
                                                  {VehiclePictures::kWidth, VehiclePictures::kHeight});
        QCOMPARE(*stage->pictures->pictureOf(4), imageForDisplay(expected));
        QVERIFY(!stage->isRead(kTracks));
        stage->panel.table()->verticalScrollBar()->setValue(stage->panel.table()->verticalScrollBar()->maximum());
        QTRY_VERIFY_WITH_TIMEOUT(stage->isRead(kTracks), kPatience_ms);
        QVERIFY(!stage->isRead(kTracks / 2));
        QVERIFY2(stage->isRead(4), "what was read is kept");
    }

    void whatCannotBeReadHoldsUpNothing() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        stage->showPictures();
        QTRY_VERIFY_WITH_TIMEOUT(stage->isRead(kUnreadable) && stage->isRead(kUnreadable + 1), kPatience_ms);
        QVERIFY(stage->pictures->pictureOf(kUnreadable)->isNull());
        QVERIFY(!stage->pictures->pictureOf(kUnreadable + 1)->isNull());
        QVERIFY2(!stage->isRead(2), "a row about no vehicle");
    }

    void withoutTheVideoThereAreNone() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        stage->showPictures();
        QTRY_VERIFY_WITH_TIMEOUT(stage->isRead(1), kPatience_ms);
        stage->session.closeProject();
        QVERIFY(!stage->isRead(1));
        QVERIFY(test::openAndWait(stage->session, test::sceneUnderTest(kFrames)));
        QTRY_VERIFY_WITH_TIMEOUT(stage->isRead(1), kPatience_ms);
    }
};

}  // namespace eyrie::ui::picture_column_test

EYRIE_UI_TEST(QApplication, picture_column_test, PictureColumnTest)
#include "picture_column_test.moc"
