#include "canvas/view_transform.h"

#include <QTest>
#include <numbers>

#include "ui/support/ui_test.h"

namespace eyrie::ui::view_transform_test {

namespace {
ViewTransform shown(QSize image, QSizeF view, double density = 1) {
    ViewTransform transform;
    transform.setView(view, density);
    transform.setImageSize(image);
    return transform;
}

void compare(QPointF a, QPointF b) {
    QVERIFY2(QLineF(a, b).length() < 1e-9,
             qPrintable(QStringLiteral("(%1, %2) and (%3, %4)").arg(a.x()).arg(a.y()).arg(b.x()).arg(b.y())));
}
}  // namespace

class ViewTransformTest : public QObject {
    Q_OBJECT

 private slots:
    void fitShowsTheWholeImageCentred() {
        const ViewTransform t = shown({400, 200}, {800, 800});
        QCOMPARE(t.scale(), 2.0);
        QCOMPARE(t.imageRect(), QRectF(0, 200, 800, 400));
        // The centre of the top left pixel lies half a pixel inside the image.
        compare(t.viewFromImage({0, 0}), {1, 201});
        compare(t.imageFromView({400, 400}), {199.5, 99.5});
    }

    void mappingThereAndBackIsTheIdentity() {
        ViewTransform t = shown({641, 479}, {1013, 777}, 1.5);
        t.zoomAround({100, 50}, 3.7);
        t.panBy({-33, 12});
        for (const QPointF p : {QPointF(0, 0), QPointF(640, 478), QPointF(12.25, 300.75)})
            compare(t.imageFromView(t.viewFromImage(p)), p);
    }

    void zoomKeepsThePointUnderTheCursor() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        const QPointF cursor(731, 122);
        const QPointF point = t.imageFromView(cursor);
        for (const double factor : {1.25, 1.25, 8.0, 0.3, 0.01, 1000.0}) {
            t.zoomAround(cursor, factor);
            compare(t.imageFromView(cursor), point);
        }
    }

    void zoomThereAndBackIsTheIdentity() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        const QRectF before = t.imageRect();
        t.zoomAround({10, 20}, 2.5);
        t.zoomAround({10, 20}, 1 / 2.5);
        compare(t.imageRect().topLeft(), before.topLeft());
        QVERIFY(std::abs(t.imageRect().width() - before.width()) < 1e-9);
    }

    void zoomHasLimits() {
        ViewTransform t = shown({640, 480}, {1000, 700}, 2);
        t.zoomAround({0, 0}, 1e9);
        QCOMPARE(t.zoom(), ViewTransform::kMaxZoom);
        t.zoomAround({0, 0}, 1e-9);
        QVERIFY(t.zoom() > 0.05);
    }

    void oneToOneIsOneScreenPixelPerImagePixel() {
        ViewTransform t = shown({640, 480}, {1000, 700}, 2);
        t.setZoomAround({500, 350}, 1);
        QCOMPARE(t.scale(), 0.5);
        QCOMPARE(t.zoom(), 1.0);
    }

    void theScaleOfAPlaceIsThatOfItsSurroundings() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        t.setRotation(0.7);
        QVERIFY(std::abs(t.scaleAt({100, 50}) - t.scale()) < 1e-12);
        // On the ground what is far is drawn larger than it was filmed.
        t.setGround(QTransform(1, 0, 0.0005, 0, 1, 0, 0, 0, 1));
        for (const QPointF at : {QPointF(0, 0), QPointF(600, 400)}) {
            const double step = 1e-3;
            const QPointF o = t.viewFromImage(at);
            const QPointF x = (t.viewFromImage(at + QPointF(step, 0)) - o) / step;
            const QPointF y = (t.viewFromImage(at + QPointF(0, step)) - o) / step;
            const double px = std::sqrt(std::abs(x.x() * y.y() - x.y() * y.x()));
            QVERIFY2(std::abs(t.scaleAt(at) - px) < 1e-4, qPrintable(QString::number(t.scaleAt(at) - px)));
        }
        QVERIFY(t.scaleAt({600, 400}) < 0.8 * t.scaleAt({0, 0}));
    }

    void pixelsAreSharpFromFourHundredPercent() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        t.setZoomAround({0, 0}, 3.99);
        QVERIFY(!t.sharp());
        t.setZoomAround({0, 0}, 4);
        QVERIFY(t.sharp());
    }

    void panningNeverLosesTheImage() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        for (const QPointF far : {QPointF(1e6, 0), QPointF(-1e6, -1e6), QPointF(0, 1e6)}) {
            t.panBy(far);
            QVERIFY(!t.imageRect().intersected(QRectF(0, 0, 1000, 700)).isEmpty());
        }
    }

    void resizingKeepsAFittedImageFitted() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        t.setView({500, 900}, 1);
        QVERIFY(t.fitted());
        QCOMPARE(t.imageRect().width(), 500.0);
    }

    void resizingKeepsTheMiddleOfAZoomedImage() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        t.zoomAround({300, 300}, 5);
        const QPointF middle = t.imageFromView({500, 350});
        t.setView({800, 500}, 1);
        compare(t.imageFromView({400, 250}), middle);
    }

    void anotherDensityKeepsTheZoom() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        t.setZoomAround({500, 350}, 2);
        t.setView({1000, 700}, 2);
        QCOMPARE(t.zoom(), 2.0);
    }

    void aTurnedPictureMapsThereAndBack() {
        ViewTransform transform;
        transform.setView({800, 600}, 1);
        transform.setImageSize({320, 224});
        transform.setZoomAround({100, 80}, 3);
        transform.centreOn({40, 60});
        transform.setRotation(-1.1);
        compare(transform.viewFromImage({40, 60}), {400, 300});  // the middle stays
        const QPointF somewhere(12.25, 91.5);
        compare(transform.imageFromView(transform.viewFromImage(somewhere)), somewhere);
        const QPointF before = transform.imageFromView({150, 500});
        transform.zoomAround({150, 500}, 1.7);
        compare(transform.imageFromView({150, 500}), before);
        transform.panBy({10, -4});
        compare(transform.viewFromImage(before), {160, 496});
        transform.setRotation(std::numbers::pi / 2);  // clockwise: what pointed right points down
        const QPointF along = transform.viewVector({1, 0}, {});
        QVERIFY(std::abs(along.x()) < 1e-9 && along.y() > 0);
        compare(transform.turn().map(transform.unturnedFromImage(somewhere)), transform.viewFromImage(somewhere));
    }

    void onTheGroundPlacesMapThereAndBackAndAreDrawnWhereTheyLie() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        t.setRotation(0.4);
        t.setGround(QTransform(1.1, 0.2, 2e-4, -0.1, 0.9, 1e-4, 30, -12, 1));
        QVERIFY(t.onGround());
        for (const QPointF p : {QPointF(0, 0), QPointF(639, 479), QPointF(12.25, 300.75)}) {
            compare(t.imageFromView(t.viewFromImage(p)), p);
            compare(t.drawing().map(p), t.viewFromImage(p));
            // Small ways go where their ends go.
            const QPointF way(1e-4, -2e-4);
            compare(t.viewVector(way, p), t.viewFromImage(p + way) - t.viewFromImage(p));
            compare(t.imageVector(t.viewVector({3, 5}, p), p), {3, 5});
            const QPointF right = t.viewVector({1, 0}, p);
            QVERIFY(std::abs(t.turnAt(p) - std::atan2(right.y(), right.x())) < 1e-9);
        }
        t.setGround(std::nullopt);
        QVERIFY(!t.onGround());
        compare(t.drawing().map(QPointF(3, 4)), t.viewFromImage({3, 4}));
    }

    void theGroundStandsStillWhileThePictureMovesOverIt() {
        ViewTransform t = shown({640, 480}, {640, 480});
        const auto at = [&](double way) {
            t.setGround(QTransform::fromTranslate(way, 0));  // the camera has moved right
            return t.viewFromImage({200 - way, 100});        // what stands at 200 of the ground
        };
        const QPointF before = at(0);
        QVERIFY(!t.keepInView());
        compare(at(50), before);
        QVERIFY(!t.keepInView());
        // Where the picture would leave the view, it goes on with it.
        compare(at(300), before);
        QVERIFY(t.keepInView());
        const double shift = t.viewFromImage({-100, 100}).x() - before.x();
        QVERIFY(shift < -200 && shift > -300);
        QVERIFY(!t.keepInView());
        // A part that is looked at closely stands still for as long as the picture shows it.
        ViewTransform near = shown({640, 480}, {640, 480});
        near.setZoomAround({320, 240}, 8);
        near.setGround(QTransform::fromTranslate(200, 0));
        QVERIFY(!near.keepInView());
        near.setGround(QTransform::fromTranslate(500, 0));
        QVERIFY(near.keepInView());
    }

    void fittedOnTheGroundAllOfThePictureIsSeen() {
        ViewTransform t = shown({640, 480}, {640, 480});
        t.setGround(QTransform().translate(900, -40).rotate(30).scale(2, 2));
        t.fit();
        for (const QPointF p : {QPointF(0, 0), QPointF(639, 0), QPointF(639, 479), QPointF(0, 479)})
            QVERIFY(QRectF(-1, -1, 642, 482).contains(t.viewFromImage(p)));
    }

    void visibleImageEndsAtTheImage() {
        ViewTransform t = shown({640, 480}, {1000, 700});
        QCOMPARE(t.visibleImage(), QRectF(-0.5, -0.5, 640, 480));
    }
};

}  // namespace eyrie::ui::view_transform_test

EYRIE_UI_TEST(QCoreApplication, view_transform_test, ViewTransformTest)
#include "view_transform_test.moc"
