// Motion vectors of corners and their noise, against slow ways that follow the words of the descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <set>

#include "motion/moving_corners.h"
#include "motion/vectors/independent_motion.h"
#include "motion/vectors/vector_groups.h"

namespace eyrie::slow_vectors_test {
namespace {

using test::MovingCorners;
using test::MovingPatch;

double upperMedian(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// The motion of corners, each looked up by its id in every picture that is remembered.
class SlowMotion {
 public:
    CornerVerdicts verdicts;  ///< of the last frame

    SlowMotion(const IndependentMotionOptions& options, const SceneScale& scale) : options_(options), scale_(scale) {
        options_.baseline = std::max(options_.baseline, options_.min_age);
    }

    FrameMotion next(const RegisteredFrame& registered, cv::Size size, const cv::Matx33d& camera) {
        const RegistrationState state = registered.registration.state;
        FrameMotion motion;
        verdicts.clear();
        if (state == RegistrationState::first) pictures_.clear();
        if (state == RegistrationState::frozen) return last_;
        for (Picture& picture : pictures_) ++picture.frames_ago;
        if (state != RegistrationState::failed) {
            Picture picture{camera, 0, {}};
            for (const Corner& corner : registered.corners) picture.corners[corner.id] = corner;
            pictures_.insert(pictures_.begin(), picture);
            if (state != RegistrationState::first) sort(registered, size, motion);
        }
        last_ = motion;
        return motion;
    }

 private:
    struct Picture {
        cv::Matx33d camera;
        int frames_ago;
        std::map<CornerId, Corner> corners;
    };
    struct Measured {
        int baseline = 0;
        cv::Point2d velocity{0, 0};
    };

    /// How many pictures back a corner is known without a gap since it was new.
    int steps(const Corner& corner) const {
        const int deepest =
            std::max({options_.baseline, options_.min_age, options_.find_slow ? options_.slow_baseline : 0});
        int steps = 0;
        while (steps < deepest && steps + 1 < int(pictures_.size()) &&
               pictures_[std::size_t(steps)].corners.at(corner.id).age > 0 &&
               pictures_[std::size_t(steps) + 1].corners.count(corner.id) > 0)
            ++steps;
        return steps;
    }
    cv::Point2d then(CornerId id, int back) const {
        const Picture& picture = pictures_[std::size_t(back)];
        return MovingCorners::mapped(pictures_[0].camera * picture.camera.inv(), picture.corners.at(id).current);
    }
    Measured measure(const Corner& corner, int longest) const {
        for (int back = std::min(steps(corner), longest); back > 0; --back) {
            const int frames = pictures_[std::size_t(back)].frames_ago;
            if (frames > longest) continue;
            if (frames < options_.min_age) return {};
            return {frames, (cv::Point2d(corner.current) - then(corner.id, back)) / frames};
        }
        return {};
    }
    /// Carried on to the present where the two halves of the way differ across it.
    cv::Point2d present(const Corner& corner, cv::Point2d mean, double sigma) const {
        const int half = options_.baseline / 2;
        if (!options_.follow_turns || half < 3 || steps(corner) < 2 * half) return mean;
        const int recent = pictures_[std::size_t(half)].frames_ago, whole = pictures_[std::size_t(2 * half)].frames_ago;
        if (whole != 2 * recent || whole > options_.baseline) return mean;
        const cv::Point2d middle = then(corner.id, half);
        const cv::Point2d change =
            (cv::Point2d(corner.current) - middle) / recent - (middle - then(corner.id, 2 * half)) / recent;
        const double speed = cv::norm(mean);
        const cv::Point2d across(-mean.y / speed, mean.x / speed);
        const double bend = change.dot(across);
        const double certain = std::max(0.2 * speed, 7 * sigma);
        return mean + std::min(1.0, std::max(0.0, 2 * std::abs(bend) / certain - 1)) * bend * across;
    }
    /// By the measurement that came nearest to its limit.
    template <class Sigma>
    CornerVerdict verdictOn(const Corner& corner, const Measured& fast, const Measured& slow,
                            const Sigma& sigma) const {
        CornerVerdict verdict;
        verdict.id = corner.id;
        verdict.position = corner.current;
        verdict.age = corner.age;
        verdict.on_background = corner.on_background;
        double nearest = -1;
        const auto look = [&](const Measured& m, double metres, const char* name) {
            const double lowest = std::max(scale_.pxPerFrame(metres), options_.min_speed_px);
            const double noise = options_.sigma_factor * sigma(m.baseline);
            if (m.baseline == 0 || cv::norm(m.velocity) / std::max(lowest, noise) <= nearest) return;
            nearest = cv::norm(m.velocity) / std::max(lowest, noise);
            verdict.baseline = m.baseline;
            verdict.speed = cv::norm(m.velocity);
            verdict.limit = std::max(lowest, noise);
            verdict.parameter = noise >= lowest                  ? "motion.sigma_factor"
                                : lowest > options_.min_speed_px ? name
                                                                 : "motion.min_speed_px";
        };
        look(fast, options_.min_speed_m_s, "motion.min_speed");
        if (options_.find_slow) look(slow, options_.slow_min_speed_m_s, "motion.slow_min_speed");
        verdict.fate = CornerFate::slow;
        const double most = scale_.gsd_known ? scale_.pxPerFrame(options_.max_speed_m_s) : 0;
        if (corner.age < options_.min_age || fast.baseline == 0) {
            verdict.fate = CornerFate::young;
            verdict.parameter = "motion.min_age";
        } else if (most > 0 && verdict.speed > most) {
            verdict.fate = CornerFate::too_fast;
            verdict.parameter = "motion.max_speed";
            verdict.limit = most;
        }
        return verdict;
    }
    void sort(const RegisteredFrame& registered, cv::Size size, FrameMotion& motion) {
        std::map<CornerId, Measured> fast, slow;
        int background = 0;
        for (const Corner& corner : registered.corners) {
            fast[corner.id] = measure(corner, options_.baseline);
            if (options_.find_slow && steps(corner) >= options_.slow_min_age)
                slow[corner.id] = measure(corner, options_.slow_baseline);
            background += corner.on_background;
        }
        if (options_.local_background.local_background) {
            const double cell = std::max(24.0, options_.local_background.local_background_cell_m / scale_.gsd_m_per_px);
            const auto cellOf = [&](cv::Point2f p) {
                const auto inside = [&](float at, int length) {
                    return std::clamp(int(double(at) / cell), 0, std::max(1, int(std::ceil(length / cell))) - 1);
                };
                return std::pair(inside(p.y, size.height), inside(p.x, size.width));
            };
            std::map<std::pair<int, int>, std::pair<std::vector<double>, std::vector<double>>> cells;
            for (const Corner& corner : registered.corners) {
                if (!corner.on_background || fast[corner.id].baseline == 0) continue;
                cells[cellOf(corner.current)].first.push_back(fast[corner.id].velocity.x);
                cells[cellOf(corner.current)].second.push_back(fast[corner.id].velocity.y);
            }
            for (const Corner& corner : registered.corners) {
                const auto& [x, y] = cells[cellOf(corner.current)];
                if (int(x.size()) < options_.local_background.local_background_min_corners) continue;
                fast[corner.id].velocity -= cv::Point2d(upperMedian(x), upperMedian(y));
                slow[corner.id].velocity -= cv::Point2d(upperMedian(x), upperMedian(y));
            }
        }
        std::map<int, std::vector<double>> speeds;
        std::vector<double> displacements;
        for (const Corner& corner : registered.corners) {
            if (4 * background >= int(registered.corners.size()) && !corner.on_background) continue;
            const auto add = [&](const Measured& m) {
                speeds[m.baseline].push_back(cv::norm(m.velocity));
                displacements.push_back(cv::norm(m.velocity) * m.baseline);
            };
            if (fast[corner.id].baseline > 0) add(fast[corner.id]);
            if (slow[corner.id].baseline > fast[corner.id].baseline) add(slow[corner.id]);
        }
        const auto sigmaOf = [&](int baseline) {
            if (displacements.empty() || baseline == 0) return 0.0;
            if (speeds[baseline].size() >= 60) return upperMedian(speeds[baseline]) / 1.17741;
            return upperMedian(displacements) / 1.17741 / baseline;
        };
        std::map<int, double> sigmas;  // each is asked for by every corner
        const auto sigma = [&](int baseline) {
            if (sigmas.count(baseline) == 0) sigmas[baseline] = sigmaOf(baseline);
            return sigmas[baseline];
        };
        motion.background_speed_sigma = sigma(std::max(options_.baseline, options_.min_age));
        // Of the whole picture's noise, what the corners in the cells around show.
        const double cell = options_.noise_cell * size.width;
        const auto cellOf = [&](cv::Point2f place) {
            const auto inside = [&](float at, int length) {
                return std::clamp(int(double(at) / cell), 0, int(std::ceil(length / cell)) - 1);
            };
            return std::pair(inside(place.y, size.height), inside(place.x, size.width));
        };
        std::map<std::pair<int, int>, std::vector<double>> shares;
        for (const Corner& corner : registered.corners) {
            const Measured& m = fast[corner.id];
            const bool counts = 4 * background < int(registered.corners.size()) || corner.on_background;
            if (cell > 0 && counts && m.baseline > 0 && sigma(m.baseline) > 0)
                shares[cellOf(corner.current)].push_back(cv::norm(m.velocity) / 1.17741 / sigma(m.baseline));
        }
        std::map<std::pair<int, int>, double> noises;
        const auto noiseHere = [&](cv::Point2f place) {
            if (cell == 0) return 1.0;
            const auto here = cellOf(place);
            if (noises.count(here) > 0) return noises[here];
            std::vector<double> around;
            for (const auto& [there, some] : shares) {
                if (std::abs(there.first - here.first) <= 1 && std::abs(there.second - here.second) <= 1)
                    around.insert(around.end(), some.begin(), some.end());
            }
            const double share = around.size() < 60 ? 1 : upperMedian(around);
            return noises[here] = share > 0.8 ? 1 : std::max(share, 0.3);
        };
        for (const Corner& corner : registered.corners) {
            const double noise_here = noiseHere(corner.current);
            const auto sigmaHere = [&](int baseline) { return noise_here * sigma(baseline); };
            const auto moves = [&](const Measured& m, double min_speed_m_s) {
                const double speed = cv::norm(m.velocity);
                if (m.baseline == 0 || corner.age < options_.min_age) return false;
                if (scale_.gsd_known && options_.max_speed_m_s > 0 && speed > scale_.pxPerFrame(options_.max_speed_m_s))
                    return false;
                return speed >= std::max({scale_.pxPerFrame(min_speed_m_s), options_.min_speed_px,
                                          options_.sigma_factor * sigmaHere(m.baseline)});
            };
            const Measured* found = moves(fast[corner.id], options_.min_speed_m_s) ? &fast[corner.id]
                                    : options_.find_slow && moves(slow[corner.id], options_.slow_min_speed_m_s)
                                        ? &slow[corner.id]
                                        : nullptr;
            verdicts.push_back(verdictOn(corner, fast[corner.id], slow[corner.id], sigmaHere));
            if (found != nullptr) {
                verdicts.back().fate = CornerFate::moving;
                verdicts.back().parameter.clear();
            }
            if (found != nullptr) {
                const cv::Point2d velocity = present(corner, found->velocity, motion.background_speed_sigma);
                motion.motion_vectors.push_back({corner.id, corner.current, velocity, corner.age});
            } else if (corner.on_background && fast[corner.id].baseline > 0) {
                motion.stationary_corners.push_back(corner.current);
            }
        }
    }

    IndependentMotionOptions options_;
    SceneScale scale_;
    std::vector<Picture> pictures_;  ///< newest first
    FrameMotion last_;
};

IndependentMotionOptions onlyCorners() {
    IndependentMotionOptions options;
    options.shadow.shadow_test = options.silhouettes.silhouettes = options.areas.areas =
        options.parallax.parallax_test = false;
    return options;
}

}  // namespace

TEST(SlowVectors, CornersMoveByWhatEveryPictureSaysOfThem) {
    std::size_t vectors = 0, standing = 0;
    for (int variant = 0; variant < 13; ++variant) {
        IndependentMotionOptions options = onlyCorners();
        options.baseline = variant == 1 ? 5 : variant == 2 ? 9 : variant == 3 ? 3 : 12;
        options.min_age = variant == 4 ? 8 : 5;
        options.sigma_factor = variant == 5 ? 0 : variant == 6 ? 9 : 4;
        options.noise_cell = variant % 3 == 1 ? 0 : variant % 3 == 2 ? 0.25 : 0.0625;
        options.find_slow = variant % 3 == 0;
        options.follow_turns = variant != 7;
        options.local_background.local_background = variant % 4 == 2 || variant == 12;
        options.local_background.local_background_min_corners = variant == 2 ? 12 : 30;
        if (variant == 12) options.local_background.local_background_cell_m = 100;
        options.max_speed_m_s = variant == 8 ? 12 : variant == 9 ? 0 : 70;
        options.min_speed_px = variant == 10 ? 0.3 : 0.05;
        const SceneScale scale{variant == 11 ? 0.8 : 0.3, 25, variant != 6};
        // Straight, turning, slow, creeping, and much too fast.
        MovingCorners scene({{{200, 150}, {1.5, 0.4}, 20, 10, 24, 0.05},
                             {{400, 250}, {-0.8, 0.9}, 22, 9, 20, -0.11},
                             {{300, 350}, {0.14, 0.02}},
                             {{500, 100}, {0.09, -0.04}},
                             {{100, 300}, {11, 2}}},
                            0.08, unsigned(variant + 1), variant == 5 ? 40 : 300);
        IndependentMotion motion(options, scale);
        SlowMotion slow(options, scale);
        std::mt19937 random(unsigned(variant) + 5);
        std::map<CornerId, int> born;
        int index = 0;
        RegisteredFrame registered;
        for (int t = 0; t < 30; ++t) {
            const int what = t > 8 ? int(random() % 12) : 2;
            RegisteredFrame seen;
            if (what == 0 && variant % 2 == 0) {  // a repeated picture
                seen = registered;
                seen.registration.state = RegistrationState::frozen;
                seen.registration.current_from_previous.matrix = cv::Matx33d::eye();
            } else {
                seen = scene.next();
                if (what == 1) {
                    seen.registration.state = RegistrationState::failed;
                    seen.corners.clear();
                } else {
                    // Some corners get lost, and found as new ones under the same number.
                    std::erase_if(seen.corners, [&](const Corner&) { return random() % 40 == 0; });
                    for (Corner& corner : seen.corners) {
                        if (born.count(corner.id) == 0 || random() % 60 == 0) born[corner.id] = t;
                        corner.age = t - born[corner.id];
                        if (variant == 9 && corner.id % 5 > 0) corner.on_background = false;
                        // A slope, from which the ground is not followed quite.
                        if (variant == 12) corner.current.x += 0.06F * static_cast<float>(t);
                    }
                    registered = seen;
                }
            }
            seen.frame = index;
            seen.registration.current_from_previous.from_frame = std::max(0, index - 1);
            seen.registration.current_from_previous.to_frame = index;
            if (index == 0) seen.registration.state = RegistrationState::first;
            static int time = 0;
            if (index == 0) time = 0;
            CornerVerdicts verdicts;
            const FrameMotion found = motion.next(seen, test::flatFrame(index), &verdicts);
            const bool repeated = seen.registration.state == RegistrationState::frozen;
            const FrameMotion expected = slow.next(seen, {640, 480}, MovingCorners::camera(repeated ? time - 1 : time));
            if (!repeated) ++time;
            ++index;
            EXPECT_NEAR(found.background_speed_sigma, expected.background_speed_sigma, 1e-6) << variant << " " << t;
            ASSERT_EQ(found.motion_vectors.size(), expected.motion_vectors.size()) << variant << " " << t;
            for (std::size_t i = 0; i < found.motion_vectors.size(); ++i) {
                const MotionVector& a = found.motion_vectors[i];
                const MotionVector& b = expected.motion_vectors[i];
                ASSERT_EQ(a.id, b.id) << variant << " " << t;
                EXPECT_EQ(a.position, b.position);
                EXPECT_LT(cv::norm(a.velocity - b.velocity), 2e-5) << variant << " " << t;
                EXPECT_EQ(a.age, b.age);
            }
            ASSERT_EQ(found.stationary_corners, expected.stationary_corners) << variant << " " << t;
            ASSERT_EQ(verdicts.size(), slow.verdicts.size()) << variant << " " << t;
            for (std::size_t i = 0; i < verdicts.size(); ++i) {
                const CornerVerdict& a = verdicts[i];
                const CornerVerdict& b = slow.verdicts[i];
                ASSERT_EQ(a.id, b.id);
                EXPECT_EQ(a.position, b.position);
                EXPECT_EQ(a.age, b.age);
                EXPECT_EQ(a.on_background, b.on_background);
                EXPECT_EQ(a.fate, b.fate) << variant << " " << t;
                EXPECT_EQ(a.parameter, b.parameter) << variant << " " << t;
                EXPECT_EQ(a.baseline, b.baseline) << variant << " " << t;
                EXPECT_NEAR(a.speed, b.speed, 1e-5);
                EXPECT_NEAR(a.limit, b.limit, 1e-5);
            }
            vectors += found.motion_vectors.size();
            standing += found.stationary_corners.size();
        }
    }
    EXPECT_GT(vectors, 3000U);
    EXPECT_GT(standing, 20000U);
}

TEST(SlowVectors, NoiseIsRayleighsMedianByBaseline) {
    std::mt19937 random(4);
    for (const std::size_t few : {59U, 60U}) {
        BackgroundNoise noise(6);
        std::map<int, std::vector<double>> speeds;
        std::vector<double> displacements;
        const auto add = [&](int baseline, std::size_t count) {
            for (std::size_t i = 0; i < count; ++i) {
                const double speed = double(random() % 1000) / 1000;
                noise.add(baseline, speed);
                speeds[baseline].push_back(speed);
                displacements.push_back(speed * baseline);
            }
        };
        EXPECT_EQ(noise.sigma(3), 0);
        add(2, 200);
        add(5, few);
        add(6, 3);
        noise.finish();
        const double pooled = upperMedian(displacements) / 1.17741;
        EXPECT_NEAR(noise.sigma(2), upperMedian(speeds[2]) / 1.17741, 1e-6);
        EXPECT_NEAR(noise.sigma(5), few < 60 ? pooled / 5 : upperMedian(speeds[5]) / 1.17741, 1e-6);
        EXPECT_NEAR(noise.sigma(6), pooled / 6, 1e-6);
        EXPECT_NEAR(noise.sigma(1), pooled, 1e-6);
        EXPECT_EQ(noise.sigma(99), noise.sigma(6)) << "the longest there is";
        EXPECT_EQ(noise.sigma(-1), noise.sigma(0));
        EXPECT_EQ(noise.sigma(0), 0);
    }
}

TEST(SlowVectors, VehiclesAreLinkedByTheirSizeAndGroupedWithTheirMeans) {
    const Linkage linkage = vehicleLinkage({0.25, 25, true}, 0.05, 0.1);
    EXPECT_DOUBLE_EQ(linkage.along, 14);
    EXPECT_DOUBLE_EQ(linkage.across, 4);
    EXPECT_DOUBLE_EQ(linkage.velocity_floor, 0.05);
    EXPECT_DOUBLE_EQ(linkage.velocity_share, 0.1);
    EXPECT_DOUBLE_EQ(vehicleLinkage({1, 25, true}, 0.01, 0).velocity_floor, 0.03);
    EXPECT_DOUBLE_EQ(vehicleLinkage({1, 25, true}, 0.2, 0).velocity_floor, 0.06);
    EXPECT_DOUBLE_EQ(vehicleLinkage({1, 25, true}, 0.2, 0).along, 4);
    EXPECT_DOUBLE_EQ(vehicleLinkage({0.125, 25, true}, 0.2, 0).across, 8);
    const std::vector<MotionVector> vectors{{0, {10, 10}, {1, 0}, 9},         {1, {90, 10}, {1, 0}, 9},
                                            {2, {14, 12}, {1.02F, 0.02F}, 9}, {3, {16, 10}, {1, 0}, 9},
                                            {4, {94, 11}, {1, 0}, 9},         {5, {12, 11}, {1, 0}, 9}};
    const auto groups = groupVectors(vectors, {0, 1, 2, 4, 5}, linkage);
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(groups[0].members, (std::vector<int>{0, 2, 5}));
    EXPECT_EQ(groups[1].members, (std::vector<int>{1, 4}));
    EXPECT_NEAR(groups[0].velocity.x, 3.02 / 3, 1e-6);
    EXPECT_NEAR(groups[0].velocity.y, 0.02 / 3, 1e-6);
    EXPECT_NEAR(groups[1].box.length, 4, 1e-6);
    EXPECT_NEAR(groups[1].box.width, 1, 1e-6);
    EXPECT_NEAR(groups[0].box.heading, std::atan2(0.02, 3.02), 1e-6);
    EXPECT_EQ(groupVectors(vectors, {3}, linkage).size(), 1U) << "one alone, and no group of none";
    EXPECT_TRUE(groupVectors(vectors, {}, linkage).empty());
}

}  // namespace eyrie::slow_vectors_test
