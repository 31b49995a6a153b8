// Silhouettes, difference images and the memory of pictures against slow ones that follow the words of their
// descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <set>

#include "core/values/inferred_ids.h"
#include "motion/differences/registered_frames.h"
#include "motion/differences/silhouettes.h"
#include "motion/driven_ground.h"
#include "motion/vectors/vector_groups.h"

namespace eyrie::slow_silhouettes_test {
namespace {

using test::DrivenGround;

/// One silhouette, cell by cell.
struct SlowSilhouette {
    const SilhouetteOptions& options;
    const SceneScale& scale;
    const DrivenGround& scene;
    const std::vector<cv::Mat>& pictures;  ///< of the frames from 0 on
    const VectorGroup& group;
    std::vector<cv::Point2d> corners;

    int now() const { return int(pictures.size()) - 1; }
    int known() const { return std::min(now(), options.silhouette_frames); }
    double cell() const { return std::max(1.0, 0.3 / scale.gsd_m_per_px); }
    double ahead() const { return 2 + 0.5 / scale.gsd_m_per_px; }
    double longest() const { return options.silhouette_max_length_m / scale.gsd_m_per_px; }

    /// Rows from the front on, columns from the middle line on.
    cv::Point2d place(int row, int column) const {
        const cv::Point2d along(std::cos(group.box.heading), std::sin(group.box.heading)), across(-along.y, along.x);
        return group.box.centre + (group.box.length / 2 + ahead() - row * cell()) * along + column * cell() * across;
    }
    bool inLattice(int row, int column) const {
        const int rows = int((ahead() + longest() + 4) / cell());
        const int aside = int((group.box.width / 2 + 1.5 / scale.gsd_m_per_px + 1) / cell());
        return row >= 0 && row < rows && std::abs(column) <= aside;
    }
    std::optional<int> brightness(int back, cv::Point2d at) const {
        const cv::Vec3d p = scene.path(now(), now() - back) * cv::Vec3d(at.x, at.y, 1);
        const double x = p[0] / p[2], y = p[1] / p[2];
        const cv::Mat& gray = pictures[std::size_t(now() - back)];
        if (x < 0 || y < 0 || x >= gray.cols - 1 || y >= gray.rows - 1) return std::nullopt;
        const int ix = int(x), iy = int(y);
        const auto value = [&](int dx, int dy) { return double(gray.at<uchar>(iy + dy, ix + dx)); };
        const double upper = value(0, 0) + (x - ix) * (value(1, 0) - value(0, 0));
        const double lower = value(0, 1) + (x - ix) * (value(1, 1) - value(0, 1));
        return cvRound(upper + (y - iy) * (lower - upper));
    }
    bool isVehicle(int row, int column) const {
        const cv::Point2d at = place(row, column);
        const cv::Point pixel(cvRound(at.x), cvRound(at.y));
        if (!cv::Rect({0, 0}, scene.size).contains(pixel)) return false;
        const int since = int(std::max(2.0, std::ceil((row * cell() + 1) / cv::norm(group.velocity))));
        if (since > known() - 2) return false;
        std::vector<int> values;
        for (int back = since; back <= known() && values.size() < 5; back += std::max(1, (known() - since) / 6)) {
            if (const auto value = brightness(back, cv::Point2d(pixel))) values.push_back(*value);
        }
        if (values.size() < 3) return false;
        std::sort(values.begin(), values.end());
        const int ground = values[values.size() / 2];
        const int spread = values[values.size() - 2] - values[1];
        const double here = pictures.back().at<uchar>(pixel);
        const double share = here / std::max(1, ground);
        if (share > 0.4 && share < 0.75) return false;  // a shadow
        return std::abs(here - ground) >
               std::max(options.silhouette_contrast, options.silhouette_noise_factor * spread);
    }
    std::vector<cv::Point2d> outline() const {
        if (corners.size() < 3 || cv::norm(group.velocity) < scale.pxPerFrame(options.silhouette_min_speed_m_s))
            return {};
        std::set<std::pair<int, int>> region;
        std::vector<std::pair<int, int>> next;
        const auto visit = [&](int row, int column) {
            if (!inLattice(row, column) || region.count({row, column}) > 0 || !isVehicle(row, column)) return;
            region.insert({row, column});
            next.emplace_back(row, column);
        };
        const cv::Point2d along(std::cos(group.box.heading), std::sin(group.box.heading));
        for (const cv::Point2d& corner : corners) {
            const cv::Point2d from = corner - group.box.centre;
            const int row = cvRound((group.box.length / 2 + ahead() - from.dot(along)) / cell());
            const int column = cvRound(along.cross(from) / cell());
            for (int k = 0; k < 9; ++k) visit(row + k / 3 - 1, column + k % 3 - 1);
        }
        while (!next.empty()) {
            const auto [row, column] = next.back();
            next.pop_back();
            visit(row - 1, column);
            visit(row + 1, column);
            visit(row, column - 1);
            visit(row, column + 1);
        }
        if (region.size() < 6) return {};
        std::map<int, std::pair<int, int>> rows;
        int left = 1000, right = -1000;
        for (const auto& [row, column] : region) {
            auto& ends = rows.try_emplace(row, column, column).first->second;
            ends = {std::min(ends.first, column), std::max(ends.second, column)};
            left = std::min(left, column);
            right = std::max(right, column);
        }
        const int first = rows.begin()->first, last = rows.rbegin()->first;
        if ((last - first + 1) * cell() >= longest()) return {};
        if ((right - left + 1) * cell() >= options.silhouette_max_width_m / scale.gsd_m_per_px + 2) return {};
        std::vector<cv::Point2d> result;
        for (const auto& [row, ends] : rows) {
            if ((row - first) % std::max(1, int(2 / cell())) != 0) continue;
            for (const int column : std::set<int>{ends.first, ends.second}) {
                const cv::Point2d at = place(row, column);
                if (std::all_of(corners.begin(), corners.end(),
                                [&](cv::Point2d corner) { return cv::norm(corner - at) >= 1.5; }))
                    result.push_back(at);
            }
        }
        return result;
    }
};

}  // namespace

TEST(SlowSilhouettes, OutlinesAreThoseOfWhatDiffersFromTheGroundBefore) {
    DrivenGround scene;
    scene.size = {170, 130};
    scene.ground_contrast = 0.45;
    scene.noise = 4;
    scene.vehicles = {{{70, 60}, {1.6, 0.2}, {34, 8}, 205, 0.1},    // a plain lorry
                      {{110, 30}, {-1.1, 0.5}, {20, 9}, 141, 0.6},  // light, textured
                      {{70, 100}, {0.9, -0.1}, {16, 7}, 75, 0.1},   // half dark, like a shadow
                      {{130, 90}, {0.05, 1.3}, {7, 22}, 20, 0.2},   // black, towards the border
                      {{40, 40}, {0.2, 0}, {12, 7}, 220, 0.3}};     // creeping
    std::vector<cv::Mat> pictures;
    constexpr int kFrames = 22;
    for (int i = 0; i < kFrames; ++i) pictures.push_back(scene.draw(i));
    const cv::Matx33d now = scene.pictureFromGround(kFrames - 1);
    std::size_t vectors = 0;
    std::set<std::size_t> counts;
    for (const double gsd : {0.3, 0.2, 0.12, 0.45}) {
        const SceneScale scale{gsd, 25, true};
        for (int k = 0; k < 8; ++k) {
            SilhouetteOptions options;
            options.silhouette_frames = k == 1 ? 12 : k == 2 ? 17 : 28;
            options.silhouette_contrast = k == 3 ? 45 : 16;
            options.silhouette_noise_factor = k == 4 ? 0.5 : k == 5 ? 9 : 4;
            options.silhouette_max_length_m = k == 6 ? 6.1 : 18;
            options.silhouette_max_width_m = k == 7 ? 1.9 : 3.4;
            options.silhouette_min_speed_m_s = k == 2 ? 0.5 : 2.5;
            Silhouettes silhouettes(options, scale);
            for (int i = 0; i < kFrames; ++i)
                silhouettes.add(test::frameOf(i, pictures[std::size_t(i)]), scene.registration(i));
            // Corners at the front of each vehicle, two of which would be too few.
            std::vector<MotionVector> corners;
            std::vector<int> chosen;
            for (const auto& vehicle : scene.vehicles) {
                const cv::Point2d along = vehicle.velocity / cv::norm(vehicle.velocity), across(-along.y, along.x);
                const double half_length = std::max(vehicle.size.width, vehicle.size.height) / 2;
                const double half_width = std::min(vehicle.size.width, vehicle.size.height) / 2;
                for (int i = 0; i < (k == 7 ? 3 : 5); ++i) {
                    const cv::Point2d on = vehicle.start + vehicle.velocity * (kFrames - 1) +
                                           along * (half_length - 0.5 - 1.7 * (i / 2)) +
                                           across * (half_width - 1) * (i % 2 == 0 ? 1 : -1);
                    const cv::Vec3d p = now * cv::Vec3d(on.x, on.y, 1),
                                    q = now * cv::Vec3d(on.x + vehicle.velocity.x, on.y + vehicle.velocity.y, 1);
                    const cv::Point2d at(p[0] / p[2], p[1] / p[2]), then(q[0] / q[2], q[1] / q[2]);
                    corners.push_back({CornerId(corners.size()), at, then - at, 20});
                    if (k != 5 || i < 2 + int(corners.size()) % 3) chosen.push_back(int(corners.size()) - 1);
                }
            }
            const auto found = silhouettes.infer(corners, chosen, 0.02);
            std::vector<std::pair<cv::Point2d, cv::Point2d>> expected;
            for (const VectorGroup& group : groupVectors(corners, chosen, vehicleLinkage(scale, 0.02, 0.12))) {
                SlowSilhouette slow{options, scale, scene, pictures, group, {}};
                for (const int member : group.members) slow.corners.emplace_back(corners[std::size_t(member)].position);
                for (const cv::Point2d& at : slow.outline()) expected.emplace_back(at, group.velocity);
            }
            ASSERT_EQ(found.size(), expected.size()) << gsd << " " << k;
            vectors += found.size();
            counts.insert(found.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                EXPECT_EQ(found[i].id, kFirstOfSilhouettes + CornerId(i));
                EXPECT_LT(cv::norm(cv::Point2d(found[i].position) - expected[i].first), 1e-3)
                    << gsd << " " << k << " " << i;
                EXPECT_LT(cv::norm(cv::Point2d(found[i].velocity) - expected[i].second), 1e-5);
                EXPECT_EQ(found[i].age, 0);
            }
        }
    }
    EXPECT_GT(vectors, 500U);
    EXPECT_GT(counts.size(), 8U);
}

TEST(SlowSilhouettes, PicturesAreRememberedWithTheirWays) {
    DrivenGround scene;
    scene.size = {60, 50};
    RegisteredFrames frames(3);
    std::vector<int> kept;  // frames, newest first
    const auto take = [&](int index, RegistrationState state, bool follows = true) {
        Registration registration = scene.registration(index);
        registration.state = state;
        if (!follows) registration.current_from_previous.from_frame = index - 2;
        const bool adds = frames.add(scene.frame(index), registration);
        const bool starts = !follows || state == RegistrationState::first;
        if (starts) kept.clear();
        EXPECT_EQ(adds, starts || state == RegistrationState::registered);
        if (adds) kept.insert(kept.begin(), index);
        if (kept.size() > 4) kept.pop_back();
        ASSERT_EQ(frames.count(), int(kept.size()) - 1) << index;
        for (std::size_t back = 0; back < kept.size(); ++back) {
            EXPECT_EQ(cv::norm(frames.picture(int(back)), scene.draw(kept[back]), cv::NORM_INF), 0);
            // The way leads from the newest frame, also from one that failed.
            EXPECT_LT(test::gridError(frames.pathTo(int(back)).matrix, scene.path(index, kept[back]), scene.size),
                      1e-6);
        }
        if (kept.size() < 2) return;
        const WarpedFrame past = frames.past(1);
        cv::Mat expected;
        cv::warpPerspective(scene.draw(kept[1]), expected, scene.path(kept[1], index), scene.size, cv::INTER_LINEAR,
                            cv::BORDER_REPLICATE);
        EXPECT_LE(cv::norm(past.gray, expected, cv::NORM_INF), 1);
        const cv::Vec3d corner = scene.path(index, kept[1]) * cv::Vec3d(scene.size.width - 1, scene.size.height - 1, 1);
        EXPECT_EQ(past.inside.at<uchar>(scene.size.height / 2, scene.size.width / 2), 255);
        const bool seen = corner[0] / corner[2] < scene.size.width - 0.5 &&
                          corner[1] / corner[2] < scene.size.height - 0.5 && corner[1] > -0.5;
        EXPECT_EQ(past.inside.at<uchar>(scene.size.height - 1, scene.size.width - 1) != 0, seen) << index;
    };
    EXPECT_EQ(frames.count(), 0);
    take(0, RegistrationState::first);
    for (int i = 1; i < 7; ++i) take(i, RegistrationState::registered);
    take(7, RegistrationState::failed);
    take(8, RegistrationState::registered);
    take(9, RegistrationState::frozen);
    take(10, RegistrationState::registered);
    take(11, RegistrationState::first);
    take(12, RegistrationState::registered);
    take(13, RegistrationState::registered, false);
    take(14, RegistrationState::registered);
    // Another size is another video.
    Registration registration = scene.registration(15);
    EXPECT_TRUE(frames.add(test::frameOf(15, cv::Mat(20, 20, CV_8UC1, cv::Scalar(3))), registration));
    EXPECT_EQ(frames.count(), 0);
    frames.clear();
    EXPECT_EQ(frames.count(), 0);
}

}  // namespace eyrie::slow_silhouettes_test
