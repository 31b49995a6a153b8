#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "detection/segmenters/component_boxes.h"
#include "detection/sliding_window/box_classifier.h"
#include "detection/sliding_window/global_sliding_window.h"
#include "detection/sliding_window/scale_votes.h"
#include "detection/sliding_window/window_hypotheses.h"
#include "detection/trained_window_model.h"
#include "imaging/upright_patch.h"
#include "support/dice.h"

/// Boxes of components, windows and what they vote for, against the same worked out as their rules are told.
namespace eyrie::slow_detection_test {
namespace {

using test::Dice;

/// A box by its sides.
struct Sides {
    double left = 0, top = 0, right = 0, bottom = 0;
    double width() const { return right - left; }
    double height() const { return bottom - top; }
    bool holds(const cv::Point2f& p, double beside) const {
        return p.x >= left - beside && p.x <= right + beside && p.y >= top - beside && p.y <= bottom + beside;
    }
};

Sides around(const std::vector<cv::Point2f>& points, double along, double across) {
    if (points.empty()) return {-across, -along, across, along};
    Sides sides{1e9, 1e9, -1e9, -1e9};
    for (const cv::Point2f& p : points) {
        sides.left = std::min<double>(sides.left, p.x);
        sides.right = std::max<double>(sides.right, p.x);
        sides.top = std::min<double>(sides.top, p.y);
        sides.bottom = std::max<double>(sides.bottom, p.y);
    }
    return {sides.left - across, sides.top - along, sides.right + across, sides.bottom + along};
}

std::vector<Sides> slowlySelected(const cv::Mat& labels, const std::vector<cv::Point2f>& vectors,
                                  const GradientOptions& options, const SceneScale& scale) {
    double most = 0;
    cv::minMaxLoc(labels, nullptr, &most);
    const double px = 1 / scale.gsd_m_per_px;
    // Lengths that stand for something have a pixel at least.
    const double core_margin = std::max(1.0, options.core_margin_m * px);
    const Sides core = around(vectors, core_margin, core_margin);
    std::vector<Sides> boxes;
    for (int label = 1; label <= cvRound(most); ++label) {
        std::vector<cv::Point> own;
        bool cut = false;
        for (int y = 0; y < labels.rows; ++y)
            for (int x = 0; x < labels.cols; ++x) {
                if (labels.at<int>(y, x) != label) continue;
                own.emplace_back(x, y);
                cut = cut || x == 0 || y == 0 || x == labels.cols - 1 || y == labels.rows - 1;
            }
        if (cv::boundingRect(own).area() < options.min_box_area) continue;
        if (cut && options.handle_cut)
            std::erase_if(own, [&](const cv::Point& p) {
                return p.x < cvRound(core.left) || p.x > cvRound(core.right) || p.y < cvRound(core.top) ||
                       p.y > cvRound(core.bottom);
            });
        if (own.empty()) continue;
        const cv::Rect box = cv::boundingRect(own);
        const Sides sides{box.x - 0.5, box.y - 0.5, box.br().x - 0.5, box.br().y - 0.5};
        const auto inside = std::count_if(vectors.begin(), vectors.end(), [&](auto& p) { return sides.holds(p, 1); });
        const double needed = std::max(1.0, options.support_share * static_cast<double>(vectors.size()));
        if (options.need_support && static_cast<double>(inside) < needed) continue;
        boxes.push_back(sides);
    }
    const double longest = options.vehicle_length_m * px;
    const double widest = std::max(4.0, options.vehicle_width_m * px);
    while (options.join_components) {
        std::size_t first = 0, second = 0;
        Sides best;
        for (std::size_t a = 0; a < boxes.size(); ++a)
            for (std::size_t b = a + 1; b < boxes.size(); ++b) {
                const Sides both{std::min(boxes[a].left, boxes[b].left), std::min(boxes[a].top, boxes[b].top),
                                 std::max(boxes[a].right, boxes[b].right), std::max(boxes[a].bottom, boxes[b].bottom)};
                if (both.height() > longest || both.width() > widest) continue;
                if (second > 0 && both.width() * both.height() >= best.width() * best.height()) continue;
                best = both;
                first = a;
                second = b;
            }
        if (second == 0) break;
        boxes[first] = best;
        boxes.erase(boxes.begin() + static_cast<std::ptrdiff_t>(second));
    }
    std::vector<Sides> selected;
    for (Sides box : boxes) {
        std::vector<cv::Point2f> own;
        for (const cv::Point2f& p : vectors)
            if (box.holds(p, 1)) own.push_back(p);
        const Sides near =
            around(own, std::max(1.0, options.growth_along_m * px), std::max(1.0, options.growth_across_m * px));
        if (!own.empty() && options.growth_along_m > 0) {
            box.top = std::max(box.top, near.top);
            box.bottom = std::min(box.bottom, near.bottom);
        }
        if (!own.empty() && options.growth_across_m > 0) {
            box.left = std::max(box.left, near.left);
            box.right = std::min(box.right, near.right);
        }
        if (box.width() <= 0 || box.height() <= 0) box = {};
        const double radius =
            options.method == GradientMethod::lbp ? std::max(options.lbp_radius_min, options.lbp_radius_max) : 0;
        const auto narrowed = [](double& low, double& high, double less) {
            const double left = std::max(high - low - less, std::min(high - low, 1.0));
            const double middle = (low + high) / 2;
            low = middle - left / 2;
            high = middle + left / 2;
        };
        narrowed(box.left, box.right, options.width_correction * radius);
        narrowed(box.top, box.bottom, options.length_correction * radius);
        if (box.width() * box.height() >= options.min_box_area) selected.push_back(box);
    }
    return selected;
}

TEST(SlowDetection, ComponentsBecomeBoxesAsTheRulesSay) {
    Dice dice(1);
    int found = 0, joined = 0;
    for (int i = 0; i < 600; ++i) {
        cv::Mat binary = cv::Mat::zeros(90, 60, CV_8UC1);
        for (int k = 0; k < 9; ++k) {
            const cv::Rect part(dice.number(-4, 58), dice.number(-4, 88), dice.number(1, 16), dice.number(1, 24));
            binary(part & cv::Rect(0, 0, 60, 90)).setTo(255);
        }
        std::vector<cv::Point2f> vectors;
        const int count = dice.number(0, 12);
        vectors.reserve(static_cast<std::size_t>(count));
        for (int k = 0; k < count; ++k) vectors.emplace_back(dice.number(10, 50), dice.number(10, 80));
        const SceneScale scale{dice.happens(0.5) ? 0.1 : 0.23, 25, true};
        GradientOptions options = GradientOptions::thesis();
        options.min_box_area = dice.number(1, 40);
        options.need_support = dice.happens(0.5);
        options.support_share = dice.between(0, 0.4);
        options.handle_cut = dice.happens(0.5);
        options.core_margin_m = dice.between(0, 1);
        options.join_components = dice.happens(0.5);
        options.vehicle_length_m = dice.between(0.2, 6);
        options.vehicle_width_m = dice.between(0.2, 4);
        options.growth_along_m = dice.happens(0.5) ? 0 : dice.between(0, 1);
        options.growth_across_m = dice.happens(0.5) ? 0 : dice.between(0, 1);
        options.length_correction = dice.happens(0.5) ? 0 : dice.between(0, 2);
        options.width_correction = dice.happens(0.5) ? 0 : dice.between(0, 2);
        options.lbp_radius_max = dice.number(1, 4);
        if (dice.happens(0.2)) options.method = GradientMethod::simple;
        cv::Mat labels;
        const auto regions = findRegions(binary, options.min_box_area, labels);
        const auto boxes = ComponentBoxes(options, scale).select(regions, labels, vectors);
        const auto slow = slowlySelected(labels, vectors, options, scale);
        ASSERT_EQ(boxes.size(), slow.size()) << i;
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            ASSERT_NEAR(boxes[k].x, slow[k].left, 1e-5) << i;
            ASSERT_NEAR(boxes[k].y, slow[k].top, 1e-5) << i;
            ASSERT_NEAR(boxes[k].width, slow[k].width(), 1e-5) << i;
            ASSERT_NEAR(boxes[k].height, slow[k].height(), 1e-5) << i;
        }
        found += static_cast<int>(boxes.size());
        joined += boxes.size() < regions.size();
        // They explain what moves where they hold its share.
        const auto held = std::count_if(vectors.begin(), vectors.end(), [&](const cv::Point2f& p) {
            return std::any_of(slow.begin(), slow.end(), [&](const Sides& box) { return box.holds(p, 1); });
        });
        options.fall_back_share = dice.between(0, 1);
        ASSERT_EQ(
            ComponentBoxes(options, scale).explain(boxes, vectors),
            !slow.empty() && static_cast<double>(held) >= options.fall_back_share * static_cast<double>(vectors.size()))
            << i;
    }
    EXPECT_GT(found, 500);
    EXPECT_GT(joined, 100);
}

TEST(SlowDetection, PeaksAreHigherThanAllAroundThem) {
    Dice dice(2);
    for (int i = 0; i < 300; ++i) {
        cv::Mat decision(dice.number(1, 12), dice.number(1, 12), CV_32FC1);
        for (int y = 0; y < decision.rows; ++y)
            for (int x = 0; x < decision.cols; ++x) decision.at<float>(y, x) = static_cast<float>(dice.number(0, 4));
        std::vector<cv::Point> slow;
        const double threshold = dice.number(0, 3);
        for (int y = 0; y < decision.rows; ++y)
            for (int x = 0; x < decision.cols; ++x) {
                const float own = decision.at<float>(y, x);
                bool peak = static_cast<double>(own) >= threshold;
                for (int k = 0; k < 9; ++k) {
                    const cv::Point beside(x + k % 3 - 1, y + k / 3 - 1);
                    if (k == 4 || !cv::Rect({}, decision.size()).contains(beside)) continue;
                    // Of neighbours that are the same the first counts.
                    const float other = decision.at<float>(beside);
                    peak = peak && (other < own || (other == own && k > 4));
                }
                if (peak) slow.emplace_back(x, y);
            }
        ASSERT_EQ(decisionPeaks(decision, threshold), slow) << i;
    }
}

double shared(const cv::Rect2d& a, const cv::Rect2d& b) {
    const double width = std::min(a.x + a.width, b.x + b.width) - std::max(a.x, b.x);
    const double height = std::min(a.y + a.height, b.y + b.height) - std::max(a.y, b.y);
    return width > 0 && height > 0 ? width * height : 0;
}

TEST(SlowDetection, OfWindowsThatOverlapTheSurestStay) {
    Dice dice(3);
    for (int i = 0; i < 300; ++i) {
        std::vector<WindowHypothesis> windows(static_cast<std::size_t>(dice.number(0, 14)));
        for (WindowHypothesis& window : windows) {
            window.box = cv::Rect2d(dice.number(0, 20), dice.number(0, 20), dice.number(0, 12), dice.number(0, 12));
            window.decision = dice.number(0, 6);
        }
        const double most = dice.between(0, 0.7);
        std::vector<char> open(windows.size(), 1);
        std::vector<std::size_t> slow;
        for (;;) {
            std::size_t best = windows.size();
            for (std::size_t k = 0; k < windows.size(); ++k)
                if (open[k] && (best == windows.size() || windows[k].decision > windows[best].decision)) best = k;
            if (best == windows.size()) break;
            slow.push_back(best);
            for (std::size_t k = 0; k < windows.size(); ++k) {
                const double both = shared(windows[best].box, windows[k].box);
                const double all = windows[best].box.area() + windows[k].box.area() - both;
                if (k == best || (all > 0 && both / all > most)) open[k] = 0;
            }
        }
        const auto kept = suppressOverlapping(windows, most);
        ASSERT_EQ(kept.size(), slow.size()) << i;
        for (std::size_t k = 0; k < kept.size(); ++k) ASSERT_EQ(kept[k].box, windows[slow[k]].box) << i;
    }
}

using test::drivenScene;
using test::drivenSceneWindow;
using test::kContractScale;

TEST(SlowDetection, ABoxIsLookedAtLongerAndShorterThroughAllWindowsAroundIt) {
    const WindowScanner scanner(loadModel(drivenSceneWindow().model));
    const BoxClassifier classifier(loadModel(drivenSceneWindow().model), drivenSceneWindow(), kContractScale);
    const WindowFit& fit = scanner.model().fit;
    Dice dice(4);
    for (int i = 0; i < 24; ++i) {
        const auto scene = drivenScene(dice.between(-3, 3), {150, 118}, static_cast<std::uint64_t>(i) + 1);
        OrientedBox box = scene.vehicle;
        box.centre += cv::Point2d(dice.between(-30, 30), dice.between(-30, 30));
        box.length = dice.between(5, 120);
        box.width = dice.between(2, 40);
        // Half way between what was measured, within limits, and a car of 40 × 16 px.
        const double length = (std::min(80.0, std::max(20.0, box.length)) + 40) / 2;
        const double width = (std::min(25.6, std::max(9.6, box.width)) + 16) / 2;
        const int columns = kWindowWidth + 2 * static_cast<int>(std::ceil(0.15 * fit.width));
        const int rows = kWindowHeight + 2 * static_cast<int>(std::ceil(0.15 * fit.length));
        const double across = columns * width / fit.width, along = rows * length / fit.length;
        const UprightPatch patch = cutUpright(scene.frame.gray, {box.centre, along * 1.33, across, box.heading});
        double highest = -1e300;
        for (const double longer : {0.75, 1.0, 1.33}) {
            const int w = std::min(patch.image.cols, std::max(1, cvRound(across)));
            const int h = std::min(patch.image.rows, std::max(1, cvRound(along * longer)));
            const cv::Mat part = patch.image(cv::Rect((patch.image.cols - w) / 2, (patch.image.rows - h) / 2, w, h));
            cv::Mat looked, decision;
            const bool smaller = columns <= w && rows <= h;
            cv::resize(part, looked, {columns, rows}, 0, 0, smaller ? cv::INTER_AREA : cv::INTER_LINEAR);
            scanner.scan(looked, WindowScanner::kNothingRejected, decision);
            for (int y = 0; y < decision.rows; ++y)
                for (int x = 0; x < decision.cols; ++x)
                    highest = std::max(highest, static_cast<double>(decision.at<float>(y, x)));
        }
        EXPECT_NEAR(classifier.at(scene.frame.gray, box), highest, 1e-6) << i;
    }
}

TEST(SlowDetection, TheGlobalWindowLooksInAllDirectionsAndKeepsTheSurest) {
    const WindowScanner scanner(loadModel(drivenSceneWindow().model));
    SlidingWindowOptions options = drivenSceneWindow();
    options.decision_threshold = -1000;
    options.rejection_margin = SlidingWindowOptions::kNoRejection;
    options.overlap_threshold = 0.2;
    const auto scene = drivenScene(0.8, {150, 118}, 5);
    const cv::Mat gray = scene.frame.gray(cv::Rect(95, 70, 120, 90)).clone();
    for (const int orientations : {1, 4}) {
        std::vector<Detection> all;
        for (int i = 0; i < orientations; ++i) {
            const double heading = kPi / 2 - i * kPi / orientations;
            const double c = std::abs(std::cos(heading)), s = std::abs(std::sin(heading));
            const OrientedBox whole{{59.5, 44.5}, 120 * c + 90 * s, 120 * s + 90 * c, heading};
            const UprightPatch patch = cutUpright(gray, whole);
            for (const double factor : options.scales()) {
                cv::Mat decision;
                for (const auto& window :
                     scanAtScale(scanner, patch.image, factor, options, kContractScale, decision)) {
                    Detection each;
                    const cv::Point2d middle(window.box.x + window.box.width / 2, window.box.y + window.box.height / 2);
                    const cv::Vec2d at = patch.image_from_patch * cv::Vec3d(middle.x, middle.y, 1);
                    each.box = {{at[0], at[1]}, window.box.height, window.box.width, heading};
                    each.score = window.decision;
                    if (areaInImage(each.box, gray.size()) * 2 > each.box.area()) all.push_back(each);
                }
            }
        }
        std::vector<Detection> slow;
        while (!all.empty()) {
            const auto best =
                std::max_element(all.begin(), all.end(), [](auto& a, auto& b) { return a.score < b.score; });
            slow.push_back(*best);
            all.erase(best);
            std::erase_if(all, [&](const Detection& each) { return overlap(each.box, slow.back().box) > 0.2; });
        }
        const auto found = globalSlidingWindow(scanner, gray, options, kContractScale, orientations);
        ASSERT_EQ(found.size(), slow.size()) << orientations;
        EXPECT_GT(found.size(), 1U);
        for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_EQ(found[k].score, slow[k].score);
            EXPECT_LT(cv::norm(found[k].box.centre - slow[k].box.centre), 1e-6);
            EXPECT_NEAR(found[k].box.length, slow[k].box.length, 1e-6);
            EXPECT_NEAR(found[k].box.width, slow[k].box.width, 1e-6);
            EXPECT_NEAR(std::abs(std::cos(found[k].box.heading - slow[k].box.heading)), 1, 1e-9);
        }
    }
}

TEST(SlowDetection, WindowsVoteForTheirScaleAsTheRulesSay) {
    SlidingWindowOptions options = drivenSceneWindow();
    options.rejection_margin = SlidingWindowOptions::kNoRejection;
    const ScaleLooker looker(options);
    const WindowScanner scanner(loadModel(options.model));
    Dice dice(6);
    int voted = 0;
    for (int i = 0; i < 30; ++i) {
        const auto scene = drivenScene(dice.between(-3, 3), {150, 118}, static_cast<std::uint64_t>(i) + 1);
        OrientedBox moving = scene.vehicle.scaled(dice.between(0.7, 1.6), dice.between(0.7, 1.6));
        moving.centre += cv::Point2d(dice.between(-3, 3), dice.between(-3, 3));
        std::vector<cv::Point2f> vectors;
        const int count = dice.number(4, 16);
        vectors.reserve(static_cast<std::size_t>(count));
        for (int k = 0; k < count; ++k)
            vectors.emplace_back(scene.vehicle.toImage({dice.between(-24, 24), dice.between(-10, 10)}));
        const ScaleRange range{dice.between(0.06, 0.1), dice.between(0.1, 0.3)};
        struct Seen {
            cv::Rect2d box;
            double gsd = 0, decision = 0;
        };
        std::vector<Seen> seen;
        std::vector<double> scales{range.finest_m_per_px};
        while (scales.back() * 1.12 <= range.coarsest_m_per_px) scales.push_back(scales.back() * 1.12);
        for (const double gsd : scales) {
            const double length = options.car_length_m / gsd, width = options.car_width_m / gsd;
            if (length < 8 || length > 250 || 0.6 * length > moving.length) continue;
            const OrientedBox area{moving.centre, moving.length + 1.3 * length, moving.width + 1.6 * width,
                                   moving.heading};
            const UprightPatch patch = cutUpright(scene.frame.gray, area);
            SlidingWindowOptions sure = options;
            sure.decision_threshold = 6;
            cv::Mat decision;
            SceneScale scale;
            scale.gsd_m_per_px = gsd;
            for (const auto& window : scanAtScale(scanner, patch.image, 1, sure, scale, decision)) {
                // Upright around the middle of what moves.
                const cv::Point2d middle = toPatch(patch.image_from_patch, moving.centre);
                const cv::Rect2d box = window.box - middle;
                int held = 0, near = 0;
                double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
                for (const cv::Point2f& vector : vectors) {
                    const cv::Point2d ahead = moving.toBox(vector);
                    const cv::Point2d at(ahead.y, -ahead.x);
                    const auto within = [&](double x, double y) {
                        return at.x >= box.x - x && at.x < box.x + box.width + x && at.y >= box.y - y &&
                               at.y < box.y + box.height + y;
                    };
                    near += within(1 + 0.15 * box.width, 1 + 0.15 * box.height);
                    if (!within(1, 1)) continue;
                    ++held;
                    left = std::min(left, at.x);
                    right = std::max(right, at.x);
                    top = std::min(top, at.y);
                    bottom = std::max(bottom, at.y);
                }
                if (held >= 4 && held >= 0.8 * near && bottom - top >= 0.6 * box.height &&
                    right - left >= 0.45 * box.width)
                    seen.push_back({box, gsd, window.decision});
            }
        }
        std::stable_sort(seen.begin(), seen.end(), [](auto& a, auto& b) { return a.decision > b.decision; });
        std::vector<Seen> slow;
        for (const Seen& each : seen)
            if (std::none_of(slow.begin(), slow.end(), [&](const Seen& surer) {
                    return shared(surer.box, each.box) > 0.3 * std::min(surer.box.area(), each.box.area());
                }))
                slow.push_back(each);
        const auto votes = looker.votesOn(scene.frame.gray, moving, vectors, range);
        ASSERT_EQ(votes.size(), slow.size()) << i;
        for (std::size_t k = 0; k < votes.size(); ++k) {
            EXPECT_EQ(votes[k].gsd_m_per_px, slow[k].gsd) << i;
            EXPECT_EQ(votes[k].decision, slow[k].decision) << i;
            const cv::Point2d middle(slow[k].box.x + slow[k].box.width / 2, slow[k].box.y + slow[k].box.height / 2);
            EXPECT_LT(cv::norm(votes[k].place - moving.toImage({-middle.y, middle.x})), 1e-9) << i;
        }
        voted += static_cast<int>(votes.size());
    }
    EXPECT_GT(voted, 8);
}

}  // namespace
}  // namespace eyrie::slow_detection_test
