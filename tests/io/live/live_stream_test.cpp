#include "io/live/live_stream.h"

#include <gmock/gmock.h>

#include <chrono>
#include <map>
#include <random>

#include "core/error.h"
#include "io/live/live_address.h"
#include "io/numbered_video.h"
#include "io/video/stream_copy.h"
#include "support/live_sender.h"
#include "support/live_server.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace eyrie::live_stream_test {
namespace {

using test::LiveSender;
using testing::HasSubstr;

/// Waits are short, so that the tests are; machines that have much to do still get some seconds.
class LiveStreams : public testing::Test {
 protected:
    std::filesystem::path film(const std::string& name, int frames, int first_number = 0, cv::Size size = {160, 64},
                               const std::string& codec = {}) {
        VideoWriterOptions options;
        options.codec = codec;
        options.key_frame_distance = 10;
        test::writeNumberedVideo(folder_ / name, frames, options, size, first_number);
        return folder_ / name;
    }
    LiveOptions options() const {
        LiveOptions options;
        options.recording = folder_ / "recorded.ts";
        options.connect_s = 10;
        options.stall_s = 1;
        options.give_up_s = 2;
        return options;
    }
    std::string address() const { return "udp://127.0.0.1:" + std::to_string(port_); }
    std::vector<int> recorded() const {
        return test::numbersOf(*openSource(folder_ / "recorded.ts", {.index_folder = folder_ / "index"}));
    }
    test::TemporaryFolder folder_;
    int port_ = test::freePort();
};

TEST_F(LiveStreams, FramesComeInOrderAndAreThoseOfTheRecording) {
    const LiveSender sender(port_, {{film("a.ts", 60), 1.5, 0.3}});
    LiveStream stream(address(), options(), {});
    EXPECT_EQ(stream.info().size, cv::Size(160, 64));
    EXPECT_NEAR(stream.info().frame_rate_hz, 25, 0.01);
    const std::vector<int> numbers = test::numbersOf(stream);
    ASSERT_GE(numbers.size(), 50U);
    for (std::size_t i = 1; i < numbers.size(); ++i) EXPECT_EQ(numbers[i], numbers[0] + static_cast<int>(i));
    EXPECT_EQ(recorded(), numbers);
    const LiveFacts facts = stream.facts();
    EXPECT_EQ(facts.skipped, 0);
    EXPECT_EQ(facts.frames, static_cast<int>(numbers.size()));
    EXPECT_THAT(facts.ended, HasSubstr("no picture came"));
}

TEST_F(LiveStreams, AfterAStallItIsConnectedToAgainAndTheRecordingGoesOn) {
    LiveOptions patient = options();
    patient.give_up_s = 4;
    const LiveSender sender(port_, {{film("a.ts", 40), 1, 0.3}, {film("b.ts", 40, 500), 1, 1.5}});
    LiveStream stream(address(), patient, {});
    const std::vector<int> numbers = test::numbersOf(stream);
    const LiveFacts facts = stream.facts();
    EXPECT_EQ(facts.reconnects, 1);
    EXPECT_GT(facts.longest_gap_s, 1);
    EXPECT_EQ(std::count(numbers.begin(), numbers.end(), 530), 1) << "frames after the stall";
    EXPECT_TRUE(std::is_sorted(numbers.begin(), numbers.end()));
    EXPECT_EQ(recorded(), numbers);
}

TEST_F(LiveStreams, ItsTimesRiseEvenWhereTheClockOfTheSenderIsSetBack) {
    // The second film begins with the stamps of the first.
    const LiveSender sender(port_, {{film("a.ts", 30), 0.7, 0.3}, {film("b.ts", 30, 100), 0.7}});
    LiveStream stream(address(), options(), {});
    std::int64_t last_us = -1;
    try {
        for (FrameIndex frame = 0;; ++frame) {
            const Frame read = stream.read(frame, false);
            EXPECT_EQ(read.index, frame);
            EXPECT_GT(read.time_us, last_us);
            EXPECT_LT(read.time_us, last_us + 1'000'000);
            last_us = read.time_us;
        }
    } catch (const StreamEnded&) {
    }
    EXPECT_GT(last_us, 1'500'000);
}

TEST_F(LiveStreams, AReaderThatIsBehindGetsRepeatsInPlaceOfWhatWasLeftOut) {
    LiveOptions narrow = options();
    narrow.waiting_frames = 5;
    const LiveSender sender(port_, {{film("a.ts", 60), 0.5, 0.3}});
    LiveStream stream(address(), narrow, {});
    test::waitUntil("the stream has ended", [&] { return !stream.facts().ended.empty(); });
    EXPECT_EQ(stream.backlog(), 1);
    int repeats = 0;
    cv::Mat last;
    FrameIndex frame = 0;
    try {
        for (;; ++frame) {
            const Frame read = stream.read(frame, false);
            repeats += !last.empty() && read.gray.data == last.data ? 1 : 0;
            last = read.gray;
        }
    } catch (const StreamEnded&) {
    }
    EXPECT_EQ(frame, stream.facts().frames);
    EXPECT_GE(frame, 50);
    EXPECT_EQ(repeats, stream.facts().skipped);
    EXPECT_EQ(frame - repeats, 5);
    EXPECT_EQ(recorded().size(), static_cast<std::size_t>(frame)) << "what was left out was recorded";
}

TEST_F(LiveStreams, APictureOfAnotherSizeEndsIt) {
    const LiveSender sender(port_, {{film("a.ts", 30), 0.7, 0.3}, {film("b.ts", 30, 0, {320, 128}), 0.7, 0.1}});
    LiveStream stream(address(), options(), {});
    const std::vector<int> numbers = test::numbersOf(stream);
    EXPECT_LE(numbers.size(), 31U);
    EXPECT_THAT(stream.facts().ended, HasSubstr("changed from 160×64 px to 320×128 px"));
}

TEST_F(LiveStreams, ACodecOrSizeThatIsAnotherAfterConnectingAgainEndsItAndIsNotRecorded) {
    const std::string first = test::bytesOf(film("a.ts", 30));
    for (const auto& [other, change] :
         {std::pair(film("b.ts", 30, 100, {160, 64}, "mpeg2video"), "the codec changed from h264 to mpeg2video"),
          std::pair(film("c.ts", 30, 100, {320, 128}), "the picture changed from 160×64 px to 320×128 px")}) {
        const test::LiveServer server({first, test::bytesOf(other)});
        LiveStream stream("tcp://" + server.place(), options(), {});
        const std::vector<int> numbers = test::numbersOf(stream);
        EXPECT_EQ(numbers.size(), 30U);
        EXPECT_EQ(stream.facts().ended, change + std::string(" after frame 29; start another run for it"));
        EXPECT_EQ(recorded(), numbers);
    }
}

TEST_F(LiveStreams, AFileOnTheNetEndsWhereItEnds) {
    const test::LiveServer server({test::LiveServer::httpReply(test::bytesOf(film("a.ts", 30))), {}});
    LiveStream stream("http://" + server.place() + "/a.ts", options(), {});
    EXPECT_EQ(test::numbersOf(stream).size(), 30U);
    EXPECT_THAT(stream.facts().ended, HasSubstr("the source has an end"));
    EXPECT_EQ(server.connections(), 1);
}

TEST_F(LiveStreams, AConnectionThatBreaksOffIsNoEnd) {
    const std::string whole = test::LiveServer::httpReply(test::bytesOf(film("a.ts", 30)));
    const test::LiveServer server({whole.substr(0, whole.size() / 2), whole});
    LiveStream stream("http://" + server.place() + "/a.ts", options(), {});
    EXPECT_GT(test::numbersOf(stream).size(), 30U);
    EXPECT_EQ(stream.facts().reconnects, 1);
}

TEST_F(LiveStreams, MetadataWithoutPicturesAreAStall) {
    // Far more of them than of pictures, so that they go on for half a minute after the last one.
    copyWithKlv(
        film("film.ts", 30),
        [](const TakePacket& take) {
            for (std::int64_t number = 0; number < 600; ++number)
                take({2'000'000 + 40'000 * number, std::vector<std::uint8_t>(1000, 7)});
        },
        folder_ / "a.ts");
    const LiveSender sender(port_, {{folder_ / "a.ts", 30, 0.3}});
    const auto begin = std::chrono::steady_clock::now();
    LiveStream stream(address(), options(), {});
    EXPECT_GE(test::numbersOf(stream).size(), 20U);
    EXPECT_THAT(stream.facts().ended, HasSubstr("no picture came for 2 s"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(25));
}

TEST_F(LiveStreams, WhatNeverShowsAPictureLeavesNoRecording) {
    // Without key frames nothing can be shown: the first slices of H.264 are made ordinary ones.
    std::string stream = test::bytesOf(film("a.ts", 60));
    const std::string key("\0\0\1\x65", 4);
    for (std::size_t at = stream.find(key); at != std::string::npos; at = stream.find(key, at)) stream[at + 3] = '\x61';
    const test::LiveServer server({stream});
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { LiveStream("tcp://" + server.place(), options(), {}); }),
                HasSubstr("ended before its first picture"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "recorded.ts"));
}

TEST_F(LiveStreams, ATrackThatIsSilentHoldsNothingOfTheRecordingBack) {
    copyWithKlv(
        film("film.ts", 60), [](const TakePacket&) {}, folder_ / "a.ts");
    const LiveSender sender(port_, {{folder_ / "a.ts", 2, 0.3}});
    LiveStream stream(address(), options(), {});
    for (FrameIndex frame = 0; frame < 25; ++frame) stream.read(frame, false);
    EXPECT_GT(std::filesystem::file_size(folder_ / "recorded.ts"), 1000U) << "after one second of video";
}

TEST_F(LiveStreams, WhatNoTransportStreamCarriesIsRefusedBeforeItIsRecorded) {
    const test::LiveServer server({test::bytesOf(film("a.mkv", 30, 0, {160, 64}, "mjpeg"))});
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { LiveStream("tcp://" + server.place(), options(), {}); }),
                testing::AllOf(HasSubstr("cannot carry the source's codec (mjpeg)"), HasSubstr("H.264")));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "recorded.ts"));
}

TEST_F(LiveStreams, WhatNeverAnswersIsToldInTimeAndRecordsNothing) {
    LiveOptions brief = options();
    brief.connect_s = 0.6;
    const auto begin = std::chrono::steady_clock::now();
    const std::string told = test::messageOf(ErrorKind::input, [&] { LiveStream(address(), brief, {}); });
    EXPECT_THAT(told, HasSubstr("nothing that could be read came within 1 s"));
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(8));
    // Nobody listens on the port: refused at once, or not answered in time.
    EXPECT_THAT(
        test::messageOf(ErrorKind::input, [&] { LiveStream("tcp://127.0.0.1:" + std::to_string(port_), brief, {}); }),
        HasSubstr("check the address"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "recorded.ts"));
}

TEST_F(LiveStreams, NoiseIsNoVideo) {
    std::mt19937 dice(3);
    std::string noise(200'000, '\0');
    for (char& byte : noise) byte = static_cast<char>(dice());
    test::writeBytes(folder_ / "noise.ts", noise);
    LiveOptions brief = options();
    brief.connect_s = 1;
    const LiveSender sender(port_, {{folder_ / "noise.ts", 0.5, 0.1}});
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { LiveStream(address(), brief, {}); }), HasSubstr(address()));
}

TEST_F(LiveStreams, ARecordingThatCannotBeWrittenIsTold) {
    LiveOptions nowhere = options();
    nowhere.recording = folder_ / "absent" / "recorded.ts";
    const test::LiveServer server({test::bytesOf(film("a.ts", 30))});
    EXPECT_THAT(test::messageOf(ErrorKind::output, [&] { LiveStream("tcp://" + server.place(), nowhere, {}); }),
                HasSubstr("recording cannot be written"));
}

TEST_F(LiveStreams, EndingItKeepsWhatCame) {
    const LiveSender sender(port_, {{film("a.ts", 200), 8, 0.3}});
    std::stop_source stop;
    LiveStream stream(address(), options(), stop.get_token());
    std::vector<int> numbers;
    try {
        for (FrameIndex frame = 0;; ++frame) {
            numbers.push_back(test::numberIn(stream.read(frame, false).gray));
            if (frame == 20) stop.request_stop();
        }
    } catch (const StreamEnded&) {
    }
    EXPECT_GE(numbers.size(), 21U);
    EXPECT_LT(numbers.size(), 150U);
    stream.finish();
    EXPECT_EQ(recorded(), numbers);
}

TEST_F(LiveStreams, TheSpaceThatIsLeftIsToldAndTooLittleEndsIt) {
    LiveOptions full = options();
    full.least_free_bytes = UINT64_MAX;
    try {
        const LiveStream stream(address(), full, {});
        FAIL() << "there is no such disk";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
        EXPECT_THAT(error.what(), HasSubstr("MB left; make room, or choose another place"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder_ / "recorded.ts"));
    const LiveSender sender(port_, {{film("a.ts", 60), 1.5, 0.3}});
    LiveStream stream(address(), options(), {});
    test::numbersOf(stream);
    EXPECT_GT(stream.facts().free_bytes, 0U);
    EXPECT_EQ(stream.facts().recorded_bytes, std::filesystem::file_size(folder_ / "recorded.ts"));
}

TEST_F(LiveStreams, WhileNothingComesItSaysForHowLongAndThatItConnectsAgain) {
    LiveOptions patient = options();
    patient.give_up_s = 8;
    const LiveSender sender(port_, {{film("a.ts", 40), 1, 0.3}});
    LiveStream stream(address(), patient, {});
    EXPECT_TRUE(stream.facts().connected);
    test::waitUntil("the connection is lost", [&] { return !stream.facts().connected; });
    EXPECT_GT(stream.facts().silent_s, 1);
    EXPECT_TRUE(stream.facts().ended.empty());
    stream.finish();
}

TEST_F(LiveStreams, FramesCarryColourWhereItIsWanted) {
    LiveOptions coloured = options();
    coloured.with_colour = true;
    const LiveSender sender(port_, {{film("a.ts", 40), 1, 0.3}});
    LiveStream stream(address(), coloured, {});
    const Frame frame = stream.read(0, true);
    EXPECT_EQ(frame.colour.type(), CV_8UC3);
    EXPECT_EQ(frame.colour.size(), frame.gray.size());
    stream.finish();
}

TEST(LiveAddresses, SayWhatIsWrongWithThemAndWhatTheyLookLike) {
    for (const char* good : {"rtsp://camera/stream", "rtsp://me:secret@camera:554/s", "udp://@239.0.0.1:5000",
                             "udp://:5000", "udp://0.0.0.0:5000?ttl=2", "srt://[::1]:9000", "http://camera/film.ts",
                             "/dev/video0", "camera:0", "/dev/v4l/by-id/usb-camera-index0", "camera:/dev/any"})
        EXPECT_EQ(faultOfAddress(good), "") << good;
    const std::map<std::string, std::string> faults{{"", "an address is needed"},
                                                    {"camera", "rtsp://camera"},
                                                    {"/films/a.mp4", "Open video"},
                                                    {"/dev/null", "“/dev/null” is no camera"},
                                                    {"camera:", "camera:0 or /dev/video0"},
                                                    {"camera:front", "camera:0 or /dev/video0"},
                                                    {"rtsp:// camera", "no blanks"},
                                                    {"file:///etc/passwd", "“file” is not known"},
                                                    {"rtsp:///stream", "the name of the sender is missing"},
                                                    {"http://:80/x", "the name of the sender is missing"},
                                                    {"udp://239.0.0.1", "udp://239.0.0.1:5000"},
                                                    {"udp://", "the port is missing"},
                                                    {"srt://[::1]", "the port is missing"},
                                                    {"tcp://camera:0", "“0” is not a port"},
                                                    {"tcp://camera:port", "“port” is not a port"},
                                                    {"rtsp://camera:99999/x", "“99999” is not a port"}};
    for (const auto& [address, fault] : faults) EXPECT_THAT(faultOfAddress(address), HasSubstr(fault)) << address;
}

TEST(LiveAddresses, AreThoseOfTheNetAndCameras) {
    EXPECT_TRUE(isLiveAddress("/dev/video0"));
    EXPECT_TRUE(isLiveAddress("camera:2"));
    EXPECT_FALSE(isLiveAddress("/dev/shm/clip.mp4"));
    EXPECT_FALSE(isLiveAddress("camera.mp4"));
    EXPECT_EQ(cameraDevice("camera:2"), "/dev/video2");
    EXPECT_EQ(cameraDevice("camera:/dev/any"), "/dev/any");
    EXPECT_EQ(cameraDevice("/dev/video0"), "/dev/video0");
    EXPECT_EQ(shownAddress("/dev/video0"), "/dev/video0");
    EXPECT_TRUE(isLiveAddress("udp://239.0.0.1:5000"));
    EXPECT_TRUE(isLiveAddress("rtsp://camera/stream"));
    EXPECT_FALSE(isLiveAddress("clip.mp4"));
    EXPECT_FALSE(isLiveAddress("scene:demo"));
    EXPECT_FALSE(isLiveAddress("file:///etc/passwd"));
    EXPECT_FALSE(isLiveAddress("concat://a|b"));
    EXPECT_EQ(shownAddress("rtsp://me:secret@camera:554/stream@1"), "rtsp://camera:554/stream@1");
    EXPECT_EQ(shownAddress("udp://@239.0.0.1:5000"), "udp://@239.0.0.1:5000");
    EXPECT_EQ(shownAddress("rtsp://camera/x"), "rtsp://camera/x");
    EXPECT_EQ(shownAddress("srt://camera:9000?passphrase=se/cr@et&mode=caller"), "srt://camera:9000");
}

}  // namespace
}  // namespace eyrie::live_stream_test
