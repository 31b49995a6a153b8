// Moving areas against slow ones that follow the words of their descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>
#include <set>

#include "core/geometry/homography_jacobian.h"
#include "core/values/inferred_ids.h"
#include "motion/differences/area_matching.h"
#include "motion/differences/moving_areas.h"
#include "motion/driven_ground.h"

namespace eyrie::slow_areas_test {
namespace {

using test::DrivenGround;

double correlation(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to, cv::Point shift) {
    double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
    for (const cv::Point& p : pixels) {
        const double u = from.at<uchar>(p), v = to.at<uchar>(p + shift);
        a += u;
        b += v;
        aa += u * u;
        bb += v * v;
        ab += u * v;
    }
    const double n = double(pixels.size());
    const double both = (aa - a * a / n) * (bb - b * b / n);
    return both > 0 ? (ab - a * b / n) / std::sqrt(both) : 0;
}

/// Whether an area that is shifted lies in the picture with a pixel around it.
bool fits(const std::vector<cv::Point>& pixels, const cv::Mat& picture, cv::Point shift) {
    const cv::Rect inner(1, 1, picture.cols - 2, picture.rows - 2);
    return std::all_of(pixels.begin(), pixels.end(), [&](cv::Point p) { return inner.contains(p + shift); });
}

/// The best of shifts `step` apart at which the area fits; of equal ones the first, row by row.
cv::Point bestOf(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to, cv::Point around,
                 int reach, int step) {
    std::pair<double, cv::Point> best(-9, around);
    for (int dy = -reach; dy <= reach; dy += step) {
        for (int dx = -reach; dx <= reach; dx += step) {
            const cv::Point shift = around + cv::Point(dx, dy);
            if (!fits(pixels, to, shift)) continue;
            const double found = correlation(pixels, from, to, shift);
            if (found > best.first + 1e-12) best = {found, shift};
        }
    }
    return best.second;
}

std::optional<AreaMatch> slowMatch(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to,
                                   cv::Point around, int reach) {
    if (pixels.empty() || !fits(pixels, to, around)) return std::nullopt;
    double sum = 0, squares = 0;
    for (const cv::Point& p : pixels) {
        sum += from.at<uchar>(p);
        squares += from.at<uchar>(p) * from.at<uchar>(p);
    }
    const double n = double(pixels.size());
    if (squares - sum * sum / n < 4 * n) return std::nullopt;
    cv::Point best = around;
    if (reach > 4) {
        std::vector<cv::Point> some;
        const std::size_t step = std::max<std::size_t>(1, pixels.size() / 48);
        for (std::size_t i = 0; i < pixels.size(); i += step) some.push_back(pixels[i]);
        best = bestOf(pixels, from, to, bestOf(some, from, to, around, reach, 2), 2, 1);
    } else {
        best = bestOf(pixels, from, to, around, reach, 1);
    }
    const auto at = [&](int dx, int dy) { return correlation(pixels, from, to, best + cv::Point(dx, dy)); };
    const auto top = [&](double before, double after) {
        // Of the parabola through three values.
        const double bend = before + after - 2 * at(0, 0);
        return bend < 0 ? std::clamp((before - after) / (2 * bend), -0.5, 0.5) : 0.0;
    };
    return AreaMatch{cv::Point2d(best) + cv::Point2d(top(at(-1, 0), at(1, 0)), top(at(0, -1), at(0, 1))), at(0, 0)};
}

}  // namespace

TEST(SlowAreas, AMatchIsTheBestCorrelationOfAllShifts) {
    DrivenGround scene;
    scene.ground_contrast = 1.2;
    const cv::Mat from = scene.draw(0);
    int found_some = 0;
    for (const int frame : {1, 4}) {
        const cv::Mat to = scene.draw(frame);
        std::mt19937 random(3);
        for (int trial = 0; trial < 60; ++trial) {
            const cv::Rect area =
                cv::Rect(int(random() % 145), int(random() % 115), 2 + int(random() % 16), 2 + int(random() % 9)) &
                cv::Rect({0, 0}, scene.size);
            std::vector<cv::Point> pixels;
            for (int y = area.y; y < area.br().y; ++y) {
                for (int x = area.x; x < area.br().x; ++x) {
                    if (random() % 5 > 0) pixels.emplace_back(x, y);
                }
            }
            for (const int reach : {2, 4, 5, 9}) {
                const cv::Point around(int(random() % 5) - 2, int(random() % 5) - 2);
                const auto found = matchArea(pixels, from, to, around, reach);
                const auto slow = slowMatch(pixels, from, to, around, reach);
                ASSERT_EQ(found.has_value(), slow.has_value()) << area << reach << around;
                if (!found) continue;
                ++found_some;
                EXPECT_NEAR(found->correlation, slow->correlation, 1e-9);
                EXPECT_LT(cv::norm(found->shift - slow->shift), 1e-6) << area << reach;
            }
        }
    }
    EXPECT_GT(found_some, 100);
}

TEST(SlowAreas, PlainIsWhatDeviatesByLessThanTwoGreyLevels) {
    // Half of the pixels brighter by d deviate by d / 2.
    std::vector<cv::Point> pixels;
    for (int i = 0; i < 16; ++i) pixels.emplace_back(20 + i % 4, 20 + i / 4);
    for (const int difference : {3, 4, 5}) {
        cv::Mat gray(50, 50, CV_8UC1, cv::Scalar(90));
        for (int i = 0; i < 8; ++i) gray.at<uchar>(pixels[std::size_t(i)]) = uchar(90 + difference);
        EXPECT_EQ(matchArea(pixels, gray, gray, {0, 0}, 3).has_value(), difference >= 4) << difference;
    }
    // Sums of more than 65,000 pixels would not fit.
    cv::Mat large(400, 400, CV_8UC1);
    cv::randu(large, 0, 256);
    std::vector<cv::Point> many;
    for (int i = 0; i < 65001; ++i) many.emplace_back(20 + i % 300, 20 + i / 300);
    EXPECT_FALSE(matchArea(many, large, large, {0, 0}, 1));
    many.pop_back();
    EXPECT_TRUE(matchArea(many, large, large, {0, 0}, 1));
}

namespace {

/// Moving areas, step by step and with pictures that are looked up by frame.
struct SlowAreas {
    const MovingAreaOptions& options;
    const SceneScale& scale;
    const std::vector<cv::Mat>& pictures;
    const DrivenGround& scene;
    int gap;

    int now() const { return int(pictures.size()) - 1; }
    const cv::Mat& picture(int back) const { return pictures[std::size_t(now() - back)]; }
    cv::Matx33d pathTo(int back) const { return scene.path(now(), now() - back); }

    static cv::Mat half(const cv::Mat& gray) {
        cv::Mat result;
        cv::resize(gray, result, {gray.cols / 2, gray.rows / 2}, 0, 0, cv::INTER_AREA);
        return result;
    }
    static cv::Mat smooth(const cv::Mat& gray) {
        cv::Mat result;
        cv::GaussianBlur(gray, result, {5, 5}, 1);
        return result;
    }
    static double noise(const cv::Mat& difference) {
        std::vector<int> values;
        for (int y = 0; y < difference.rows; y += 4) {
            for (int x = 0; x < difference.cols; ++x) values.push_back(difference.at<uchar>(y, x));
        }
        std::sort(values.begin(), values.end());
        const int middle = values[values.size() / 2 - 1];
        const auto [first, last] = std::equal_range(values.begin(), values.end(), middle);
        const double inside = (double(values.size()) / 2 - double(first - values.begin())) / double(last - first);
        return (middle - 0.5 + inside) / 0.6745;
    }
    cv::Mat warped(int back, cv::Mat& inside) const {
        const cv::Matx33d double_size(2, 0, 0.5, 0, 2, 0.5, 0, 0, 1);
        const cv::Matx33d map = double_size.inv() * pathTo(back).inv() * double_size;
        const cv::Mat past = half(picture(back));
        cv::Mat result;
        cv::warpPerspective(smooth(past), result, map, past.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
        std::vector<cv::Point> corners;
        for (const cv::Point& corner : {cv::Point(3, 3), cv::Point(past.cols - 4, 3),
                                        cv::Point(past.cols - 4, past.rows - 4), cv::Point(3, past.rows - 4)}) {
            const cv::Vec3d at = map * cv::Vec3d(corner.x, corner.y, 1);
            corners.emplace_back(cvRound(at[0] / at[2]), cvRound(at[1] / at[2]));
        }
        inside = cv::Mat::zeros(past.size(), CV_8UC1);
        cv::fillConvexPoly(inside, corners, cv::Scalar(255));
        return result;
    }
    /// Pixels of the halved picture, area by area, each in reading order.
    std::vector<std::vector<cv::Point>> areas() const {
        cv::Mat in_before, in_long_before, first, second;
        const cv::Mat before = warped(gap, in_before), long_before = warped(2 * gap, in_long_before);
        cv::absdiff(smooth(half(picture(0))), before, first);
        cv::absdiff(before, long_before, second);
        const cv::Mat both = cv::min(first, second);
        const double threshold = std::max(options.area_noise_factor * noise(both), options.area_contrast);
        const cv::Mat differs = (both > threshold) & in_before & in_long_before;
        cv::Mat labels;
        const int count = cv::connectedComponents(differs, labels, 8, CV_32S);
        std::vector<std::vector<cv::Point>> result(std::size_t(count) - 1);
        for (int y = 0; y < labels.rows; ++y) {
            for (int x = 0; x < labels.cols; ++x) {
                if (labels.at<int>(y, x) > 0) result[std::size_t(labels.at<int>(y, x)) - 1].emplace_back(x, y);
            }
        }
        const double px = 0.5 / scale.gsd_m_per_px;
        const int fewest = std::max(options.area_min_size_px / 4, cvRound(options.area_min_size_m2 * px * px));
        std::erase_if(result, [&](const auto& area) {
            const cv::Rect bounds = cv::boundingRect(area);
            return int(area.size()) < fewest ||
                   std::hypot(bounds.width, bounds.height) > options.area_max_length_m * px;
        });
        return result;
    }
    cv::Mat part(int back, const cv::Rect& place) const {
        const HomographyJacobian map(pathTo(back),
                                     {place.x + (place.width - 1) / 2.0, place.y + (place.height - 1) / 2.0});
        cv::Mat result(place.size(), CV_8UC1);
        const cv::Point2d x = map.vector({1, 0}), y = map.vector({0, 1});
        const cv::Point2d corner = map.point() - (place.width - 1) / 2.0 * x - (place.height - 1) / 2.0 * y;
        cv::warpAffine(picture(back), result, cv::Matx23d(x.x, y.x, corner.x, x.y, y.y, corner.y), place.size(),
                       cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
        return result;
    }
    /// Two pixels more on every side.
    static cv::Rect grown(const std::vector<cv::Point>& area) {
        const cv::Rect bounds = cv::boundingRect(area);
        return {2 * bounds.x - 2, 2 * bounds.y - 2, 2 * bounds.width + 4, 2 * bounds.height + 4};
    }
    std::optional<cv::Point2d> shift(const std::vector<cv::Point>& area, double least) const {
        const cv::Rect place = grown(area);
        cv::Mat1b mask = cv::Mat1b::zeros(place.size());
        for (const cv::Point& p : area) {
            for (int i = 0; i < 4; ++i) mask(2 * p.y - place.y + i / 2, 2 * p.x - place.x + i % 2) = 255;
        }
        cv::dilate(mask, mask, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
        std::vector<cv::Point> pixels;
        cv::findNonZero(mask, pixels);
        const cv::Mat before = part(gap, place);
        // As far as 40 m/s go, 4 to 100 px.
        const int reach = std::clamp(int(std::ceil(40 / scale.gsd_m_per_px / scale.frame_rate_hz * gap)), 4, 100);
        const auto on = matchArea(pixels, before, picture(0), place.tl(), reach);
        if (!on || on->correlation < least) return std::nullopt;
        const cv::Point2d moved = on->shift - cv::Point2d(place.tl());
        // A tenth of the way on or two pixels the way back may differ by.
        const int differ = std::max(2, cvRound(0.1 * cv::norm(moved)));
        const int margin = differ + 4;
        const cv::Rect whence(place.x - cvRound(moved.x) - margin, place.y - cvRound(moved.y) - margin,
                              place.width + 2 * margin, place.height + 2 * margin);
        const auto came = matchArea(pixels, before, part(2 * gap, whence), {margin, margin}, differ);
        if (!came || came->correlation < least) return std::nullopt;
        return moved;
    }
    std::vector<MotionVector> infer(const FrameMotion& motion, double min_speed) const {
        std::vector<MotionVector> result;
        const double on_car =
            motion.corner_count / double(motion.image_size.area()) * 8.1 / (scale.gsd_m_per_px * scale.gsd_m_per_px);
        const bool slow_video = scale.frame_rate_hz < options.area_low_rate_hz;
        if (on_car >= options.area_max_corners && !slow_video) return result;
        const double least = slow_video                          ? options.area_low_rate_correlation
                             : on_car < options.area_few_corners ? options.area_min_correlation
                                                                 : options.area_sure_correlation;
        for (const auto& area : areas()) {
            const auto moved = shift(area, least);
            if (!moved || cv::norm(*moved) < std::max(options.area_min_shift, min_speed * gap)) continue;
            const cv::Point2d velocity = *moved / gap;
            const cv::Rect2d place = cv::Rect2d(grown(area)) + *moved;
            const auto known =
                std::count_if(motion.motion_vectors.begin(), motion.motion_vectors.end(), [&](const auto& vector) {
                    return place.contains(cv::Point2d(vector.position)) &&
                           cv::norm(cv::Point2d(vector.velocity) - velocity) <= std::max(0.4, 0.3 * cv::norm(velocity));
                });
            if (known >= 3) continue;
            std::vector<cv::Point2d> chosen;
            for (const cv::Point& p : area) {
                const cv::Point2d at(2 * p.x + 0.5, 2 * p.y + 0.5);
                if (std::all_of(chosen.begin(), chosen.end(), [&](cv::Point2d other) {
                        return cv::norm(at - other) >= std::max(2.0, 0.6 / scale.gsd_m_per_px);
                    }))
                    chosen.push_back(at);
            }
            for (const cv::Point2d& at : chosen)
                result.push_back({kFirstOfAreas + CornerId(result.size()), at + *moved, velocity, 0});
        }
        return result;
    }
};

DrivenGround carScene(unsigned variant) {
    DrivenGround scene;
    scene.ground_contrast = 0.3;
    scene.noise = 0.7;
    scene.vehicles = {{{60, 50}, {1.9, 0.3}},
                      {{90, 80}, {-1.2, -0.9}, {10, 8}, 60, 1.2},
                      {{40, 90}, {0.5, 0}, {16, 7}, 220},
                      {{100, 35}, {0.2, 1.4}, {6, 12}, 30, 0.5}};
    if (variant == 1) scene.size = {151, 121};
    if (variant == 2) {
        // Ground comes into view on the right and above, where it is looked at but for the border.
        scene.camera_per_frame = -1;
        scene.vehicles.push_back({{148, 50}, {0.3, 1.6}});
        scene.vehicles.push_back({{75, -6}, {1.6, 0.2}});
    }
    return scene;
}

}  // namespace

TEST(SlowAreas, VectorsAreThoseOfAreasThatWentSomewhere) {
    std::size_t vectors = 0;
    std::set<std::size_t> counts;
    for (unsigned variant = 0; variant < 3; ++variant) {
        const DrivenGround scene = carScene(variant);
        std::vector<cv::Mat> pictures;
        for (int i = 0; i < 9; ++i) pictures.push_back(scene.draw(i));
        const SceneScale scales[] = {{0.32, 25, true}, {0.2, 12, true}, {0.5, 30, true}};
        for (const SceneScale& scale : scales) {
            for (int k = 0; k < 7; ++k) {
                MovingAreaOptions options;
                options.area_noise_factor = k == 1 ? 4 : 8;
                options.area_contrast = k == 1 ? 3 : 6;
                options.area_min_size_m2 = k == 2 ? 0 : 1;
                options.area_min_size_px = k == 2 ? 90 : 8;
                options.area_max_length_m = k == 3 ? 4.4 : 20;
                options.area_min_shift = k == 4 ? 5 : 1.5;
                options.area_min_correlation = k == 5 ? 0.95 : 0.6;
                MovingAreas areas(options, scale);
                for (int i = 0; i < 9; ++i)
                    areas.add(test::frameOf(i, pictures[std::size_t(i)]), scene.registration(i));
                FrameMotion motion;
                motion.image_size = scene.size;
                motion.corner_count = k == 6 ? 1000 : 300;
                const SlowAreas slow{options, scale, pictures, scene, options.gapFrames(scale)};
                for (const double min_speed : {0.1, 1.1}) {
                    motion.motion_vectors.clear();
                    const auto found = areas.infer(motion, [&](cv::Point2d) { return min_speed; });
                    auto expected = slow.infer(motion, min_speed);
                    ASSERT_EQ(found.size(), expected.size()) << variant << " " << scale.gsd_m_per_px << " " << k;
                    vectors += found.size();
                    counts.insert(found.size());
                    for (std::size_t i = 0; i < found.size(); ++i) {
                        EXPECT_EQ(found[i].id, found[0].id + i);
                        EXPECT_LT(cv::norm(found[i].position - expected[i].position), 1e-3);
                        EXPECT_LT(cv::norm(found[i].velocity - expected[i].velocity), 1e-4);
                        EXPECT_EQ(found[i].age, 0);
                    }
                    // Some of them are known already: from three on an area has none of its own.
                    for (const float off : {0.0F, 0.38F, 0.55F, 0.8F}) {
                        motion.motion_vectors.clear();
                        for (std::size_t i = 0; i < found.size(); i += 3) {
                            motion.motion_vectors.push_back(found[i]);
                            motion.motion_vectors.back().velocity += cv::Point2f(0, off);
                        }
                        EXPECT_EQ(areas.infer(motion, [&](cv::Point2d) { return min_speed; }).size(),
                                  slow.infer(motion, min_speed).size())
                            << off;
                    }
                }
            }
        }
    }
    EXPECT_GT(vectors, 500U);
    EXPECT_GT(counts.size(), 8U);
}

TEST(SlowAreas, PathsThatNoCameraFliesAreNotFollowed) {
    const DrivenGround scene = carScene(0);
    const SceneScale scale{0.32, 25, true};
    const auto inferred = [&](const cv::Matx33d& first_step) {
        MovingAreas areas({}, scale);
        for (int i = 0; i < 7; ++i) {
            Registration registration = scene.registration(i);
            if (i == 1) registration.current_from_previous.matrix = first_step;
            areas.add(scene.frame(i), registration);
        }
        FrameMotion motion;
        motion.image_size = scene.size;
        motion.corner_count = 100;
        areas.infer(motion, [](cv::Point2d) { return 0.1; });
        return areas.infer(motion, [](cv::Point2d) { return 0.1; }).size();
    };
    const cv::Matx33d step = scene.registration(1).current_from_previous.matrix;
    EXPECT_GT(inferred(step), 0U);
    // The horizon crosses the picture; the way leads ten pictures away. Either way round.
    EXPECT_EQ(inferred({1, 0, 0, 0, 1, 0, -0.02, 0, 1}), 0U);
    EXPECT_EQ(inferred({1, 0, 0, 0, 1, 0, 0, 0.02, 1}), 0U);
    EXPECT_EQ(inferred({1, 0, 1600, 0, 1, 0, 0, 0, 1}), 0U);
    EXPECT_EQ(inferred({1, 0, 0, 0, 1, -1300, 0, 0, 1}), 0U);
}

TEST(SlowAreas, TheHorizonMustNotComeNearThePicture) {
    // Plain ground looks the same however the camera tilts, and so does a car about which it tilts.
    DrivenGround scene;
    scene.ground_contrast = 0;
    scene.noise = 0.5;
    scene.camera_per_frame = 0;
    const cv::Point2d car(40, 40);
    scene.vehicles = {{car, {1.5, 0}}};
    const auto seenWith = [&](cv::Point2d tilt) {
        cv::Matx33d step(1, 0, 0, 0, 1, 0, tilt.x, tilt.y, 1);
        step = cv::Matx33d(1, 0, car.x, 0, 1, car.y, 0, 0, 1) * step * cv::Matx33d(1, 0, -car.x, 0, 1, -car.y, 0, 0, 1);
        MovingAreas areas({}, {0.32, 25, true});
        for (int i = 0; i < 7; ++i) {
            Registration registration = scene.registration(i);
            if (i == 1) registration.current_from_previous.matrix = step * (1 / step(2, 2));
            areas.add(scene.frame(i), registration);
        }
        FrameMotion motion;
        motion.image_size = scene.size;
        motion.corner_count = 100;
        return !areas.infer(motion, [](cv::Point2d) { return 0.1; }).empty();
    };
    // The tilt with which the ground at the far side is `times` as far away as that at the corner (0, 0).
    const auto tilt = [](double size, double middle, double times) {
        return (1 - 1 / times) / (size - middle + middle / times);
    };
    for (const int sign : {-1, 1}) {
        EXPECT_TRUE(seenWith({sign * tilt(150, car.x, 4.7), 0})) << sign;
        EXPECT_FALSE(seenWith({sign * tilt(150, car.x, 5.3), 0})) << sign;
        EXPECT_TRUE(seenWith({0, sign * tilt(120, car.y, 4.7)})) << sign;
        EXPECT_FALSE(seenWith({0, sign * tilt(120, car.y, 5.3)})) << sign;
    }
}

}  // namespace eyrie::slow_areas_test
