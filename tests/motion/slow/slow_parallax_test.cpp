// Which motion parallax explains, against a slow way that follows the words of the description.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <random>
#include <vector>

#include "motion/vectors/parallax_test.h"

namespace eyrie::slow_parallax_test {
namespace {

/// Plane and parallax, over the same pairs of residuals.
struct SlowParallax {
    struct Residual {
        cv::Point2d p, v;
    };
    double factor, agreement, sigma;
    std::vector<Residual> residuals{};
    cv::Vec3d epipole{0, 0, 0};
    double limits[2] = {0, 0};

    static cv::Vec3d line(const Residual& r, double unit = 1) {
        return cv::Vec3d(r.p.x / unit, r.p.y / unit, 1).cross(cv::Vec3d(r.v.x, r.v.y, 0));
    }
    static cv::Point2d towards(const cv::Vec3d& e, cv::Point2d p) {
        const cv::Point2d way(e[0] - e[2] * p.x, e[1] - e[2] * p.y);
        const double length = cv::norm(way);
        return length > 1e-12 ? way / length : cv::Point2d(0, 0);
    }
    bool onLine(const cv::Vec3d& e, const Residual& r) const {
        return std::abs(towards(e, r.p).cross(r.v)) <= 2.5 * sigma;
    }
    std::size_t support(const cv::Vec3d& e, const std::vector<Residual>& of) const {
        return std::size_t(std::count_if(of.begin(), of.end(), [&](const Residual& r) { return onLine(e, r); }));
    }
    void finish() {
        std::vector<Residual> strong;
        for (const Residual& r : residuals) {
            if (cv::norm(r.v) > 3 * sigma) strong.push_back(r);
        }
        if (strong.size() < 30) return;
        const std::size_t each = (strong.size() + 599) / 600;
        std::vector<Residual> some;
        for (std::size_t i = 0; i < strong.size(); i += each) some.push_back(strong[i]);
        std::uint64_t state = 0x9e3779b97f4a7c15ULL;
        const auto drawn = [&]() -> const Residual& {
            state = state * 6364136223846793005ULL + 1442695040888963407ULL;
            return some[std::size_t(state >> 33U) % some.size()];
        };
        std::size_t most = 0;
        cv::Vec3d best;
        for (int trial = 0; trial < 150; ++trial) {
            const Residual& a = drawn();
            const Residual& b = drawn();
            const cv::Vec3d crossing = line(a).cross(line(b));
            if (cv::norm(crossing) <= 1e-12 || support(crossing / cv::norm(crossing), some) <= most) continue;
            best = crossing / cv::norm(crossing);
            most = support(best, some);
        }
        if (most < 30) return;
        cv::Matx33d normal = cv::Matx33d::zeros();
        for (const Residual& r : some) {
            if (onLine(best, r)) normal += line(r, 500) * line(r, 500).t();
        }
        cv::Mat values, vectors;
        cv::eigen(normal, values, vectors);
        const cv::Vec3d better(vectors.at<double>(2, 0) * 500, vectors.at<double>(2, 1) * 500,
                               vectors.at<double>(2, 2));
        if (support(better, some) >= most) {
            best = better;
            most = support(better, some);
        }
        if (double(most) < agreement * double(some.size())) return;
        epipole = best;
        std::vector<double> sides[2];
        for (const Residual& r : residuals) {
            const double along = towards(epipole, r.p).dot(r.v);
            if (onLine(epipole, r) && std::abs(along) > 3 * sigma) sides[along > 0 ? 0 : 1].push_back(std::abs(along));
        }
        for (int side = 0; side < 2; ++side) {
            std::sort(sides[side].begin(), sides[side].end());
            if (sides[side].size() >= 30)
                limits[side] = factor * sides[side][std::size_t(0.9 * double(sides[side].size() - 1))];
        }
    }
    bool explains(cv::Point2d p, cv::Point2d v) const {
        const double along = towards(epipole, p).dot(v);
        return (limits[0] > 0 || limits[1] > 0) && onLine(epipole, {p, v}) &&
               std::abs(along) <= limits[along > 0 ? 0 : 1];
    }
};

}  // namespace

TEST(SlowParallax, ParallaxPointsAlongTheLinesOfMostPairs) {
    int explained = 0, refused = 0, idle = 0;
    for (int variant = 0; variant < 24; ++variant) {
        std::mt19937 random(unsigned(variant) + 1);
        const auto some = [&](double least, double most) {
            return least + (most - least) * double(random() % 100001) / 1e5;
        };
        const cv::Point2d source = variant % 3 == 0   ? cv::Point2d(320, 200)
                                   : variant % 3 == 1 ? cv::Point2d(-900, 4000)
                                                      : cv::Point2d(1e6, 3e5);
        ParallaxTestOptions options;
        options.parallax_factor = 1 + 0.5 * (variant % 4);
        options.parallax_agreement = variant % 5 == 0 ? 0.8 : 0.5;
        const double sigma = 0.01;
        ParallaxTest test(options);
        SlowParallax slow{options.parallax_factor, options.parallax_agreement, sigma};
        const int count = variant < 8 ? 40 + 8 * variant : variant < 16 ? 300 : 2500;
        for (int i = 0; i < count; ++i) {
            const cv::Point2d p(some(0, 640), some(0, 480));
            const cv::Point2d away = (p - source) / cv::norm(p - source);
            // Things that rise and, fewer, that lie lower; others go their own way.
            cv::Point2d v = away * (i % 7 < variant % 4 ? -some(0, 0.06) : some(0, 0.12));
            if (i % 10 < variant % 6) v = {some(-0.1, 0.1), some(-0.1, 0.1)};
            v += cv::Point2d(some(-1, 1), some(-1, 1)) * 0.015;
            test.add(p, v);
            slow.residuals.push_back({p, v});
        }
        test.finish(sigma);
        slow.finish();
        EXPECT_EQ(test.active(), slow.limits[0] > 0 || slow.limits[1] > 0) << variant;
        idle += !test.active();
        for (int i = 0; i < 400; ++i) {
            const cv::Point2d p(some(0, 640), some(0, 480));
            const cv::Point2d away = (p - source) / cv::norm(p - source);
            const cv::Point2d v = away * some(-0.5, 0.5) + cv::Point2d(some(-0.03, 0.03), some(-0.03, 0.03));
            const bool found = test.explains(p, v);
            EXPECT_EQ(found, slow.explains(p, v)) << variant << p << v;
            ++(found ? explained : refused);
        }
    }
    EXPECT_GT(explained, 300);
    EXPECT_GT(refused, 1000);
    EXPECT_GT(idle, 1);
}

}  // namespace eyrie::slow_parallax_test
