// Stacks against slow ones that look through everything for each vector, by the words of the descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

#include "core/geometry/angle.h"
#include "core/values/inferred_ids.h"
#include "imaging/upright_patch.h"
#include "stacking/image_stacker.h"

namespace eyrie::slow_stacking_test {
namespace {

double lower(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[(values.size() - 1) / 2];
}

/// The median of the turns away from the mean direction.
double middleHeading(const std::vector<double>& headings) {
    double x = 0, y = 0;
    for (const double heading : headings) {
        x += std::cos(heading);
        y += std::sin(heading);
    }
    std::vector<double> turns;
    for (const double heading : headings) turns.push_back(std::remainder(heading - std::atan2(y, x), 2 * CV_PI));
    return std::remainder(std::atan2(y, x) + lower(turns), 2 * CV_PI);
}

/// Objects that drive and turn, with corners that come and go.
struct Drive {
    struct Object {
        cv::Point2d start, velocity;
        double turn;
    };
    std::vector<Object> objects;
    std::mt19937 random;
    CornerId next_id = 1;
    /// By object: corners with their places on it.
    std::vector<std::map<CornerId, cv::Point2d>> corners;

    explicit Drive(unsigned seed) : random(seed) {
        for (int k = 0; k < 5; ++k)
            objects.push_back({{60.0 + 90 * k, 120 + some(30)}, {1.2 + some(0.4), some(0.4)}, some(0.03)});
        // Two that drive side by side and are seen as one at times.
        objects.push_back({objects[0].start + cv::Point2d(0, 14), objects[0].velocity, objects[0].turn});
        corners.resize(objects.size());
    }
    double some(double most) { return most * (double(random() % 20001) / 10000 - 1); }

    struct Seen {
        FrameMotion motion;
        std::vector<MotionCluster> clusters;
        std::vector<Detection> detections;
    };
    Seen at(int t) {
        Seen seen;
        seen.motion.image_size = {640, 300};
        seen.motion.registration.state = RegistrationState::registered;
        std::vector<std::vector<int>> members(objects.size());
        for (std::size_t k = 0; k < objects.size(); ++k) {
            std::erase_if(corners[k], [&](const auto&) { return random() % 9 == 0; });
            while (corners[k].size() < 6 && random() % 3 > 0) corners[k][next_id++] = {some(8), some(4)};
            const double heading = std::atan2(objects[k].velocity.y, objects[k].velocity.x) + objects[k].turn * t;
            const cv::Point2d along(std::cos(heading), std::sin(heading)), across(-along.y, along.x);
            for (const auto& [id, on] : corners[k]) {
                const cv::Point2d place = objects[k].start + objects[k].velocity * t + on.x * along + on.y * across;
                const cv::Point2d off(some(0.1), some(0.1));
                members[k].push_back(int(seen.motion.motion_vectors.size()));
                const bool inferred = random() % 12 == 0;
                seen.motion.motion_vectors.push_back({inferred ? kFirstOfSilhouettes + id : id, place + off,
                                                      along * cv::norm(objects[k].velocity) + off, inferred ? 0 : 9});
            }
        }
        // Clusters: mostly one for each object; the pair is one cluster in every other frame.
        if (t % 2 == 0) {
            members[0].insert(members[0].end(), members.back().begin(), members.back().end());
            members.back().clear();
        }
        for (std::size_t k = 0; k < objects.size(); ++k) {
            if (random() % 10 == 0) members[k].clear();
            if (members[k].empty()) continue;
            MotionCluster cluster;
            cluster.members = members[k];
            std::vector<cv::Point2d> places;
            for (const int member : members[k]) {
                cluster.velocity +=
                    cv::Point2d(seen.motion.motion_vectors[std::size_t(member)].velocity) / double(members[k].size());
                places.emplace_back(seen.motion.motion_vectors[std::size_t(member)].position);
            }
            cluster.box = boxAround(places, std::atan2(cluster.velocity.y, cluster.velocity.x));
            cluster.box.length += 3;
            cluster.box.width += 3;
            seen.clusters.push_back(cluster);
            // Detections: some miss, some split what the cluster holds, some hold no vector.
            if (random() % 4 == 0) continue;
            Detection detection;
            detection.vectors = members[k];
            Detection second = detection;
            if (random() % 3 == 0) {
                second.vectors.assign(members[k].begin() + std::ptrdiff_t(members[k].size() / 2), members[k].end());
                detection.vectors.resize(members[k].size() / 2);
                if (random() % 4 == 0) second.rejection = Rejection::outlier;
                seen.detections.push_back(second);
            }
            seen.detections.push_back(detection);
        }
        return seen;
    }
};

/// The book-keeping of §5.3.1 and §5.3.2 with maps of everything.
class SlowStacks {
 public:
    struct Related {
        cv::Point2d offset;  ///< from the vector to the master, along and across the vector's direction
        double turn;
    };
    struct Stack {
        int id;
        MasterPose pose;
        std::map<CornerId, Related> related;
        int height = 0;
    };
    explicit SlowStacks(const StackingOptions& options) : options_(options) {}
    std::vector<Stack> stacks;

    void update(const Drive::Seen& seen) {
        vectors_.clear();
        for (const MotionCluster& cluster : seen.clusters) {
            for (const int member : cluster.members) {
                const MotionVector& vector = seen.motion.motion_vectors[std::size_t(member)];
                if (vector.age > 0) vectors_[vector.id] = {vector, cluster.box.heading};
            }
        }
        for (Stack& stack : stacks) move(stack);
        std::erase_if(owner_, [](const auto& one) { return one.second == 0; });
        std::erase_if(stacks, [](const Stack& stack) { return stack.related.empty(); });
        join(seen);
        for (const auto& ids : remembered_) begin(ids);
        std::erase_if(stacks, [](const Stack& stack) { return stack.related.empty(); });
        for (Stack& stack : stacks) stack.height = std::min(stack.height + 1, options_.capacity);
        remembered_.clear();
    }
    void remember(const Drive::Seen& seen) {
        remembered_.clear();
        for (const Detection& detection : seen.detections) {
            std::vector<CornerId> ids;
            for (const int index : detection.vectors) {
                const MotionVector& vector = seen.motion.motion_vectors[std::size_t(index)];
                if (vector.age > 0) ids.push_back(vector.id);
            }
            if (detection.rejection == Rejection::none && !ids.empty()) remembered_.push_back(ids);
        }
    }

 private:
    struct Placed {
        MotionVector vector;
        double direction;
    };
    static cv::Point2d turned(cv::Point2d p, double angle) {
        return {p.x * std::cos(angle) - p.y * std::sin(angle), p.x * std::sin(angle) + p.y * std::cos(angle)};
    }
    void relate(Stack& stack, const Placed& placed) {
        stack.related[placed.vector.id] = {
            turned(stack.pose.position - cv::Point2d(placed.vector.position), -placed.direction),
            std::remainder(stack.pose.heading - placed.direction, 2 * CV_PI)};
        owner_[placed.vector.id] = stack.id;
    }
    void move(Stack& stack) {
        std::vector<double> x, y, headings, vx, vy;
        std::erase_if(stack.related, [&](const auto& one) {
            // Missing, or taken by another stack.
            const bool own = owner_.at(one.first) == stack.id;
            const bool gone = !own || vectors_.count(one.first) == 0;
            if (gone && own) owner_.at(one.first) = 0;
            return gone;
        });
        for (const auto& [id, related] : stack.related) {
            const Placed& placed = vectors_.at(id);
            const cv::Point2d place = cv::Point2d(placed.vector.position) + turned(related.offset, placed.direction);
            x.push_back(place.x);
            y.push_back(place.y);
            headings.push_back(placed.direction + related.turn);
            vx.push_back(double(placed.vector.velocity.x));
            vy.push_back(double(placed.vector.velocity.y));
        }
        if (!x.empty()) stack.pose = {{lower(x), lower(y)}, middleHeading(headings), {lower(vx), lower(vy)}};
    }
    /// Each new vector joins the stack of most of its nearest neighbours in the cluster; in a tie that of the nearest,
    /// else the first by number.
    void join(const Drive::Seen& seen) {
        std::vector<std::pair<CornerId, int>> joins;
        for (const MotionCluster& cluster : seen.clusters) {
            for (const int member : cluster.members) {
                const MotionVector& newcomer = seen.motion.motion_vectors[std::size_t(member)];
                if (newcomer.age == 0 || owner_.count(newcomer.id) > 0) continue;
                std::vector<std::pair<double, int>> voters;
                for (const int other : cluster.members) {
                    const MotionVector& neighbour = seen.motion.motion_vectors[std::size_t(other)];
                    if (neighbour.age == 0 || owner_.count(neighbour.id) == 0) continue;
                    const cv::Point2f apart = neighbour.position - newcomer.position;
                    voters.emplace_back(double(apart.x) * double(apart.x) + double(apart.y) * double(apart.y),
                                        owner_.at(neighbour.id));
                }
                if (voters.empty()) continue;
                std::sort(voters.begin(), voters.end());
                voters.resize(std::min(voters.size(), std::size_t(options_.neighbours)));
                std::map<int, int> votes;
                int most = 0;
                for (const auto& [distance, stack] : voters) most = std::max(most, ++votes[stack]);
                int winner = voters[0].second;
                for (auto at = votes.rbegin(); at != votes.rend(); ++at) {
                    if (votes[voters[0].second] < most && at->second == most) winner = at->first;
                }
                joins.emplace_back(newcomer.id, winner);
            }
        }
        for (const auto& [id, number] : joins) {
            for (Stack& stack : stacks) {
                if (stack.id == number) relate(stack, vectors_.at(id));
            }
            owner_[id] = number;
        }
    }
    void begin(const std::vector<CornerId>& ids) {
        std::vector<CornerId> present, free;
        std::map<int, int> owners;
        for (const CornerId id : ids) {
            if (vectors_.count(id) == 0) continue;
            present.push_back(id);
            if (owner_.count(id) > 0)
                ++owners[owner_.at(id)];
            else
                free.push_back(id);
        }
        // Of a stack that owns half of it, in the order of stacks.
        for (const Stack& stack : stacks) {
            if (owners.count(stack.id) == 0 || 2 * owners[stack.id] < int(present.size())) continue;
            // Where most of that stack's vectors lie elsewhere, two shared it, and this one gets its own.
            if (2 * owners[stack.id] >= int(stack.related.size())) return;
            for (const CornerId id : present) {
                if (owner_.count(id) > 0) free.push_back(id);
            }
            break;
        }
        if (free.empty()) return;
        std::vector<double> x, y, headings, vx, vy;
        for (const CornerId id : free) {
            const Placed& placed = vectors_.at(id);
            x.push_back(double(placed.vector.position.x));
            y.push_back(double(placed.vector.position.y));
            headings.push_back(placed.direction);
            vx.push_back(double(placed.vector.velocity.x));
            vy.push_back(double(placed.vector.velocity.y));
        }
        stacks.push_back({next_id_++, {{lower(x), lower(y)}, middleHeading(headings), {lower(vx), lower(vy)}}, {}, 0});
        for (const CornerId id : free) relate(stacks.back(), vectors_.at(id));
    }

    StackingOptions options_;
    std::map<CornerId, Placed> vectors_;
    std::map<CornerId, int> owner_;
    std::vector<std::vector<CornerId>> remembered_;
    int next_id_ = 1;
};

}  // namespace

TEST(SlowStacking, MastersAndTheirVectorsAreThoseOfTheBook) {
    std::size_t stacks = 0, rois = 0, refused = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
        StackingOptions options = StackingOptions::thesis();
        options.follow_lone_vectors = false;  // clusters fail at random here, to lose vectors
        options.neighbours = 1 + int(seed % 4);
        options.capacity = seed % 2 == 0 ? 50 : 7;
        options.min_height = 4 + int(seed % 3);
        options.area_length_m = 40;
        options.area_width_m = 18;
        options.max_speed_difference = 0.04 + 0.04 * (seed % 3);
        options.max_turn_deg = 2 + 2 * (seed % 4);
        const SceneScale scale{0.3, 25, true};
        ImageStacker stacker(options, scale);
        SlowStacks slow(options);
        Drive drive(seed);
        Frame frame;
        frame.gray = cv::Mat(300, 640, CV_8UC1);
        cv::randu(frame.gray, 0, 255);
        for (int t = 0; t < 30; ++t) {
            frame.index = t;
            const Drive::Seen seen = drive.at(t);
            stacker.update(frame, seen.motion, seen.clusters);
            slow.update(seen);
            const auto views = stacker.views(frame, StackPictures::none);
            ASSERT_EQ(views.size(), slow.stacks.size()) << seed << " " << t;
            for (std::size_t i = 0; i < views.size(); ++i) {
                const SlowStacks::Stack& stack = slow.stacks[i];
                EXPECT_EQ(views[i].id, stack.id);
                EXPECT_EQ(views[i].height, stack.height);
                std::vector<CornerId> related;
                for (const auto& [id, unused] : stack.related) related.push_back(id);
                ASSERT_EQ(views[i].related, related) << seed << " " << t;
                EXPECT_LT(cv::norm(views[i].pose.position - stack.pose.position), 1e-6);
                EXPECT_LT(cv::norm(views[i].pose.velocity - stack.pose.velocity), 1e-6);
                EXPECT_NEAR(std::remainder(views[i].pose.heading - stack.pose.heading, 2 * CV_PI), 0, 1e-9);
            }
            stacks += views.size();
            // Stacks stand in where they move like the cluster, are high enough and reach as far.
            for (std::size_t c = 0; c < seen.clusters.size(); ++c) {
                const MotionCluster& cluster = seen.clusters[c];
                const OrientedBox extended = cluster.box.scaled(1.3 + 0.25 * (t % 8), 1.5 + 0.25 * (t % 5));
                std::vector<const SlowStacks::Stack*> fit;
                const cv::Size area(cvRound(18 / 0.3), cvRound(40 / 0.3));
                for (const SlowStacks::Stack& stack : slow.stacks) {
                    const double speed = cv::norm(cluster.velocity);
                    if (std::abs(cv::norm(stack.pose.velocity) - speed) > options.max_speed_difference * speed)
                        continue;
                    const double turn = std::remainder(stack.pose.heading - cluster.box.heading, 2 * CV_PI);
                    if (std::abs(turn) * 180 / CV_PI > options.max_turn_deg) continue;
                    if (stack.height < options.min_height || !cluster.box.contains(stack.pose.position)) continue;
                    const OrientedBox whole{stack.pose.position, double(area.height), double(area.width),
                                            stack.pose.heading};
                    const cv::Matx23d map = imageFromPatch(whole, area);
                    bool inside = true;
                    for (const cv::Point2d& corner : extended.corners()) {
                        const cv::Point2d p = toPatch(map, corner);
                        // With the pixel after the last one that is touched.
                        inside = inside && std::floor(p.x) >= 0 && std::floor(p.y) >= 0 &&
                                 std::ceil(p.x) + 1 <= area.width && std::ceil(p.y) + 1 <= area.height;
                    }
                    if (inside) fit.push_back(&stack);
                    refused += !inside;
                }
                const auto found = stacker.replace(cluster, int(c), extended, seen.motion);
                ASSERT_EQ(found.size(), fit.size()) << seed << " " << t;
                rois += found.size();
                for (std::size_t i = 0; i < found.size(); ++i) {
                    EXPECT_EQ(found[i].stack_layers, fit[i]->height);
                    EXPECT_EQ(found[i].cluster, int(c));
                    EXPECT_EQ(found[i].velocity, cluster.velocity);
                    EXPECT_EQ(found[i].inside.size(), found[i].image.size());
                    ASSERT_EQ(found[i].vectors.size(), cluster.members.size());
                    // Its vectors lie where they are in the image.
                    for (std::size_t v = 0; v < found[i].vectors.size(); ++v) {
                        const cv::Point2d there = toImage(found[i].image_from_roi, found[i].vectors[v]);
                        const MotionVector& vector = seen.motion.motion_vectors[std::size_t(cluster.members[v])];
                        EXPECT_LT(cv::norm(there - cv::Point2d(vector.position)), 1e-3);
                    }
                    // The picture ends with the pixels that the corners touch.
                    double right = 0, bottom = 0, left = 1e9, top = 1e9;
                    for (const cv::Point2d& corner : extended.corners()) {
                        const cv::Point2d p = toPatch(found[i].image_from_roi, corner);
                        right = std::max(right, p.x);
                        bottom = std::max(bottom, p.y);
                        left = std::min(left, p.x);
                        top = std::min(top, p.y);
                    }
                    EXPECT_EQ(found[i].image.cols, int(std::ceil(right - 1e-7)) + 1);
                    EXPECT_EQ(found[i].image.rows, int(std::ceil(bottom - 1e-7)) + 1);
                    EXPECT_TRUE(left > -1e-6 && left < 1 && top > -1e-6 && top < 1) << left << " " << top;
                }
            }
            stacker.remember(seen.motion, seen.detections);
            slow.remember(seen);
        }
    }
    EXPECT_GT(stacks, 1000U);
    EXPECT_GT(rois, 100U);
    EXPECT_GT(refused, 20U);
}

TEST(SlowStacking, TheMiddleHeadingIsTheMedianAboutTheMeanDirection) {
    std::mt19937 random(4);
    for (int trial = 0; trial < 500; ++trial) {
        // Up to a right angle about any direction, beyond ±180° too.
        const double about = double(random() % 6283) / 1000 - CV_PI;
        std::vector<double> headings;
        for (unsigned i = 0; i < 1 + random() % 6; ++i)
            headings.push_back(std::remainder(about + double(random() % 3000) / 1000 - 1.5, 2 * CV_PI));
        EXPECT_NEAR(std::remainder(medianHeading(headings) - middleHeading(headings), 2 * CV_PI), 0, 1e-9) << trial;
        EXPECT_LE(std::abs(medianHeading(headings)), CV_PI + 1e-9);
        EXPECT_EQ(lowerMedian(headings), lower(headings));
    }
}

}  // namespace eyrie::slow_stacking_test
