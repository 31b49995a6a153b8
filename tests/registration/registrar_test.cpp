#include "registration/registrar.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <opencv2/imgproc.hpp>
#include <set>

#include "core/error.h"
#include "registration/flight.h"

namespace eyrie::registrar_test {
namespace {

using test::drift;
using test::expectWellFormed;
using test::Flight;
using test::kSize;
using test::scaleOf;
using test::Watch;

}  // namespace

TEST(Registrar, firstFrameHasCornersAndNothingBefore) {
    Watch watch;
    Flight flight;
    const RegisteredFrame result = watch.see(flight);
    EXPECT_EQ(result.registration.state, RegistrationState::first);
    EXPECT_GT(result.corners.size(), 800U);
    for (const Corner& corner : result.corners) EXPECT_EQ(corner.age, 0);
    expectWellFormed(result, kSize);
}

TEST(Registrar, followsTheCameraToAHundredthOfAPixel) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    double sum = 0;
    constexpr int kFrames = 12;
    for (int i = 1; i <= kFrames; ++i) {
        flight.move(test::cameraMotion(kSize, 1.7 * std::cos(i), 2.1 * std::sin(2.0 * i), 0.3 * std::sin(i), 1.002));
        const RegisteredFrame result = watch.see(flight);
        ASSERT_EQ(result.registration.state, RegistrationState::registered);
        expectWellFormed(result, kSize);
        EXPECT_EQ(result.registration.current_from_previous.from_frame, i - 1);
        EXPECT_EQ(result.registration.current_from_previous.to_frame, i);
        EXPECT_GT(result.registration.current_from_previous.inliers, 500);
        sum += watch.error(result);
    }
    EXPECT_LT(sum / kFrames, 0.015);
}

TEST(Registrar, cornersStayOnTheirSpotOfTheGround) {
    // No random walk: what errors there are after 15 frames are hardly more than after two.
    Watch watch;
    Flight flight(kSize, 1);
    std::map<CornerId, cv::Point2f> start;
    for (const Corner& corner : watch.see(flight).corners) start[corner.id] = corner.current;
    const auto medianError = [&](const RegisteredFrame& result) {
        std::vector<double> errors;
        for (const Corner& corner : result.corners) {
            const auto at = start.find(corner.id);
            if (at == start.end()) continue;
            const cv::Vec3d p = flight.pictureFromGround() * cv::Vec3d(at->second.x, at->second.y, 1);
            errors.push_back(
                std::hypot(p[0] / p[2] - double(corner.current.x), p[1] / p[2] - double(corner.current.y)));
        }
        EXPECT_GT(errors.size(), start.size() / 2);
        std::nth_element(errors.begin(), errors.begin() + long(errors.size() / 2), errors.end());
        return errors[errors.size() / 2];
    };
    double early = 0;
    double late = 0;
    for (int i = 1; i <= 15; ++i) {
        flight.move(drift());
        const RegisteredFrame result = watch.see(flight);
        if (i == 2) early = medianError(result);
        if (i == 15) late = medianError(result);
    }
    EXPECT_LT(early, 0.2);
    EXPECT_LT(late, 1.35 * early);
}

TEST(Registrar, yawDoesNotSpoilVelocities) {
    // The scatter of the background's velocity over ten frames must not depend on whether the camera turns.
    const auto scatter = [](double degrees_per_frame) {
        Watch watch;
        Flight flight(kSize, 1);
        std::map<CornerId, cv::Point2f> start;
        cv::Matx33d then;
        std::vector<double> speeds;
        for (int i = 0; i <= 13; ++i) {
            flight.move(test::cameraMotion(kSize, 0.7, -0.4, degrees_per_frame));
            const RegisteredFrame result = watch.see(flight);
            if (i == 3) {
                then = flight.pictureFromGround();
                for (const Corner& corner : result.corners) start[corner.id] = corner.current;
            }
            if (i < 13) continue;
            const cv::Matx33d now_from_then = flight.pictureFromGround() * then.inv();
            for (const Corner& corner : result.corners) {
                const auto at = start.find(corner.id);
                if (at == start.end()) continue;
                const cv::Vec3d p = now_from_then * cv::Vec3d(at->second.x, at->second.y, 1);
                speeds.push_back(
                    std::hypot(p[0] / p[2] - double(corner.current.x), p[1] / p[2] - double(corner.current.y)) / 10);
            }
        }
        EXPECT_GT(speeds.size(), 800U);
        std::nth_element(speeds.begin(), speeds.begin() + long(speeds.size() / 2), speeds.end());
        return speeds[speeds.size() / 2];
    };
    const double straight = scatter(0);
    EXPECT_LT(straight, 0.02);
    EXPECT_LT(scatter(1.0), 1.3 * straight);
}

TEST(Registrar, movingPatchesNeitherPullTheGroundNorLoseTheirCorners) {
    // Twelve textured patches, a third of the picture, drive to the right at 1.3 px/frame over the ground.
    const test::TexturedGround vehicles(77, 1.5);
    Watch watch;
    Flight flight;
    double sum = 0;
    RegisteredFrame result;
    constexpr int kFrames = 10;
    constexpr int kVehicles = 12;
    const auto placed = [](int k, double moved) {
        return cv::Rect2d(8 + 80 * (k % 4) + 6 * (k / 4) + moved, 18 + 75 * (k / 4), 50, 42);
    };
    for (int i = 0; i <= kFrames; ++i) {
        if (i > 0) flight.move(test::cameraMotion(kSize, -0.8, 0.5, 0));
        cv::Mat gray = flight.picture();
        const cv::Matx33d ground_from_picture = flight.pictureFromGround().inv();
        for (int y = 0; y < kSize.height; ++y) {
            for (int x = 0; x < kSize.width; ++x) {
                const double gx = x + ground_from_picture(0, 2);
                const double gy = y + ground_from_picture(1, 2);
                for (int k = 0; k < kVehicles; ++k) {
                    const cv::Rect2d where = placed(k, 1.3 * i);
                    if (!where.contains({gx, gy})) continue;
                    const int noise = int((unsigned(x * 31 + y * 17 + i * 7) * 2654435761U >> 16) % 7) - 3;
                    gray.at<std::uint8_t>(y, x) =
                        cv::saturate_cast<std::uint8_t>(vehicles.at(gx - 1.3 * i, gy) + noise);
                }
            }
        }
        watch.truth = test::cameraMotion(kSize, -0.8, 0.5, 0);
        result = watch.seePicture(gray);
        if (i == 0) continue;
        ASSERT_EQ(result.registration.state, RegistrationState::registered);
        EXPECT_LT(watch.error(result), 0.25);
        // From five frames on it is known which corners move.
        if (i >= 5) sum += watch.error(result);
    }
    EXPECT_LT(sum / (kFrames - 4), 0.03);
    int on_vehicle = 0;
    int seen_as_moving = 0;
    double speed = 0;
    const cv::Matx33d ground_from_picture = flight.pictureFromGround().inv();
    for (const Corner& corner : result.corners) {
        if (corner.age < 5) continue;
        const double gx = double(corner.current.x) + ground_from_picture(0, 2);
        const double gy = double(corner.current.y) + ground_from_picture(1, 2);
        bool inside = false;
        for (int k = 0; k < kVehicles; ++k) {
            const cv::Rect2d where = placed(k, 1.3 * kFrames);
            inside = inside || (gx > where.x + 5 && gx < where.x + where.width - 5 && gy > where.y + 5 &&
                                gy < where.y + where.height - 5);
        }
        if (!inside) continue;
        ++on_vehicle;
        const double own = double(corner.current.x - corner.previous.x) + 0.8;
        if (!corner.on_background && std::abs(own - 1.3) < 0.3) {
            ++seen_as_moving;
            speed += own;
        }
    }
    EXPECT_GT(on_vehicle, 150);
    EXPECT_GT(seen_as_moving, on_vehicle * 9 / 10);
    EXPECT_NEAR(speed / seen_as_moving, 1.3, 0.02);
}

TEST(Registrar, survivesShakeAndTurns) {
    for (const cv::Size size : {cv::Size(320, 240), cv::Size(640, 480)}) {
        Watch watch;
        Flight flight(size);
        watch.see(flight);
        const double shakes[5][3] = {{14, -11, 2}, {-18, 3, -3}, {9, 15, 3}, {-12, -14, -1}, {15, 8, 2.5}};
        for (const auto& shake : shakes) {
            flight.move(test::cameraMotion(size, shake[0], shake[1], shake[2]));
            const RegisteredFrame result = watch.see(flight);
            ASSERT_EQ(result.registration.state, RegistrationState::registered)
                << describe(result.registration.failure);
            EXPECT_LT(watch.error(result, size), 0.05);
        }
    }
}

TEST(Registrar, everySizeRunsWithoutHarm) {
    for (const cv::Size size :
         {cv::Size(1, 1), cv::Size(16, 16), cv::Size(2, 300), cv::Size(33, 17), cv::Size(64, 48)}) {
        Watch watch;
        Flight flight(size);
        for (int i = 0; i < 5; ++i) {
            flight.move(test::cameraMotion(size, 0.5, 0.3, 0));
            const RegisteredFrame result = watch.see(flight);
            expectWellFormed(result, size);
            if (size.width >= 64 && i > 0) {
                EXPECT_EQ(result.registration.state, RegistrationState::registered)
                    << describe(result.registration.failure);
                EXPECT_LT(watch.error(result, size), 0.15);
            }
        }
    }
}

TEST(Registrar, largePicturesRun) {
    // 8K, tiled from a small picture: the size is what matters here.
    Flight flight;
    cv::Mat large;
    cv::repeat(flight.picture(), 18, 24, large);
    Watch watch;
    EXPECT_GT(watch.seePicture(large).corners.size(), 5000U);
    cv::Mat shifted(large.size(), CV_8UC1, cv::Scalar(0));
    large(cv::Rect(3, 2, large.cols - 3, large.rows - 2))
        .copyTo(shifted(cv::Rect(0, 0, large.cols - 3, large.rows - 2)));
    const RegisteredFrame result = watch.seePicture(shifted);
    ASSERT_EQ(result.registration.state, RegistrationState::registered) << describe(result.registration.failure);
    EXPECT_LE(result.corners.size(), 24000U) << "twice as many as in a picture of usual size";
    EXPECT_LT(
        test::gridError(result.registration.current_from_previous.matrix, {1, 0, -3, 0, 1, -2, 0, 0, 1}, large.size()),
        0.01);
}

TEST(Registrar, refusesFramesItCannotUse) {
    Watch watch;
    Flight flight;
    EXPECT_THROW(watch.seePicture(cv::Mat()), Error);
    EXPECT_THROW(watch.seePicture(cv::Mat(10, 10, CV_8UC3)), Error);
    watch.see(flight);
    flight.move(drift());
    watch.see(flight);
    try {
        watch.seePicture(cv::Mat(100, 100, CV_8UC1, cv::Scalar(1)));
        FAIL() << "a change of size must be refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_NE(std::string(error.what()).find("100×100"), std::string::npos);
        EXPECT_NE(std::string(error.what()).find("320×240"), std::string::npos);
    }
    flight.move(drift());
    EXPECT_EQ(watch.see(flight).registration.state, RegistrationState::registered);  // as if nothing had happened
    watch.registrar.reset();
    EXPECT_EQ(watch.seePicture(cv::Mat(100, 100, CV_8UC1, cv::Scalar(1))).registration.state, RegistrationState::first);
}

TEST(Registrar, isTheSameEachTimeAndOnAnyNumberOfThreads) {
    const auto run = [] {
        Watch watch;
        Flight flight;
        std::vector<RegisteredFrame> results;
        for (int i = 0; i < 4; ++i) {
            flight.move(drift());
            results.push_back(watch.see(flight));
        }
        return results;
    };
    std::vector<RegisteredFrame> one;
    {
        const tbb::global_control single(tbb::global_control::max_allowed_parallelism, 1);
        one = run();
    }
    for (int repetition = 0; repetition < 2; ++repetition) {
        const std::vector<RegisteredFrame> again = run();
        for (std::size_t i = 0; i < one.size(); ++i) {
            EXPECT_EQ(one[i].registration.current_from_previous.matrix,
                      again[i].registration.current_from_previous.matrix);
            ASSERT_EQ(one[i].corners.size(), again[i].corners.size());
            for (std::size_t k = 0; k < one[i].corners.size(); ++k) {
                EXPECT_EQ(one[i].corners[k].id, again[i].corners[k].id);
                EXPECT_EQ(one[i].corners[k].current, again[i].corners[k].current);
            }
        }
    }
}

TEST(Registrar, fillsTheTimesItIsAskedFor) {
    Registrar registrar({}, scaleOf(0.3));
    Flight flight;
    StageTimes times{};
    times[std::size_t(Stage::motion)] = 7;
    times[std::size_t(Stage::corners)] = times[std::size_t(Stage::homography)] = 1e9;  // of a frame before
    registrar.next(test::frameOf(0, flight.picture()), &times);
    flight.move(drift());
    registrar.next(test::frameOf(1, flight.picture()), &times);
    EXPECT_GT(times[std::size_t(Stage::corners)], 0);
    EXPECT_GT(times[std::size_t(Stage::tracking_corners)], 0);
    EXPECT_GT(times[std::size_t(Stage::homography)], 0);
    EXPECT_EQ(times[std::size_t(Stage::motion)], 7);
    EXPECT_LT(times[std::size_t(Stage::corners)], 1e8);
    EXPECT_LT(times[std::size_t(Stage::homography)], 1e8);
}

TEST(RegistrationOptions, everyParameterIsNamedAfterTheRoomAndReadsBack) {
    RegistrationOptions options;
    const auto all = listParameters(describeOf(options));
    EXPECT_EQ(all.size(), 20U);
    for (const Parameter& parameter : all) {
        EXPECT_EQ(parameter.name.rfind("registration.", 0), 0U) << parameter.name;
        EXPECT_FALSE(parameter.text.help.empty());
        setParameter(describeOf(options), parameter.name, parameter.value);
    }
    setParameter(describeOf(options), "registration.max_corners", "321");
    EXPECT_EQ(options.corners.max_corners, 321);
    EXPECT_THROW(setParameter(describeOf(options), "registration.max_corners", "99999"), Error);
}

}  // namespace eyrie::registrar_test
