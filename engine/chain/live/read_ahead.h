#pragma once

#include <deque>

#include "io/video/frame_source.h"

namespace eyrie {

/// A live source some frames of which may be looked at before the run comes to them. Frames are read in their order.
class ReadAhead : public FrameSource {
 public:
    /// The source must outlive it.
    explicit ReadAhead(FrameSource& source) : source_(source) {}

    /// Waits for so many frames from the first on, fewer where the source ends before; to be called before any is read.
    /// Returns a video of those alone, which may be read as often as one likes.
    std::unique_ptr<FrameSource> first(int frames);

    const VideoInfo& info() const override { return source_.info(); }
    std::int64_t timeOf(FrameIndex index) const override { return source_.timeOf(index); }
    Frame read(FrameIndex index, bool with_colour) override;

 private:
    FrameSource& source_;
    std::deque<Frame> ahead_;
};

}  // namespace eyrie
