#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/core.hpp>

#include "scene/painting/glare.h"
#include "scene/painting/sensor.h"
#include "scene/painting/surface.h"

/// Colours of materials, the passes of a picture, what the camera makes of light, and halos, worked out by hand.
namespace eyrie::painting_by_hand_test {
namespace {

/// The brightness of a surface at a place, as a multiple of the material's own.
double factorAt(const Surface& surface, cv::Vec3f base, cv::Point2d place) {
    return colourOf(surface, place)[0] / base[0];
}

/// Mean over places that are far from each other.
double meanOf(int count, const std::function<double(int)>& value) {
    double sum = 0;
    for (int i = 0; i < count; ++i) sum += value(i);
    return sum / count;
}

Sensor plainSensor() {
    Sensor sensor;
    sensor.read_noise = sensor.shot_noise = sensor.haze = sensor.vignette = 0;
    sensor.contrast = 1;
    sensor.level = 120;
    return sensor;
}

}  // namespace

TEST(SurfaceByHand, EachMaterialHasItsColourHoweverBrightAPlaceIs) {
    struct Known {
        Material material;
        cv::Vec3f base;
        double mean, least, most;  ///< of the brightness: on average, and what it stays within
    };
    for (const Known& known : {Known{Material::asphalt, {101, 99, 97}, 1, 0.7, 1.3},
                               {Material::worn_asphalt, {124, 124, 123}, 1, 0.68, 1.32},
                               {Material::concrete, {150, 156, 158}, 0.99, 0.51, 1.21},
                               {Material::paving, {142, 148, 152}, 0.97, 0.64, 1.21},
                               {Material::field, {86, 128, 132}, 1, 0.63, 1.37},
                               {Material::soil, {92, 116, 136}, 1, 0.67, 1.33},
                               {Material::gravel, {132, 142, 148}, 1, 0.77, 1.23},
                               {Material::kerb, {165, 168, 170}, 1, 0.82, 1.18},
                               {Material::paint, {212, 216, 217}, 1, 0.9, 1.1},
                               {Material::tar, {74, 72, 70}, 1, 0.92, 1.08},
                               {Material::stain, {58, 57, 56}, 1, 1, 1},
                               {Material::roof_gravel, {140, 145, 147}, 1, 0.78, 1.22},
                               {Material::roof_tiles, {78, 88, 134}, 0.92, 0.62, 1.22},
                               {Material::roof_metal, {160, 160, 156}, 0.965, 0.78, 1.06},
                               {Material::plain, {128, 128, 128}, 1, 1, 1}}) {
        const Surface surface{known.material};
        const int number = static_cast<int>(known.material);
        double sum = 0;
        for (int i = 0; i < 2000; ++i) {
            const cv::Point2d place(17.31 * (i % 50), 23.19 * (i / 50));  // fits no joints
            const cv::Vec3f colour = colourOf(surface, place);
            const double factor = colour[0] / known.base[0];
            sum += factor;
            EXPECT_GE(factor, known.least - 1e-5) << number;
            EXPECT_LE(factor, known.most + 1e-5) << number;
            if (colour[1] >= 255 || colour[2] >= 255) continue;
            EXPECT_NEAR(colour[1] / colour[0], known.base[1] / known.base[0], 1e-4) << number;
            EXPECT_NEAR(colour[2] / colour[0], known.base[2] / known.base[0], 1e-4) << number;
        }
        EXPECT_NEAR(sum / 2000, known.mean, 0.025) << number;
    }
}

TEST(SurfaceByHand, ToneAndTintMultiplyUpToWhite) {
    Surface surface{Material::plain, 1.5};
    EXPECT_EQ(colourOf(surface, {0, 0}), cv::Vec3f(192, 192, 192));
    surface.tint = {0.5F, 1, 2};
    EXPECT_EQ(colourOf(surface, {7, 7}), cv::Vec3f(96, 192, 255));
    EXPECT_EQ(opacityOf(Surface{Material::plain, 1, 0.4}, {3, 3}), 0.4F);
}

TEST(SurfaceByHand, GrassIsGreenOrDry) {
    // Between (52, 92, 74) and (78, 122, 118), whatever the brightness.
    double least = 9, most = 0;
    for (int i = 0; i < 2000; ++i) {
        const cv::Vec3f colour = colourOf(Surface{Material::grass}, {7.31 * (i % 50), 9.57 * (i / 50)});
        const double red = colour[2] / colour[1];
        least = std::min(least, red);
        most = std::max(most, red);
    }
    EXPECT_GE(least, 74.0 / 92 - 1e-4);
    EXPECT_LE(most, 118.0 / 122 + 1e-4);
    EXPECT_LT(least, 0.83);
    EXPECT_GT(most, 0.92);
}

TEST(SurfaceByHand, JointsRibsAndCoursesAreDarker) {
    // What noise makes of a place is nearly the same a hand's breadth beside it.
    Surface concrete{Material::concrete};
    concrete.direction = {0, 1};
    const cv::Vec3f grey(150, 156, 158);
    const auto slab = [&](double along, double across) {
        return meanOf(400, [&](int i) {
            // Along is down, across to the left.
            const double down = 7.5 * i + along, left = 2 + across;
            return factorAt(concrete, grey, {-left, down});
        });
    };
    EXPECT_NEAR(slab(0.2, 0) - slab(0, 0), 0.28, 0.035);
    EXPECT_NEAR(slab(0.2, 0) - slab(0.06, 0), 0.14, 0.035) << "half way out of a joint of 0.12 m";
    EXPECT_NEAR(slab(0.2, 0) - slab(-0.2, 0), 0, 0.035);
    EXPECT_NEAR(slab(2, -2) - slab(2, 0), -0.28, 0.05) << "a joint along it";

    const Surface paving{Material::paving};
    const cv::Vec3f stone(142, 148, 152);
    const auto plate = [&](double along, double across) {
        return meanOf(400, [&](int i) { return factorAt(paving, stone, {5.0 * i + along, 0.75 * 3 + across}); });
    };
    EXPECT_NEAR(plate(0.3, 0.2) - plate(0, 0.2), 0.15, 0.03);
    EXPECT_NEAR(plate(0.3, 0.2) - plate(0.3, 0), 0.15, 0.03);
    EXPECT_NEAR(plate(0.3, 0.2) - plate(0.05, 0.2), 0.075, 0.03);

    const Surface tiles{Material::roof_tiles};
    const auto course = [&](double share) {
        return meanOf(400, [&](int i) { return factorAt(tiles, {78, 88, 134}, {3.7 * i, 0.42 * (5 + share)}); });
    };
    EXPECT_NEAR(course(0.05) - course(0.45), 0.064, 0.025);
    EXPECT_NEAR(course(0.05) - course(0.95), 0.144, 0.03);
    EXPECT_NEAR(course(0.99) - course(1.01), -0.157, 0.02);

    const Surface metal{Material::roof_metal};
    const auto rib = [&](double along) {
        return meanOf(300, [&](int i) { return factorAt(metal, {160, 160, 156}, {1.1 * i + along, 4}); });
    };
    EXPECT_NEAR(rib(0.26) - rib(0.23), 0.16, 0.01) << "ribs of 0.242 m, 1.1 m apart";
    EXPECT_NEAR(rib(0.02) - rib(-0.02), -0.16, 0.01);
}

TEST(SurfaceByHand, PaintIsWornInPlacesAndStainsAreUneven) {
    const Surface paint{Material::paint};
    int whole = 0;
    double least = 9, most = 0;
    for (int i = 0; i < 3000; ++i) {
        const double opacity = opacityOf(paint, {1.31 * (i % 60), 1.57 * (i / 60)});
        least = std::min(least, opacity);
        most = std::max(most, opacity);
        whole += opacity > 0.9199 ? 1 : 0;
    }
    EXPECT_NEAR(most, 0.92, 1e-5);
    EXPECT_GE(least, 0.1 - 1e-6);
    EXPECT_LT(least, 0.45);
    EXPECT_NEAR(whole / 3000.0, 0.56, 0.12) << "what is not worn";
    const Surface stain{Material::stain, 1, 0.5};
    double mean = 0, largest = 0;
    for (int i = 0; i < 3000; ++i) {
        const double opacity = opacityOf(stain, {4.31 * (i % 60), 5.57 * (i / 60)});
        mean += opacity / 3000;
        largest = std::max(largest, opacity);
        EXPECT_GE(opacity, 0);
        EXPECT_LE(opacity, 0.5);
    }
    EXPECT_NEAR(mean, 0.5 * 0.55, 0.02);
    EXPECT_GT(largest, 0.42);
}

TEST(SensorByHand, PassesAreSpreadOverAPixelAndTheExposure) {
    Sensor sensor;
    sensor.samples = 4;
    sensor.blur_px = 0;
    sensor.exposure = 0.2;
    // A triangle of radius √½ has the variance of a pixel, 1/12.
    const double far = 0.353553, near = 0.094734;
    const double x[] = {-far, -near, near, far}, y[] = {-far, near, -near, far},
                 moment[] = {0.075, 0.025, -0.025, -0.075};
    const std::vector<PassSample> passes = passesOf(sensor);
    ASSERT_EQ(passes.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(passes[i].offset.x, x[i], 1e-6) << i;
        EXPECT_NEAR(passes[i].offset.y, y[i], 1e-6) << i;
        EXPECT_NEAR(passes[i].moment, moment[i], 1e-9) << i;
    }
    sensor.blur_px = 0.5;  // four times the variance
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(passesOf(sensor)[i].offset.x, 2 * x[i], 1e-6) << i;
    sensor.samples = 32;
    EXPECT_EQ(passesOf(sensor).size(), 32U);
}

TEST(SensorByHand, LightBecomesGreyLevels) {
    Sensor sensor = plainSensor();
    cv::Mat light(3, 4, CV_32FC3, cv::Scalar(100, 200, 50));
    Frame frame = develop(light, sensor, 1, 0);
    EXPECT_EQ(frame.colour.at<cv::Vec3b>(1, 1), cv::Vec3b(100, 200, 50));
    EXPECT_EQ(frame.gray.at<unsigned char>(1, 1), 144) << "0.114, 0.587 and 0.299 of them";
    sensor.gray = true;
    frame = develop(light, sensor, 1, 0);
    EXPECT_EQ(frame.gray.at<unsigned char>(1, 1), 144);
    EXPECT_EQ(frame.colour.at<cv::Vec3b>(2, 3), cv::Vec3b(144, 144, 144));
    // A tenth of haze: 0.45 of the contrast about 104. 200 becomes 140.
    sensor = plainSensor();
    sensor.contrast = 0.5;
    sensor.level = 100;
    sensor.haze = 0.1;
    light.setTo(cv::Scalar(200, 20, 120));
    EXPECT_EQ(develop(light, sensor, 1, 0).colour.at<cv::Vec3b>(0, 0), cv::Vec3b(140, 59, 104));
    // The corner of 4 × 3 px lies √3.25 px from the middle; at 2.5 px a fifth would be missing.
    sensor.vignette = 0.2;
    frame = develop(light, sensor, 1, 0);
    EXPECT_EQ(frame.colour.at<cv::Vec3b>(0, 0)[0], 125);
    EXPECT_EQ(frame.colour.at<cv::Vec3b>(2, 3)[0], 125);
    EXPECT_EQ(frame.colour.at<cv::Vec3b>(1, 1)[0], 139);
    light.setTo(cv::Scalar(900, -900, 120));
    EXPECT_EQ(develop(light, plainSensor(), 1, 0).colour.at<cv::Vec3b>(0, 0), cv::Vec3b(255, 0, 120));
}

TEST(SensorByHand, NoiseGrowsWithTheRootOfTheLevel) {
    const auto deviationOf = [](double level, double read, double shot, FrameIndex moment) {
        Sensor sensor = plainSensor();
        sensor.read_noise = read;
        sensor.shot_noise = shot;
        const cv::Mat light(120, 160, CV_32FC3, cv::Scalar::all(level));
        cv::Scalar mean, deviation;
        cv::meanStdDev(develop(light, sensor, 1, moment).colour, mean, deviation);
        EXPECT_NEAR(mean[0], level, 0.2);
        return deviation[1];
    };
    // Rounding adds a twelfth to the variance.
    EXPECT_NEAR(deviationOf(100, 3, 0, 0), std::sqrt(9 + 1.0 / 12), 0.06);
    EXPECT_NEAR(deviationOf(100, 0, 0.4, 0), std::sqrt(16 + 1.0 / 12), 0.08);
    EXPECT_NEAR(deviationOf(25, 0, 0.4, 0), std::sqrt(4 + 1.0 / 12), 0.05);
    EXPECT_NEAR(deviationOf(100, 3, 0.4, 0), std::sqrt(25 + 1.0 / 12), 0.1);
}

TEST(GlareByHand, ALampHasThreeHalos) {
    cv::Mat lamps(201, 201, CV_32SC3, cv::Scalar::all(0)), light(201, 201, CV_32FC3, cv::Scalar::all(0));
    lamps.at<cv::Vec3i>(100, 100) = {1000, 0, 500};
    addGlare(light, lamps, 2, 1);
    // Three boxes of n px laid over each other have (3n² + 1) / 4n³ of all in their middle: 7/27 of 3, 91/1331 of 11
    // and 1141/59319 of 39 px, squared, times 2.5, 6 and 16.
    EXPECT_NEAR(light.at<cv::Vec3f>(100, 100)[0], 101, 0.3);
    EXPECT_EQ(light.at<cv::Vec3f>(100, 100)[1], 0);
    EXPECT_NEAR(light.at<cv::Vec3f>(100, 100)[2], 50.5, 0.3);
    // Beyond 3, 15 and 57 px one of them ends.
    EXPECT_GT(light.at<cv::Vec3f>(100, 103)[0], light.at<cv::Vec3f>(100, 104)[0]);
    EXPECT_GT(light.at<cv::Vec3f>(100, 150)[0], 0);
    EXPECT_EQ(light.at<cv::Vec3f>(100, 158)[0], 0);
    EXPECT_EQ(light.at<cv::Vec3f>(158, 100)[0], 0);
    EXPECT_NEAR(light.at<cv::Vec3f>(100, 120)[0], light.at<cv::Vec3f>(80, 100)[0], 0.02);
    EXPECT_NEAR(light.at<cv::Vec3f>(100, 110)[0], light.at<cv::Vec3f>(100, 90)[0], 0.02);
    EXPECT_NEAR(cv::sum(light)[0], 500 * 24.5, 350);
    cv::Mat hazy(201, 201, CV_32FC3, cv::Scalar::all(10));
    addGlare(hazy, lamps, 2, 2);
    EXPECT_NEAR(hazy.at<cv::Vec3f>(100, 100)[0], 212, 0.6) << "added to what is there";
}

}  // namespace eyrie::painting_by_hand_test
