#include "review/events/events_dock.h"

#include <QLabel>
#include <QMainWindow>
#include <QTableView>
#include <QTest>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <cstdlib>
#include <mutex>
#include <set>

#include "canvas/timeline/timeline_view.h"
#include "canvas/video_view.h"
#include "review/events/event_review.h"
#include "review/events/event_text.h"
#include "review/events/event_thresholds.h"
#include "review/events/events_panel.h"
#include "review/events/left_list.h"
#include "review/inspector/inspector_panel.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "widgets/charts/stage_times_chart.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"
#include "workspace/timeline_binding.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::events_dock_test {

using test::kPatience_ms;

namespace {

/// What of the window the dock needs.
class EventsWindow : public QMainWindow {
 public:
    EventsWindow() : actions_(overlays_, this), docks_(*this), inspector_(new InspectorPanel(session_)) {
        auto* centre = new QWidget;
        auto* rows = new QVBoxLayout(centre);
        messages_ = new MessageBar;
        canvas_ = new VideoView(overlays_);
        timeline_ = new TimelineView;
        rows->addWidget(messages_);
        rows->addWidget(canvas_, 1);
        rows->addWidget(timeline_);
        setCentralWidget(centre);
        new TimelineBinding(session_, *timeline_, chart_, this);
        events_ = new EventsDock({session_, *canvas_, *timeline_, docks_, actions_, *messages_});
        docks_.add(DockId::inspector, QStringLiteral("Inspector"), inspector_);
        connect(&session_, &ProjectSession::changed, this,
                Reactions<SessionChange>{
                    {SessionChange::picture, [this] { canvas_->setFrame(session_.viewFrame()); }},
                    {SessionChange::selection, [this] { canvas_->setSelectedTrack(session_.selectedTrack()); }},
                });
        docks_.arrange(WorkspaceKind::review);
    }
    ~EventsWindow() override { hide(); }

    ProjectSession& session() { return session_; }
    VideoView& canvas() { return *canvas_; }
    TimelineView& timeline() { return *timeline_; }
    MessageBar& messages() { return *messages_; }
    WindowActions& actions() { return actions_; }
    EventsDock& events() { return *events_; }

 private:
    OverlaySettings overlays_;
    ProjectSession session_;
    WindowActions actions_;
    DockRegistry docks_;
    StageTimesChart chart_;
    InspectorPanel* inspector_;
    MessageBar* messages_;
    VideoView* canvas_;
    TimelineView* timeline_;
    EventsDock* events_;
};

}  // namespace

/// Events in the window: found in a run, judged by keys, stored, undone, and shown on the timeline.
class EventsDockTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

    /// Both vehicles of the scene are fast by these limits.
    static void lowerLimits(EventsWindow& window) {
        EventThresholds& limits = window.events().panel().thresholds();
        limits.setValue(QStringLiteral("events.over"), QStringLiteral("5"));
        limits.setValue(QStringLiteral("events.over_time"), QStringLiteral("0.2"));
    }
    static bool waitForEvents(EventsWindow& window, int least) {
        return QTest::qWaitFor([&] { return window.events().model().rowCount() >= least; }, kPatience_ms);
    }
    static std::unique_ptr<EventsWindow> windowWithScene(int frames = 60,
                                                         const std::function<void(FrameIndex)>& before_read = {}) {
        auto window = std::make_unique<EventsWindow>();
        window->resize(1280, 720);
        window->show();
        if (!QTest::qWaitForWindowActive(window.get())) return nullptr;
        return test::openAndWait(window->session(), test::sceneUnderTest(frames, before_read)) ? std::move(window)
                                                                                               : nullptr;
    }
    /// Only the first 60 frames are searched.
    static std::unique_ptr<EventsWindow> windowWithEvents(int frames = 60) {
        auto window = windowWithScene(frames);
        if (!window) return nullptr;
        window->session().settings().range = {0, 59};
        if (!test::runAndWait(window->session())) return nullptr;
        lowerLimits(*window);
        return waitForEvents(*window, 2) ? std::move(window) : nullptr;
    }
    static int idAt(EventsWindow& window, int row) { return window.events().model().recordAt(row)->id; }
    static std::size_t judged(EventsWindow& window) { return window.events().review().judgedCount(); }

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void withoutARunItSaysWhatWouldBeHere() {
        const auto window = windowWithScene();
        QVERIFY(window);
        QVERIFY(window->events().review().state() == EventReview::State::nothing);
        QVERIFY(test::says(window->events().panel(), QStringLiteral("What happened to the vehicles")));
        QVERIFY(!window->actions().relevant->isEnabled());
        QVERIFY(window->timeline().marks().empty());
    }

    void anEventThatIsChosenIsShown() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        window->canvas().setFocus();
        QTest::keyClick(window.get(), Qt::Key_Down, Qt::ControlModifier);
        const FoundEvents& found = *window->events().model().found();
        QCOMPARE(window->events().panel().currentId(), idAt(*window, 0));
        QVERIFY(test::shows(window->session(), found.frameAt(0)));
        QCOMPARE(window->session().selectedTrack(), std::optional(found.eventAt(0)->tracks.front()));
    }

    void theFramesOfTheEventsInViewAreReadBeforeTheyAreChosen() {
        std::mutex mutex;
        std::set<FrameIndex> read;
        const auto note = [&](FrameIndex frame) {
            const std::scoped_lock lock(mutex);
            read.insert(frame);
        };
        const auto is_read = [&](FrameIndex frame) {
            const std::scoped_lock lock(mutex);
            return read.contains(frame);
        };
        const auto forget = [&] {
            const std::scoped_lock lock(mutex);
            read.clear();
        };
        const auto window = windowWithScene(60, note);
        QVERIFY(window);
        connect(&window->session(), &ProjectSession::runFinished, window.get(), forget);
        QVERIFY(test::runAndWait(window->session()));
        lowerLimits(*window);
        QVERIFY(waitForEvents(*window, 2));
        const FrameIndex frame = window->events().model().found()->frameAt(0);
        QVERIFY(frame != window->session().currentFrame());
        QTRY_VERIFY_WITH_TIMEOUT(is_read(frame), kPatience_ms);
        QVERIFY(test::shows(window->session(), window->session().currentFrame()));
        QTest::qWait(500);  // until what has begun has ended
        forget();
        window->events().show(idAt(*window, 0));
        QVERIFY(test::shows(window->session(), frame));
        QVERIFY(!is_read(frame));
    }

    void ofALongVideoTheTimelineShowsTheEventAndFiveSecondsAround() {
        const auto window = windowWithEvents(3100);  // of 25 Hz
        QVERIFY(window);
        const TimelineAxis& axis = window->timeline().axis();
        QVERIFY(axis.showsAll());
        const int id = idAt(*window, 0);
        window->events().show(id);
        const FrameSpan frames = window->events().model().found()->framesAt(0);
        QVERIFY(!axis.showsAll());
        QCOMPARE(axis.firstVisible(), 0);
        QVERIFY2(std::abs(axis.lastVisible() - (frames.last + 125)) <= 1,
                 qPrintable(QStringLiteral("%1, %2").arg(axis.lastVisible()).arg(frames.last)));
    }

    void ofAShortVideoItShowsAll() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        window->events().show(idAt(*window, 0));
        QVERIFY(window->timeline().axis().showsAll());
    }

    void aPlaceOutOfViewIsCentredAndAWholePictureIsLeftAlone() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        VideoView& canvas = window->canvas();
        canvas.fit();
        const QPointF corner = canvas.transform().viewFromImage({0, 0});
        const int id = idAt(*window, 0);
        window->events().show(id);
        QCOMPARE(canvas.transform().viewFromImage({0, 0}), corner);
        canvas.restore(40, {0, 0});
        const cv::Point2d place = window->events().model().found()->eventAt(0)->place;
        const QPointF image_place(place.x, place.y);
        QVERIFY(!canvas.rect().contains(canvas.transform().viewFromImage(image_place).toPoint()));
        window->events().show(id);
        QVERIFY(canvas.rect().contains(canvas.transform().viewFromImage(image_place).toPoint()));
    }

    void aKeyJudgesAndGoesOn() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        EventsPanel& panel = window->events().panel();
        window->canvas().setFocus();
        QTest::keyClick(window.get(), Qt::Key_Down, Qt::ControlModifier);
        QTest::keyClick(window.get(), Qt::Key_Y);
        QCOMPARE(judged(*window), std::size_t(1));
        QCOMPARE(window->events().review().verdictAt(0)->judgement, Judgement::relevant);
        QVERIFY(!window->events().review().verdictAt(0)->person.empty());
        QVERIFY(panel.headerText().startsWith(QStringLiteral("1 of")));
        QCOMPARE(panel.currentId(), idAt(*window, 1));
        QTest::keyClick(window.get(), Qt::Key_I);
        QCOMPARE(window->events().review().verdictAt(1)->judgement, Judgement::not_relevant);
        QTest::keyClick(window.get(), Qt::Key_Z);
        QCOMPARE(judged(*window), std::size_t(1));
        QCOMPARE(panel.currentId(), idAt(*window, 1));  // back at what was undone
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(judged(*window), std::size_t(0));
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        QCOMPARE(judged(*window), std::size_t(1));
    }

    void severalAreJudgedAtOnceAndUndoneAtOnce() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        window->events().panel().table()->selectAll();
        QTest::keyClick(window.get(), Qt::Key_I);
        QCOMPARE(judged(*window), window->events().review().count());
        QTest::keyClick(window.get(), Qt::Key_Z);
        QCOMPARE(judged(*window), std::size_t(0));
    }

    void verdictsStarsAndNotesAreThereInTheNextWindow() {
        {
            const auto window = windowWithEvents();
            QVERIFY(window);
            EventReview& review = window->events().review();
            QVERIFY(review.judge({0}, Judgement::unsure));
            QVERIFY(review.setStarred({0}, true));
            QVERIFY(review.setNote(0, QStringLiteral("white van")));
            window->close();
        }
        const auto window = windowWithScene();
        QVERIFY(window);
        QVERIFY(waitForEvents(*window, 2));
        QCOMPARE(judged(*window), std::size_t(1));
        const EventsModel& model = window->events().model();
        int marked = -1;
        for (int row = 0; row < model.rowCount(); ++row)
            if (model.recordAt(row)->starred) marked = row;
        QVERIFY(marked >= 0);
        QCOMPARE(model.recordAt(marked)->judgement, Judgement::unsure);
        QCOMPARE(model.recordAt(marked)->note, QStringLiteral("white van"));
        QVERIFY(window->actions().undo_verdict->isEnabled());  // undo survives closing
        window->events().review().undo();
        QVERIFY(model.recordAt(marked)->note.isEmpty());
    }

    void verdictsFollowTheirEventsWhenLimitsChange() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        EventReview& review = window->events().review();
        const int fast = static_cast<int>(EventKind::over_speed);
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < review.count(); ++i)
            if (listedKindAt(*review.found(), i) == fast) places.push_back(i);
        QVERIFY(!places.empty());
        QVERIFY(review.judge(places, Judgement::relevant));
        EventThresholds& limits = window->events().panel().thresholds();
        limits.setValue(QStringLiteral("events.over"), QStringLiteral("400"));
        QVERIFY(QTest::qWaitFor([&] { return review.leftCount() == places.size(); }, kPatience_ms));
        QCOMPARE(review.judgedCount(), std::size_t(0));
        // The count leads to a list of them, and that to their frames.
        const auto labels = window->events().panel().findChildren<QLabel*>();
        const auto header = std::find_if(labels.begin(), labels.end(), [](const QLabel* label) {
            return label->text().contains(QStringLiteral("without an event</a>"));
        });
        QVERIFY(header != labels.end());
        emit(*header)->linkActivated(QStringLiteral("left"));
        auto* left = window->events().panel().findChild<LeftList*>();
        QVERIFY(left != nullptr && left->isVisible());
        QCOMPARE(left->list().topLevelItemCount(), static_cast<int>(places.size()));
        QTreeWidgetItem* last = left->list().topLevelItem(static_cast<int>(places.size()) - 1);
        QCOMPARE(last->text(1), listedKindText(fast));
        QCOMPARE(last->text(2), judgementText(Judgement::relevant));
        QCOMPARE(last->text(5), QStringLiteral("no such event near"));
        const FrameIndex frame = last->data(0, Qt::UserRole).toInt();
        emit left->list().itemActivated(last, 0);
        QVERIFY(test::shows(window->session(), frame));
        limits.setValue(QStringLiteral("events.over"), QStringLiteral("5"));
        QVERIFY(QTest::qWaitFor([&] { return review.judgedCount() == places.size(); }, kPatience_ms));
        QCOMPARE(left->list().topLevelItemCount(), 0);
    }

    void marksOnTheTimelineLeadToTheirEvents() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        TimelineView& timeline = window->timeline();
        QCOMPARE(timeline.marks().size(), window->events().review().count());
        const int id = idAt(*window, 1);
        const FrameIndex frame = window->events().model().found()->frameAt(1);
        QCoreApplication::processEvents();
        const auto place = timeline.placeOfMark(id);
        QVERIFY(place);
        QTest::mouseClick(&timeline, Qt::LeftButton, {}, place->toPoint());
        QVERIFY(test::shows(window->session(), frame));
        window->events().panel().kinds().showAll(false);
        QVERIFY(QTest::qWaitFor([&] { return timeline.marks().empty(); }, kPatience_ms));
    }

    void everyKindThatIsListedHasARowOnTheTimeline() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        const TimelineView& timeline = window->timeline();
        const FoundEvents& found = *window->events().model().found();
        std::set<int> kinds;
        for (std::size_t i = 0; i < found.queue.size(); ++i) kinds.insert(listedKindAt(found, i));
        QCOMPARE(timeline.kinds().rowCount(), std::min(static_cast<int>(kinds.size()), TimelineKinds::kMostRows));
        const auto first = timeline.kinds().find(idAt(*window, 0));
        QVERIFY(first);
        QCOMPARE(first->second.first, found.framesAt(0).first);
        QCOMPARE(first->second.last, found.framesAt(0).last);
        window->events().panel().kinds().showAll(false);
        QVERIFY(QTest::qWaitFor([&] { return timeline.kinds().empty(); }, kPatience_ms));
        window->events().panel().kinds().setShown(static_cast<int>(EventKind::over_speed), true);
        QVERIFY(QTest::qWaitFor([&] { return timeline.kinds().rowCount() == 1; }, kPatience_ms));
        QCOMPARE(timeline.kinds().nameOf(0), listedKindText(static_cast<int>(EventKind::over_speed)));
    }

    void whereKeysAreNotWantedThereAreNoMarks() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        window->events().setActive(false);
        QVERIFY(window->timeline().marks().empty());
        QVERIFY(!window->actions().relevant->isEnabled() && !window->actions().undo_verdict->isEnabled());
        window->events().setActive(true);
        QVERIFY(window->actions().relevant->isEnabled());
        QVERIFY(!window->timeline().marks().empty());
    }

    void whereAnotherWindowJudgesItOnlyReads() {
        const auto window = windowWithEvents();
        QVERIFY(window);
        QVERIFY(window->events().review().judge({0}, Judgement::relevant));
        const auto other = windowWithScene();
        QVERIFY(other);
        QVERIFY(waitForEvents(*other, 2));
        QCOMPARE(judged(*other), std::size_t(1));
        other->messages().dismissAll();  // that nobody said the frame rate
        QVERIFY(!other->events().review().judge({1}, Judgement::relevant));
        QCOMPARE(other->messages().texts().size(), 1);  // says why
        QVERIFY(window->events().review().judge({1}, Judgement::unsure));
        QVERIFY(QTest::qWaitFor([&] { return judged(*other) == 2; }, kPatience_ms));  // read now and then
    }
};

}  // namespace eyrie::ui::events_dock_test

EYRIE_UI_TEST(QApplication, events_dock_test, EventsDockTest)
#include "events_dock_test.moc"
