// What is a shadow and whose, against slow ways that follow the words of the descriptions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "motion/vectors/shadow_owners.h"
#include "motion/vectors/shadow_test.h"
#include "motion/vectors/vector_groups.h"

namespace eyrie::slow_shadows_test {
namespace {

/// A street with dark, half dark and bright things.
cv::Mat street(unsigned seed, cv::Size size, int brightness) {
    cv::Mat gray(size, CV_8UC1);
    cv::RNG random(seed);
    random.fill(gray, cv::RNG::NORMAL, brightness, 4);
    for (int i = 0; i < 26; ++i) {
        const cv::Rect thing(random.uniform(0, size.width - 4), random.uniform(0, size.height - 4),
                             random.uniform(2, 22), random.uniform(2, 14));
        gray(thing & cv::Rect({0, 0}, size)) = cv::saturate_cast<uchar>(brightness * random.uniform(0.15, 1.5));
    }
    return gray;
}

struct SlowShadows {
    const ShadowTestOptions& options;
    const SceneScale& scale;
    const cv::Mat& gray;

    double ground(cv::Point2d place) const {
        const int block = std::clamp(int(std::lround(1 / scale.gsd_m_per_px)), 3, 16);
        const int cells = int(std::lround(options.shadow_ground_m / scale.gsd_m_per_px / block));
        cv::Mat small, median;
        cv::resize(gray, small, {int(std::ceil(double(gray.cols) / block)), int(std::ceil(double(gray.rows) / block))},
                   0, 0, cv::INTER_AREA);
        // The odd number of cells at or above.
        cv::medianBlur(small, median, std::clamp(cells % 2 == 0 ? cells + 1 : cells, 3, 61));
        const auto cell = [](double at, int many, int length) {
            return std::clamp(cvRound(at) * many / length, 0, many - 1);
        };
        return median.at<uchar>(cell(place.y, median.rows, gray.rows), cell(place.x, median.cols, gray.cols));
    }
    bool isShadow(cv::Point2f corner) const {
        const int radius = std::clamp(int(std::lround(options.shadow_radius_m / scale.gsd_m_per_px)), 2, 8);
        const double brightness = ground(corner);
        if (brightness < options.shadow_min_brightness) return false;
        const cv::Rect all({0, 0}, gray.size());
        const cv::Rect near =
            cv::Rect(cvRound(corner.x) - radius, cvRound(corner.y) - radius, 2 * radius + 1, 2 * radius + 1) & all;
        if (std::min(near.width, near.height) < 3) return false;
        double darkest = 1e9, brightest = 0;
        for (int y = near.y; y < near.br().y - 1; ++y) {
            for (int x = near.x; x < near.br().x - 1; ++x) {
                const double mean = cv::mean(gray(cv::Rect(x, y, 2, 2)))[0];
                darkest = std::min(darkest, mean);
                brightest = std::max(brightest, mean);
            }
        }
        return darkest >= options.shadow_darkest * brightness && darkest <= options.shadow_brightest * brightness &&
               brightest <= options.shadow_bright_near * brightness;
    }
    /// Two half pixels of lit ground in a row on the way to the vehicle, before anything bright.
    bool lit(const OrientedBox& vehicle, cv::Point2f corner) const {
        const cv::Point2d way = vehicle.centre - cv::Point2d(corner);
        const double brightness = ground(corner);
        bool lit_before = false;
        for (int half = 3; half * 0.5 < cv::norm(way); ++half) {
            const cv::Point2d place = cv::Point2d(corner) + way * (half * 0.5 / cv::norm(way));
            if (vehicle.contains(place, 0.5)) return false;
            const cv::Point pixel(cvRound(place.x), cvRound(place.y));
            if (!cv::Rect({0, 0}, gray.size()).contains(pixel)) continue;
            const double here = gray.at<uchar>(pixel);
            if (here > options.shadow_bright_near * brightness) return false;
            const bool now = here >= options.shadow_lit * brightness;
            if (now && lit_before) return true;
            lit_before = now;
        }
        return false;
    }
};

}  // namespace

TEST(SlowShadows, ShadowsAreToldByTheGroundAroundThem) {
    int shadows = 0, others = 0, lit = 0, unlit = 0;
    for (unsigned variant = 0; variant < 10; ++variant) {
        ShadowTestOptions options;
        options.shadow_radius_m = 0.3 + 0.35 * (variant % 4);
        options.shadow_ground_m = 6 + 3 * (variant % 3);
        options.shadow_min_brightness = variant == 3 ? 100 : 60;
        const SceneScale scale{variant % 2 == 0 ? 0.3 : variant % 4 == 1 ? 0.12 : 0.05, 25, true};
        const cv::Mat gray =
            street(variant + 1, variant == 4 ? cv::Size(97, 71) : cv::Size(130, 100), variant == 3 ? 99 : 130);
        ShadowTest test(options, scale);
        test.prepare(gray);
        const SlowShadows slow{options, scale, gray};
        cv::RNG random(variant);
        for (int i = 0; i < 300; ++i) {
            const cv::Point2f corner(random.uniform(-6.0F, float(gray.cols + 6)),
                                     random.uniform(-6.0F, float(gray.rows + 6)));
            const bool found = test.isShadow(corner);
            ASSERT_EQ(found, slow.isShadow(corner)) << variant << corner;
            ++(found ? shadows : others);
            const OrientedBox vehicle{{random.uniform(0.0, double(gray.cols)), random.uniform(-4.0, double(gray.rows))},
                                      14,
                                      7,
                                      random.uniform(0.0, 3.0)};
            const bool ground = test.litUpTo(vehicle, corner);
            ASSERT_EQ(ground, slow.lit(vehicle, corner)) << variant << corner << vehicle.centre;
            ++(ground ? lit : unlit);
        }
    }
    EXPECT_GT(shadows, 100);
    EXPECT_GT(others, 1000);
    EXPECT_GT(lit, 300);
    EXPECT_GT(unlit, 100);
    ShadowTest none({}, {0.3, 25, true});
    none.prepare(cv::Mat());
    EXPECT_FALSE(none.litUpTo({{10, 10}, 5, 5, 0}, {30, 30}));
}

TEST(SlowShadows, ShadowsAreCastByWhatMovesLikeThemBesideThem) {
    int cast = 0, own = 0;
    for (unsigned seed = 1; seed <= 40; ++seed) {
        std::mt19937 random(seed);
        const auto some = [&](double least, double most) {
            return least + (most - least) * double(random() % 10001) / 1e4;
        };
        const SceneScale scale{seed % 2 == 0 ? 0.3 : 0.2, 25, true};
        ShadowTestOptions options;
        options.shadow_reach_m = some(0.8, 3);
        std::vector<MotionVector> vectors;
        std::vector<char> dark;
        for (int k = 0; k < 5; ++k) {
            const cv::Point2d middle(60.0 * k + 30, 50 + some(-5, 5)), velocity(some(0.6, 2), some(-0.3, 0.3));
            const int lit = 2 + int(random() % 6);
            for (int i = 0; i < lit + 5; ++i) {
                const bool shadow = i >= lit;
                const cv::Point2d at =
                    middle + (shadow ? cv::Point2d(some(-7, 7), some(3, 11)) : cv::Point2d(some(-7, 7), some(-4, 4)));
                const double off = shadow ? some(0, 0.12) : some(0, 0.02);
                vectors.push_back({CornerId(vectors.size()), at, velocity + cv::Point2d(off, 0), 9});
                dark.push_back(shadow);
            }
        }
        const bool asks = seed % 3 == 0;
        const auto lit_up_to = [](const OrientedBox& box, cv::Point2f corner) {
            return int(box.centre.x + double(corner.x)) % 2 == 0;
        };
        const auto found =
            ShadowOwners(options, scale)
                .castShadows(vectors, dark, 0.02, asks ? ShadowOwners::LitUpTo(lit_up_to) : ShadowOwners::LitUpTo());
        std::vector<int> bright_ones, dark_ones;
        for (std::size_t i = 0; i < vectors.size(); ++i) (dark[i] ? dark_ones : bright_ones).push_back(int(i));
        Linkage linkage = vehicleLinkage(scale, 0.02, 0.05);
        const auto vehicles = groupVectors(vectors, bright_ones, linkage);
        linkage.along = linkage.across = std::max(4.0, 1.2 / scale.gsd_m_per_px);
        std::vector<char> expected(vectors.size(), 0);
        for (const VectorGroup& shadow : groupVectors(vectors, dark_ones, linkage)) {
            for (const VectorGroup& vehicle : vehicles) {
                if (vehicle.members.size() < 4 || vehicle.box.length < 2.2 / scale.gsd_m_per_px ||
                    vehicle.box.width < 0.9 / scale.gsd_m_per_px)
                    continue;
                const double most = std::max(0.03, 0.05 * cv::norm(vehicle.velocity));
                if (cv::norm(shadow.velocity - vehicle.velocity) > 2.5 * most) continue;
                const auto distance = [&](int member) {
                    const cv::Point2d p = vehicle.box.toBox(vectors[std::size_t(member)].position);
                    return std::hypot(std::max(0.0, std::abs(p.x) - vehicle.box.length / 2),
                                      std::max(0.0, std::abs(p.y) - vehicle.box.width / 2));
                };
                std::size_t parted = 0;
                bool near = true;
                for (const int member : shadow.members) {
                    near = near && distance(member) <= options.shadow_reach_m / scale.gsd_m_per_px + 1;
                    parted += lit_up_to(vehicle.box, vectors[std::size_t(member)].position);
                }
                if (!near || (asks && 2 * parted > shadow.members.size())) continue;
                for (const int member : shadow.members) {
                    if (distance(member) > 0.5) expected[std::size_t(member)] = 1;
                    own += distance(member) <= 0.5;
                }
            }
        }
        EXPECT_EQ(found, expected) << seed;
        cast += int(std::count(found.begin(), found.end(), 1));
    }
    EXPECT_GT(cast, 60);
    EXPECT_GT(own, 5);
}

}  // namespace eyrie::slow_shadows_test
