#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "io/live/camera_device.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// How a live source is connected and recorded, and how long it may be silent.
struct LiveOptions {
    std::filesystem::path recording;  ///< what comes is written here as it is, as a transport stream
    double frame_rate_hz = 0;         ///< 0: what the stream says
    double connect_s = 10;            ///< how long the first picture may take
    double stall_s = 5;               ///< without a picture for so long, the connection is made anew
    double give_up_s = 30;            ///< without a picture for so long, the stream has ended
    int waiting_frames = 50;          ///< that may wait for the reader; further ones are left out
    bool with_colour = false;         ///< frames carry colour, for whoever looks at them
    /// With less space for the recording than this the stream ends, so that what was found can still be stored.
    std::uint64_t least_free_bytes = 100'000'000;
    std::vector<std::filesystem::path> also_written;  ///< what grows on other disks, which must keep that space, too
    double camera_close_s = 0.5;  ///< how long a camera may take to be closed; one that hangs is left to itself then
    CameraOpener open_camera;     ///< empty: openCamera(); may still be at work when the stream is gone (CameraReader)
};

/// What became of a stream so far.
struct LiveFacts {
    int frames = 0;      ///< received
    int skipped = 0;     ///< of them, left out because the reader was behind
    int reconnects = 0;  ///< successful ones
    double longest_gap_s = 0;
    double silent_s = 0;               ///< since the last picture came, at the moment of asking
    bool connected = true;             ///< false while the connection is made anew
    std::uint64_t recorded_bytes = 0;  ///< of the recording
    std::uint64_t free_bytes = 0;      ///< of the disk with the least space that is written to; 0: not known
    std::string ended;                 ///< why it ended, for people; empty: it goes on, or was ended by the reader
};

/// Thrown by reading a frame that a live source will never have, because it has ended.
struct StreamEnded {};

/// Video that comes as it is made, over the net from the first key frame on, or from a camera of this machine, encoded
/// here. A thread of its own receives, records and decodes; frames must be read in their order. A frame that was left
/// out is answered by the picture before it, in the same memory, with its own number and time, so that numbers are
/// those of the recording.
class LiveStream : public FrameSource {
 public:
    /// Waits for the first picture. Throws Error(input) when none comes in time, the address is of no use, or no
    /// transport stream can carry the video; Error(output) when the recording cannot be written, which is made when the
    /// address answers. `stop` ends waiting as Error(input) "stopped".
    LiveStream(std::string address, LiveOptions options, std::stop_token stop);
    ~LiveStream() override;

    /// `path` is the recording, `frame_count` as many as there may ever be.
    const VideoInfo& info() const override;
    /// Waits for the frame. Throws StreamEnded.
    Frame read(FrameIndex index, bool with_colour) override;
    /// Of frames that were read; an estimate for others.
    std::int64_t timeOf(FrameIndex index) const override;

    /// Share of the waiting frames that is used, 0 … 1. From any thread.
    double backlog() const;
    /// From any thread.
    LiveFacts facts() const;
    /// Ends receiving and completes the recording; read() throws StreamEnded once all that came was read. By the thread
    /// that reads. Throws nothing: read() throws Error(output) where the recording could not be written.
    void finish();

 private:
    struct Receiver;
    std::unique_ptr<Receiver> receiver_;
};

}  // namespace eyrie
