#include "learning/models/window_scanner.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "learning/drawn_windows.h"
#include "learning/training/trainer.h"
#include "support/every_target.h"

namespace eyrie::window_scanner_test {
namespace {

VehicleModel modelOf(DescriptorKind descriptor, ClassifierKind classifier, int trees) {
    TrainingOptions options;
    options.descriptor = descriptor;
    options.classifier = classifier;
    options.classifier_options.trees = trees;
    options.hard_negative_rounds = 1;
    return *trainModel(test::drawnSamples(60, 200, 1), options, {});
}

const VehicleModel& boosted() {
    static const VehicleModel model = modelOf(DescriptorKind::channel_features, ClassifierKind::adaboost, 101);
    return model;
}

/// Ground with vehicles, other things and noise.
cv::Mat drawnRoi(cv::Size size, std::uint64_t seed) {
    SeededRandom random(seed);
    cv::Mat roi(size, CV_8UC1, cv::Scalar(120));
    for (int i = 0; i < size.area() / 900; ++i) {
        const cv::Point at(random.below(size.width), random.below(size.height));
        if (random.below(2) == 0) {
            cv::rectangle(roi, cv::Rect(at, cv::Size(9, 21)), cv::Scalar(random.below(256)), cv::FILLED);
        } else {
            cv::circle(roi, at, random.below(12), cv::Scalar(random.below(256)), cv::FILLED);
        }
    }
    for (auto& pixel : cv::Mat1b(roi)) pixel = cv::saturate_cast<uchar>(pixel + random.below(13) - 6);
    return roi;
}

cv::Mat1f scanned(const WindowScanner& scanner, const cv::Mat& roi, double margin, ScanStatistics* statistics = {}) {
    cv::Mat decision;
    scanner.scan(roi, margin, decision, statistics);
    return decision;
}

}  // namespace

TEST(WindowScanner, equalsTheModelOnEveryWindowWhenNothingIsRejected) {
    const WindowScanner scanner(boosted());
    ASSERT_TRUE(scanner.fast());
    // Widths around whole vectors of every size, and an image that is a part of another one.
    for (const cv::Size size : {cv::Size(60, 70), cv::Size(16, 32), cv::Size(17, 33), cv::Size(47, 40),
                                cv::Size(48, 32), cv::Size(79, 35), cv::Size(110, 36)}) {
        const cv::Mat large = drawnRoi(size + cv::Size(9, 7), 5);
        const cv::Mat roi = large(cv::Rect(cv::Point(4, 3), size));
        const cv::Mat1f decision = scanned(scanner, roi, WindowScanner::kNothingRejected);
        ASSERT_EQ(decision.size(), size - cv::Size(15, 31));
        for (int y = 0; y < decision.rows; ++y) {
            for (int x = 0; x < decision.cols; ++x) {
                ASSERT_EQ(decision(y, x), static_cast<float>(boosted().decide(roi(cv::Rect(x, y, 16, 32)))))
                    << size << " " << x << " " << y;
            }
        }
    }
}

TEST(WindowScanner, isTheSameOnEveryKindOfProcessor) {
    const WindowScanner scanner(boosted());
    const cv::Mat roi = drawnRoi({75, 50}, 8);
    for (const double margin : {WindowScanner::kNothingRejected, 0.5}) {
        const cv::Mat1f expected = scanned(scanner, roi, margin);
        test::forEveryTarget([&](const std::string& name) {
            const cv::Mat1f decision = scanned(scanner, roi, margin);
            EXPECT_EQ(cv::countNonZero(decision != expected), 0) << name;
        });
    }
}

TEST(WindowScanner, findsTheDrawnVehicle) {
    cv::Mat roi(90, 60, CV_8UC1, cv::Scalar(120));
    cv::rectangle(roi, cv::Rect(23, 35, 9, 21), cv::Scalar(220), cv::FILLED);
    const cv::Mat1f decision = scanned(WindowScanner(boosted()), roi, 8);
    double best = 0;
    cv::Point at;
    cv::minMaxLoc(decision, nullptr, &best, nullptr, &at);
    EXPECT_GT(best, 0);
    EXPECT_NEAR(at.x + 7.5, 27, 2);
    EXPECT_NEAR(at.y + 15.5, 45, 5) << "nothing in these samples teaches where a vehicle ends";
}

TEST(WindowScanner, rejectsByTheTraceAndLeavesTheOthersAlone) {
    const WindowScanner scanner(boosted());
    const auto& forest = dynamic_cast<const GentleAdaBoost&>(*boosted().classifier);
    const auto& rectangles = dynamic_cast<const ChannelFeatures&>(*boosted().descriptor).rectangles();
    const cv::Mat roi = drawnRoi({75, 80}, 8);
    const cv::Mat1f all = scanned(scanner, roi, WindowScanner::kNothingRejected);
    for (const double margin : {0.0, 1.0, 5.0}) {
        const cv::Mat1f decision = scanned(scanner, roi, margin);
        int rejected = 0;
        for (int y = 0; y < decision.rows; ++y) {
            for (int x = 0; x < decision.cols; ++x) {
                // The slow way: after every fourth tree the sum is held against the trace.
                const IntegralChannels channels(roi(cv::Rect(x, y, 16, 32)));
                double sum = 0;
                bool given_up = false;
                for (std::size_t t = 0; t < forest.trees().size(); ++t) {
                    const BoostedTree& tree = forest.trees()[t];
                    const auto reaches = [&](std::size_t node) -> std::size_t {
                        const auto& r = rectangles[static_cast<std::size_t>(tree.feature[node])];
                        return channels.sum(r.channel, r.area) >= tree.threshold[node] ? 1 : 0;
                    };
                    const std::size_t side = reaches(0);
                    sum += tree.leaf[2 * side + reaches(1 + side)] / 512.0;
                    const bool checked = t % 4 == 3 || t + 1 == forest.trees().size();
                    given_up = given_up || (checked && sum < static_cast<double>(forest.leastSums()[t]) - margin);
                }
                ASSERT_EQ(std::isinf(decision(y, x)), given_up) << margin << " at " << x << " " << y;
                rejected += given_up ? 1 : 0;
                if (!given_up) {
                    ASSERT_EQ(decision(y, x), all(y, x));
                }
            }
        }
        EXPECT_GT(rejected, decision.total() / 4) << margin;
    }
}

TEST(WindowScanner, readsTheTraceAfterEveryFourthTreeAndAtTheEnd) {
    // Lines that no sum reaches, where the trace is read or everywhere else.
    const auto& forest = dynamic_cast<const GentleAdaBoost&>(*boosted().classifier);
    const std::size_t trees = forest.trees().size();
    const cv::Mat roi = drawnRoi({75, 50}, 8);
    const auto rejected = [&](const auto& impossible_at) {
        std::vector<float> trace(trees, -5000);
        for (std::size_t t = 0; t < trees; ++t) {
            if (impossible_at(t)) trace[t] = 5000;
        }
        VehicleModel model = boosted();
        model.classifier = std::make_shared<GentleAdaBoost>(forest.dimension(), forest.trees(), trace);
        int count = 0;
        for (const float value : scanned(WindowScanner(model), roi, 0)) count += std::isinf(value) ? 1 : 0;
        return count;
    };
    EXPECT_EQ(rejected([&](std::size_t t) { return t % 4 != 3 && t + 1 != trees; }), 0);
    EXPECT_EQ(rejected([](std::size_t t) { return t == 3; }), 60 * 19);
    EXPECT_EQ(rejected([](std::size_t t) { return t == 67; }), 60 * 19);
    EXPECT_EQ(rejected([&](std::size_t t) { return t + 1 == trees; }), 60 * 19);
}

TEST(WindowScanner, savesTreesByRejecting) {
    const WindowScanner scanner(boosted());
    const cv::Mat roi = drawnRoi({160, 120}, 8);
    ScanStatistics strict;
    ScanStatistics lenient;
    ScanStatistics all;
    scanned(scanner, roi, 0, &strict);
    scanned(scanner, roi, 4, &lenient);
    scanned(scanner, roi, WindowScanner::kNothingRejected, &all);
    EXPECT_EQ(all.windows, 145 * 89);
    EXPECT_EQ(all.trees, all.windows * 101);
    EXPECT_LT(strict.trees, lenient.trees);
    EXPECT_LT(lenient.trees, all.trees);
}

TEST(WindowScanner, deliversNothingForImagesSmallerThanTheWindow) {
    const WindowScanner scanner(boosted());
    for (const cv::Size size : {cv::Size(15, 32), cv::Size(16, 31), cv::Size(1, 1), cv::Size(200, 3)}) {
        EXPECT_TRUE(scanned(scanner, cv::Mat(size, CV_8UC1, cv::Scalar(9)), 1).empty());
    }
}

TEST(WindowScanner, scansWithEveryOtherModelWindowByWindow) {
    for (const auto& [descriptor, classifier] :
         {std::pair(DescriptorKind::hog, ClassifierKind::adaboost),
          std::pair(DescriptorKind::channel_features, ClassifierKind::random_forest)}) {
        const VehicleModel model = modelOf(descriptor, classifier, 20);
        const WindowScanner scanner(model);
        EXPECT_FALSE(scanner.fast());
        const cv::Mat roi = drawnRoi({22, 37}, 2);
        const cv::Mat1f decision = scanned(scanner, roi, 1);
        ASSERT_EQ(decision.size(), cv::Size(7, 6));
        for (int y = 0; y < decision.rows; ++y) {
            for (int x = 0; x < decision.cols; ++x) {
                EXPECT_NEAR(decision(y, x), model.decide(roi(cv::Rect(x, y, 16, 32))), 1e-5);
            }
        }
    }
}

}  // namespace eyrie::window_scanner_test
