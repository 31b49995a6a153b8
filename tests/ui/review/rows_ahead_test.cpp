#include "review/pictures/rows_ahead.h"

#include <QScrollBar>
#include <QTableView>
#include <QTest>
#include <algorithm>
#include <mutex>
#include <set>

#include "review/tracks/tracks_panel.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::rows_ahead_test {

using test::kPatience_ms;

namespace {

constexpr int kTracks = 40;
constexpr int kBetween = 20;  ///< frames from one row's to the next: more than is read ahead of one

FrameIndex frameOf(int id) {
    return kBetween * id;
}

/// Which frames were read of the video, by whom ever.
class ReadFrames {
 public:
    void add(FrameIndex frame) {
        const std::scoped_lock lock(mutex_);
        frames_.push_back(frame);
    }
    void clear() {
        const std::scoped_lock lock(mutex_);
        frames_.clear();
    }
    std::vector<FrameIndex> all() const {
        const std::scoped_lock lock(mutex_);
        return frames_;
    }
    bool holds(FrameIndex frame) const {
        const auto frames = all();
        return std::find(frames.begin(), frames.end(), frame) != frames.end();
    }
    /// Those of rows, in the order that they were read.
    std::vector<int> rows() const {
        std::vector<int> ids;
        for (const FrameIndex frame : all())
            if (frame > 0 && frame % kBetween == 0) ids.push_back(frame / kBetween);
        return ids;
    }

 private:
    mutable std::mutex mutex_;
    std::vector<FrameIndex> frames_;
};

}  // namespace

/// Frames of the rows of a list are read before anybody asks for them: of those in view, when nothing else is wanted.
class RowsAheadTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// A list of forty rows, each about a frame of its own.
    struct Stage {
        ReadFrames read;
        ProjectSession session;
        TracksModel model;
        TracksPanel panel{&model};

        QTableView& table() { return *panel.table(); }
        void scrollTo(int value) { table().verticalScrollBar()->setValue(value); }
        void scrollToEnd() { scrollTo(table().verticalScrollBar()->maximum()); }
        /// Ids of the rows in view, from top to bottom: rows stand by id.
        std::vector<int> inView() {
            const int below = table().rowAt(table().viewport()->height() - 1);
            std::vector<int> ids;
            for (int row = table().rowAt(0); row <= (below < 0 ? kTracks - 1 : below); ++row) ids.push_back(row + 1);
            return ids;
        }
        bool readsAll(const std::vector<int>& ids) {
            return QTest::qWaitFor(
                [&] { return std::all_of(ids.begin(), ids.end(), [&](int id) { return read.holds(frameOf(id)); }); },
                kPatience_ms);
        }
    };
    static std::unique_ptr<Stage> stageWithScene(bool shown = true) {
        auto stage = std::make_unique<Stage>();
        const auto note = [&read = stage->read](FrameIndex frame) { read.add(frame); };
        const Media media = test::sceneUnderTest(kBetween * (kTracks + 1), note);
        if (!test::openAndWait(stage->session, media) || !test::shows(stage->session, 0)) return nullptr;
        new RowsAhead(stage->panel, stage->session,
                      [](int id) { return id > 0 ? std::optional(frameOf(id)) : std::nullopt; });
        std::vector<TrackSummary> tracks(kTracks);
        for (int i = 0; i < kTracks; ++i) {
            tracks[static_cast<std::size_t>(i)].id = i + 1;
            tracks[static_cast<std::size_t>(i)].confirmed = true;
            tracks[static_cast<std::size_t>(i)].score = 1;
        }
        stage->model.setTracks(std::move(tracks), {});
        stage->panel.resize(500, 400);
        if (!shown) return stage;
        stage->panel.show();
        return QTest::qWaitForWindowExposed(&stage->panel) ? std::move(stage) : nullptr;
    }
    /// Longer than a list has to stand still.
    static void waitABit() { QTest::qWait(3 * RowsAhead::kStill_ms); }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void theRowsInViewAreReadFromTopToBottomAndNoOthers() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        const std::vector<int> in_view = stage->inView();
        QVERIFY(in_view.size() > 4 && in_view.size() < kTracks / 2);
        QVERIFY(stage->readsAll(in_view));
        waitABit();
        QCOMPARE(stage->read.rows(), in_view);
    }

    void aRowThatIsChosenNeedsNoReading() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        QVERIFY(stage->readsAll(stage->inView()));
        waitABit();
        stage->read.clear();
        for (const int id : {3, 1, 5, 4}) {
            stage->panel.selectId(id);
            stage->session.goToFrame(frameOf(id));
            QVERIFY(test::shows(stage->session, frameOf(id)));
        }
        for (const int id : {3, 1, 5, 4}) QVERIFY2(!stage->read.holds(frameOf(id)), "it was read again");
    }

    void thoseBelowTheSelectedRowComeFirst() {
        const auto stage = stageWithScene(false);
        QVERIFY(stage);
        stage->panel.selectId(4);
        stage->panel.show();
        QVERIFY(QTest::qWaitForWindowExposed(&stage->panel));
        const std::vector<int> in_view = stage->inView();
        QVERIFY(in_view.front() == 1 && in_view.back() > 5);
        std::vector<int> expected;
        for (int id = 4; id <= in_view.back(); ++id) expected.push_back(id);
        for (const int id : {3, 2, 1}) expected.push_back(id);
        QVERIFY(stage->readsAll(in_view));
        QCOMPARE(stage->read.rows(), expected);
    }

    void fromTheLastRowInViewKeysLeadToRowsThatAreReadToo() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        const int last = stage->inView().back();
        stage->panel.selectId(last - 1);  // seen whole: the list stays
        QVERIFY(stage->readsAll({last, last + 1, last - 1 + RowsAhead::kNextRows}));
        waitABit();
        QVERIFY(!stage->read.holds(frameOf(last + RowsAhead::kNextRows)));
    }

    void whereTheListIsScrolledToItsRowsAreRead() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        QVERIFY(stage->readsAll({1}));
        stage->scrollToEnd();
        const std::vector<int> in_view = stage->inView();
        QCOMPARE(in_view.back(), kTracks);
        QVERIFY(stage->readsAll(in_view));
        QVERIFY(!stage->read.holds(frameOf(kTracks / 2)));
    }

    void otherRowsThatAreListedAreRead() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        QVERIFY(stage->readsAll({1}));
        stage->panel.setFilterText(QStringLiteral("39"));
        QVERIFY(stage->readsAll({39}));
        QVERIFY(!stage->read.holds(frameOf(38)));
    }

    void nothingIsReadWhileTheVideoPlays() {
        const auto stage = stageWithScene();
        QVERIFY(stage);
        QVERIFY(stage->readsAll(stage->inView()));
        stage->session.playback().setSpeed(Playback::kSlowest, 0);
        stage->session.togglePlay();
        QVERIFY(stage->session.playback().playing());
        stage->scrollToEnd();
        const std::vector<int> in_view = stage->inView();
        waitABit();
        for (const int id : in_view) QVERIFY(!stage->read.holds(frameOf(id)));
        stage->session.togglePlay();
        QVERIFY(stage->readsAll(in_view));
    }

    void aListThatIsHiddenReadsNothing() {
        const auto stage = stageWithScene(false);
        QVERIFY(stage);
        waitABit();
        QVERIFY(stage->read.rows().empty());
        stage->panel.show();
        QVERIFY(stage->readsAll({1}));
        stage->panel.hide();
        stage->scrollToEnd();
        waitABit();
        QVERIFY(!stage->read.holds(frameOf(kTracks)));
    }

    void ofAnotherVideoTheRowsAreReadAnew() {
        ReadFrames other;
        const auto stage = stageWithScene();
        QVERIFY(stage);
        QVERIFY(stage->readsAll({1, 2}));
        Media media = test::sceneUnderTest(kBetween * 3, [&other](FrameIndex frame) { other.add(frame); });
        media.identity = "/nowhere/other.mp4";
        QVERIFY(test::openAndWait(stage->session, media));
        QVERIFY(QTest::qWaitFor([&] { return other.holds(frameOf(1)) && other.holds(frameOf(2)); }, kPatience_ms));
        stage->session.closeProject();
        waitABit();
        QVERIFY(!other.holds(frameOf(3)));  // there is no such frame
    }
};

}  // namespace eyrie::ui::rows_ahead_test

EYRIE_UI_TEST(QApplication, rows_ahead_test, RowsAheadTest)
#include "rows_ahead_test.moc"
