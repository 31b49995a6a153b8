// Removal of duplicates and outliers against slow ways that look at every pair anew, by the words of the descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/geometry/angle.h"
#include "core/values/corner_density.h"
#include "core/values/inferred_ids.h"
#include "removal/duplicate_removal.h"
#include "removal/outlier_removal.h"
#include "removal/part_joining.h"
#include "removal/vector_support.h"

namespace eyrie::slow_removal_test {
namespace {

class Dice {
 public:
    explicit Dice(unsigned seed) : random_(seed) {}
    double between(double least, double most) { return least + (most - least) * double(random_() % 100001) / 1e5; }
    bool oneIn(unsigned many) { return random_() % many == 0; }

 private:
    std::mt19937 random_;
};

/// Boxes one behind the other, on top of each other and alone, with vectors in and beside them.
struct Frames {
    std::vector<Detection> detections;
    FrameMotion motion;

    explicit Frames(unsigned seed) {
        Dice dice(seed);
        motion.image_size = {300, 200};
        motion.corner_count = int(dice.between(200, 4000));
        for (int k = 0; k < 9; ++k) {
            const double heading = dice.between(-3, 3);
            const cv::Point2d along(std::cos(heading), std::sin(heading)), across(-along.y, along.x);
            const cv::Point2d centre(dice.between(0, 300), dice.between(0, 200)),
                velocity = along * dice.between(0.3, 2.5);
            const int parts = 1 + k % 3;
            for (int i = 0; i < parts; ++i) {
                Detection detection;
                const double ahead = dice.between(0, dice.oneIn(2) ? 6 : 22) * i;
                detection.box = {centre + along * ahead + across * dice.between(-1, 1), dice.between(5, 16),
                                 dice.between(3, 8), heading + dice.between(-0.3, 0.3)};
                detection.velocity = velocity + cv::Point2d(dice.between(-0.09, 0.09), dice.between(-0.09, 0.09));
                detection.score = dice.oneIn(3) ? 0 : dice.between(0, 1);
                detection.complete = dice.oneIn(3);
                if (dice.oneIn(12)) detection.rejection = Rejection::size;
                detections.push_back(detection);
            }
            for (int i = 0; i < 24; ++i) {
                const cv::Point2d at = centre + along * dice.between(-9, 32) + across * dice.between(-6, 6);
                const bool inferred = dice.oneIn(3);
                const cv::Point2d off(dice.between(-0.3, 0.3), dice.between(-0.3, 0.3));
                motion.motion_vectors.push_back(
                    {CornerId(motion.motion_vectors.size()) + (inferred ? kFirstOfSilhouettes : 0), at,
                     velocity + off * dice.between(0, 1), inferred ? 0 : 9});
            }
        }
    }
};

bool alike(cv::Point2d a, cv::Point2d b, double floor, double share) {
    return cv::norm(a - b) <= std::max(floor, share * std::max(cv::norm(a), cv::norm(b)));
}

void slowSupport(Detection& detection, const FrameMotion& motion, double margin, bool compare) {
    const cv::Point2d before = detection.velocity;
    cv::Point2d sum(0, 0);
    detection.vectors.clear();
    for (std::size_t i = 0; i < motion.motion_vectors.size(); ++i) {
        const MotionVector& vector = motion.motion_vectors[i];
        const cv::Point2d in_box = detection.box.toBox(vector.position);
        if (std::abs(in_box.x) > detection.box.length / 2 + margin ||
            std::abs(in_box.y) > detection.box.width / 2 + margin)
            continue;
        const cv::Point2d velocity(vector.velocity);
        if (compare && cv::norm(velocity - before) > std::max(0.1, 0.2 * cv::norm(before))) continue;
        detection.vectors.push_back(int(i));
        sum += velocity;
    }
    if (!detection.vectors.empty()) detection.velocity = sum / double(detection.vectors.size());
}

bool kept(const Detection& detection) {
    return detection.rejection == Rejection::none;
}

/// The length up to which two parts were joined, and the whole; 0: they are not parts of one.
std::pair<double, OrientedBox> slowUnion(const Detection& a, const Detection& b, const FrameMotion& motion,
                                         const PartJoiningOptions& options, const SceneScale& scale) {
    const auto px = [&](double metres) { return metres / scale.gsd_m_per_px; };
    const OrientedBox both = a.box.area() >= b.box.area() ? unionBox(a.box, b.box) : unionBox(b.box, a.box);
    const double widest = std::max(a.box.width, b.box.width);
    if (!alike(a.velocity, b.velocity, options.part_velocity_floor, options.part_velocity_share) ||
        std::abs(turnBetween(a.box.heading, b.box.heading)) * 180 / CV_PI > options.part_max_turn_deg ||
        both.width > std::max({4.0, px(options.part_vehicle_width_m), widest}) || both.width > 1.5 * widest + 1)
        return {0, both};
    const cv::Point2d way = b.box.centre - a.box.centre;
    const double length = cv::norm(way);
    if (length >= 1 && options.part_silhouette_gap_m > 0 && both.length <= px(options.part_silhouette_length_m)) {
        std::vector<double> places{0, length};
        bool outline = false;
        for (const MotionVector& vector : motion.motion_vectors) {
            const cv::Point2d from = cv::Point2d(vector.position) - a.box.centre;
            const double place = from.dot(way) / length, aside = std::abs(way.cross(from)) / length;
            if (place < 0 || place > length || aside > std::min(a.box.width, b.box.width) / 2 + 1 ||
                !alike(vector.velocity, a.velocity, 0.1, 0.2))
                continue;
            places.push_back(place);
            outline = outline || isOfSilhouette(vector);
        }
        std::sort(places.begin(), places.end());
        double gap = 0;
        for (std::size_t i = 1; i < places.size(); ++i) gap = std::max(gap, places[i] - places[i - 1]);
        if (outline && gap <= std::max(3.0, px(options.part_silhouette_gap_m)))
            return {px(options.part_silhouette_length_m), both};
    }
    if (a.complete || b.complete) return {0, both};
    const bool parts = std::max(a.box.length, b.box.length) <= px(options.part_length_m);
    const double longest = px(parts ? options.part_vehicle_length_m : options.part_car_length_m);
    return {both.length <= longest ? longest : 0, both};
}

std::vector<Detection> slowJoin(std::vector<Detection> all, const FrameMotion& motion,
                                const PartJoiningOptions& options, const SceneScale& scale) {
    while (options.join_parts) {
        std::pair<double, std::pair<std::size_t, std::size_t>> nearest(1e9, {0, 0});
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t k = i + 1; k < all.size(); ++k) {
                const double distance = cv::norm(all[i].box.centre - all[k].box.centre);
                if (kept(all[i]) && kept(all[k]) && distance < nearest.first &&
                    slowUnion(all[i], all[k], motion, options, scale).first > 0)
                    nearest = {distance, {i, k}};
            }
        }
        if (nearest.first >= 1e9) break;
        Detection& a = all[nearest.second.first];
        Detection& b = all[nearest.second.second];
        const OrientedBox both = slowUnion(a, b, motion, options, scale).second;
        a.velocity = (a.velocity * a.box.area() + b.velocity * b.box.area()) / (a.box.area() + b.box.area());
        a.box = both;
        a.score = std::max(a.score, b.score);
        a.complete = a.complete && b.complete;
        b.rejection = Rejection::duplicate;
    }
    return all;
}

double strength(const Detection& a, const Detection& b, const DuplicateRemovalOptions& options) {
    if (std::abs(turnBetween(a.box.heading, b.box.heading)) * 180 / CV_PI > options.max_turn_deg) return 0;
    if (options.compare_speed && !alike(a.velocity, b.velocity, options.velocity_floor, options.velocity_share))
        return 0;
    const double shared = intersectionArea(a.box, b.box);
    if (options.measure == DuplicateMeasure::containment) return shared / std::min(a.box.area(), b.box.area());
    return shared / (a.box.area() + b.box.area() - shared);
}

std::vector<Detection> slowDuplicates(std::vector<Detection> all, const FrameMotion& motion,
                                      const DuplicateRemovalOptions& options, const SceneScale& scale) {
    all = slowJoin(all, motion, options.parts, scale);
    for (Detection& detection : all) {
        if (kept(detection)) slowSupport(detection, motion, 1, options.compare_speed);
    }
    // The surest that is left gives up its like, as long as there is one.
    std::vector<bool> judged(all.size(), false);
    for (;;) {
        int surest = -1;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool takes_part =
                kept(all[i]) && !judged[i] && (all[i].complete || options.strategy == DuplicateStrategy::suppress);
            if (takes_part && (surest < 0 || all[i].score > all[std::size_t(surest)].score)) surest = int(i);
        }
        if (surest < 0) break;
        judged[std::size_t(surest)] = true;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Detection& sure = all[std::size_t(surest)];
            if (kept(all[i]) && !judged[i] && all[i].complete == sure.complete &&
                strength(sure, all[i], options) >= options.threshold &&
                (all[i].complete || options.strategy == DuplicateStrategy::suppress))
                all[i].rejection = Rejection::duplicate;
        }
    }
    for (;;) {
        std::pair<double, std::pair<std::size_t, std::size_t>> strongest(options.threshold - 1e-12, {0, 0});
        for (std::size_t i = 0; i < all.size(); ++i) {
            for (std::size_t k = i + 1; k < all.size(); ++k) {
                if (kept(all[i]) && kept(all[k]) && strength(all[i], all[k], options) > strongest.first)
                    strongest = {strength(all[i], all[k], options), {i, k}};
            }
        }
        if (strongest.second.second == 0) break;
        Detection* a = &all[strongest.second.first];
        Detection* b = &all[strongest.second.second];
        const bool swapped = a->complete != b->complete ? b->complete : b->box.area() > a->box.area();
        if (swapped) std::swap(a, b);
        b->rejection = Rejection::duplicate;
        if (a->complete != b->complete) continue;
        const OrientedBox both = unionBox(a->box, b->box);
        if (options.growth_limit > 0 && both.area() > options.growth_limit * a->box.area()) continue;
        a->box = both;
        a->score = std::max(a->score, b->score);
        slowSupport(*a, motion, 1, options.compare_speed);
    }
    return all;
}

std::vector<Detection> slowOutliers(std::vector<Detection> all, const FrameMotion& motion,
                                    const OutlierRemovalOptions& options, const SceneScale& scale) {
    const double car = 4.5 * 1.8 / (scale.gsd_m_per_px * scale.gsd_m_per_px);
    const double density = motion.corner_count / 60000.0;
    const double needed =
        std::max(double(options.min_vectors),
                 std::min(std::round(options.min_density_share * density * car), double(options.max_min_vectors)));
    for (Detection& detection : all) {
        if (!kept(detection)) continue;
        slowSupport(detection, motion, options.vector_margin, options.compare_velocity);
        const double area = std::min(std::max(detection.box.area(), car / 2), 2 * car);
        if (detection.score <= 0) detection.score = double(detection.vectors.size()) / std::max(1.0, density * area);
        const OrientedBox upright = detection.box.upright();
        const bool outside =
            upright.centre.x - upright.length / 2 < -0.501 || upright.centre.x + upright.length / 2 > 299.501 ||
            upright.centre.y - upright.width / 2 < -0.501 || upright.centre.y + upright.width / 2 > 199.501;
        const auto beyond = [&](double metres, double size) {
            return metres > 0 && size > metres / scale.gsd_m_per_px;
        };
        if (double(detection.vectors.size()) < needed)
            detection.rejection = Rejection::outlier;
        else if (detection.box.area() < options.min_area || (options.inside_image && outside) ||
                 detection.box.length < options.min_length_m / scale.gsd_m_per_px ||
                 beyond(options.max_length_m, detection.box.length) || beyond(options.max_width_m, detection.box.width))
            detection.rejection = Rejection::size;
    }
    return all;
}

int expectSame(const std::vector<Detection>& found, const std::vector<Detection>& slow, const std::string& where) {
    int rejected = 0;
    EXPECT_EQ(found.size(), slow.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].rejection, slow[i].rejection) << where << " " << i;
        EXPECT_EQ(found[i].complete, slow[i].complete) << where << " " << i;
        EXPECT_LT(cv::norm(found[i].box.centre - slow[i].box.centre), 1e-6) << where << " " << i;
        EXPECT_NEAR(found[i].box.length, slow[i].box.length, 1e-6) << where << " " << i;
        EXPECT_NEAR(found[i].box.width, slow[i].box.width, 1e-6) << where << " " << i;
        EXPECT_NEAR(found[i].box.heading, slow[i].box.heading, 1e-9) << where << " " << i;
        EXPECT_LT(cv::norm(found[i].velocity - slow[i].velocity), 1e-9) << where << " " << i;
        EXPECT_NEAR(found[i].score, slow[i].score, 1e-9) << where << " " << i;
        if (kept(slow[i])) {
            EXPECT_EQ(found[i].vectors, slow[i].vectors) << where << " " << i;
        }
        rejected += !kept(found[i]);
    }
    return rejected;
}

}  // namespace

TEST(SlowRemoval, PartsAreJoinedFromTheNearestPairOn) {
    int joined = 0;
    for (unsigned seed = 1; seed <= 150; ++seed) {
        const Frames frames(seed);
        PartJoiningOptions options;
        options.join_parts = seed % 20 != 0;
        options.part_silhouette_gap_m = seed % 5 == 0 ? 0 : seed % 5 == 1 ? 2 : 1;
        options.part_max_turn_deg = 10 + seed % 3 * 5;
        options.part_velocity_share = 0.1;
        options.part_silhouette_length_m = seed % 4 == 0 ? 7 : 18;
        const SceneScale scale{seed % 2 == 0 ? 0.3 : 0.5, 25, true};
        RemovalTrace trace;
        const auto found = joinParts(frames.detections, frames.motion, options, scale, &trace);
        expectSame(found, slowJoin(frames.detections, frames.motion, options, scale), std::to_string(seed));
        joined += int(trace.duplicates.size());
        for (const RemovedDuplicate& one : trace.duplicates) {
            EXPECT_EQ(found[std::size_t(one.removed)].rejection, Rejection::duplicate);
            EXPECT_LE(one.value, one.limit);
        }
    }
    EXPECT_GT(joined, 60);
}

TEST(SlowRemoval, TwoInOnePlaceHaveNoSilhouetteBetweenThem) {
    // Half a pixel apart, both complete, and vectors of a silhouette all over them.
    Detection detection;
    detection.box = {{50, 50}, 12, 6, 0};
    detection.velocity = {1, 0};
    detection.complete = true;
    FrameMotion motion;
    for (int x = 40; x <= 60; ++x)
        motion.motion_vectors.push_back({kFirstOfSilhouettes + CornerId(x), cv::Point2f(float(x), 50), {1, 0}, 0});
    for (const double apart : {0.5, 1.5}) {
        Detection other = detection;
        other.box.centre.x += apart;
        const auto found = joinParts({detection, other}, motion, {}, {0.3, 25, true});
        EXPECT_EQ(found[1].rejection == Rejection::duplicate, apart > 1);
    }
}

TEST(SlowRemoval, DuplicatesAreSuppressedByScoreAndFusedByStrength) {
    int rejected = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        const Frames frames(seed);
        DuplicateRemovalOptions options;
        options.strategy = seed % 3 == 0 ? DuplicateStrategy::suppress : DuplicateStrategy::fuse;
        options.measure = seed % 2 == 0 ? DuplicateMeasure::containment : DuplicateMeasure::overlap;
        options.threshold = seed % 2 == 0 ? 0.5 : 0.25;
        options.compare_speed = seed % 4 != 0;
        options.max_turn_deg = 10 + 10 * (seed % 3);
        options.growth_limit = seed % 5 == 0 ? 0 : 1.2;
        options.parts.join_parts = seed % 2 == 0;
        const SceneScale scale{0.4, 25, true};
        RemovalTrace trace;
        const auto found = removeDuplicates(frames.detections, frames.motion, options, scale, &trace);
        rejected +=
            expectSame(found, slowDuplicates(frames.detections, frames.motion, options, scale), std::to_string(seed));
        for (const RemovedDuplicate& one : trace.duplicates) {
            EXPECT_EQ(found[std::size_t(one.removed)].rejection, Rejection::duplicate);
            if (one.parameter == "duplicates.threshold") {
                EXPECT_GE(one.value, options.threshold);
            }
        }
    }
    EXPECT_GT(rejected, 200);
}

TEST(SlowRemoval, OutliersBreakALimit) {
    int rejected = 0, all = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        const Frames frames(seed);
        OutlierRemovalOptions options;
        options.min_vectors = int(seed % 4);
        options.min_density_share = 0.1 * (seed % 5);
        options.max_min_vectors = 4 + int(seed % 3) * 4;
        options.vector_margin = 0.4 * (seed % 3) + 0.1;
        options.compare_velocity = seed % 3 != 0;
        options.min_area = seed % 2 == 0 ? 40 : 10;
        options.min_length_m = 1.2 + 0.5 * (seed % 3);
        options.max_length_m = seed % 4 == 0 ? 0 : 4;
        options.max_width_m = seed % 5 == 0 ? 0 : 2;
        options.inside_image = seed % 2 == 0;
        const SceneScale scale{0.3, 25, true};
        const auto found = removeOutliers(frames.detections, frames.motion, options, scale);
        rejected +=
            expectSame(found, slowOutliers(frames.detections, frames.motion, options, scale), std::to_string(seed));
        all += int(found.size());
    }
    EXPECT_GT(rejected, 200);
    EXPECT_LT(rejected, all - 200);
}

}  // namespace eyrie::slow_removal_test
