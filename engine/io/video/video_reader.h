#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <utility>
#include <vector>

#include "io/video/frame_source.h"
#include "io/video/pixel_conversion.h"
#include "io/video/video_decoder.h"
#include "io/video/video_index.h"

namespace eyrie {

/// A video file. Reading the next frame decodes just that one; any other frame is decoded from a key frame before it.
class VideoReader : public FrameSource {
 public:
    /// Uses the cached index or builds and keeps one. Throws Error(input).
    VideoReader(const std::filesystem::path& path, const SourceOptions& options, const IndexProgress& progress,
                std::stop_token stop);

    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool with_colour) override;
    std::int64_t timeOf(FrameIndex index) const override;
    std::vector<PictureStamp> pictureStamps() const override;
    bool hasGrown() const noexcept override;
    void giveUpWhen(std::function<bool()> given_up) override { given_up_ = std::move(given_up); }

 private:
    void describe(const SourceOptions& options);
    const AVFrame& pictureOf(FrameIndex index);
    bool showsBefore(FrameIndex index, int packet) const;
    const AVFrame* decodeUpTo(FrameIndex index);
    std::vector<int> startsFor(FrameIndex index) const;
    void checkIndex(FrameIndex index) const;

    VideoInfo info_;
    std::uint64_t bytes_ = 0;  ///< of the file before it was indexed
    VideoIndex index_;
    std::int64_t stamp_tick_numerator_ = 1;  ///< of the container, whatever rate the user gave
    std::int64_t stamp_tick_denominator_ = 1;
    std::vector<FrameIndex> frame_of_packet_;
    std::vector<int> key_packets_;           ///< of frames that show, ascending
    std::unique_ptr<VideoDecoder> decoder_;  ///< null until a frame is read, where the index was known
    PixelConversion conversion_;
    const AVFrame* picture_ = nullptr;  ///< what the decoder delivered last
    FrameIndex picture_frame_ = -1;
    int start_ = 0;                ///< packet that decoding last began with
    bool start_came_out_ = false;  ///< the decoder delivered the picture of `start_`
    std::function<bool()> given_up_;
};

}  // namespace eyrie
