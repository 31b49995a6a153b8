// The homography's estimation against a slow one in double precision that writes its equations down one by one.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <complex>
#include <numeric>
#include <random>
#include <set>

#include "registration/estimation/homography_estimator.h"
#include "registration/estimation/normal_equations.h"
#include "support/textured_ground.h"

namespace eyrie::slow_estimator_test {
namespace {

const cv::Size kPicture(640, 480);
constexpr double kPerPx = 2.0 / 640;

cv::Matx33d one(const cv::Matx33d& m) {
    return m * (1 / m(2, 2));
}

const cv::Matx33d kNormalised{kPerPx, 0, -319.5 * kPerPx, 0, kPerPx, -239.5 * kPerPx, 0, 0, 1};

struct Pair {
    cv::Vec2d from, to;
    double weight;
};

std::vector<Pair> normalised(const Correspondences& points) {
    std::vector<Pair> result;
    for (std::size_t i = 0; i < points.from_x.size(); ++i) {
        const auto place = [&](float x, float y) {
            return cv::Vec2d((double(x) - 319.5) * kPerPx, (double(y) - 239.5) * kPerPx);
        };
        result.push_back({place(points.from_x[i], points.from_y[i]), place(points.to_x[i], points.to_y[i]),
                          double(points.weight[i])});
    }
    return result;
}

cv::Vec2d mapped(const cv::Matx33d& m, cv::Vec2d p) {
    const cv::Vec3d q = m * cv::Vec3d(p[0], p[1], 1);
    return {q[0] / q[2], q[1] / q[2]};
}

double squareOf(const cv::Matx33d& m, const Pair& pair) {
    const cv::Vec2d error = mapped(m, pair.from) - pair.to;
    return error.dot(error);
}

/// From the residual below which 40 % of the weight lies, in bins of 1/16 octave.
double slowSigma(const cv::Matx33d& m, const std::vector<Pair>& pairs) {
    std::vector<std::pair<double, double>> sorted;
    double total = 0;
    for (const Pair& pair : pairs) {
        sorted.emplace_back(squareOf(m, pair), pair.weight);
        total += pair.weight;
    }
    std::sort(sorted.begin(), sorted.end());
    double below = 0;
    for (const auto& [square, weight] : sorted) {
        below += weight;
        if (below < 0.4 * total) continue;
        const auto bits = std::bit_cast<std::uint32_t>(float(square));
        return std::sqrt(double(std::bit_cast<float>((bits >> 19U << 19U) + (1U << 18U)))) / 1.0108;
    }
    return 0;
}

/// A step of Gauss and Newton with Tukey's weights; returns its largest number.
double slowStep(cv::Matx33d& m, const std::vector<Pair>& pairs, double cutoff, double deviation, double projective) {
    cv::Mat_<double> a = cv::Mat_<double>::zeros(8, 8);
    cv::Mat_<double> b = cv::Mat_<double>::zeros(8, 1);
    double total = 0;
    for (const Pair& pair : pairs) {
        const cv::Vec2d image = mapped(m, pair.from);
        const double q = 1 - squareOf(m, pair) / (cutoff * cutoff);
        if (q <= 0) continue;
        const double weight = q * q * pair.weight;
        total += weight;
        const double x = pair.from[0], y = pair.from[1];
        const double w = m(2, 0) * x + m(2, 1) * y + 1;
        for (int axis = 0; axis < 2; ++axis) {
            cv::Mat_<double> j = cv::Mat_<double>::zeros(8, 1);
            j(3 * axis) = x / w;
            j(3 * axis + 1) = y / w;
            j(3 * axis + 2) = 1 / w;
            j(6) = -image[axis] * x / w;
            j(7) = -image[axis] * y / w;
            a += weight * (j * j.t());
            b += weight * (image[axis] - pair.to[axis]) * j;
        }
    }
    const double hold = std::pow(deviation / projective, 2);
    for (int i = 0; i < 2; ++i) {
        a(6 + i, 6 + i) += hold;
        b(6 + i) += hold * m(2, i);
    }
    for (int i = 0; i < 8; ++i) a(i, i) += 1e-9 * total;
    cv::Mat_<double> change;
    cv::solve(a, b, change, cv::DECOMP_CHOLESKY);
    double largest = 0;
    for (int i = 0; i < 8; ++i) {
        m.val[i] -= change(i);
        largest = std::max(largest, std::abs(change(i)));
    }
    return largest;
}

HomographyFit slowFit(const Correspondences& points, const cv::Matx33d& start, double coarse, double first_cutoff,
                      double inlier_distance, double projective) {
    const std::vector<Pair> pairs = normalised(points);
    cv::Matx33d m = one(kNormalised * start * kNormalised.inv());
    double cutoff = first_cutoff * kPerPx;
    for (int step = 0; step < 12; ++step) {
        const double sigma = slowSigma(m, pairs);
        cutoff = std::min(cutoff, std::max(3 * sigma, 0.15 * coarse * kPerPx));
        if (step >= 3) cutoff = std::min(cutoff, 3 * inlier_distance * coarse * kPerPx);
        const double change = slowStep(m, pairs, cutoff, std::max(sigma, 0.02 * kPerPx), projective);
        if (step >= 2 && change < 1e-3 * kPerPx) break;
    }
    HomographyFit fit;
    fit.matrix = one(kNormalised.inv() * m * kNormalised);
    fit.sigma_px = slowSigma(m, pairs) / kPerPx;
    const double most = inlier_distance * coarse;
    fit.inlier_distance_px = std::min(std::max(5 * fit.sigma_px, std::min(0.5 * coarse, most)), most);
    double sum = 0;
    int weighty = 0;
    for (const Pair& pair : pairs) {
        if (pair.weight == 0) continue;
        ++weighty;
        const double square = squareOf(m, pair) / (kPerPx * kPerPx);
        if (square > fit.inlier_distance_px * fit.inlier_distance_px) continue;
        ++fit.inliers;
        sum += square;
    }
    fit.inlier_share = double(fit.inliers) / weighty;
    fit.rms_px = std::sqrt(sum / fit.inliers);
    return fit;
}

cv::Matx33d someMap() {
    cv::Matx33d m = test::cameraMotion(kPicture, 4.3, -2.8, 0.8, 1.006);
    m(2, 0) = 6e-6;
    m(2, 1) = -9e-6;
    return m;
}

/// Points in a part of the picture with random weights, some of them 0; of the rest some are wrong by up to 12 px.
Correspondences some(cv::Rect2d area, int count, double noise, double wrong, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0, noise);
    std::uniform_real_distribution<double> uniform(0, 1);
    Correspondences result;
    for (int i = 0; i < count; ++i) {
        const cv::Vec2d from(area.x + uniform(random) * area.width, area.y + uniform(random) * area.height);
        cv::Vec2d to = mapped(someMap(), from) + cv::Vec2d(normal(random), normal(random));
        if (uniform(random) < wrong) to += cv::Vec2d(24 * uniform(random) - 12, 24 * uniform(random) - 12);
        const double weight = uniform(random);
        result.add({float(from[0]), float(from[1])}, {float(to[0]), float(to[1])}, weight < 0.1 ? 0.0F : float(weight));
    }
    return result;
}

const cv::Rect2d kEverywhere(0, 0, 639, 479);
const cv::Rect2d kPart(400, 30, 180, 240);

}  // namespace

TEST(SlowEstimator, RefinementIsThatOfTheEquations) {
    const struct {
        cv::Rect2d area;
        int count;
        double noise, wrong, coarse, first_cutoff, distance;
    } cases[] = {
        {kEverywhere, 400, 0.1, 0.3, 1, 1e6, 1},   {kEverywhere, 400, 0.4, 0.5, 1, 1e6, 1},
        {kEverywhere, 300, 0.02, 0.2, 1, 1e6, 1},  {kEverywhere, 300, 1.5, 0.2, 1, 1e6, 1},
        {kEverywhere, 200, 0.02, 0.6, 4, 1e6, 1},  {kEverywhere, 120, 0.5, 0.4, 2, 8, 1},
        {kPart, 40, 0.1, 0.1, 1, 1e6, 1},          {kPart, 40, 0.003, 0, 1, 1e6, 1},
        {kPart, 60, 0.6, 0.3, 2, 1.5, 2},          {kPart, 25, 0.15, 0.2, 1, 3, 0.3},
        {kEverywhere, 100, 0.25, 0.2, 1, 2.5, 10}, {kEverywhere, 9, 0.05, 0, 1, 1e6, 1},
    };
    for (std::size_t i = 0; i < std::size(cases); ++i) {
        const auto& c = cases[i];
        for (unsigned seed = 1; seed <= 3; ++seed) {
            const Correspondences points = some(c.area, c.count, c.noise, c.wrong, 10 * seed + unsigned(i));
            HomographyOptions options;
            options.inlier_distance = c.distance;
            const cv::Matx33d start = c.first_cutoff < 1e6 ? someMap() : test::cameraMotion(kPicture, 3, -2, 0.5);
            const HomographyEstimator held(options, kPicture);
            const bool free = (i + seed) % 2 == 0;
            const auto fit = (free ? held.anyPerspective() : held).refine(points, start, c.coarse, c.first_cutoff);
            const HomographyFit slow = slowFit(points, start, c.coarse, c.first_cutoff, c.distance, free ? 0.3 : 0.004);
            ASSERT_TRUE(fit);
            EXPECT_LT(test::gridError(fit->matrix, slow.matrix, kPicture), 2e-3) << i << " " << seed;
            EXPECT_NEAR(fit->sigma_px, slow.sigma_px, 1e-3 * slow.sigma_px) << i << " " << seed;
            EXPECT_NEAR(fit->inlier_distance_px, slow.inlier_distance_px, 1e-3 * slow.inlier_distance_px);
            EXPECT_NEAR(fit->inliers, slow.inliers, 0.5) << i << " " << seed;
            EXPECT_NEAR(fit->inlier_share, slow.inlier_share, 1e-6) << i << " " << seed;
            EXPECT_NEAR(fit->rms_px, slow.rms_px, 1e-3 * slow.rms_px) << i << " " << seed;
        }
    }
}

namespace {

/// The map of a picture to another through two or four pairs, in normalised coordinates.
std::optional<cv::Matx33d> slowlyThrough(const std::vector<Pair>& pairs) {
    if (pairs.size() == 2) {
        const auto complex = [](cv::Vec2d v) { return std::complex<double>(v[0], v[1]); };
        const auto from = complex(pairs[1].from - pairs[0].from);
        const auto s = complex(pairs[1].to - pairs[0].to) / from;
        if (std::abs(from) < 0.1 || std::abs(s) < 0.25 || std::abs(s) > 4) return std::nullopt;
        const auto t = complex(pairs[0].to) - s * complex(pairs[0].from);
        return cv::Matx33d(s.real(), -s.imag(), t.real(), s.imag(), s.real(), t.imag(), 0, 0, 1);
    }
    cv::Mat_<double> a(8, 8), b(8, 1), h;
    for (int k = 0; k < 4; ++k) {
        const auto [from, to, weight] = pairs[std::size_t(k)];
        for (int axis = 0; axis < 2; ++axis) {
            const double row[8] = {axis == 0 ? from[0] : 0, axis == 0 ? from[1] : 0, axis == 0 ? 1.0 : 0.0,
                                   axis == 1 ? from[0] : 0, axis == 1 ? from[1] : 0, axis == 1 ? 1.0 : 0.0,
                                   -to[axis] * from[0],     -to[axis] * from[1]};
            for (int i = 0; i < 8; ++i) a(2 * k + axis, i) = row[i];
            b(2 * k + axis) = to[axis];
        }
    }
    if (!cv::solve(a, b, h, cv::DECOMP_LU) || cv::norm(h, cv::NORM_INF) >= 8 || std::abs(h(6)) + std::abs(h(7)) >= 0.5)
        return std::nullopt;
    return cv::Matx33d(h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), 1);
}

std::pair<double, int> costOf(const cv::Matx33d& m, const std::vector<Pair>& pairs, double tolerance) {
    std::pair<double, int> cost(0, 0);
    for (const Pair& pair : pairs) {
        const double square = squareOf(m, pair);
        cost.first += std::min(square, tolerance * tolerance);
        cost.second += square < tolerance * tolerance;
    }
    return cost;
}

/// MSAC over the same random numbers: samples of `size` of up to 512 points, until a better one is unlikely.
std::optional<cv::Matx33d> slowSearch(const Correspondences& points, std::size_t size, double tolerance_px,
                                      double projective, double rounds) {
    std::mt19937 random(20141);
    const double tolerance = tolerance_px * kPerPx;
    std::vector<Pair> pairs = normalised(points);
    pairs.erase(std::remove_if(pairs.begin(), pairs.end(), [](const Pair& p) { return p.weight == 0; }), pairs.end());
    const std::size_t count = std::min<std::size_t>(512, pairs.size());
    if (count < size) return std::nullopt;
    for (std::size_t i = 0; i < count; ++i) std::swap(pairs[i], pairs[i + random() % (pairs.size() - i)]);
    pairs.resize(count);
    std::optional<cv::Matx33d> best;
    double best_cost = 1e30;
    for (int round = 0; round < rounds; ++round) {
        std::vector<std::size_t> drawn;
        for (std::size_t k = 0; k < size; ++k) drawn.push_back(random() % count);
        if (std::set<std::size_t>(drawn.begin(), drawn.end()).size() < size) continue;
        std::vector<Pair> sample;
        for (const std::size_t at : drawn) sample.push_back(pairs[at]);
        auto m = slowlyThrough(sample);
        if (!m) continue;
        auto cost = costOf(*m, pairs, tolerance);
        if (cost.first >= best_cost) continue;
        if (size == 4) {
            cv::Matx33d improved = *m;
            for (int step = 0; step < 3; ++step) slowStep(improved, pairs, 2 * tolerance, 0.3 * tolerance, projective);
            const auto then = costOf(improved, pairs, tolerance);
            if (then.first < cost.first) {
                cost = then;
                m = improved;
            }
        }
        best = m;
        best_cost = cost.first;
        // By then none of the samples was all good with a probability of a thousandth.
        const double good = std::pow(double(cost.second) / double(count), double(size));
        const double needed = good >= 0.999 ? 1 : std::log(0.001) / std::log(1 - std::max(good, 1e-6));
        rounds = std::min(rounds, std::max(20.0, std::floor(needed) + 1));
    }
    if (!best) return std::nullopt;
    return one(kNormalised.inv() * *best * kNormalised);
}

}  // namespace

TEST(SlowEstimator, SearchDrawsTheSameSamplesAndKeepsTheBest) {
    const HomographyEstimator held({}, kPicture);
    const HomographyEstimator unheld = held.anyPerspective();
    const struct {
        cv::Rect2d area;
        int count;
        double noise, wrong, tolerance;
    } cases[] = {{kEverywhere, 400, 0.1, 0.3, 1}, {kEverywhere, 900, 0.3, 0.6, 0.5}, {kEverywhere, 60, 0.3, 0.5, 2},
                 {kPart, 60, 0.1, 0.5, 1},        {kEverywhere, 30, 0.4, 0.75, 0.5}, {kEverywhere, 8, 0.2, 0, 1},
                 {kEverywhere, 100, 0, 0, 1},     {kEverywhere, 700, 0.3, 0.9, 0.5}};
    for (std::size_t i = 0; i < std::size(cases); ++i) {
        const auto& c = cases[i];
        for (unsigned seed = 1; seed <= 4; ++seed) {
            const Correspondences points = some(c.area, c.count, c.noise, c.wrong, 100 * seed + unsigned(i));
            for (const std::size_t size : {2, 4}) {
                const bool free = seed % 2 == 0;
                const auto found =
                    (free ? unheld : held)
                        .search(points, size == 2 ? MotionModel::similarity : MotionModel::homography, c.tolerance);
                const auto slow = slowSearch(points, size, c.tolerance, free ? 0.3 : 0.004, free ? 4000 : 300);
                ASSERT_EQ(found.has_value(), slow.has_value()) << i << " " << seed << " " << size;
                if (!found) continue;
                EXPECT_LT(test::gridError(*found, *slow, kPicture), 2e-3) << i << " " << seed << " " << size;
            }
        }
    }
}

TEST(SlowEstimator, SearchNeedsAsManyPointsAsItDraws) {
    const HomographyEstimator estimator({}, kPicture);
    const auto found = [&](std::size_t count, MotionModel model) {
        Correspondences points;
        const cv::Point2f places[] = {{10, 10}, {600, 20}, {30, 460}, {610, 450}};
        for (std::size_t i = 0; i < count; ++i) points.add(places[i], places[i] + cv::Point2f(3, 1), 1);
        points.add({300, 200}, {303, 201}, 0);
        return estimator.search(points, model, 1).has_value();
    };
    EXPECT_FALSE(found(1, MotionModel::similarity));
    EXPECT_TRUE(found(2, MotionModel::similarity));
    EXPECT_FALSE(found(3, MotionModel::homography));
    EXPECT_TRUE(found(4, MotionModel::homography));
    // Two that are nearer than a twentieth of the longer side say nothing about a turn.
    for (const float apart : {31.0F, 33.0F}) {
        Correspondences points;
        points.add({300, 200}, {303, 201}, 1);
        points.add({300, 200 + apart}, {303, 201 + apart}, 1);
        EXPECT_EQ(estimator.search(points, MotionModel::similarity, 1).has_value(), apart > 32);
    }
}

TEST(SlowEstimator, RefinementNeedsFourPointsAndSomeWithin) {
    const HomographyEstimator estimator({}, kPicture);
    Correspondences points;
    const cv::Point2f places[] = {{10, 10}, {600, 20}, {30, 460}, {610, 450}};
    for (const cv::Point2f& place : places) {
        EXPECT_FALSE(estimator.refine(points, cv::Matx33d::eye()));
        points.add(place, place + cv::Point2f(3, 1), 1);
    }
    ASSERT_TRUE(estimator.refine(points, cv::Matx33d::eye()));
    EXPECT_FALSE(estimator.refine(points, cv::Matx33d::eye(), 1, 3))
        << "all lie farther from where the start takes them";
    EXPECT_TRUE(estimator.refine(points, cv::Matx33d::eye(), 1, 4));
    std::fill(points.weight.begin(), points.weight.end(), 0.0F);
    EXPECT_FALSE(estimator.refine(points, cv::Matx33d::eye()));
}

TEST(SlowEstimator, EverySumIsThatOfItsFormula) {
    const Correspondences points = some(kEverywhere, 77, 0.3, 0.1, 5);
    Correspondences p;
    for (const Pair& pair : normalised(points)) {
        p.add({float(pair.from[0]), float(pair.from[1])}, {float(pair.to[0]), float(pair.to[1])}, float(pair.weight));
    }
    const HomographyParameters h{1.005F, 0.012F, 0.014F, -0.013F, 1.004F, -0.009F, 0.02F, -0.03F};
    cv::Matx33d m = cv::Matx33d::eye();
    std::copy(h.begin(), h.end(), m.val);
    constexpr double kCutoff = 0.06;
    NormalSums expected;
    for (std::size_t i = 0; i < 77; ++i) {
        const double x = double(p.from_x[i]), y = double(p.from_y[i]);
        const Pair pair{{x, y}, {double(p.to_x[i]), double(p.to_y[i])}, double(p.weight[i])};
        const cv::Vec2d image = mapped(m, pair.from);
        const cv::Vec2d error = image - pair.to;
        const double q = std::max(0.0, 1 - squareOf(m, pair) / (kCutoff * kCutoff));
        const double weight = q * q * pair.weight;
        const double w = m(2, 0) * x + m(2, 1) * y + 1;
        const double moments[6] = {x * x, x * y, x, y * y, y, 1};
        for (std::size_t k = 0; k < 6; ++k) expected.plain[k] += weight / (w * w) * moments[k];
        for (std::size_t k = 0; k < 5; ++k) {
            expected.times_u[k] += weight / (w * w) * image[0] * moments[k];
            expected.times_v[k] += weight / (w * w) * image[1] * moments[k];
        }
        for (std::size_t k = 0; k < 3; ++k) {
            expected.times_square[k] += weight / (w * w) * image.dot(image) * moments[k == 2 ? 3 : k];
            const double first[3] = {x, y, 1};
            expected.right_x[k] += weight / w * error[0] * first[k];
            expected.right_y[k] += weight / w * error[1] * first[k];
            if (k < 2) expected.right_projective[k] += weight / w * image.dot(error) * first[k];
        }
        expected.weight += weight;
    }
    const NormalSums sums = sumNormalEquations(p, h, float(kCutoff));
    const auto compare = [](const auto& found, const auto& truth, const char* name) {
        for (std::size_t k = 0; k < truth.size(); ++k) EXPECT_NEAR(found[k], truth[k], 2e-5) << name << k;
    };
    compare(sums.plain, expected.plain, "plain");
    compare(sums.times_u, expected.times_u, "u");
    compare(sums.times_v, expected.times_v, "v");
    compare(sums.times_square, expected.times_square, "square");
    compare(sums.right_x, expected.right_x, "x");
    compare(sums.right_y, expected.right_y, "y");
    compare(sums.right_projective, expected.right_projective, "projective");
    EXPECT_NEAR(sums.weight, expected.weight, 1e-4);
}

}  // namespace eyrie::slow_estimator_test
