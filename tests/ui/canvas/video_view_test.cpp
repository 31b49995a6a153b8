#include "canvas/video_view.h"

#include <QPainter>
#include <QSignalSpy>
#include <QTest>
#include <QWheelEvent>

#include "canvas/canvas_tool.h"
#include "canvas/drawing/image_convert.h"
#include "canvas/layers/track_layer.h"
#include "ui/support/ui_test.h"

namespace eyrie::ui::video_view_test {

namespace {

/// Draws a cross somewhere.
class CrossTool : public CanvasTool {
 public:
    void paint(QPainter& painter, const CanvasPlace&) const override {
        painter.setPen(Qt::red);
        painter.drawLine(at - QPointF(20, 0), at + QPointF(20, 0));
        painter.drawLine(at - QPointF(0, 20), at + QPointF(0, 20));
    }
    bool press(const QMouseEvent&, const CanvasPlace&) override { return false; }
    bool move(const QMouseEvent&, const CanvasPlace&) override { return false; }
    bool release(const QMouseEvent&, const CanvasPlace&) override { return false; }
    bool doubleClick(const QMouseEvent&, const CanvasPlace&) override { return false; }
    void leave() override {}
    const QCursor* cursor() const override { return nullptr; }

    QPointF at{300, 200};  ///< view coordinates
};

}  // namespace

class VideoViewTest : public QObject {
    Q_OBJECT

    static ViewFrame checkered(QSize size) {
        ViewFrame frame;
        frame.image = QImage(size, QImage::Format_RGB32);
        for (int y = 0; y < size.height(); ++y)
            for (int x = 0; x < size.width(); ++x)
                frame.image.setPixel(x, y, (x + y) % 2 == 0 ? qRgb(255, 255, 255) : qRgb(0, 0, 0));
        return frame;
    }
    static std::shared_ptr<FrameResult> oneTrack() {
        auto result = std::make_shared<FrameResult>();
        result->motion.image_size = {200, 100};
        TrackState state;
        state.id = 7;
        state.status = TrackStatus::confirmed;
        state.box = {{60, 40}, 30, 14, 0};
        result->tracks.push_back(state);
        return result;
    }
    static void wheel(VideoView& view, QPointF position, int steps) {
        QWheelEvent event(position, view.mapToGlobal(position), {}, {0, 120 * steps}, Qt::NoButton, Qt::NoModifier,
                          Qt::NoScrollPhase, false);
        QApplication::sendEvent(&view, &event);
    }

 private slots:
    void wheelZoomsToTheCursor() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(600, 400);
        view.show();
        view.setFrame(checkered({200, 100}));
        const QPointF cursor(412, 133);
        const QPointF point = view.transform().imageFromView(cursor);
        const double before = view.transform().zoom();
        wheel(view, cursor, 3);
        QVERIFY(view.transform().zoom() > before * 1.5);
        QVERIFY(QLineF(view.transform().imageFromView(cursor), point).length() < 1e-9);
        wheel(view, cursor, -3);
        QVERIFY(qAbs(view.transform().zoom() - before) < 1e-9);
    }

    void draggingMovesThePictureWithTheCursor() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(600, 400);
        view.show();
        view.setFrame(checkered({200, 100}));
        wheel(view, {300, 200}, 8);
        const QPointF point = view.transform().imageFromView({300, 200});
        QTest::mousePress(&view, Qt::LeftButton, {}, {300, 200});
        QTest::mouseMove(&view, {330, 190});
        QTest::mouseMove(&view, {350, 180});
        QTest::mouseRelease(&view, Qt::LeftButton, {}, {350, 180});
        QVERIFY(QLineF(view.transform().imageFromView({350, 180}), point).length() < 1e-6);
    }

    void cursorIsReportedToTheSubPixelAndOnlyInsideTheImage() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(600, 400);
        view.show();
        view.setFrame(checkered({200, 100}));  // fitted: scale 3, picture from y = 50 to 350
        std::optional<QPointF> reported;
        connect(&view, &VideoView::cursorMoved, this, [&](std::optional<QPointF> point) { reported = point; });
        QTest::mouseMove(&view, {301, 200});
        QVERIFY(reported);
        QVERIFY(qAbs(reported->x() - (301 / 3.0 - 0.5)) < 1e-9);
        QTest::mouseMove(&view, {301, 20});
        QVERIFY(!reported);
    }

    void atEightHundredPercentPixelsAreSharpSquares() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(400, 320);
        view.show();
        view.setFrame(checkered({50, 40}));  // fitted: exactly 8 screen pixels per pixel
        QCOMPARE(view.transform().zoom(), 8.0);
        const QImage picture = view.picture();
        for (const QPoint inside : {QPoint(0, 0), QPoint(7, 7), QPoint(3, 4)}) {
            QCOMPARE(picture.pixelColor(inside), QColor(Qt::white));
            QCOMPARE(picture.pixelColor(inside + QPoint(8, 0)), QColor(Qt::black));
        }
    }

    void clickingATrackSelectsIt() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(600, 400);
        view.show();
        ViewFrame frame = checkered({200, 100});
        frame.result = oneTrack();
        view.setFrame(frame);
        std::optional<TrackId> clicked;
        connect(&view, &VideoView::trackClicked, this, [&](std::optional<TrackId> track) { clicked = track; });
        QTest::mouseClick(&view, Qt::LeftButton, {}, view.transform().viewFromImage({60, 40}).toPoint());
        QCOMPARE(clicked, std::optional<TrackId>(7));
        QTest::mouseClick(&view, Qt::LeftButton, {}, view.transform().viewFromImage({150, 80}).toPoint());
        QVERIFY(!clicked);
    }

    void aTapOnTheSpaceBarPlaysButPanningWithItDoesNot() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(600, 400);
        view.show();
        view.setFrame(checkered({200, 100}));
        QSignalSpy played(&view, &VideoView::playToggled);
        QTest::keyClick(&view, Qt::Key_Space);
        QCOMPARE(played.count(), 1);
        QTest::keyPress(&view, Qt::Key_Space);
        QTest::mousePress(&view, Qt::LeftButton, {}, {300, 200});
        QTest::mouseMove(&view, {340, 200});
        QTest::mouseMove(&view, {360, 200});
        QTest::mouseRelease(&view, Qt::LeftButton, {}, {360, 200});
        QTest::keyRelease(&view, Qt::Key_Space);
        QCOMPARE(played.count(), 1);
    }

    void aMissingPictureStillShowsItsOverlays() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(600, 400);
        view.show();
        view.clear({});
        ViewFrame frame;
        frame.result = oneTrack();
        view.setFrame(frame);
        QCOMPARE(view.transform().imageSize(), QSize(200, 100));
        const QImage with = view.picture();
        settings.setVisible(TrackLayer::kKind, false);
        QVERIFY(with != view.picture());
    }

    void underAToolThePictureStaysAsItIsNow() {
        OverlaySettings settings;
        VideoView view(settings);
        view.resize(600, 400);
        view.show();
        CrossTool tool;
        view.setTool(&tool);
        const auto shown = [&view] {
            // The first shows what is new, the second keeps it, the third paints what was kept.
            for (int i = 0; i < 2; ++i) view.grab();
            return view.grab().toImage().convertToFormat(QImage::Format_RGB32);
        };
        const auto as_painted = [&view] { return view.picture(); };
        view.setFrame(checkered({200, 100}));
        const QImage first = shown();
        QCOMPARE(first, as_painted());

        ViewFrame frame = checkered({200, 100});
        frame.result = oneTrack();
        view.setFrame(frame);
        const QImage tracked = shown();
        QCOMPARE(tracked, as_painted());
        QVERIFY(tracked != first);

        settings.setVisible(TrackLayer::kKind, !settings.isVisible(TrackLayer::kKind));
        QCOMPARE(shown(), as_painted());
        QVERIFY(view.picture() != tracked);
        view.zoomBy(2);
        QCOMPARE(shown(), as_painted());
        view.setBadge(QStringLiteral("preview"));
        QCOMPARE(shown(), as_painted());
        view.resize(500, 300);
        QCOMPARE(shown(), as_painted());
        tool.at = {120, 90};  // what the tool draws is never kept
        QCOMPARE(shown(), as_painted());
        view.setTool(nullptr);
        QCOMPARE(shown(), as_painted());
    }

    void wrappedImagesShareTheirPixels() {
        cv::Mat gray(20, 30, CV_8UC1, cv::Scalar(77));
        const QImage image = wrapImage(gray);
        QCOMPARE(static_cast<const void*>(image.constBits()), static_cast<const void*>(gray.data));
        cv::Mat colour(20, 30, CV_8UC3, cv::Scalar(10, 20, 30));
        QCOMPARE(wrapImage(colour).pixelColor(3, 4), QColor(30, 20, 10));
        QImage outlives;
        {
            cv::Mat part = cv::Mat(40, 40, CV_8UC3, cv::Scalar(1, 2, 3))(cv::Rect(5, 5, 10, 10));
            outlives = wrapImage(part);
        }
        QCOMPARE(outlives.pixelColor(9, 9), QColor(3, 2, 1));
        QVERIFY(wrapImage({}).isNull());
    }
};

}  // namespace eyrie::ui::video_view_test

EYRIE_UI_TEST(QApplication, video_view_test, VideoViewTest)
#include "video_view_test.moc"
