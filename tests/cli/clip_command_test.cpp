#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cli/loaded_program.h"
#include "io/atomic_file.h"
#include "io/video/frame_source.h"
#include "io/video/video_writer.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "support/temporary_folder.h"

namespace eyrie::clip_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kVideoFrames = 250;
const cv::Size kVideoSize(320, 200);

int brightnessOf(int frame) {
    return 20 + frame / 2;
}

/// What a run found in a real file: grey pictures that grow brighter frame by frame, and one vehicle that drives to
/// x = 150 by frame 100 and stands there. Made once for all tests.
struct MadeClip {
    MadeClip() {
        VideoWriterOptions options;
        options.quality = 4;
        VideoWriter video(folder / "clip.mp4", kVideoSize, options);
        for (int frame = 0; frame < kVideoFrames; ++frame)
            video.write(cv::Mat(kVideoSize, CV_8UC3, cv::Scalar::all(brightnessOf(frame))));
        video.finish();
        RunRecord run;
        run.sequence = {.path = (folder / "clip.mp4").string(),
                        .size = kVideoSize,
                        .frame_count = kVideoFrames,
                        .frame_rate_hz = 25};
        run.last_frame = kVideoFrames - 1;
        run.scale = {0.2, 25, true};
        ProjectFile::create(folder / "p.eyrie");
        ResultWriter writer(folder / "p.eyrie", run, {});
        for (int frame = 0; frame < kVideoFrames; ++frame) {
            FrameResult result;
            result.motion.frame = frame;
            result.motion.time_us = frame * 40'000LL;
            result.motion.image_size = kVideoSize;
            auto& registration = result.motion.registration;
            registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
            registration.current_from_previous.from_frame = std::max(0, frame - 1);
            registration.current_from_previous.to_frame = frame;
            TrackState track;
            track.id = 5;
            track.box = {{std::min(150.0, 50.0 + frame), 100}, 22, 9, 0};
            track.velocity = {frame < 100 ? 1.0 : 0.0, 0};
            track.status = TrackStatus::confirmed;
            result.tracks.push_back(track);
            writer.write(result);
        }
        writer.finish(RunState::finished, "");
    }
    const test::TemporaryFolder folder;
};

class HandedOver : public testing::Test {
 protected:
    HandedOver() {
        static const MadeClip made;
        for (const char* name : {"clip.mp4", "p.eyrie"}) std::filesystem::copy_file(made.folder / name, folder_ / name);
        ProjectFile project = ProjectFile::open(folder_ / "p.eyrie");
        project.database().exec("UPDATE sequence SET path = '" + at("clip.mp4") + "'");
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    /// Words that begin with "@" are paths in the folder.
    test::ProcessResult call(std::vector<std::string> arguments) const {
        for (std::string& word : arguments) {
            if (word.starts_with('@')) word = at(word.substr(1));
        }
        return test::runLoaded(arguments);
    }
    /// How many frames a clip has, and how bright its first one is far from the vehicle.
    std::pair<int, int> framesAndBrightness(const std::string& name) const {
        const auto source = openSource(folder_ / name);
        return {source->info().frame_count, source->read(0, false).gray.at<unsigned char>(10, 10)};
    }
    test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(HandedOver, FramesAreCutOut) {
    const auto result = call({"clip", "--project", "@p.eyrie", "--frames", "40:69", "--out", "@part.mp4", "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("frames 40 to 69"));
    const auto [frames, brightness] = framesAndBrightness("part.mp4");
    EXPECT_EQ(frames, 30);
    EXPECT_NEAR(brightness, brightnessOf(40), 3);
}

TEST_F(HandedOver, AnEventIsCutOutWithTwoSecondsBeforeAndAfter) {
    const auto list = call({"events", "--project", "@p.eyrie", "--kind", "stops", "--csv", "@e.csv"});
    ASSERT_EQ(list.exit_code, 0) << list.errors;
    std::ifstream table(at("e.csv"));
    std::string line;
    std::getline(table, line);
    ASSERT_TRUE(std::getline(table, line)) << "no event";
    const std::string before_utc = line.substr(0, line.rfind(','));
    const std::string number = before_utc.substr(before_utc.rfind(',') + 1);
    const int first = std::stoi(line.substr(line.find(',') + 1));
    EXPECT_NEAR(first, 100, 10);
    const auto result = call({"clip", "--project", "@p.eyrie", "--event", number, "--out", "@stop.mp4", "--quiet"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto [frames, brightness] = framesAndBrightness("stop.mp4");
    EXPECT_EQ(frames, 101) << "of a moment: 50 frames before, 50 after";
    EXPECT_NEAR(brightness, brightnessOf(first - 50), 3);
    const auto wide = call({"clip", "--project", "@p.eyrie", "--event", number, "--around", "60", "--out", "@wide.mp4",
                            "--quiet", "--overlay"});
    ASSERT_EQ(wide.exit_code, 0) << wide.errors;
    EXPECT_EQ(framesAndBrightness("wide.mp4").first, kVideoFrames) << "no more than there are";
}

TEST_F(HandedOver, TheOverlayIsDrawnOnlyWhereItIsAskedFor) {
    ASSERT_EQ(call({"clip", "--project", "@p.eyrie", "--frames", "120:121", "--out", "@plain.mp4"}).exit_code, 0);
    ASSERT_EQ(
        call({"clip", "--project", "@p.eyrie", "--frames", "120:121", "--overlay", "--out", "@drawn.mp4"}).exit_code,
        0);
    const cv::Mat plain = openSource(folder_ / "plain.mp4")->read(0, false).gray;
    const auto drawn_source = openSource(folder_ / "drawn.mp4");
    const cv::Mat drawn = drawn_source->read(0, false).gray;
    double low = 0, high = 0;
    cv::minMaxLoc(plain, &low, &high);
    EXPECT_LT(high - low, 12);
    EXPECT_EQ(drawn.size(), kVideoSize * 3) << "enlarged, so that numbers can be read";
    cv::minMaxLoc(drawn, &low, &high);
    EXPECT_GT(high - low, 40);
}

TEST_F(HandedOver, WhatCannotBeCutIsSaid) {
    const auto expect = [&](std::vector<std::string> more, int code, const std::string& words) {
        std::vector<std::string> all{"clip", "--project", "@p.eyrie", "--quiet"};
        all.insert(all.end(), more.begin(), more.end());
        const auto result = call(all);
        EXPECT_EQ(result.exit_code, code) << words;
        EXPECT_THAT(result.errors, HasSubstr(words));
    };
    expect({"--out", "@x.mp4"}, 2, "--event N or --frames A:B");
    expect({"--event", "1", "--frames", "1:2", "--out", "@x.mp4"}, 2, "--frames");
    expect({"--event", "99", "--out", "@x.mp4"}, 2, "the events 1 to");
    expect({"--event", "0", "--out", "@x.mp4"}, 2, "the events 1 to");
    expect({"--frames", "0:250", "--out", "@x.mp4"}, 2, "0 to 249");
    expect({"--frames", "0:9", "--around", "-1", "--out", "@x.mp4"}, 2, "--around");
    expect({"--frames", "0:9", "--out", "@clip.mp4", "--force"}, 4, "is read by this command");
    expect({"--frames", "0:9", "--out", "@p.eyrie"}, 4, "is read by this command");
    std::filesystem::remove(at("clip.mp4"));
    expect({"--frames", "0:9", "--out", "@x.mp4"}, 3, "clip.mp4");
    EXPECT_FALSE(std::filesystem::exists(at("x.mp4")));
}

TEST_F(HandedOver, TheReportOfEventsIsOneFileWithPictures) {
    const auto result = call({"report", "--project", "@p.eyrie", "--events", "--verdict", "all", "--out", "@r.html",
                              "--start", "2009-01-12T22:08:22Z"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const std::string html = readWholeFile(at("r.html"));
    EXPECT_THAT(html, AllOf(HasSubstr("data:image/jpeg;base64,"), HasSubstr("2009-01-12T22:08:2"), HasSubstr("stops")));
    const auto none = call({"report", "--project", "@p.eyrie", "--events", "--out", "@n.html"});
    EXPECT_EQ(none.exit_code, 0) << none.errors;
    EXPECT_THAT(none.output, HasSubstr("0 of "));
    EXPECT_THAT(none.errors, HasSubstr("No event fits the choice; --verdict all"));
    const auto untagged =
        call({"report", "--project", "@p.eyrie", "--events", "--verdict", "all", "--tag", "bus", "--out", "@t.html"});
    EXPECT_EQ(untagged.exit_code, 0) << untagged.errors;
    EXPECT_THAT(untagged.errors, AllOf(HasSubstr("No event fits the choice\n"), Not(HasSubstr("--verdict"))));
}

TEST_F(HandedOver, TracksHaveMetresAndTimesOrARefusal) {
    const auto table = call({"export", "--project", "@p.eyrie", "--format", "tracks-csv", "--out", "@t.csv", "--start",
                             "2009-01-12T22:08:22Z"});
    ASSERT_EQ(table.exit_code, 0) << table.errors;
    EXPECT_THAT(readWholeFile(at("t.csv")),
                HasSubstr("\n5,25,1,2009-01-12T22:08:23.000000Z,75,100,22,9,0,0,15,20,,,18,"));
    for (const char* format : {"geojson", "kml", "stanag4676"}) {
        const auto refused = call({"export", "--project", "@p.eyrie", "--format", format, "--out", "@x"});
        EXPECT_EQ(refused.exit_code, 3) << format;
        EXPECT_THAT(refused.errors, AllOf(HasSubstr("where on earth"), HasSubstr("no metadata"))) << format;
        EXPECT_FALSE(std::filesystem::exists(at("x"))) << format;
    }
    EXPECT_EQ(call({"export", "--project", "@p.eyrie", "--format", "kw18", "--out", "@t.kw18"}).exit_code, 0);
}

}  // namespace eyrie::clip_command_test
