#include "motion/vectors/parallax_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace eyrie::parallax_test_test {
namespace {

constexpr double kSigma = 0.01;  // px/frame

/// Flat ground with noise, a fifth of it covered by standing things that rise up to one unit: a thing of height h at p
/// seems to move by h · 0.1 · (p − epipole) / |p − epipole|.
class Town {
 public:
    explicit Town(cv::Point2d epipole, double highest = 1, const ParallaxTestOptions& options = {}, int corners = 3000)
        : epipole_(epipole), test_(options) {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> x(0, 640);
        std::uniform_real_distribution<double> y(0, 480);
        std::uniform_real_distribution<double> height(0, highest);
        std::normal_distribution<double> noise(0, kSigma);
        for (int i = 0; i < corners; ++i) {
            const cv::Point2d p(x(random), y(random));
            const cv::Point2d v = i % 5 == 0 ? parallax(p, height(random)) : cv::Point2d(0, 0);
            test_.add(p, v + cv::Point2d(noise(random), noise(random)));
        }
        test_.finish(kSigma);
    }
    cv::Point2d parallax(cv::Point2d p, double height) const {
        const cv::Point2d away = p - epipole_;
        return 0.1 * height * away / std::hypot(away.x, away.y);
    }
    const ParallaxTest& test() const { return test_; }

 private:
    cv::Point2d epipole_;
    ParallaxTest test_;
};

void explainsRoofsOnly(const Town& town) {
    ASSERT_TRUE(town.test().active());
    for (const cv::Point2d p : {cv::Point2d(100, 60), cv::Point2d(500, 400), cv::Point2d(60, 400)}) {
        const cv::Point2d roof = town.parallax(p, 0.9);
        EXPECT_TRUE(town.test().explains(p, roof)) << p.x;
        EXPECT_TRUE(town.test().explains(p, town.parallax(p, 1.3))) << "a little higher than the others, " << p.x;
        EXPECT_FALSE(town.test().explains(p, cv::Point2d(-roof.y, roof.x))) << "across the line, " << p.x;
        EXPECT_FALSE(town.test().explains(p, -roof)) << "lower than the ground, " << p.x;
        EXPECT_FALSE(town.test().explains(p, town.parallax(p, 6))) << "far too fast, " << p.x;
    }
}

TEST(ParallaxTest, TakesRoofsForStandingWhenTheCameraMovesSideways) {
    explainsRoofsOnly(Town({1e7, 2e6}));
}

TEST(ParallaxTest, TakesRoofsForStandingWhenTheCameraMovesTowardsAPointInThePicture) {
    explainsRoofsOnly(Town({320, 200}));
}

TEST(ParallaxTest, OfVeryManyRoofsEveryFewthVotes) {
    explainsRoofsOnly(Town({320, 200}, 1, {}, 12000));
}

TEST(ParallaxTest, RoofsMayStrayFromTheirLineByTwoAndAHalfDeviations) {
    const Town town({1e7, 2e6});
    for (const cv::Point2d p : {cv::Point2d(100, 60), cv::Point2d(500, 400)}) {
        const cv::Point2d roof = town.parallax(p, 0.9);
        const cv::Point2d across = cv::Point2d(-roof.y, roof.x) / cv::norm(roof);
        for (const double side : {-1.0, 1.0}) {
            EXPECT_TRUE(town.test().explains(p, roof + across * (side * 2.1 * kSigma)));
            EXPECT_FALSE(town.test().explains(p, roof + across * (side * 2.9 * kSigma)));
        }
    }
}

TEST(ParallaxTest, ExplainsNothingOverFlatGround) {
    const Town town({1e7, 2e6}, 0);
    EXPECT_FALSE(town.test().active());
    EXPECT_FALSE(town.test().explains({100, 100}, {0.05, 0.01}));
}

TEST(ParallaxTest, AThirdOfTheRoofsMayBeVehicles) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> place(0, 480);
        std::uniform_real_distribution<double> angle(-3.1416, 3.1416);
        ParallaxTest test{ParallaxTestOptions{}};
        const cv::Point2d epipole(300, 220);
        for (int i = 0; i < 45; ++i) {
            const cv::Point2d p(place(random), place(random));
            const cv::Point2d away = (p - epipole) / cv::norm(p - epipole);
            const double a = angle(random);
            test.add(p, random() % 3 > 0 || i % 3 > 0 ? 0.1 * away : 0.1 * cv::Point2d(std::cos(a), std::sin(a)));
        }
        test.finish(kSigma);
        EXPECT_TRUE(test.explains({100, 60},
                                  0.09 * (cv::Point2d(100, 60) - epipole) / cv::norm(cv::Point2d(100, 60) - epipole)))
            << seed;
    }
}

TEST(ParallaxTest, ExplainsNothingWhereResidualsAgreeOnNoEpipole) {
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(0, 480);
    std::uniform_real_distribution<double> angle(-3.1416, 3.1416);
    ParallaxTest test{ParallaxTestOptions{}};
    for (int i = 0; i < 1000; ++i) {
        const double a = angle(random);
        test.add({place(random), place(random)}, {0.1 * std::cos(a), 0.1 * std::sin(a)});
    }
    test.finish(kSigma);
    EXPECT_FALSE(test.active());
}

TEST(ParallaxTest, FactorIsHowMuchHigherARoofMayBe) {
    // Nine tenths of the roofs show up to .09 px/frame.
    ParallaxTestOptions options;
    options.parallax_factor = 4;
    const Town town({1e7, 2e6}, 1, options);
    const cv::Point2d p(100, 60);
    EXPECT_FALSE(Town({1e7, 2e6}).test().explains(p, town.parallax(p, 3)));
    EXPECT_TRUE(town.test().explains(p, town.parallax(p, 3)));
    EXPECT_FALSE(town.test().explains(p, town.parallax(p, 4.5)));
}

TEST(ParallaxTest, AgreementIsTheShareOfRoofsThatMustPointAlongTheLines) {
    ParallaxTestOptions all;
    all.parallax_agreement = 1;
    EXPECT_FALSE(Town({1e7, 2e6}, 1, all).test().active()) << "noise takes some off their lines";
    all.parallax_agreement = 0.9;
    EXPECT_TRUE(Town({1e7, 2e6}, 1, all).test().active());
}

TEST(ParallaxTest, ForgetsTheFrameBefore) {
    ParallaxTest test{ParallaxTestOptions{}};
    test.finish(kSigma);
    EXPECT_FALSE(test.active());
    for (int i = 0; i < 200; ++i) test.add({double(i), double(i % 17)}, {0.001 * i, 0});
    test.finish(kSigma);
    EXPECT_TRUE(test.active());
    test.clear();
    EXPECT_FALSE(test.active());
    EXPECT_FALSE(test.explains({10, 10}, {0.05, 0}));
}

}  // namespace
}  // namespace eyrie::parallax_test_test
