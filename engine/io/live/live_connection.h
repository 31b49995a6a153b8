#pragma once

#include <memory>
#include <stop_token>
#include <string>

#include "io/live/camera_reader.h"
#include "io/video/libav.h"

/// Inside of this room only.
namespace eyrie {

/// A live source that is open and sends packets of video, whatever it is. Every wait has a limit.
class LiveConnection {
 public:
    LiveConnection() = default;
    virtual ~LiveConnection() = default;
    LiveConnection(const LiveConnection&) = delete;
    LiveConnection& operator=(const LiveConnection&) = delete;

    virtual const AVFormatContext& demuxer() const = 0;
    virtual int video() const = 0;
    const AVStream& videoStream() const { return *demuxer().streams[video()]; }
    /// The next packet of any track; false when none came for `seconds`, at the end and when stopped.
    virtual bool read(AVPacket& packet, double seconds) = 0;
    /// Whether the last packet came when waiting had been given up: it had been held back until then.
    virtual bool wasHeldBack() const { return false; }
    /// Whether all of a source that has an end, such as a file on the net, was read.
    virtual bool hasEnded() const { return false; }
};

/// An address of the net. Throws Error(input) when nothing of use comes within `seconds`.
std::unique_ptr<LiveConnection> connectToNet(const std::string& address, double seconds, const std::stop_token& stop);
/// A camera, whose pictures are encoded as they come. Throws Error(input) where it sends none in time, and what
/// `open` and CameraReader throw. One that hangs is not waited for; `open` must stay of use until then (CameraReader).
std::unique_ptr<LiveConnection> connectToCamera(const std::string& address, const CameraOpener& open,
                                                const CameraPatience& patience, const std::stop_token& stop);

}  // namespace eyrie
