#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "io/video/libav.h"

/// Inside of this room only.
namespace eyrie {

/// A transport stream that is written as packets come, over several connections; what is there can be read at any time.
/// On its clock the first picture is at 1 s, whatever the clocks of the connections say.
class LiveRecording {
 public:
    /// The file is made when the first connection begins.
    explicit LiveRecording(std::filesystem::path path);
    ~LiveRecording();
    LiveRecording(const LiveRecording&) = delete;
    LiveRecording& operator=(const LiveRecording&) = delete;

    /// The tracks of a connection; those of the first make up the recording, later ones take the places of those alike.
    /// Throws Error(input) for a video that no transport stream can carry, Error(output).
    void begin(const AVFormatContext& demuxer, int video);
    /// Writes a packet of the connection and gives it the clock of the recording. `gap_us`: how long nothing came
    /// before the first packet of a connection. False for what is not recorded: before the first key frame, or of a new
    /// track. Throws Error(output).
    bool write(AVPacket& packet, const AVFormatContext& demuxer, std::int64_t gap_us);
    /// Written so far.
    std::uint64_t bytes() const;
    /// Completes the file, if there is one. Throws Error(output).
    void finish();
    /// Takes the file away, if it was made: nothing in it can be shown.
    void discard();

 private:
    [[noreturn]] void fail(int reason) const;
    void open(const AVFormatContext& demuxer, int video);
    void shift(AVPacket& packet, AVRational tick, std::int64_t gap_us);

    std::filesystem::path path_;
    libav::Muxer muxer_;       ///< null before and after it is written
    std::vector<int> places_;  ///< of the present connection's tracks; −1: nowhere
    int video_ = -1;           ///< of the present connection
    bool waits_for_key_ = true;
    std::optional<std::int64_t> shift_us_;  ///< from the connection's clock to that of the recording
    std::int64_t last_us_ = 0;              ///< decoding time of the last picture on the recording's clock
    std::int64_t usual_step_us_ = 40'000;   ///< between pictures
};

}  // namespace eyrie
