#pragma once

#include <opencv2/imgproc.hpp>

#include "chain/live/live_run.h"
#include "io/video/video_writer.h"
#include "support/live_sender.h"
#include "ui/support/ui_support.h"

namespace eyrie::ui::test {

/// Writes frames of the scene under test as a transport stream that can be joined every ten frames.
inline std::filesystem::path writeFilm(const std::filesystem::path& file, int frames, cv::Size size = {240, 180}) {
    VideoWriterOptions options;
    options.key_frame_distance = 10;
    options.quality = 12;
    VideoWriter writer(file, size, options);
    for (int i = 0; i < frames; ++i) {
        cv::Mat colour;
        cv::cvtColor(sceneFrame(i, size), colour, cv::COLOR_GRAY2BGR);
        writer.write(colour);
    }
    writer.finish();
    return file;
}

/// A source on a port of this machine, recorded into a folder; impatient, so that tests are short.
struct LiveSource {
    explicit LiveSource(const std::filesystem::path& folder) : port(eyrie::test::freePort()) {
        request.address = "udp://127.0.0.1:" + std::to_string(port);
        request.project = folder / "live.eyrie";
        request.gsd_m_per_px = 0.25;
        request.stream.connect_s = 30;
        request.stream.stall_s = 1;
        request.stream.give_up_s = 2;
    }
    int port;
    LiveRequest request;
};

}  // namespace eyrie::ui::test
