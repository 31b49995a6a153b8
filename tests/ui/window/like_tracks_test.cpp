#include <QTableView>
#include <QTest>
#include <QToolButton>

#include "review/tracks/filter_chips.h"
#include "review/tracks/tracks_panel.h"
#include "ui/session/session_support.h"
#include "ui/support/ui_test.h"
#include "widgets/message_bar.h"
#include "widgets/tables/table_roles.h"
#include "window/docks/review_docks.h"
#include "window/main_window.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::like_tracks_test {

using test::kPatience_ms;

/// Tracks like the one selected, in the window.
class LikeTracksTest : public QObject {
    Q_OBJECT

    std::unique_ptr<test::OwnHome> home_;

 private slots:
    void init() { home_ = std::make_unique<test::OwnHome>(); }
    void cleanup() { home_.reset(); }

    void theCommandListsTracksLikeTheSelectedOneUntilAnotherRunIsShown() {
        MainWindow window;
        window.resize(1280, 720);
        window.show();
        QVERIFY(QTest::qWaitForWindowActive(&window));
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(60)));
        QVERIFY(test::runAndWait(window.session()));
        TracksPanel& panel = window.review().tracks();
        const QAbstractItemModel* shown = panel.table()->model();
        QVERIFY(QTest::qWaitFor([&] { return shown->rowCount() > 0; }, kPatience_ms));
        QVERIFY2(!window.actions().like_track->isEnabled(), "nothing is selected");

        const int all = shown->rowCount();
        const TrackId chosen = shown->index(all - 1, 0).data(id_role).toInt();
        window.session().selectTrack(chosen);
        QVERIFY(window.actions().like_track->isEnabled());
        QTest::keyClick(&window, Qt::Key_T, Qt::ControlModifier | Qt::ShiftModifier);
        QCOMPARE(panel.chips().filter().like, std::optional(LikeLimit{.track = chosen}));
        const auto text_of_first = [&] { return shown->index(0, TracksModel::like_column).data().toString(); };
        QVERIFY(QTest::qWaitFor([&] { return text_of_first() == QStringLiteral("1.00"); }, kPatience_ms));
        QCOMPARE(shown->index(0, 0).data(id_role).toInt(), chosen);
        for (int row = 1; row < shown->rowCount(); ++row)
            QVERIFY(shown->index(row, TracksModel::like_column).data().toDouble() >= 0.5);

        QVERIFY(test::runAndWait(window.session()));
        QVERIFY2(!panel.chips().filter().like, "the number means another vehicle in another run");
    }

    void looksCountOnceTheirPicturesWereRead() {
        MainWindow window;
        window.show();
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(60)));
        QVERIFY(test::runAndWait(window.session()));
        TracksPanel& panel = window.review().tracks();
        const QAbstractItemModel* shown = panel.table()->model();
        QVERIFY(QTest::qWaitFor([&] { return shown->rowCount() > 1; }, kPatience_ms));
        const TrackId chosen = shown->index(0, 0).data(id_role).toInt();
        TrackFilter filter;
        filter.like = LikeLimit{.track = chosen, .least = 0};
        panel.chips().setFilter(filter);
        const auto likenesses = [&] {
            QStringList all;
            for (int row = 0; row < shown->rowCount(); ++row)
                all << shown->index(row, TracksModel::like_column).data().toString();
            return all;
        };
        QVERIFY(QTest::qWaitFor([&] { return likenesses().value(0) == QStringLiteral("1.00"); }, kPatience_ms));
        const QStringList without = likenesses();
        filter.like->counts = {.path = false, .speed = false, .size = false, .looks = true};
        panel.chips().setFilter(filter);
        // Until then nothing that counts is known.
        QVERIFY(QTest::qWaitFor(
            [&] {
                const QStringList now = likenesses();
                return now != without && now.value(1).toDouble() > 0;
            },
            kPatience_ms));
        QVERIFY2(window.messages().texts().filter(QStringLiteral("could not be read")).isEmpty(),
                 "all pictures could be");
    }

    void whileARunWorksTheChipSaysThatItWaits() {
        MainWindow window;
        window.show();
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(60)));
        const auto chip_says = [&](const QString& text) {
            for (const auto* button : window.review().tracks().chips().findChildren<QToolButton*>())
                if (button->text().contains(text)) return true;
            return false;
        };
        window.session().startRun();
        QVERIFY(
            QTest::qWaitFor([&] { return window.session().running() && window.session().currentRun(); }, kPatience_ms));
        window.review().tracks().listLike(1);
        QVERIFY(chip_says(QStringLiteral("when the run ends")));
        // Then they are looked for, on the ground that is watched.
        QVERIFY(QTest::qWaitFor([&] { return !window.session().running(); }, kPatience_ms));
        QVERIFY(QTest::qWaitFor(
            [&] {
                return !chip_says(QStringLiteral("when the run ends")) &&
                       !chip_says(QStringLiteral("being looked for"));
            },
            kPatience_ms));
    }

    void aTrackThatIsNoPartOfTheResultIsSaidToBeNone() {
        MainWindow window;
        window.show();
        QVERIFY(test::openAndWait(window.session(), test::sceneUnderTest(60)));
        QVERIFY(test::runAndWait(window.session()));
        TracksPanel& panel = window.review().tracks();
        panel.listLike(4711);
        const auto told = [&] {
            const QStringList texts = window.messages().texts();
            return std::any_of(texts.begin(), texts.end(),
                               [](const QString& text) { return text.contains(QStringLiteral("no track 4711")); });
        };
        QVERIFY(QTest::qWaitFor(told, kPatience_ms));
        QVERIFY(!panel.chips().filter().any());
    }
};

}  // namespace eyrie::ui::like_tracks_test

EYRIE_UI_TEST(QApplication, like_tracks_test, LikeTracksTest)
#include "like_tracks_test.moc"
