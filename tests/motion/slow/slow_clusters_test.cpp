// Clustering against slow ones that compare everything with everything, by the words of the descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <tuple>

#include "core/geometry/oriented_box.h"
#include "motion/clusters/linkage_gaps.h"
#include "motion/clusters/motion_clustering.h"
#include "motion/clusters/neighbour_grid.h"
#include "motion/clusters/single_linkage.h"
#include "motion/differences/roof_bridge.h"

namespace eyrie::slow_clusters_test {
namespace {

using Groups = std::vector<std::vector<int>>;

/// A few vehicles whose vectors scatter, some of them one behind the other, and strays.
std::vector<MotionVector> traffic(unsigned seed, int vehicles, int vectors_each, double scatter = 0.04) {
    std::mt19937 random(seed);
    const auto some = [&](double most) { return most * (double(random() % 20001) / 10000 - 1); };
    std::vector<MotionVector> result;
    const auto add = [&](cv::Point2d at, cv::Point2d velocity) {
        result.push_back({CornerId(result.size()), cv::Point2f(at), cv::Point2f(velocity), 9});
    };
    for (int k = 0; k < vehicles; ++k) {
        const double heading = k % 3 == 0 ? 0 : some(3.1);
        const cv::Point2d along(std::cos(heading), std::sin(heading)), across(-along.y, along.x);
        const cv::Point2d centre(100 + some(90), 80 + some(70));
        const cv::Point2d velocity = along * (0.6 + 0.5 * (k % 4));
        // Every third has a neighbour in the next lane, another one close behind.
        const cv::Point2d beside = centre + (k % 3 == 1 ? across * 9.5 : along * 21);
        for (int i = 0; k % 3 != 0 && i < vectors_each; ++i)
            add(beside + along * some(9) + across * some(4), velocity + cv::Point2d(some(scatter), some(scatter)));
        for (int i = 0; i < vectors_each; ++i)
            add(centre + along * some(9) + across * some(4), velocity + cv::Point2d(some(scatter), some(scatter)));
    }
    for (int i = 0; i < 10; ++i) add({100 + some(95), 80 + some(75)}, {some(2), some(2)});
    add({50, 50}, {0, 0});
    add({52, 51}, {0, 0});
    add({52, 55.5}, {0, 0});
    std::shuffle(result.begin(), result.end(), random);
    return result;
}

/// Whether b lies in the ellipse about a, and moves alike.
bool slowlyJoined(const MotionVector& a, const MotionVector& b, const Linkage& linkage) {
    const cv::Point2d apart = cv::Point2d(b.position) - cv::Point2d(a.position);
    const cv::Point2d mean = 0.5 * (cv::Point2d(a.velocity) + cv::Point2d(b.velocity));
    const double speed = cv::norm(mean);
    if (cv::norm(cv::Point2d(b.velocity) - cv::Point2d(a.velocity)) >
        std::max(linkage.velocity_floor, linkage.velocity_share * speed))
        return false;
    if (speed == 0) return cv::norm(apart) <= std::min(linkage.along, linkage.across);
    const double heading = std::atan2(mean.y, mean.x);
    const double ahead = apart.x * std::cos(heading) + apart.y * std::sin(heading);
    const double aside = apart.y * std::cos(heading) - apart.x * std::sin(heading);
    return std::hypot(ahead / linkage.along, aside / linkage.across) <= 1;
}

/// Connected parts, members ascending, in the order of their first members.
template <class Joined>
Groups components(int count, const Joined& joined) {
    Groups groups;
    std::vector<bool> seen(std::size_t(count), false);
    for (int i = 0; i < count; ++i) {
        if (seen[std::size_t(i)]) continue;
        std::vector<int> group{i};
        seen[std::size_t(i)] = true;
        for (std::size_t k = 0; k < group.size(); ++k) {
            for (int j = 0; j < count; ++j) {
                if (seen[std::size_t(j)] || !joined(group[k], j)) continue;
                seen[std::size_t(j)] = true;
                group.push_back(j);
            }
        }
        std::sort(group.begin(), group.end());
        groups.push_back(group);
    }
    return groups;
}

Groups groupsOf(const std::vector<int>& numbers) {
    Groups groups(numbers.empty() ? 0 : std::size_t(*std::max_element(numbers.begin(), numbers.end())) + 1);
    for (std::size_t i = 0; i < numbers.size(); ++i) groups[std::size_t(numbers[i])].push_back(int(i));
    return groups;
}

Groups slowLinkage(const std::vector<MotionVector>& vectors, const Linkage& linkage) {
    return components(int(vectors.size()), [&](int a, int b) {
        return slowlyJoined(vectors[std::size_t(a)], vectors[std::size_t(b)], linkage);
    });
}

const Linkage kLinkages[] = {{10, 5, 0.04, 0.05}, {5, 10, 0.04, 0.05}, {6, 6, 0.1, 0}, {14, 3, 0, 0.12}};

}  // namespace

TEST(SlowClusters, LinkageJoinsWhatLiesInTheEllipseAndMovesAlike) {
    int joined = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const auto vectors = traffic(seed, 6, 7);
        for (const Linkage& linkage : kLinkages) {
            for (const MotionVector& a : vectors) {
                for (const MotionVector& b : vectors) {
                    ASSERT_EQ(linkage.joins(a, b), slowlyJoined(a, b, linkage));
                    joined += linkage.joins(a, b);
                }
            }
            EXPECT_EQ(groupsOf(singleLinkage(vectors, linkage)), slowLinkage(vectors, linkage));
        }
    }
    EXPECT_GT(joined, 1000);
}

TEST(SlowClusters, WhatIsNoNumberStandsAlone) {
    auto vectors = traffic(5, 4, 8);
    const float nothing = std::numeric_limits<float>::quiet_NaN(), far = std::numeric_limits<float>::infinity();
    const Groups before = slowLinkage(vectors, kLinkages[0]);
    const std::size_t count = vectors.size();
    for (const float bad : {nothing, far, -far}) {
        vectors.push_back({1, {bad, 50}, {1, 0}, 9});
        vectors.push_back({1, {50, bad}, {1, 0}, 9});
        vectors.push_back({1, {50, 50}, {bad, 0}, 9});
        vectors.push_back({1, {50, 50}, {1, bad}, 9});
    }
    Groups expected = before;
    for (std::size_t i = count; i < vectors.size(); ++i) expected.push_back({int(i)});
    EXPECT_EQ(groupsOf(singleLinkage(vectors, kLinkages[0])), expected);
    const auto positions = positionsOf(vectors);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        EXPECT_EQ(std::isfinite(positions[i].x) && std::isfinite(positions[i].y), i < count);
        if (i < count) {
            EXPECT_EQ(positions[i], vectors[i].position);
        }
    }
}

TEST(SlowClusters, AGridShowsAllWithinReachOnce) {
    std::mt19937 random(3);
    for (const cv::Point2f spread :
         {cv::Point2f(100, 60), cv::Point2f(3, 200), cv::Point2f(1e7F, 5e6F), cv::Point2f(0, 0)}) {
        std::vector<cv::Point2f> points;
        for (int i = 0; i < 300; ++i)
            points.emplace_back(spread.x * float(random() % 1000) / 1000 - 20,
                                spread.y * float(random() % 1000) / 1000 + 7);
        points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 3.0F);
        points.emplace_back(3.0F, std::numeric_limits<float>::infinity());
        for (const double reach : {0.5, 4.0, 11.0}) {
            const NeighbourGrid grid(points, reach);
            std::vector<cv::Point2f> places(points.begin(), points.end() - 2);
            // Beside the points, too, near and far.
            for (const cv::Point2f beside : {cv::Point2f(-23, 5), cv::Point2f(spread.x - 18, spread.y + 10),
                                             cv::Point2f(-1e6F, 0), cv::Point2f(0, 3e8F), cv::Point2f(4, 4)})
                places.push_back(beside);
            std::size_t looked = 0;
            for (const cv::Point2f& place : places) {
                std::vector<std::size_t> shown;
                grid.around(place, [&](std::size_t i) { shown.push_back(i); });
                const std::set<std::size_t> each(shown.begin(), shown.end());
                ASSERT_EQ(each.size(), shown.size());
                looked += shown.size();
                for (std::size_t i = 0; i + 2 < points.size(); ++i) {
                    if (cv::norm(cv::Point2d(points[i]) - cv::Point2d(place)) < reach) {
                        ASSERT_TRUE(each.count(i) > 0) << spread << reach;
                    }
                }
                ASSERT_EQ(each.count(points.size() - 1) + each.count(points.size() - 2), 0U);
                // None that is farther than two cells in either direction, while cells are as small as they should be.
                if (spread.x > 1e5F || std::count(points.begin(), points.end(), place) == 0) continue;
                for (const std::size_t i : each) {
                    ASSERT_LT(std::abs(double(points[i].x) - double(place.x)), 2 * reach + 1e-3);
                    ASSERT_LT(std::abs(double(points[i].y) - double(place.y)), 2 * reach + 1e-3);
                }
            }
            if (spread.x > 1e5F) {
                EXPECT_LT(looked, places.size() * 20) << "no more than a few for a million cells";
            }
        }
    }
    int seen = 0;
    NeighbourGrid({}, 3).around({1, 2}, [&](std::size_t) { ++seen; });
    EXPECT_EQ(seen, 0);
}

namespace {

LinkageGap slowGap(const MotionVector& a, const MotionVector& b, const Linkage& linkage) {
    const cv::Point2d apart = cv::Point2d(b.position) - cv::Point2d(a.position);
    const cv::Point2d mean = 0.5 * (cv::Point2d(a.velocity) + cv::Point2d(b.velocity));
    LinkageGap gap;
    const double speed = cv::norm(mean);
    const double heading = speed > 0 ? std::atan2(mean.y, mean.x) : std::atan2(apart.y, apart.x);
    gap.ahead = std::abs(apart.x * std::cos(heading) + apart.y * std::sin(heading));
    gap.aside = std::abs(apart.y * std::cos(heading) - apart.x * std::sin(heading));
    gap.difference = cv::norm(cv::Point2d(b.velocity) - cv::Point2d(a.velocity));
    gap.allowed = std::max(linkage.velocity_floor, linkage.velocity_share * speed);
    gap.distance = std::hypot(gap.ahead / linkage.along, gap.aside / linkage.across);
    gap.joined = slowlyJoined(a, b, linkage);
    return gap;
}

void expectSame(const LinkageGap& found, const LinkageGap& slow) {
    EXPECT_EQ(found.other, slow.other);
    EXPECT_NEAR(found.ahead, slow.ahead, 1e-6);
    EXPECT_NEAR(found.aside, slow.aside, 1e-6);
    EXPECT_NEAR(found.difference, slow.difference, 1e-9);
    EXPECT_NEAR(found.allowed, slow.allowed, 1e-9);
    EXPECT_NEAR(found.distance, slow.distance, 1e-6);
    EXPECT_EQ(found.joined, slow.joined);
}

}  // namespace

TEST(SlowClusters, GapsAreTheSmallestOutsideAndTheLargestThatHoldsInside) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const auto vectors = traffic(seed, 5, 6, seed == 2 ? 0.12 : 0.04);
        for (const Linkage& linkage : kLinkages) {
            const auto between = [&](int a, int b) {
                return slowGap(vectors[std::size_t(a)], vectors[std::size_t(b)], linkage);
            };
            for (int b = 1; b < 12; ++b)
                expectSame(gapBetween(vectors[0], vectors[std::size_t(b)], linkage), between(0, b));
            for (const auto& group : slowLinkage(vectors, linkage)) {
                LinkageGap outside;
                double cheapest = 1e300;
                for (const int member : group) {
                    for (int other = 0; other < int(vectors.size()); ++other) {
                        if (std::count(group.begin(), group.end(), other) > 0) continue;
                        LinkageGap gap = between(member, other);
                        gap.other = other;
                        const double cost = std::max(gap.distance, gap.difference / std::max(gap.allowed, 1e-9));
                        if (cost >= cheapest) continue;
                        cheapest = cost;
                        outside = gap;
                    }
                }
                expectSame(smallestGapOutside(vectors, group, linkage), outside);
                // Links in the order of their distances; the last that still joins two parts.
                std::vector<std::tuple<double, int, int>> links;
                for (const int a : group) {
                    for (const int b : group) {
                        const LinkageGap gap = between(a, b);
                        if (a < b && gap.difference <= gap.allowed) links.emplace_back(gap.distance, a, b);
                    }
                }
                std::sort(links.begin(), links.end());
                double last = 0;
                std::map<int, int> part;
                for (const int member : group) part[member] = member;
                for (const auto& [distance, a, b] : links) {
                    const int from = part[b], to = part[a];
                    if (from == to) continue;
                    last = distance;
                    for (auto& [member, its] : part) its = its == from ? to : its;
                }
                const LinkageGap inside = largestGapInside(vectors, group, linkage);
                EXPECT_NEAR(inside.distance, last, 1e-6);
                EXPECT_EQ(inside.other >= 0, group.size() > 1);
                EXPECT_LE(inside.distance, 1 + 1e-6) << "linkage holds all of it";
            }
        }
    }
    // Two that do not move alike hold nothing together.
    const std::vector<MotionVector> apart{{1, {0, 0}, {1, 0}, 9}, {2, {3, 0}, {1, 0}, 9}, {3, {4, 0}, {0, 2}, 9}};
    EXPECT_NEAR(largestGapInside(apart, {0, 1, 2}, kLinkages[0]).distance, 0.3, 1e-9);
    EXPECT_EQ(largestGapInside(apart, {0, 2}, kLinkages[0]).other, -1);
    EXPECT_EQ(largestGapInside(apart, {1}, kLinkages[0]).other, -1);
    EXPECT_EQ(smallestGapOutside(apart, {0, 1, 2}, kLinkages[0]).other, -1);
}

TEST(SlowClusters, RoofsJoinWhereNoCornerOfTheRoadIsSeen) {
    int joins = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        FrameMotion motion;
        motion.motion_vectors = traffic(seed, 12, 5, 0.02);
        std::mt19937 random(seed);
        for (unsigned i = 0; i < 40 + 60 * seed; ++i)
            motion.stationary_corners.emplace_back(float(random() % 2000) / 10, float(random() % 1600) / 10);
        const Linkage& linkage = kLinkages[seed % 2 == 0 ? 0 : 3];
        for (const RoofBridge& bridge : {RoofBridge{20, 2}, RoofBridge{26, 1}, RoofBridge{16, 3.5}}) {
            const auto& vectors = motion.motion_vectors;
            const Groups linked = slowLinkage(vectors, linkage);
            Linkage longer{bridge.length, linkage.across, linkage.velocity_floor / 2, linkage.velocity_share / 2};
            const auto hidden = [&](cv::Point2d from, cv::Point2d to) {
                const double length = cv::norm(to - from);
                if (length <= 3) return false;
                const cv::Point2d along = (to - from) / length, middle = 0.5 * (from + to);
                int around = 0;
                for (const cv::Point2f& corner : motion.stationary_corners) {
                    const cv::Point2d place(corner);
                    const double ahead = (place - from).dot(along);
                    if (ahead > 1.5 && ahead < length - 1.5 &&
                        std::abs((place - from).cross(along)) < bridge.half_width)
                        return false;
                    around += cv::norm(place - middle) <= bridge.length;
                }
                // Of those around, that many would lie in the strip.
                return around / (CV_PI * bridge.length * bridge.length) * (length - 3) * 2 * bridge.half_width >= 0.4;
            };
            const Groups expected = components(int(vectors.size()), [&](int a, int b) {
                for (const auto& group : linked) {
                    if (std::count(group.begin(), group.end(), a) > 0 && std::count(group.begin(), group.end(), b) > 0)
                        return true;
                }
                const MotionVector& u = vectors[std::size_t(a)];
                const MotionVector& v = vectors[std::size_t(b)];
                return slowlyJoined(u, v, longer) && hidden(u.position, v.position);
            });
            EXPECT_EQ(groupsOf(joinAcrossRoofs(motion, linkage, bridge, singleLinkage(vectors, linkage))), expected)
                << seed;
            joins += int(linked.size() - expected.size());
        }
    }
    EXPECT_GT(joins, 10);
}

namespace {

/// Clustering once more: link, bridge roofs, refuse, split.
struct SlowClustering {
    const MotionClusteringOptions& options;
    const SceneScale& scale;
    const FrameMotion& motion;

    Linkage linkage() const {
        const double noise =
            std::min(options.velocity_noise_factor * motion.background_speed_sigma, options.velocity_noise_limit);
        const auto reach = [&](double metres) { return std::max(metres / scale.gsd_m_per_px, options.min_distance); };
        return {reach(options.along_m), reach(options.across_m), std::max(options.velocity_floor, noise),
                options.velocity_share};
    }
    std::size_t needed() const {
        // What a car of 4.5 × 1.8 m carries at the mean density.
        const double on_car =
            motion.corner_count * 8.1 / (scale.gsd_m_per_px * scale.gsd_m_per_px) / motion.image_size.area();
        const int wanted =
            int(std::min(std::round(options.min_density_share * on_car), double(options.max_min_members)));
        return std::size_t(std::max(options.min_members, wanted));
    }
    MotionCluster summary(const std::vector<int>& members) const {
        MotionCluster cluster;
        std::vector<cv::Point2f> positions;
        for (const int member : members) {
            positions.push_back(motion.motion_vectors[std::size_t(member)].position);
            cluster.velocity +=
                cv::Point2d(motion.motion_vectors[std::size_t(member)].velocity) / double(members.size());
        }
        cluster.box = boxAround(positions, std::atan2(cluster.velocity.y, cluster.velocity.x));
        cluster.box.length += 2 * options.margin;
        cluster.box.width += 2 * options.margin;
        cluster.members = members;
        return cluster;
    }
    Groups split(const std::vector<int>& whole, Linkage tighter, int steps) const {
        const MotionCluster cluster = summary(whole);
        const auto beyond = [&](double metres, double size) {
            return metres > 0 && size > metres / scale.gsd_m_per_px + 2;
        };
        const bool wide = beyond(options.split_width_m, cluster.box.width);
        const bool high = beyond(options.split_length_m, cluster.box.length);
        if (steps == 0 || (!wide && !high) || whole.size() < 2 * needed()) return {whole};
        if (wide) tighter.across *= 0.75;
        if (high) tighter.along *= 0.75;
        tighter.velocity_floor *= 0.75;
        tighter.velocity_share *= 0.75;
        Groups pieces;
        std::size_t held = 0;
        for (auto& part : components(int(whole.size()), [&](int a, int b) {
                 const auto at = [&](int i) { return motion.motion_vectors[std::size_t(whole[std::size_t(i)])]; };
                 return slowlyJoined(at(a), at(b), tighter);
             })) {
            if (part.size() < needed()) continue;
            for (int& member : part) member = whole[std::size_t(member)];
            held += part.size();
            pieces.push_back(part);
        }
        if (pieces.size() < 2 || 4 * held < 3 * whole.size()) return split(whole, tighter, steps - 1);
        Groups result;
        for (const auto& piece : pieces) {
            for (const auto& part : split(piece, tighter, steps - 1)) result.push_back(part);
        }
        return result;
    }
    std::vector<MotionCluster> clusters() const {
        const Linkage all = linkage();
        Groups groups = slowLinkage(motion.motion_vectors, all);
        if (options.roof_length_m / scale.gsd_m_per_px > all.along) {
            groups = groupsOf(joinAcrossRoofs(
                motion, all, {options.roof_length_m / scale.gsd_m_per_px, std::max(1.0, 0.6 / scale.gsd_m_per_px)},
                singleLinkage(motion.motion_vectors, all)));
        }
        std::vector<MotionCluster> result;
        for (const auto& group : groups) {
            if (group.size() < needed()) continue;
            const MotionCluster whole = summary(group);
            const auto beyond = [&](double metres, double size) {
                return metres > 0 && size > metres / scale.gsd_m_per_px;
            };
            if (beyond(options.max_length_m, whole.box.length) || beyond(options.max_width_m, whole.box.width))
                continue;
            for (const auto& piece : split(group, all, 4)) result.push_back(summary(piece));
        }
        return result;
    }
};

}  // namespace

TEST(SlowClusters, ClustersAreLinkedRefusedAndSplitByTheirLimits) {
    std::size_t all = 0, large = 0, split = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        for (int variant = 0; variant < 8; ++variant) {
            FrameMotion motion;
            motion.motion_vectors = traffic(seed, 7, 14, variant % 2 == 0 ? 0.03 : 0.1);
            motion.image_size = {200, 160};
            motion.corner_count = 300 * (variant % 5);
            motion.background_speed_sigma = 0.02 * (variant % 4);
            std::mt19937 random(seed);
            for (int i = 0; i < 250; ++i)
                motion.stationary_corners.emplace_back(float(random() % 2000) / 10, float(random() % 1600) / 10);
            MotionClusteringOptions options;
            options.split_width_m = variant % 3 == 0 ? 1.2 : variant % 3 == 1 ? 2.2 : 0;
            options.split_length_m = variant % 4 == 1 ? 2.5 : variant % 4 == 2 ? 4 : 0;
            options.max_length_m = variant < 4 ? 9 : 0;
            options.max_width_m = variant < 2 ? 2.5 : variant < 6 ? 5 : 0;
            options.roof_length_m = variant % 2 == 0 ? 6 : 0;
            options.min_members = 2 + variant % 2;
            options.velocity_share = 0.1;
            options.margin = 0.5 + 0.25 * variant;
            const SceneScale scale{variant < 5 ? 0.3 : 0.5, 25, true};
            const MotionClustering clustering(options, scale);
            const SlowClustering slow{options, scale, motion};
            const Linkage linkage = clustering.linkageFor(motion.background_speed_sigma);
            EXPECT_NEAR(linkage.along, slow.linkage().along, 1e-9);
            EXPECT_NEAR(linkage.across, slow.linkage().across, 1e-9);
            EXPECT_NEAR(linkage.velocity_floor, slow.linkage().velocity_floor, 1e-12);
            EXPECT_EQ(std::size_t(clustering.minMembersFor(motion)), slow.needed());
            ClusteringTrace trace;
            const auto found = clustering.cluster(motion, &trace);
            const auto expected = slow.clusters();
            ASSERT_EQ(found.size(), expected.size()) << seed << " " << variant;
            for (std::size_t i = 0; i < found.size(); ++i) {
                EXPECT_EQ(found[i].members, expected[i].members) << seed << " " << variant;
                EXPECT_LT(cv::norm(found[i].velocity - expected[i].velocity), 1e-9);
                EXPECT_LT(cv::norm(found[i].box.centre - expected[i].box.centre), 1e-6);
                EXPECT_NEAR(found[i].box.length, expected[i].box.length, 1e-6);
                EXPECT_NEAR(found[i].box.width, expected[i].box.width, 1e-6);
                EXPECT_NEAR(found[i].box.heading, expected[i].box.heading, 1e-9);
                large += found[i].members.size() > 14;
            }
            all += found.size();
            // Everything is in one group of the trace, with what was compared.
            std::vector<int> told;
            for (const TracedGroup& group : trace.groups) {
                split += !group.split_by.empty();
                told.insert(told.end(), group.members.begin(), group.members.end());
                const auto size = double(group.members.size());
                switch (group.refusal) {
                    case ClusterRefusal::none:
                        EXPECT_EQ(found[std::size_t(group.cluster)].members, group.members);
                        [[fallthrough]];
                    case ClusterRefusal::too_few:
                        EXPECT_EQ(group.value, size);
                        EXPECT_EQ(group.limit, double(slow.needed()));
                        EXPECT_EQ(group.parameter, int(slow.needed()) > options.min_members
                                                       ? "clustering.min_density_share"
                                                       : "clustering.min_members");
                        EXPECT_EQ(group.refusal == ClusterRefusal::none, size >= group.limit);
                        break;
                    case ClusterRefusal::too_long:
                        EXPECT_NEAR(group.value, slow.summary(group.members).box.length, 1e-6);
                        EXPECT_NEAR(group.limit, options.max_length_m / scale.gsd_m_per_px, 1e-9);
                        break;
                    case ClusterRefusal::too_wide:
                        EXPECT_NEAR(group.value, slow.summary(group.members).box.width, 1e-6);
                        EXPECT_NEAR(group.limit, options.max_width_m / scale.gsd_m_per_px, 1e-9);
                        break;
                    default:
                        EXPECT_EQ(group.refusal, ClusterRefusal::split_off);
                        EXPECT_LT(size, double(slow.needed()));
                        EXPECT_GT(group.value, group.limit);
                        EXPECT_NEAR(group.limit,
                                    (group.split_by == "clustering.split_width" ? options.split_width_m
                                                                                : options.split_length_m) /
                                            scale.gsd_m_per_px +
                                        2,
                                    1e-9);
                }
            }
            std::sort(told.begin(), told.end());
            ASSERT_EQ(told.size(), motion.motion_vectors.size());
            for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], int(i));
        }
    }
    EXPECT_GT(all, 100U);
    EXPECT_GT(large, 10U);
    EXPECT_GT(split, 20U);
}

}  // namespace eyrie::slow_clusters_test
