#include "exchange/vmti_export.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <opencv2/core.hpp>

#include "core/error.h"
#include "formats/track_world.h"
#include "io/video/data_streams.h"
#include "io/video/video_writer.h"
#include "metadata/vmti/vmti_set.h"
#include "support/temporary_folder.h"
#include "support/vmti_reading.h"

namespace eyrie::vmti_export_test {
namespace {

constexpr int kFilmFrames = 30;
constexpr std::int64_t kFilmBegin = 1'700'000'000'000'000;

struct PlacedFrame {
    std::int64_t stamp_us;
    int pictures_before;
    vmti::Frame frame;
};

class VmtiExport : public testing::Test {
 protected:
    void film(const std::string& name, const VideoWriterOptions& options = {}) {
        video_ = folder_ / name;
        VideoWriter writer(video_, {160, 120}, options);
        for (int i = 0; i < kFilmFrames; ++i) {
            cv::Mat image(120, 160, CV_8UC3, cv::Scalar(90, 90, 90));
            for (int x = 0; x < 160; ++x) image.col(x).setTo(cv::Scalar::all((x * 3 + 5 * i) % 200));
            writer.write(image);
        }
        writer.finish();
    }
    /// One car in frames 5 … 9 and 12 … 20.
    LabelStream car(bool times = true, bool places = false) {
        LabelStream labels;
        auto world = std::make_shared<TrackWorld>();
        world->seconds = [](FrameIndex frame) { return frame / 25.0; };
        if (times) {
            world->utc_us = [](FrameIndex frame) { return kFilmBegin + 40'000 * std::int64_t{frame}; };
            world->clock_origin = "given";
        } else {
            world->no_clock = "nobody said when";
        }
        if (places) {
            world->place = [](FrameIndex, cv::Point2d px) -> std::optional<GeoPoint> {
                return GeoPoint{48 - px.y * 1e-6, 11 + px.x * 1e-6};
            };
            world->place_origin = "made up";
        }
        labels.about.world = world;
        labels.frames = [](const FrameVisitor& visit) {
            for (FrameIndex frame = 5; frame <= 20; ++frame) {
                if (frame == 10 || frame == 11) continue;
                LabelBox box;
                box.frame = frame;
                box.id = 7;
                box.box = {{20.0 + 3 * frame, 60}, 20, 10, 0};
                box.score = 0.75;
                box.velocity = {3, 0};
                visit(frame, {box});
            }
        };
        return labels;
    }
    VmtiReport copy(const LabelStream& labels) {
        const auto source = openSource(video_, {.index_folder = folder_ / "index"});
        return writeVmti(labels, *source, out_);
    }
    /// Why there is no copy.
    std::string refusal() {
        try {
            copy(car());
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return error.what();
        }
        return "nothing was refused";
    }
    /// What lies at its place or beside it.
    int filesOfTheCopy() {
        int files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
            files += entry.path().filename().string().find("copy.ts") != std::string::npos ? 1 : 0;
        return files;
    }
    std::vector<PlacedFrame> setsOf(const std::filesystem::path& path) {
        std::vector<PlacedFrame> frames;
        std::map<int, klv::Splitter> splitters;
        readDataStreams(path, [&](const DataPacket& packet) {
            splitters[packet.stream].feed(packet.bytes, [&](const klv::Set& set) -> std::optional<klv::Fault> {
                if (!vmti::isKey(set.key)) return std::nullopt;
                PlacedFrame placed{packet.stamp_us, packet.pictures_before, {}};
                int unreadable = 0;
                const auto fault = vmti::read(set, placed.frame, unreadable);
                EXPECT_EQ(unreadable, 0);
                if (!fault) frames.push_back(placed);
                return fault;
            });
        });
        return frames;
    }
    test::TemporaryFolder folder_;
    std::filesystem::path video_;
    std::filesystem::path out_ = folder_ / "copy.ts";
};

TEST_F(VmtiExport, EveryFrameOfTheTracksHasASetAtTheTimeOfItsPicture) {
    for (const char* name : {"film.ts", "film.mp4"}) {
        film(name);
        const VmtiReport report = copy(car(true, true));
        EXPECT_EQ(report.frames, 16) << "with two empty ones between";
        EXPECT_EQ(report.targets, 14);
        const auto sets = setsOf(out_);
        ASSERT_EQ(sets.size(), 16U) << name;
        const auto copied = openSource(out_, {.index_folder = folder_ / "index"});
        ASSERT_EQ(copied->info().frame_count, kFilmFrames) << name;
        std::map<std::int64_t, std::int64_t> stamps;  // of the copy's frames by their time
        for (const PictureStamp& picture : copied->pictureStamps()) stamps[picture.time_us] = picture.stamp_us;
        for (std::size_t i = 0; i < sets.size(); ++i) {
            const auto frame = static_cast<FrameIndex>(5 + i);
            const vmti::Frame& set = sets[i].frame;
            EXPECT_EQ(set.number, static_cast<unsigned>(frame));
            EXPECT_EQ(set.utc_us, kFilmBegin + 40'000 * frame);
            EXPECT_EQ(set.size, cv::Size(160, 120));
            EXPECT_NEAR(static_cast<double>(sets[i].stamp_us), static_cast<double>(stamps.at(copied->timeOf(frame))),
                        12)
                << name << ", frame " << frame;
            EXPECT_LE(sets[i].pictures_before, frame + 4) << "it comes before its picture, but for reordered ones";
            if (frame == 10 || frame == 11) {
                EXPECT_TRUE(set.targets.empty());
                continue;
            }
            ASSERT_EQ(set.targets.size(), 1U);
            const vmti::Target& target = set.targets[0];
            EXPECT_EQ(target.id, 7U);
            EXPECT_EQ(target.centre, cv::Point(20 + 3 * frame, 60));
            EXPECT_EQ(target.top_left, cv::Point(10 + 3 * frame, 55)) << "integers are the middles of pixels";
            EXPECT_EQ(target.bottom_right, cv::Point(30 + 3 * frame, 65)) << "the last that is touched";
            EXPECT_EQ(target.confidence_percent, 75);
            EXPECT_EQ(target.seen_before, frame < 10 ? frame - 5 : frame - 7);
            // A step of the code for longitudes is 2.4e-7.
            EXPECT_NEAR(target.place->longitude_deg, 11 + (20 + 3 * frame) * 1e-6, 2.5e-7);
            EXPECT_EQ(target.track, sets[0].frame.targets[0].track) << "one name for the whole track";
            if (std::string(name) == "film.ts") {
                // FNV-1a of the name, what the begin adds to it, version 8, and the number in the end: the same always.
                const std::array<std::uint8_t, 16> known{0xa4, 0x5d, 0xf8, 0x72, 0x3a, 0x44, 0x82, 0xe2,
                                                         0x80, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x07};
                EXPECT_EQ(target.track, known);
            }
            EXPECT_EQ(target.first_utc_us, kFilmBegin + 200'000);
            EXPECT_EQ(target.last_utc_us, set.utc_us) << "as far as is known by then";
            EXPECT_EQ(target.detection, vmti::Detection::active);
            // 3e-6 degrees of longitude a frame at 48 degrees north are 0.2239 m, 25 times a second.
            ASSERT_TRUE(target.velocity);
            EXPECT_NEAR(target.velocity->east_m_s, 5.6, 0.1);
            EXPECT_NEAR(target.velocity->north_m_s, 0, 0.1);
        }
    }
}

TEST_F(VmtiExport, TheVideoIsCopiedWhileTheTracksAreReadSoThatNothingPilesUp) {
    film("film.ts");
    const auto source = openSource(video_, {.index_folder = folder_ / "index"});
    LabelStream labels = car();
    double copied = 0;
    double copied_at_last_frame = 0;
    labels.frames = [&, all = labels.frames](const FrameVisitor& visit) {
        all([&](FrameIndex frame, const std::vector<LabelBox>& boxes) {
            visit(frame, boxes);
            copied_at_last_frame = copied;
        });
    };
    writeVmti(labels, *source, out_, [&](double share) { copied = share; });
    EXPECT_GT(copied_at_last_frame, 0);
}

TEST_F(VmtiExport, PicturesAreCopiedToTheBit) {
    film("film.ts");
    copy(car());
    const auto before = openSource(video_, {.index_folder = folder_ / "index"});
    const auto after = openSource(out_, {.index_folder = folder_ / "index"});
    for (const FrameIndex frame : {0, 7, 29}) {
        const cv::Mat a = before->read(frame, false).gray;
        const cv::Mat b = after->read(frame, false).gray;
        EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0) << frame;
        EXPECT_EQ(before->timeOf(frame), after->timeOf(frame));
    }
}

TEST(VmtiRemarks, TellWhatIsMissingWhereSomethingIs) {
    VmtiReport report;
    report.clock_origin = "the video";
    const std::string last = "written from what is publicly known about ST 0903.5; not checked with a validator";
    EXPECT_THAT(remarksOn(report, "none"), testing::ElementsAre("times: the video", "places: none", last));
    report.without_place = 3;
    EXPECT_EQ(remarksOn(report, "none").size(), 3U) << "that none has a place is told already";
    report.place_origin = "the map";
    report.without_stamp = 1;
    EXPECT_THAT(remarksOn(report, "none"),
                testing::ElementsAre("times: the video", "places: the map", "3 targets have no place",
                                     "1 frame is left out: no stamp in the video belongs to the picture", last));
    report.without_place = 1;
    report.without_stamp = 2;
    EXPECT_THAT(remarksOn(report, "none"),
                testing::ElementsAre("times: the video", "places: the map", "1 target has no place",
                                     "2 frames are left out: no stamp in the video belongs to the picture", last));
}

/// One frame with boxes of every kind.
TEST_F(VmtiExport, TargetsSayWhatIsKnownOfEach) {
    film("film.ts");
    LabelStream labels = car(true, true);
    auto world = std::make_shared<TrackWorld>(*labels.about.world);
    // Places are known in the left half, heights in even frames, of one kind only in each fourth.
    world->place = [](FrameIndex, cv::Point2d px) -> std::optional<GeoPoint> {
        if (px.x > 80) return std::nullopt;
        return GeoPoint{48 - px.y * 1e-6, 11 + px.x * 1e-6};
    };
    world->height = [](FrameIndex frame) -> std::optional<TrackWorld::Height> {
        if (frame % 2 != 0) return std::nullopt;
        return TrackWorld::Height{100.0 + frame, frame % 4 == 0};
    };
    labels.about.world = world;
    labels.frames = [](const FrameVisitor& visit) {
        for (FrameIndex frame = 4; frame <= 7; ++frame) {
            std::vector<LabelBox> boxes(6);
            for (std::size_t k = 0; k < boxes.size(); ++k) {
                LabelBox& box = boxes[k];
                box.frame = frame;
                box.id = static_cast<int>(k);
                box.box = {{20.4 + 20 * static_cast<double>(k), 50.6}, 10.5, 6.25, 0};
                box.score = std::array{-0.5, 0.004, 0.996, 1.5, 0.5, 0.126}[k];
            }
            boxes[1].origin = StateOrigin::standing;
            boxes[2].velocity = {0, 3};
            boxes[4].id.reset();
            boxes[5].id = -1;
            if (frame == 5) boxes.erase(boxes.begin());
            visit(frame, boxes);
        }
        LabelBox far;  // behind the video
        far.frame = kFilmFrames + 1;
        far.id = 9;
        far.box = {{20, 50}, 10, 6, 0};
        visit(far.frame, {far});
    };
    const VmtiReport report = copy(labels);
    EXPECT_EQ(report.frames, kFilmFrames - 4) << "empty ones up to the end";
    EXPECT_EQ(report.without_stamp, 2);
    EXPECT_EQ(report.targets, 4 * 4 - 1);
    EXPECT_EQ(report.without_place, 4) << "one a frame lies beyond 80 px";
    EXPECT_EQ(report.clock_origin, "given");
    EXPECT_EQ(report.place_origin, "made up");
    const auto sets = setsOf(out_);
    ASSERT_EQ(sets.size(), static_cast<std::size_t>(kFilmFrames - 4));
    for (std::size_t i = 0; i < 4; ++i) {
        const auto frame = static_cast<FrameIndex>(4 + i);
        const auto& targets = sets[i].frame.targets;
        ASSERT_EQ(targets.size(), frame == 5 ? 3U : 4U);
        for (const vmti::Target& target : targets) {
            const double x = 20.4 + 20.0 * target.id;
            EXPECT_EQ(target.centre, cv::Point(20 + 20 * static_cast<int>(target.id), 51));
            EXPECT_EQ(target.top_left, cv::Point(static_cast<int>(std::floor(x - 5.25 + 0.5)), 47));
            EXPECT_EQ(target.bottom_right, cv::Point(static_cast<int>(std::ceil(x + 5.25 + 0.5)) - 1, 54));
            const std::array<int, 4> percent{0, 0, 100, 100};
            EXPECT_EQ(target.confidence_percent, percent[target.id]);
            EXPECT_EQ(target.seen_before, target.id == 0 && frame > 5 ? frame - 5 : frame - 4);
            EXPECT_EQ(target.place.has_value(), x <= 80);
            EXPECT_EQ(target.ellipsoid_height_m.has_value(), frame == 4 && x <= 80);
            if (target.ellipsoid_height_m) {
                EXPECT_NEAR(*target.ellipsoid_height_m, 104, 0.2);
            }
            EXPECT_EQ(target.detection, target.id == 1 ? vmti::Detection::stopped : vmti::Detection::active);
            EXPECT_EQ(target.first_utc_us, kFilmBegin + 160'000);
            EXPECT_EQ(target.last_utc_us, kFilmBegin + 40'000 * frame);
            EXPECT_EQ(target.velocity.has_value(), target.id == 2);
            if (target.velocity) {
                // 3 px are 3e-6 degrees of latitude or 0.3336 m to the south, 25 times a second.
                EXPECT_NEAR(target.velocity->north_m_s, -8.34, 0.1);
                EXPECT_NEAR(target.velocity->east_m_s, 0, 0.1);
            }
        }
    }
}

TEST_F(VmtiExport, TheVelocityPointsWhereTheTrackGoes) {
    film("film.ts");
    LabelStream labels = car(true, true);
    static const std::array<cv::Point2d, 4> kWays{{{3, 0}, {2, -3}, {-3, -1}, {-1, 2}}};
    labels.frames = [](const FrameVisitor& visit) {
        std::vector<LabelBox> boxes(4);
        for (std::size_t k = 0; k < boxes.size(); ++k) {
            boxes[k].frame = 3;
            boxes[k].id = static_cast<int>(k);
            boxes[k].box = {{40, 50}, 10, 6, 0};
            boxes[k].velocity = kWays[k];
        }
        visit(3, boxes);
    };
    copy(labels);
    const auto sets = setsOf(out_);
    ASSERT_EQ(sets.size(), 1U);
    ASSERT_EQ(sets[0].frame.targets.size(), 4U);
    for (const vmti::Target& target : sets[0].frame.targets) {
        const cv::Point2d px = kWays[target.id];
        ASSERT_TRUE(target.velocity);
        EXPECT_NEAR(target.velocity->east_m_s, px.x * 25 * 0.0746, 0.1) << target.id;
        EXPECT_NEAR(target.velocity->north_m_s, -px.y * 25 * 0.1112, 0.1) << target.id;
    }
}

TEST_F(VmtiExport, WithoutTimesNothingIsWritten) {
    film("film.ts");
    try {
        copy(car(false));
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), testing::HasSubstr("nobody said when"));
    }
    EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(VmtiExport, WhatNoTransportStreamCarriesIsRefusedAndNothingIsLeft) {
    std::ofstream(out_) << "earlier";
    for (const char* codec : {"ffv1", "mjpeg"}) {
        VideoWriterOptions options;
        options.codec = codec;
        film(std::string(codec) + ".avi", options);
        EXPECT_THAT(refusal(), testing::AllOf(testing::HasSubstr(".avi: a transport stream cannot carry its codec (" +
                                                                 std::string(codec) + ")"),
                                              testing::HasSubstr("H.264")));
        EXPECT_EQ(filesOfTheCopy(), 1) << "no part beside it";
    }
}

TEST_F(VmtiExport, ACopyThatWouldLackPicturesIsRefused) {
    film("film.ts");
    std::string bytes;
    {
        std::ifstream file(video_, std::ios::binary);
        bytes.assign(std::istreambuf_iterator<char>(file), {});
    }
    // Twice the same: in its midst the stamps go back.
    std::ofstream(video_, std::ios::binary) << bytes << bytes;
    EXPECT_THAT(refusal(), testing::HasSubstr("film.ts: a picture cannot be copied"));
    EXPECT_EQ(filesOfTheCopy(), 0);
}

}  // namespace
}  // namespace eyrie::vmti_export_test
