#include <QSignalSpy>
#include <QTest>
#include <QToolButton>

#include "panels_support.h"
#include "review/inspector/track_inspector.h"
#include "ui/support/ui_test.h"
#include "widgets/charts/origin_bar.h"

namespace eyrie::ui::panels_inspector_test {

namespace {

/// Frames 10 … 19; the last three are predicted, the two before reconstructed. Speed 5 px/frame, 18 × 8 px.
std::vector<TrackFrame> life() {
    std::vector<TrackFrame> states;
    for (int i = 0; i < 10; ++i) {
        TrackFrame state;
        state.frame = 10 + i;
        state.state.id = 4;
        state.state.box = {{100.0 + 3 * i, 50.0 + 4 * i}, 18, 8, 0.9273};
        state.state.velocity = {3, 4};
        state.state.status = TrackStatus::confirmed;
        state.state.origin = i < 5   ? StateOrigin::detected
                             : i < 7 ? StateOrigin::reconstructed
                             : i < 9 ? StateOrigin::predicted
                                     : StateOrigin::standing;
        states.push_back(state);
    }
    return states;
}

}  // namespace

class InspectorTest : public QObject {
    Q_OBJECT

 private slots:
    void initTestCase() { QLocale::setDefault(QLocale::c()); }

    void showsTheWholeAndTheMoment() {
        TrackInspector inspector;
        QVERIFY(inspector.text().isEmpty());
        inspector.showTrack(4, life(), {0.25, 25, true}, TrackClass::two_wheeler);
        inspector.setCurrentFrame(12);
        const QString text = inspector.text();
        // 5 px a frame at 0.25 m/px and 25 Hz are 112.5 km/h.
        for (const char* part :
             {"Track 4", "frames 10 to 19, 0.4 s", "112.5 km/h", "4.5 × 2.0 m", "5 detected", "2 reconstructed",
              "2 predicted", "1 standing", "106.0, 58.0 px", "53°", "confirmed, detected", "Class\ttwo-wheeler"}) {
            QVERIFY2(text.contains(QString::fromUtf8(part)), qPrintable(text));
        }
        inspector.setCurrentFrame(30);
        QVERIFY(inspector.text().contains(QStringLiteral("absent")));
    }

    void theCourseIsFromNorthWhereThatIsKnown() {
        TrackInspector inspector;
        inspector.showTrack(4, life(), {0.25, 25, true}, TrackClass::unknown);
        inspector.setCurrentFrame(12);
        QVERIFY2(inspector.text().contains(QStringLiteral("53° in the image")), qPrintable(inspector.text()));
        std::optional<double> course = 143.4;
        FrameIndex asked = -1;
        inspector.setCourse([&](FrameIndex frame, const OrientedBox&) {
            asked = frame;
            return course;
        });
        inspector.showCourse();
        QVERIFY2(inspector.text().contains(QStringLiteral("143° from north")), qPrintable(inspector.text()));
        QCOMPARE(asked, 12);
        course = 359.7;
        inspector.setCurrentFrame(13);
        QVERIFY2(inspector.text().contains(QStringLiteral("\t0° from north")), qPrintable(inspector.text()));
        course.reset();
        inspector.showCourse();
        QVERIFY(inspector.text().contains(QStringLiteral("53° in the image")));
    }

    void showsPixelsWithoutGsd() {
        TrackInspector inspector;
        inspector.showTrack(4, life(), {0.25, 25, false}, TrackClass::unknown);
        QVERIFY(inspector.text().contains(QStringLiteral("5.00 px/frame")));
        QVERIFY(inspector.text().contains(QStringLiteral("18.0 × 8.0 px")));
    }

    void tellsWhatWasTakenOutOfTheBoxesAsShadow() {
        TrackInspector inspector;
        inspector.showTrack(4, life(), {0.25, 25, true}, TrackClass::unknown);
        inspector.showShadow(QStringLiteral("23 % of its boxes"));
        QVERIFY2(inspector.text().contains(QStringLiteral("Shadow\t23 % of its boxes\n")),
                 qPrintable(inspector.text()));
        inspector.showShadow({});
        QVERIFY2(inspector.text().contains(QStringLiteral("Shadow\t–\n")), qPrintable(inspector.text()));
    }

    void nothingIsExplained() {
        TrackInspector inspector;
        inspector.showTrack(4, life(), {}, TrackClass::unknown);
        inspector.showTrack(5, {}, {}, TrackClass::unknown);
        QCOMPARE(inspector.track(), 0);
        QVERIFY(inspector.text().isEmpty());
        inspector.setCurrentFrame(3);
    }

    void goesToItsEndsAndWhereTheBarIsClicked() {
        TrackInspector inspector;
        inspector.showTrack(4, life(), {}, TrackClass::unknown);
        inspector.resize(300, 400);
        inspector.show();
        QSignalSpy frames(&inspector, &TrackInspector::frameActivated);
        for (auto* button : inspector.findChildren<QToolButton*>()) button->click();
        QCOMPARE(frames.count(), 2);
        QCOMPARE(frames[0][0].toInt() + frames[1][0].toInt(), 29);
        auto* bar = inspector.findChild<OriginBar*>();
        QTest::mouseClick(bar, Qt::LeftButton, Qt::NoModifier, QPoint(bar->width() - 1, 2));
        QCOMPARE(frames.last()[0].toInt(), 19);
        QTest::mouseClick(bar, Qt::LeftButton, Qt::NoModifier, QPoint(0, 2));
        QCOMPARE(frames.last()[0].toInt(), 10);
    }

    void theBarShowsWhereBoxesCameFrom() {
        OriginBar bar;
        bar.resize(100, 10);
        bar.setStates(life());
        bar.setCurrentFrame(-1);
        const QImage image = bar.grab().toImage();
        const double scale = image.devicePixelRatio();
        const auto colourAt = [&](int x) { return image.pixelColor(static_cast<int>(x * scale), 3); };
        QCOMPARE(colourAt(20), originColour(StateOrigin::detected, bar.palette()));
        QCOMPARE(colourAt(60), originColour(StateOrigin::reconstructed, bar.palette()));
        QCOMPARE(colourAt(80), originColour(StateOrigin::predicted, bar.palette()));
        QCOMPARE(colourAt(95), originColour(StateOrigin::standing, bar.palette()));
    }

    void looksRightInBothThemes() {
        for (const bool dark : {false, true}) {
            TrackInspector inspector;
            if (dark) inspector.setPalette(ui::test::darkPalette());
            inspector.showTrack(4, life(), {0.25, 25, true}, TrackClass::two_wheeler);
            inspector.setCurrentFrame(16);
            inspector.resize(320, 380);
            inspector.show();
            ui::test::keepPicture(inspector,
                                  dark ? QStringLiteral("inspector_dark") : QStringLiteral("inspector_light"));
        }
    }
};

}  // namespace eyrie::ui::panels_inspector_test

EYRIE_UI_TEST(QApplication, panels_inspector_test, InspectorTest)
#include "panels_inspector_test.moc"
