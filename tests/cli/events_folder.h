#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cli/loaded_program.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

namespace eyrie::test {

/// A folder in which `eyrie-cli events` is called, and the runs it is called for.
class EventsFolder : public testing::Test {
 protected:
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    std::string textOf(const std::string& name) const {
        std::stringstream text;
        text << std::ifstream(folder_ / name).rdbuf();
        return text.str();
    }
    /// Words that begin with "@" are paths in the folder.
    ProcessResult call(std::vector<std::string> arguments) const {
        for (std::string& word : arguments) {
            if (word.starts_with('@')) word = at(word.substr(1));
        }
        arguments.insert(arguments.begin(), "events");
        return runLoaded(arguments);
    }
    /// A run at 0.2 m/px and 25 Hz.
    static RunRecord runOver(const std::string& video, cv::Size size, int frames, bool gsd_known = true) {
        RunRecord run;
        run.sequence = {.path = video, .size = size, .frame_count = frames, .frame_rate_hz = 25};
        run.scale = {0.2, 25, gsd_known};
        return run;
    }
    static void addTrack(FrameResult& result, TrackId id, const OrientedBox& box) {
        TrackState track;
        track.id = id;
        track.box = box;
        track.status = TrackStatus::confirmed;
        result.tracks.push_back(track);
    }
    /// 1.5 px a frame are 27 km/h. It comes over the left border, drives on to x = 420, stands there for seven seconds
    /// and is seen until the end. The camera moves by a quarter of a pixel.
    static double wayAt(int frame) { return frame < 50 ? -75 + 1.5 * 50 : std::min(420.0, -75 + 1.5 * frame); }
    static cv::Point2d placeAt(int frame) { return {wayAt(frame) - 0.25 * frame + 20, 200}; }
    /// One vehicle, 5, on that way. `failed`: the frame that could not be registered, −1: none.
    void writeProject(const std::string& name, bool gsd_known, int failed) const {
        writeRun(folder_ / name, runOver("/nowhere/clip.mp4", {640, 400}, 500, gsd_known),
                 [failed](int frame, FrameResult& result) {
                     result.motion.time_us = frame * 40000LL;
                     Registration& registration = result.motion.registration;
                     if (frame == failed) registration.state = RegistrationState::failed;
                     if (frame > 0) registration.current_from_previous.matrix(0, 2) = -0.25;
                     if (frame >= 50) addTrack(result, 5, {placeAt(frame), 22, 9, 0});
                 });
    }
    /// 1 drives to the right, 2 at once to the left beside it, 3 later where 1 was.
    void writeTraffic() const {
        writeRun(folder_ / "traffic.eyrie", runOver("/nowhere/clip.mp4", {640, 400}, 200),
                 [](int frame, FrameResult& result) {
                     result.motion.time_us = frame * 40000LL;
                     if (frame < 100) addTrack(result, 1, {{100 + 2.0 * frame, 200}, 22, 9, 0});
                     if (frame < 100) addTrack(result, 2, {{300 - 2.0 * frame, 182}, 22, 9, CV_PI});
                     if (frame >= 100) addTrack(result, 3, {{100 + 2.0 * (frame - 100), 200}, 22, 9, 0});
                 });
    }

    TemporaryFolder folder_;
};

}  // namespace eyrie::test
