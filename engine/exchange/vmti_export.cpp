#include "exchange/vmti_export.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "formats/track_world.h"
#include "io/video/stream_copy.h"
#include "metadata/vmti/vmti_set.h"

namespace eyrie {
namespace {

/// When a track is there, and how much of it came before a frame.
struct TrackLife {
    FrameIndex first = 0, last = 0;
    int seen = 0;
};

/// The same 16 bytes for the same track of the same video: version 8 of RFC 9562, what its maker pleases.
std::array<std::uint8_t, 16> trackUuid(const std::string& video, std::int64_t began_us, int id) {
    std::uint64_t hash = 1469598103934665603ULL;  // FNV-1a
    for (const char c : video) hash = (hash ^ static_cast<std::uint8_t>(c)) * 1099511628211ULL;
    hash ^= static_cast<std::uint64_t>(began_us) * 0x9E3779B97F4A7C15ULL;
    std::array<std::uint8_t, 16> uuid{};
    for (std::size_t i = 0; i < 8; ++i) uuid[i] = static_cast<std::uint8_t>(hash >> (8 * i));
    for (std::size_t i = 0; i < 4; ++i)
        uuid[15 - i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(id) >> (8 * i));
    uuid[6] = static_cast<std::uint8_t>((uuid[6] & 0x0FU) | 0x80U);
    uuid[8] = 0x80U;
    return uuid;
}

cv::Point pixelAt(double x, double y) {
    return {static_cast<int>(std::lround(x)), static_cast<int>(std::lround(y))};
}

/// Makes the sets frame by frame.
class VmtiFrames {
 public:
    VmtiFrames(const LabelStream& labels, const FrameSource& video, const TrackWorld& world)
        : world_(world), name_(video.info().path.filename().string()), size_(video.info().size) {
        labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& boxes) {
            for (const LabelBox& box : boxes) {
                if (!box.id) continue;
                lives_.try_emplace(*box.id, TrackLife{frame, frame, 0}).first->second.last = frame;
            }
        });
    }

    vmti::Frame frame(FrameIndex index, const std::vector<LabelBox>& boxes) {
        vmti::Frame made;
        made.utc_us = world_.utc_us(index).value_or(0);
        made.number = static_cast<std::uint32_t>(index);
        made.size = size_;
        made.system = "Eyrie";
        for (const LabelBox& box : boxes)
            if (box.id && *box.id >= 0) made.targets.push_back(target(index, box));
        return made;
    }
    int withoutPlace() const { return without_place_; }

 private:
    vmti::Target target(FrameIndex frame, const LabelBox& box) {
        TrackLife& life = lives_.at(*box.id);
        vmti::Target made;
        made.id = static_cast<std::uint32_t>(*box.id);
        made.centre = pixelAt(box.box.centre.x, box.box.centre.y);
        const BoxEdges edges = edgesOf(box.box, 0);
        // Edges lie between pixels: the first and the last that are within.
        made.top_left = {static_cast<int>(std::floor(edges.left)), static_cast<int>(std::floor(edges.top))};
        made.bottom_right = {static_cast<int>(std::ceil(edges.left + edges.width)) - 1,
                             static_cast<int>(std::ceil(edges.top + edges.height)) - 1};
        made.confidence_percent = static_cast<int>(std::lround(100 * std::clamp(box.score, 0.0, 1.0)));
        made.seen_before = life.seen++;
        made.place = world_.place ? world_.place(frame, box.box.centre) : std::nullopt;
        if (!made.place) ++without_place_;
        if (const auto height = made.place && world_.height ? world_.height(frame) : std::nullopt;
            height && height->ellipsoid)
            made.ellipsoid_height_m = height->metres;
        const std::int64_t began = world_.utc_us(life.first).value_or(0);
        made.track = trackUuid(name_, began, *box.id);
        made.detection = box.origin == StateOrigin::standing ? vmti::Detection::stopped : vmti::Detection::active;
        made.first_utc_us = began;
        made.last_utc_us = world_.utc_us(std::min(life.last, frame));
        const GroundState ground = groundStateOf(&world_, box);
        if (ground.speed_km_h && ground.course_deg) {
            const double speed = *ground.speed_km_h / 3.6;
            const double course = *ground.course_deg * CV_PI / 180;
            made.velocity = vmti::Target::Velocity{speed * std::sin(course), speed * std::cos(course)};
        }
        return made;
    }

    const TrackWorld& world_;
    std::string name_;
    cv::Size size_;
    std::map<int, TrackLife> lives_;
    int without_place_ = 0;
};

/// Stamps of the frames on the clock of the container, by frame; kNoStamp where a frame has none.
std::vector<std::int64_t> stampsOf(const FrameSource& video) {
    std::map<std::int64_t, std::int64_t> by_time;
    for (const PictureStamp& picture : video.pictureStamps())
        if (picture.time_us != kNoStamp) by_time[picture.time_us] = picture.stamp_us;
    std::vector<std::int64_t> stamps;
    for (FrameIndex frame = 0; frame < video.info().frame_count; ++frame) {
        const auto found = by_time.find(video.timeOf(frame));
        stamps.push_back(found == by_time.end() ? kNoStamp : found->second);
    }
    return stamps;
}

}  // namespace

VmtiReport writeVmti(const LabelStream& labels, const FrameSource& video, const std::filesystem::path& to,
                     const IndexProgress& progress, const std::stop_token& stop) {
    const TrackWorld& world = neededTimes(labels.about, to, "VMTI");
    if (video.info().is_image_sequence)
        throw Error(ErrorKind::input, video.info().path.string() +
                                          ": a folder of images cannot be copied into a transport stream; make a video "
                                          "of it first");
    if (!video.info().parts.empty())
        throw Error(ErrorKind::input,
                    video.info().path.string() +
                        ": consists of several files, which cannot be copied into one transport stream; join them "
                        "first, or export the tracks as another format");
    VmtiFrames frames(labels, video, world);
    const std::vector<std::int64_t> stamps = stampsOf(video);
    VmtiReport report;
    const auto sets = [&](const TakePacket& take) {
        const auto add = [&](FrameIndex index, const std::vector<LabelBox>& boxes) {
            const auto at = static_cast<std::size_t>(index);
            if (at >= stamps.size() || stamps[at] == kNoStamp) {
                ++report.without_stamp;
                return;
            }
            const vmti::Frame frame = frames.frame(index, boxes);
            ++report.frames;
            report.targets += static_cast<int>(frame.targets.size());
            take({stamps[at], vmti::packed(frame)});
        };
        FrameIndex next = -1;
        labels.frames([&](FrameIndex index, const std::vector<LabelBox>& boxes) {
            // Frames without a target say so: silence would mean that nobody looked.
            for (; next >= 0 && next < index; ++next) add(next, {});
            add(index, boxes);
            next = index + 1;
        });
    };
    copyWithKlv(video.info().path, sets, to, progress, stop);
    report.without_place = frames.withoutPlace();
    report.clock_origin = world.clock_origin;
    report.place_origin = world.place_origin;
    return report;
}

std::vector<std::string> remarksOn(const VmtiReport& report, const std::string& no_place) {
    std::vector<std::string> remarks;
    const auto counted = [](int count, const char* one, const char* many) {
        return std::to_string(count) + (count == 1 ? one : many);
    };
    remarks.push_back("times: " + report.clock_origin);
    remarks.push_back("places: " + (report.place_origin.empty() ? no_place : report.place_origin));
    if (report.without_place > 0 && !report.place_origin.empty())
        remarks.push_back(counted(report.without_place, " target has", " targets have") + " no place");
    if (report.without_stamp > 0)
        remarks.push_back(counted(report.without_stamp, " frame is", " frames are") +
                          " left out: no stamp in the video belongs to the picture");
    remarks.push_back("written from what is publicly known about ST 0903.5; not checked with a validator");
    return remarks;
}

}  // namespace eyrie
