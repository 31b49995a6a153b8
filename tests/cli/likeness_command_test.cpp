/// eyrie-cli events --like: which tracks are like one.
#include <gmock/gmock.h>

#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/events_folder.h"

namespace eyrie::likeness_command_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class LikenessCommand : public test::EventsFolder {};

}  // namespace

TEST_F(LikenessCommand, TracksLikeOneAreListedByLikeness) {
    writeTraffic();
    const auto result = call({"--project", "@traffic.eyrie", "--like", "1", "--csv", "@like.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.errors, "");
    EXPECT_THAT(result.output,
                StartsWith("track    likeness  path   speed  size   frames          clock\n3        1.00 "));
    EXPECT_THAT(result.output, HasSubstr("\n2        0.00      0.00   1.00   1.00   0-99            0:00.0\n"));
    EXPECT_THAT(result.output, HasSubstr("\n2 other tracks, by likeness to track 1\n"));
    const std::string table = textOf("like.csv");
    EXPECT_THAT(
        table,
        StartsWith("track,first_frame,last_frame,start_s,end_s,likeness,path,speed,size,looks\n3,100,199,4,7.96,1,"));
    EXPECT_THAT(table, HasSubstr("\n2,0,99,0,3.96,0,0,"));
}

TEST_F(LikenessCommand, WhatCountsForLikenessIsChosen) {
    writeTraffic();
    // In size 2 is like 1 as 3 is; in the path it is not.
    const auto size = call({"--project", "@traffic.eyrie", "--like", "1", "--like-by", "size,speed"});
    EXPECT_EQ(size.exit_code, 0) << size.errors;
    EXPECT_EQ(size.errors, "");
    EXPECT_THAT(size.output, HasSubstr("\n2        1.00 "));
    const auto path = call({"--project", "@traffic.eyrie", "--like", "1", "--like-by", "path"});
    EXPECT_THAT(path.output, AllOf(HasSubstr("\n2        0.00 "), Not(HasSubstr("looks"))));
    const auto wrong = call({"--project", "@traffic.eyrie", "--like", "1", "--like-by", "path,colour"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_THAT(wrong.errors, AllOf(HasSubstr("colour"), HasSubstr("path, speed, size, looks")));
    EXPECT_EQ(call({"--project", "@traffic.eyrie", "--like-by", "path"}).exit_code, 2) << "like which?";
    EXPECT_EQ(call({"--project", "@traffic.eyrie", "--like", "1", "--tag", "lorry"}).exit_code, 2) << "tags of events";
}

TEST_F(LikenessCommand, PicturesForLooksThatCannotBeReadAreToldAndTheRestCounts) {
    writeTraffic();
    const auto result = call(
        {"--project", "@traffic.eyrie", "--like", "1", "--like-by", "path,speed,size,looks", "--csv", "@like.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, AllOf(HasSubstr("what vehicles look like does not count, or only in part"),
                                     HasSubstr("pictures could not be read: "), HasSubstr("clip.mp4")));
    EXPECT_THAT(result.output, StartsWith("track    likeness  path   speed  size   looks  frames          clock\n"
                                          "3        1.00 "));
    EXPECT_THAT(result.output, HasSubstr(" 1.00   1.00   -      0-99 "));
    EXPECT_THAT(textOf("like.csv"), HasSubstr(",\n2,0,99,")) << "nothing is known of the looks";
}

TEST_F(LikenessCommand, TracksAreComparedByTheirLooksInThePictures) {
    constexpr int kPictures = 16;
    std::filesystem::create_directories(folder_ / "frames");
    const std::map<TrackId, cv::Scalar> paints{{1, {40, 40, 200}}, {2, {200, 60, 40}}, {3, {40, 40, 200}}};
    const auto placeOf = [](TrackId id, int frame) { return cv::Point(30 + frame, 30 * id); };
    for (int frame = 0; frame < kPictures; ++frame) {
        cv::Mat picture(120, 160, CV_8UC3, cv::Scalar::all(110));
        for (const auto& [id, paint] : paints)
            cv::rectangle(picture, cv::Rect(placeOf(id, frame) - cv::Point(11, 4), cv::Size(23, 9)), paint, cv::FILLED);
        cv::imwrite(at("frames/" + std::to_string(100 + frame) + ".png"), picture);
    }
    test::writeRun(folder_ / "looks.eyrie", runOver(at("frames"), {160, 120}, kPictures),
                   [&](int frame, FrameResult& result) {
                       result.motion.time_us = frame * 40000LL;
                       for (const auto& [id, paint] : paints) addTrack(result, id, {placeOf(id, frame), 23, 9, 0});
                   });
    const auto result = call({"--project", "@looks.eyrie", "--like", "1", "--like-by", "looks", "--csv", "@like.csv"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.errors, Not(HasSubstr("could not be read")));
    EXPECT_THAT(result.output, StartsWith("track    likeness  path   speed  size   looks  frames          clock\n3 "));
    std::map<std::string, double> looks;
    std::istringstream table(textOf("like.csv"));
    std::string line;
    std::getline(table, line);
    while (std::getline(table, line)) looks[line.substr(0, 1)] = std::stod(line.substr(line.rfind(',') + 1));
    EXPECT_GT(looks["3"], 0.9) << "of the same red";
    EXPECT_LT(looks["2"], 0.5) << "it is blue";
}

TEST_F(LikenessCommand, TracksThatAreNotThereAreLikeNone) {
    writeTraffic();
    const auto none = call({"--project", "@traffic.eyrie", "--like", "77", "--csv", "@like.csv"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.errors, HasSubstr("no track 77"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "like.csv"));
    for (const char* wrong : {"1.5", "car", "", "99999999999999999999"}) {
        EXPECT_EQ(call({"--project", "@traffic.eyrie", "--like", wrong}).exit_code, 2) << wrong;
    }
    EXPECT_EQ(call({"--project", "@traffic.eyrie", "--like", "-1"}).exit_code, 2);
    EXPECT_EQ(call({"--project", "@traffic.eyrie", "--like", "1", "--kind", "stops"}).exit_code, 2)
        << "what it lists is no events";
    EXPECT_EQ(call({"--project", "@traffic.eyrie", "--like", "1", "--csv", "@traffic.eyrie"}).exit_code, 4);
    writeProject("p.eyrie", true, -1);
    const auto alone = call({"--project", "@p.eyrie", "--like", "5"});
    EXPECT_EQ(alone.exit_code, 0);
    EXPECT_THAT(alone.output, HasSubstr("0 other tracks"));
}

}  // namespace eyrie::likeness_command_test
