#include "io/live/camera_device.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <future>
#include <opencv2/videoio.hpp>
#include <thread>

#include "core/error.h"
#include "io/live/camera_reader.h"
#include "io/live/live_stream.h"
#include "io/numbered_video.h"
#include "support/temporary_folder.h"

namespace eyrie::camera_device_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// Sends so many numbered pictures at the pace of a camera, and is pulled out then.
class PlayedCamera : public CameraDevice {
 public:
    PlayedCamera(int first, int pictures, cv::Size size) : next_(first), end_(first + pictures), size_(size) {}
    bool read(cv::Mat& picture) override {
        if (next_ == end_) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        picture = test::numberedImage(next_++, size_);
        return true;
    }
    double frameRate() const override { return 200; }

 private:
    int next_;
    int end_;
    cv::Size size_;
};

/// What is opened, one after the other; later on there is no camera any more.
struct Plugged {
    int first;
    int pictures;
    cv::Size size{160, 64};
};

class CameraStreams : public testing::Test {
 protected:
    LiveOptions options(std::vector<Plugged> plugged) {
        turn_ = 0;
        LiveOptions options;
        options.recording = folder_ / "recorded.ts";
        options.give_up_s = 1;
        options.waiting_frames = 1000;
        options.open_camera = [this, plugged](const std::string& device) -> std::unique_ptr<CameraDevice> {
            opened_ = device;
            const std::size_t turn = turn_++;
            if (turn >= plugged.size()) throw Error(ErrorKind::input, device + ": there is no such camera");
            return std::make_unique<PlayedCamera>(plugged[turn].first, plugged[turn].pictures, plugged[turn].size);
        };
        return options;
    }
    std::vector<int> recorded() const {
        return test::numbersOf(*openSource(folder_ / "recorded.ts", {.index_folder = folder_ / "index"}));
    }
    static std::vector<int> numbersFrom(int first, int count) {
        std::vector<int> numbers(static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) numbers[static_cast<std::size_t>(i)] = first + i;
        return numbers;
    }
    test::TemporaryFolder folder_;
    std::string opened_;  ///< by the thread that receives
    std::atomic<std::size_t> turn_{0};
};

TEST_F(CameraStreams, EveryPictureIsAFrameOfTheRunAndOfTheRecording) {
    LiveStream stream("camera:3", options({{0, 40}}), {});
    EXPECT_EQ(stream.info().size, cv::Size(160, 64));
    EXPECT_NEAR(stream.info().frame_rate_hz, 200, 0.1);
    EXPECT_EQ(test::numbersOf(stream), numbersFrom(0, 40));
    EXPECT_EQ(recorded(), numbersFrom(0, 40));
    EXPECT_THAT(stream.facts().ended, AllOf(HasSubstr("no picture came for 1 s"), HasSubstr("no such camera")));
    stream.finish();
    EXPECT_EQ(opened_, "/dev/video3");
}

TEST_F(CameraStreams, ACameraThatIsConnectedAgainGoesOnInTheSameRecording) {
    LiveStream stream("/dev/video0", options({{0, 20}, {500, 20}}), {});
    std::vector<int> expected = numbersFrom(0, 20);
    for (const int number : numbersFrom(500, 20)) expected.push_back(number);
    EXPECT_EQ(test::numbersOf(stream), expected);
    EXPECT_EQ(recorded(), expected);
    EXPECT_EQ(stream.facts().reconnects, 1);
}

TEST_F(CameraStreams, PicturesOfAnotherSizeEndIt) {
    LiveStream stream("/dev/video0", options({{0, 20}, {500, 20, {320, 128}}}), {});
    EXPECT_EQ(test::numbersOf(stream), numbersFrom(0, 20));
    EXPECT_THAT(stream.facts().ended, HasSubstr("changed from 160×64 px to 320×128 px"));
}

TEST_F(CameraStreams, WhatKeepsACameraFromBeingOpenedIsToldAndNothingIsRecorded) {
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { LiveStream("/dev/video0", options({}), {}); }),
                HasSubstr("/dev/video0: there is no such camera"));
    EXPECT_THAT(test::messageOf(ErrorKind::input,
                                [&] {
                                    LiveStream("/dev/video0", options({{0, 0}}), {});
                                }),
                HasSubstr("/dev/video0: no picture came"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "recorded.ts"));
}

TEST_F(CameraStreams, EndingItKeepsWhatCame) {
    std::stop_source stop;
    LiveStream stream("/dev/video0", options({{0, 1000}}), stop.get_token());
    std::vector<int> numbers;
    try {
        for (FrameIndex frame = 0;; ++frame) {
            numbers.push_back(test::numberIn(stream.read(frame, false).gray));
            if (frame == 20) stop.request_stop();
        }
    } catch (const StreamEnded&) {
    }
    stream.finish();
    EXPECT_GE(numbers.size(), 21U);
    EXPECT_LT(numbers.size(), 1000U);
    EXPECT_EQ(recorded(), numbers);
}

/// Sends some pictures and then hangs, as one whose cable is loose, until it is let go.
class HangingCamera : public CameraDevice {
 public:
    HangingCamera(std::shared_future<void> let_go, std::shared_ptr<std::promise<void>> closed)
        : played_(0, 10, {160, 64}), let_go_(std::move(let_go)), closed_(std::move(closed)) {}
    ~HangingCamera() override { closed_->set_value(); }
    bool read(cv::Mat& picture) override {
        if (played_.read(picture)) return true;
        let_go_.wait();
        return false;
    }
    double frameRate() const override { return 200; }

 private:
    PlayedCamera played_;
    std::shared_future<void> let_go_;
    std::shared_ptr<std::promise<void>> closed_;
};

TEST_F(CameraStreams, StopDoesNotWaitForOneThatHangs) {
    std::promise<void> letting_go;
    const std::shared_future<void> let_go = letting_go.get_future().share();
    const auto closing = std::make_shared<std::promise<void>>();
    const std::future<void> closed = closing->get_future();
    LiveOptions hanging = options({});
    hanging.stall_s = 1000;  // it is not opened again
    hanging.camera_close_s = 0.01;
    hanging.open_camera = [let_go, closing](const std::string&) {
        return std::make_unique<HangingCamera>(let_go, closing);
    };
    std::vector<int> numbers;
    {
        LiveStream stream("/dev/video0", hanging, {});
        for (FrameIndex frame = 0; frame < 5; ++frame)
            numbers.push_back(test::numberIn(stream.read(frame, false).gray));
        stream.finish();
        try {
            for (FrameIndex frame = 5;; ++frame) numbers.push_back(test::numberIn(stream.read(frame, false).gray));
        } catch (const StreamEnded&) {
        }
    }
    EXPECT_EQ(recorded(), numbers) << "what came is whole";
    letting_go.set_value();
    closed.wait();  // it does not keep the camera
}

TEST_F(CameraStreams, StopDoesNotWaitForOneThatHangsWhileItIsOpened) {
    std::promise<void> letting_go;
    const std::shared_future<void> let_go = letting_go.get_future().share();
    const auto closing = std::make_shared<std::promise<void>>();
    const std::future<void> closed = closing->get_future();
    std::stop_source stop;
    LiveOptions hanging = options({});
    hanging.stall_s = 1000;  // it is not opened again
    hanging.camera_close_s = 0.01;
    hanging.connect_s = 1000;
    hanging.open_camera = [let_go, closing, stop](const std::string&) mutable {
        stop.request_stop();  // while it is waited for
        let_go.wait();
        return std::make_unique<HangingCamera>(let_go, closing);
    };
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { LiveStream("/dev/video0", hanging, stop.get_token()); }),
                HasSubstr("/dev/video0: stopped"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "recorded.ts"));
    letting_go.set_value();
    closed.wait();
}

TEST_F(CameraStreams, OneThatHungIsOpenedAgainOnceItIsClosed) {
    std::promise<void> letting_go;
    const std::shared_future<void> let_go = letting_go.get_future().share();
    const auto closing = std::make_shared<std::promise<void>>();
    const std::shared_future<void> closed = closing->get_future().share();
    LiveOptions hanging = options({});
    hanging.stall_s = 0.2;
    hanging.camera_close_s = 0.01;
    hanging.give_up_s = 1000;
    std::stop_source stop;
    hanging.open_camera = [=, this](const std::string& device) mutable -> std::unique_ptr<CameraDevice> {
        const std::size_t turn = turn_++;
        if (turn == 0) return std::make_unique<HangingCamera>(let_go, closing);
        if (turn == 1 && closed.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
            return std::make_unique<PlayedCamera>(500, 20, cv::Size(160, 64));
        stop.request_stop();
        throw Error(ErrorKind::input, device + ": another program uses this camera");
    };
    LiveStream stream("/dev/video0", hanging, stop.get_token());
    std::vector<int> numbers;
    const auto read = [&](int count) {
        for (int i = 0; i < count; ++i)
            numbers.push_back(test::numberIn(stream.read(static_cast<FrameIndex>(numbers.size()), false).gray));
    };
    try {
        read(10);
        while (stream.facts().connected) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        letting_go.set_value();
        read(20);
    } catch (const StreamEnded&) {
    }
    std::vector<int> expected = numbersFrom(0, 10);
    for (const int number : numbersFrom(500, 20)) expected.push_back(number);
    EXPECT_EQ(numbers, expected) << stream.facts().ended;
    EXPECT_EQ(stream.facts().reconnects, 1);
    stream.finish();
}

TEST_F(CameraStreams, OneThatFailsAfterItWasOpenedIsOpenedAgain) {
    /// As a driver that throws what it has to say.
    class FailingCamera : public PlayedCamera {
     public:
        using PlayedCamera::PlayedCamera;
        bool read(cv::Mat& picture) override {
            if (PlayedCamera::read(picture)) return true;
            throw Error(ErrorKind::input, "the cable is loose");
        }
    };
    LiveOptions failing = options({{0, 0}, {500, 20}});
    failing.open_camera = [this,
                           then = failing.open_camera](const std::string& device) -> std::unique_ptr<CameraDevice> {
        if (turn_ > 0) return then(device);
        ++turn_;
        return std::make_unique<FailingCamera>(0, 10, cv::Size(160, 64));
    };
    LiveStream stream("/dev/video0", failing, {});
    std::vector<int> expected = numbersFrom(0, 10);
    for (const int number : numbersFrom(500, 20)) expected.push_back(number);
    EXPECT_EQ(test::numbersOf(stream), expected);
    EXPECT_EQ(stream.facts().reconnects, 1);
}

TEST(CameraReaders, WhoComesAfterOneThatHangsIsToldSo) {
    const std::string device = "/dev/video-of-this-test";
    std::promise<void> letting_go;
    const std::shared_future<void> let_go = letting_go.get_future().share();
    const auto closing = std::make_shared<std::promise<void>>();
    const CameraOpener opens_hanging = [=](const std::string&) {
        return std::make_unique<HangingCamera>(let_go, closing);
    };
    std::atomic<int> opened = 0;
    const CameraOpener opens_good = [&](const std::string&) {
        ++opened;
        return std::make_unique<PlayedCamera>(7, 1, cv::Size(160, 64));
    };
    const CameraPatience impatient{0.01, 0.01};
    {
        CameraReader hanging(device, opens_hanging, impatient, {});
        for (int i = 0; i < 10; ++i) ASSERT_TRUE(hanging.next(1000, {}));  // after these it hangs
        EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { CameraReader(device, opens_good, impatient, {}); }),
                    HasSubstr(device + ": this program uses this camera already"));
    }
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { CameraReader(device, opens_good, impatient, {}); }),
                HasSubstr(device + ": this camera hangs; disconnect it and connect it again"));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_FALSE(CameraReader(device, opens_good, {1000, 0.01}, stop.get_token()).next(1000, stop.get_token()));
    EXPECT_EQ(opened, 0);
    letting_go.set_value();
    CameraReader good(device, opens_good, {1000, 1000}, {});
    EXPECT_TRUE(good.next(1000, {}));
    EXPECT_EQ(opened, 1);
}

/// A camera that grants JPEG or does not, and keeps what it is asked for.
class AskedCapture : public cv::VideoCapture {
 public:
    explicit AskedCapture(bool has_jpeg) : has_jpeg_(has_jpeg) {}
    bool set(int property, double value) override {
        if (property == cv::CAP_PROP_FRAME_WIDTH) asked.width = static_cast<int>(value);
        if (property == cv::CAP_PROP_FRAME_HEIGHT) asked.height = static_cast<int>(value);
        return property != cv::CAP_PROP_FOURCC || has_jpeg_;
    }
    double get(int property) const override {
        if (property != cv::CAP_PROP_FOURCC) return 0;
        return has_jpeg_ ? cv::VideoWriter::fourcc('M', 'J', 'P', 'G') : cv::VideoWriter::fourcc('Y', 'U', 'Y', 'V');
    }
    cv::Size asked;

 private:
    bool has_jpeg_;
};

TEST(Cameras, LargePicturesAreAskedOfThoseThatHaveJpegOnly) {
    AskedCapture jpeg(true);
    askForPictures(jpeg, {640, 480});
    EXPECT_EQ(jpeg.asked, cv::Size(1920, 1080));
    AskedCapture plain(false);
    askForPictures(plain, {1280, 720});
    EXPECT_EQ(plain.asked, cv::Size(1280, 720));
    AskedCapture silent(false);
    askForPictures(silent, {});
    EXPECT_EQ(silent.asked, cv::Size()) << "it keeps what it has";
}

TEST(Cameras, WhatIsNoneIsNamedWithTheRemedy) {
    const test::TemporaryFolder folder;
    test::writeBytes(folder / "file", "no camera");
    const std::string file = (folder / "file").string();
    EXPECT_THAT(test::messageOf(ErrorKind::input, [] { openCamera("/dev/no-such-camera"); }),
                AllOf(HasSubstr("/dev/no-such-camera: there is no such camera"), HasSubstr("camera")));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [] { openCamera("/dev/null"); }),
                AllOf(HasSubstr("/dev/null: this device is no camera; "),
                      testing::AnyOf(HasSubstr("cameras that are here: /dev/video"), HasSubstr("connect one"))));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { openCamera(file); }),
                HasSubstr(file + ": this is no camera, nor any other device"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { openCamera((folder / "").string()); }),
                HasSubstr("this is no camera"));
}

TEST(Cameras, WhatIsBusyOrForbiddenIsToldWithTheRemedy) {
    EXPECT_THAT(whyNoCamera(EBUSY), AllOf(HasSubstr("another program uses this camera"), HasSubstr("close it")));
    EXPECT_THAT(whyNoCamera(EACCES), AllOf(HasSubstr("you may not use"), HasSubstr("group video")));
    EXPECT_THAT(whyNoCamera(EIO), HasSubstr("connect it again"));
}

}  // namespace
}  // namespace eyrie::camera_device_test
