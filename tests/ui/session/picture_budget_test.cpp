#include "session/frames/picture_budget.h"

#include <QTest>

#include "ui/support/ui_test.h"

namespace eyrie::ui::picture_budget_test {

/// How much memory the window takes for pictures.
class PictureBudgetTest : public QObject {
    Q_OBJECT

    static constexpr std::uint64_t kMegabyte = 1 << 20;

    static std::uint64_t megabytes(PictureUse use, std::uint64_t memory_mb) {
        return pictureBudget(use, memory_mb * kMegabyte) / kMegabyte;
    }

 private slots:
    void isAShareOfTheMemoryUpToALimit() {
        QCOMPARE(megabytes(PictureUse::review, 64 * 1024), std::uint64_t(384));
        QCOMPARE(megabytes(PictureUse::review, 4 * 1024), std::uint64_t(384));
        QCOMPARE(megabytes(PictureUse::review, 2 * 1024), std::uint64_t(256));
        QCOMPARE(megabytes(PictureUse::review, 1024), std::uint64_t(128));
        QCOMPARE(megabytes(PictureUse::comparison, 64 * 1024), std::uint64_t(256));
        QCOMPARE(megabytes(PictureUse::comparison, 1200), std::uint64_t(100));
    }

    void isEnoughToStepEvenOnASmallMachineOrAnUnknownOne() {
        for (const PictureUse use : {PictureUse::review, PictureUse::comparison}) {
            QCOMPARE(megabytes(use, 128), std::uint64_t(48));
            QCOMPARE(megabytes(use, 0), std::uint64_t(48));
        }
    }

    void isKnownHere() {
        QVERIFY(pictureBudget(PictureUse::review) >= 48 * kMegabyte);
        QVERIFY(pictureBudget(PictureUse::review) <= 384 * kMegabyte);
    }
};

}  // namespace eyrie::ui::picture_budget_test

EYRIE_UI_TEST(QCoreApplication, picture_budget_test, PictureBudgetTest)
#include "picture_budget_test.moc"
