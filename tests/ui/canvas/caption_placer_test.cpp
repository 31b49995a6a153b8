#include "canvas/drawing/caption_placer.h"

#include <QTest>
#include <random>

#include "ui/support/ui_test.h"

namespace eyrie::ui::caption_placer_test {

class CaptionPlacerTest : public QObject {
    Q_OBJECT

 private slots:
    void aLoneLabelStandsAboveItsObject() {
        const QRectF object(100, 100, 40, 20);
        CaptionPlacer placer({0, 0, 400, 400}, {object});
        const auto place = placer.place(object, {30, 12});
        QVERIFY(place);
        QVERIFY(place->bottom() <= object.top());
        QCOMPARE(place->center().x(), object.center().x());
    }

    void atTheUpperEdgeItStandsBelow() {
        const QRectF object(100, 2, 40, 20);
        CaptionPlacer placer({0, 0, 400, 400}, {object});
        const auto place = placer.place(object, {30, 12});
        QVERIFY(place);
        QVERIFY(place->top() >= object.bottom());
    }

    void inACrowdLabelsThinOutButNeverOverlap() {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> place(0, 500);
        std::vector<QRectF> objects;
        for (int i = 0; i < 200; ++i) objects.emplace_back(place(random), place(random), 24, 12);
        CaptionPlacer placer({0, 0, 520, 520}, objects);
        std::vector<QRectF> labels;
        for (const QRectF& object : objects)
            if (const auto label = placer.place(object, {26, 13})) labels.push_back(*label);
        QVERIFY(!labels.empty());
        QVERIFY(labels.size() < objects.size());
        for (size_t i = 0; i < labels.size(); ++i) {
            for (size_t k = i + 1; k < labels.size(); ++k) QVERIFY(!labels[i].intersects(labels[k]));
            for (const QRectF& object : objects) QVERIFY(!labels[i].intersects(object));
        }
    }
};

}  // namespace eyrie::ui::caption_placer_test

EYRIE_UI_TEST(QCoreApplication, caption_placer_test, CaptionPlacerTest)
#include "caption_placer_test.moc"
