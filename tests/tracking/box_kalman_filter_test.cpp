#include "tracking/box_kalman_filter.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <opencv2/core.hpp>
#include <random>

#include "core/geometry/angle.h"

namespace eyrie::box_kalman_filter_test {
namespace {

BoxMeasurement measured(const OrientedBox& box, cv::Point2d velocity = {0, 0}) {
    BoxMeasurement m;
    m.box = box;
    m.velocity = velocity;
    m.along = 0.8;
    m.across = 0.5;
    m.length = 2;
    m.width = 1.5;
    m.heading = 0.08;
    m.speed = 0.2;
    return m;
}

Homography turning(double angle, double zoom = 1, cv::Point2d shift = {0, 0}) {
    Homography h;
    h.matrix = {zoom * std::cos(angle),
                -zoom * std::sin(angle),
                shift.x,
                zoom * std::sin(angle),
                zoom * std::cos(angle),
                shift.y,
                0,
                0,
                1};
    return h;
}

/// The textbook's formulas with full matrices and an explicit inverse; the map is a similarity.
struct TextbookFilter {
    Eigen::VectorXd x;
    Eigen::MatrixXd p;

    void predict(double angle, double zoom, cv::Point2d shift, const BoxProcessNoise& noise) {
        Eigen::MatrixXd f = Eigen::MatrixXd::Identity(7, 7);
        f(0, 2) = f(1, 3) = 1;
        Eigen::MatrixXd camera = Eigen::MatrixXd::Zero(7, 7);
        Eigen::Matrix2d turn;
        turn << zoom * std::cos(angle), -zoom * std::sin(angle), zoom * std::sin(angle), zoom * std::cos(angle);
        camera.block(0, 0, 2, 2) = camera.block(2, 2, 2, 2) = turn;
        camera(4, 4) = camera(5, 5) = zoom;
        camera(6, 6) = 1;
        x = camera * f * x;
        x(0) += shift.x;
        x(1) += shift.y;
        x(6) = wrapPi(x(6) + angle);
        Eigen::MatrixXd q = Eigen::MatrixXd::Zero(7, 7);
        Eigen::MatrixXd push(7, 2);
        push << 0.5, 0, 0, 0.5, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0;
        q = push * push.transpose() * noise.acceleration * noise.acceleration;
        for (const int i : {0, 1}) q(i, i) += noise.position * noise.position;
        for (const int i : {4, 5}) q(i, i) += noise.size * noise.size;
        q(6, 6) += noise.heading * noise.heading;
        p = camera * f * p * f.transpose() * camera.transpose() + q;
    }

    void update(const BoxMeasurement& m) {
        Eigen::MatrixXd r = Eigen::MatrixXd::Zero(7, 7);
        const double c = std::cos(m.box.heading);
        const double s = std::sin(m.box.heading);
        r(0, 0) = m.along * m.along * c * c + m.across * m.across * s * s;
        r(1, 1) = m.along * m.along * s * s + m.across * m.across * c * c;
        r(0, 1) = r(1, 0) = (m.along * m.along - m.across * m.across) * s * c;
        r(2, 2) = r(3, 3) = m.speed * m.speed;
        r(4, 4) = m.length * m.length;
        r(5, 5) = m.width * m.width;
        r(6, 6) = m.heading * m.heading;
        Eigen::VectorXd y(7);
        y << m.box.centre.x, m.box.centre.y, m.velocity.x, m.velocity.y, m.box.length, m.box.width, 0;
        y -= x;
        y(6) = wrapPi(m.box.heading - x(6));
        const Eigen::MatrixXd k = p * (p + r).inverse();
        x += k * y;
        x(6) = wrapPi(x(6));
        p = (Eigen::MatrixXd::Identity(7, 7) - k) * p;
    }
};

}  // namespace

TEST(BoxKalmanFilter, ItsPlaceIsAsUncertainAsMeasuredInEveryDirection) {
    // .8 px along the heading, .5 px across it.
    for (const double heading : {0.0, 0.6, 2.0, -1.2}) {
        const BoxKalmanFilter filter(measured({{100, 50}, 20, 10, heading}));
        const cv::Point2d ahead(std::cos(heading), std::sin(heading));
        EXPECT_NEAR(filter.positionDeviation(ahead), 0.8, 1e-9) << heading;
        EXPECT_NEAR(filter.positionDeviation({-ahead.y, ahead.x}), 0.5, 1e-9) << heading;
        const cv::Point2d between = (ahead + cv::Point2d(-ahead.y, ahead.x)) / std::sqrt(2);
        EXPECT_NEAR(filter.positionDeviation(between), std::sqrt((0.64 + 0.25) / 2), 1e-9) << heading;
    }
}

TEST(BoxKalmanFilter, agreesWithTheTextbook) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, 1);
    const BoxProcessNoise process{0.05, 0.1, 0.1, 0.03};
    BoxKalmanFilter filter(measured({{100, 80}, 20, 10, 0.3}, {1, 0.3}));
    TextbookFilter slow{filter.state(), filter.covariance()};
    for (int frame = 0; frame < 60; ++frame) {
        const double angle = 0.01 * noise(random);
        const double zoom = 1 + 0.01 * noise(random);
        const cv::Point2d shift(noise(random), noise(random));
        ASSERT_TRUE(filter.predict(turning(angle, zoom, shift), process));
        slow.predict(angle, zoom, shift, process);
        const BoxMeasurement m = measured({{slow.x(0) + noise(random), slow.x(1) + noise(random)},
                                           20 + noise(random),
                                           10 + noise(random),
                                           slow.x(6) + 0.1 * noise(random)},
                                          {slow.x(2) + 0.1 * noise(random), slow.x(3) + 0.1 * noise(random)});
        ASSERT_TRUE(filter.update(m));
        slow.update(m);
        ASSERT_LT((filter.state() - slow.x).cwiseAbs().maxCoeff(), 1e-8) << frame;
        ASSERT_LT((filter.covariance() - slow.p).cwiseAbs().maxCoeff(), 1e-8) << frame;
    }
}

TEST(BoxKalmanFilter, headingCrossesTheSeamTheShortWay) {
    BoxKalmanFilter filter(measured({{0, 0}, 20, 10, kPi - 0.02}));
    filter.update(measured({{0, 0}, 20, 10, -kPi + 0.04}));
    const double turned = turnBetween(kPi - 0.02, filter.box().heading);
    EXPECT_GT(turned, 0);
    EXPECT_LT(turned, 0.06);
}

TEST(BoxKalmanFilter, headingIsMeasuredAsAnAxisAndPointedByTheVelocity) {
    BoxKalmanFilter filter(measured({{0, 0}, 20, 10, 0.1}, {2, 0}));
    filter.update(measured({{0, 0}, 20, 10, kPi + 0.1}, {2, 0}));
    EXPECT_NEAR(filter.box().heading, 0.1, 1e-9);
    BoxKalmanFilter reversed(measured({{0, 0}, 20, 10, kPi}, {2, 0}));
    reversed.pointForward(5);
    EXPECT_NEAR(std::abs(reversed.box().heading), kPi, 1e-9) << "too slow to know";
    reversed.pointForward(0.5);
    EXPECT_NEAR(reversed.box().heading, 0, 1e-9);
}

TEST(BoxKalmanFilter, standingOnTheGroundUnderATurningCameraKeepsZeroVelocity) {
    BoxKalmanFilter filter(measured({{300, 40}, 20, 10, 0}));
    OrientedBox truth{{300, 40}, 20, 10, 0};
    const Homography camera = turning(0.02, 1.001, {3, -2});
    for (int frame = 0; frame < 100; ++frame) {
        truth.centre = camera.apply(truth.centre);
        truth.heading = wrapPi(truth.heading + 0.02);
        truth.length *= 1.001;
        truth.width *= 1.001;
        filter.predict(camera, {});
        filter.update(measured(truth));
        ASSERT_LT(filter.speed(), 1e-9);
    }
    EXPECT_NEAR(filter.box().centre.x, truth.centre.x, 1e-6);
    EXPECT_NEAR(turnBetween(filter.box().heading, truth.heading), 0, 1e-9);
    EXPECT_NEAR(filter.box().length, truth.length, 1e-6);
}

TEST(BoxKalmanFilter, predictionThroughAPerspectiveMapFollowsTheMap) {
    Homography h;
    h.matrix = {1.01, 0.02, 3, -0.01, 0.99, 2, 1e-5, -2e-5, 1};
    BoxKalmanFilter filter(measured({{200, 150}, 20, 10, 0.4}, {3, -1}));
    filter.predict(h, {});
    const cv::Point2d moved(203, 149);
    EXPECT_NEAR(filter.box().centre.x, h.apply(moved).x, 1e-9);
    EXPECT_NEAR(filter.box().centre.y, h.apply(moved).y, 1e-9);
    EXPECT_NEAR(filter.velocity().x, h.applyToVector(moved, {3, -1}).x, 1e-9);
    EXPECT_NEAR(filter.box().heading, h.turned(moved, 0.4), 1e-9);
    EXPECT_NEAR(filter.box().length, 20 * h.scaleAt(moved), 1e-9);
}

TEST(BoxKalmanFilter, covarianceStaysPositiveUnderExtremeMeasurements) {
    BoxKalmanFilter filter(measured({{0, 0}, 20, 10, 0}));
    BoxMeasurement exact = measured({{0, 0}, 20, 10, 0});
    exact.along = exact.across = exact.length = exact.width = exact.heading = exact.speed = 1e-9;
    BoxMeasurement vague = measured({{0, 0}, 20, 10, 0});
    vague.along = 1e6;
    vague.across = 1e-6;
    for (int i = 0; i < 2000; ++i) {
        filter.predict({}, {0.02, 0.05, 0, 1e-4});
        filter.update(i % 3 == 0 ? exact : vague);
        BoxKalmanFilter::Covariance covariance = filter.covariance();
        cv::Mat variances;  // along the axes, largest first
        cv::eigen(cv::Mat(int(covariance.rows()), int(covariance.cols()), CV_64F, covariance.data()), variances);
        ASSERT_GE(variances.at<double>(variances.rows - 1), -1e-9) << i;
        ASSERT_TRUE(filter.state().allFinite());
    }
}

TEST(BoxKalmanFilter, nothingNotFiniteGetsIn) {
    BoxKalmanFilter filter(measured({{5, 6}, 20, 10, 0}));
    const auto before = filter.state();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(filter.update(measured({{nan, 0}, 20, 10, 0})));
    EXPECT_FALSE(filter.update(measured({{0, 0}, 20, 10, nan})));
    EXPECT_EQ(filter.state(), before);
    Homography broken;
    broken.matrix = cv::Matx33d::all(nan);
    EXPECT_FALSE(filter.predict(broken, {}));
    Homography singular;
    singular.matrix = {1, 0, 0, 1, 0, 0, 0, 0, 1};
    EXPECT_FALSE(filter.predict(singular, {}));
    EXPECT_TRUE(filter.state().allFinite());
    EXPECT_TRUE(filter.covariance().allFinite());
}

TEST(BoxKalmanFilter, anUnmeasuredSizeMayBeOffByHalfOfIt) {
    BoxMeasurement first;
    first.box = {{50, 50}, 20, 10, 0};
    const BoxKalmanFilter filter(first);
    EXPECT_NEAR(filter.covariance()(4, 4), 11 * 11, 1e-9);
    EXPECT_NEAR(filter.covariance()(5, 5), 6 * 6, 1e-9);
}

}  // namespace eyrie::box_kalman_filter_test
