#pragma once

#include <filesystem>

#include "core/geometry/local_plane.h"
#include "core/geometry/outline_map.h"
#include "io/video/stream_copy.h"
#include "io/video/video_writer.h"
#include "support/klv_writer.h"
#include "ui/support/ui_support.h"

namespace eyrie::ui::test {

inline const GeoPoint kFlownFrom{48, 11};
inline constexpr double kFlownPixel_m = 0.5;
inline constexpr std::int64_t kFlownAt_us = 1'231'798'102'000'000;  // 2009-01-12T22:08:22Z

/// Where a pixel of the flown video lies: it flies east over the ground of sceneFrame(), its top to the north.
inline GeoPoint flownPlace(FrameIndex frame, cv::Point2d px) {
    return LocalPlane(kFlownFrom).placeOf({kFlownPixel_m * (px.x + frame), -kFlownPixel_m * px.y});
}

/// The scene as a transport stream with metadata: a set each frame, of which `damaged` have a wrong checksum.
inline std::filesystem::path writeFlownVideo(const std::filesystem::path& folder, int frames, int damaged = 0) {
    const cv::Size size(240, 180);
    const std::filesystem::path plain = folder / "plain.mp4", flown = folder / "flown.ts";
    VideoWriter writer(plain, size);
    for (int i = 0; i < frames; ++i) {
        cv::Mat picture;
        cv::cvtColor(sceneFrame(i, size), picture, cv::COLOR_GRAY2BGR);
        writer.write(picture);
    }
    writer.finish();
    SourceOptions options;
    options.index_folder = folder / "index";
    const std::vector<PictureStamp> pictures = openSource(plain, options)->pictureStamps();
    std::vector<AddedPacket> sets;
    for (const PictureStamp& picture : pictures) {
        const auto frame = static_cast<FrameIndex>(picture.time_us / 40'000);
        eyrie::test::LocalSetWriter set;
        set.time(static_cast<std::uint64_t>(kFlownAt_us + picture.time_us));
        const std::string mission = frame < frames / 2 ? "OUTBOUND" : "RETURN";
        set.item(3, {mission.begin(), mission.end()});
        int tag = 82;
        for (const cv::Point2d& corner : outlineOf(size)) {
            const GeoPoint place = flownPlace(frame, corner);
            set.angle(tag, place.latitude_deg, 90).angle(tag + 1, place.longitude_deg, 180);
            tag += 2;
        }
        auto bytes = set.bytes();
        if (frame < damaged) bytes.back() ^= 0xFF;
        sets.push_back({picture.stamp_us, bytes});
    }
    std::sort(sets.begin(), sets.end(),
              [](const AddedPacket& a, const AddedPacket& b) { return a.stamp_us < b.stamp_us; });
    copyWithKlv(
        plain,
        [&](const TakePacket& take) {
            for (const AddedPacket& set : sets) take(set);
        },
        flown);
    return flown;
}

}  // namespace eyrie::ui::test
