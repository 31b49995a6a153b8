#pragma once

#include <chrono>
#include <stop_token>
#include <string>

#include "io/video/libav.h"

/// Inside of this room only.
namespace eyrie {

/// An address that is open. Every wait has a limit.
class LiveConnection {
 public:
    /// Throws Error(input) when nothing of use comes within `seconds`.
    LiveConnection(const std::string& address, double seconds, const std::stop_token& stop);
    LiveConnection(const LiveConnection&) = delete;
    LiveConnection& operator=(const LiveConnection&) = delete;

    AVFormatContext& demuxer() { return *demuxer_; }
    int video() const { return video_; }
    const AVStream& videoStream() const { return *demuxer_->streams[video_]; }
    /// The next packet of any track; false when none came for `seconds`, at the end and when stopped.
    bool read(AVPacket& packet, double seconds);
    /// Whether the last packet came when waiting had been given up: the demuxer had held it back until then.
    bool wasHeldBack() const { return std::chrono::steady_clock::now() >= limit_; }
    /// Whether all of a source that has an end, such as a file on the net, was read.
    bool hasEnded() const { return has_ended_; }

 private:
    static int overdue(void* self);
    void allow(double seconds);

    std::stop_token stop_;
    std::chrono::steady_clock::time_point limit_;
    libav::Demuxer demuxer_;
    int video_ = -1;
    bool has_ended_ = false;
};

}  // namespace eyrie
