// Motion vectors of corners, and what is not counted as one, against slow ways that follow the words of the
// descriptions.
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
        const auto sigma = [&](int baseline) {
            if (displacements.empty() || baseline == 0) return 0.0;
            if (speeds[baseline].size() >= 60) return upperMedian(speeds[baseline]) / 1.17741;
            return upperMedian(displacements) / 1.17741 / baseline;
        };
        motion.background_speed_sigma = sigma(std::max(options_.baseline, options_.min_age));
        for (const Corner& corner : registered.corners) {
            const auto moves = [&](const Measured& m, double min_speed_m_s) {
                const double speed = cv::norm(m.velocity);
                if (m.baseline == 0 || corner.age < options_.min_age) return false;
                if (scale_.gsd_known && options_.max_speed_m_s > 0 && speed > scale_.pxPerFrame(options_.max_speed_m_s))
                    return false;
                return speed >= std::max({scale_.pxPerFrame(min_speed_m_s), options_.min_speed_px,
                                          options_.sigma_factor * sigma(m.baseline)});
            };
            const Measured* found = moves(fast[corner.id], options_.min_speed_m_s) ? &fast[corner.id]
                                    : options_.find_slow && moves(slow[corner.id], options_.slow_min_speed_m_s)
                                        ? &slow[corner.id]
                                        : nullptr;
            verdicts.push_back(verdictOn(corner, fast[corner.id], slow[corner.id], sigma));
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
    for (int variant = 0; variant < 12; ++variant) {
        IndependentMotionOptions options = onlyCorners();
        options.baseline = variant == 1 ? 5 : variant == 2 ? 9 : variant == 3 ? 3 : 12;
        options.min_age = variant == 4 ? 8 : 5;
        options.sigma_factor = variant == 5 ? 0 : variant == 6 ? 9 : 4;
        options.find_slow = variant % 3 == 0;
        options.follow_turns = variant != 7;
        options.local_background.local_background = variant % 4 == 2;
        options.local_background.local_background_min_corners = variant == 2 ? 12 : 30;
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

TEST(SlowVectors, ParallaxPointsAlongTheLinesOfMostPairs) {
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

TEST(SlowVectors, ShadowsAreToldByTheGroundAroundThem) {
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

TEST(SlowVectors, ShadowsAreCastByWhatMovesLikeThemBesideThem) {
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
