#pragma once

#include <chrono>
#include <future>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <stop_token>
#include <vector>

#include "chain/chain_run.h"

namespace eyrie {

/// The grey pictures of a run, held while it goes on where all of them together take little memory, so that a short
/// video need not be decoded once more to finish its tracks.
class RunPictures {
 public:
    static constexpr std::size_t kMostBytes = 256'000'000;

    RunPictures() = default;  ///< holds none
    /// Holds those of a range; an end that is not known yet is too far.
    explicit RunPictures(FrameRange range);

    void take(FrameIndex frame, const cv::Mat& gray);
    /// Empty where it is not held.
    cv::Mat at(FrameIndex frame) const;

 private:
    FrameIndex first_ = 0;
    std::size_t frames_ = 0;         ///< 0: none is held
    std::vector<cv::Mat> pictures_;  ///< by frame from `first_`, CV_8UC1; empty ones are not held
};

/// The pictures of a run once more, for finishing, which asks for them in ascending order. Tells how far it is. None
/// that cannot be read any more, and none from a stop on. While one is worked on, the one that probably comes next is
/// read.
class PicturesOnceMore {
 public:
    /// `held` and `source`, which gives those that are not held and is left to it alone, must outlive it; `told`, if
    /// given, hears how far it is.
    PicturesOnceMore(const RunPictures& held, FrameSource& source, FrameIndex first, FrameIndex last,
                     ChainObserver* told, std::stop_token stop);

    cv::Mat operator()(FrameIndex frame);
    /// Pictures that could not be read any more.
    int lost() const { return lost_; }
    /// Whether a picture was refused: then what finishing did with them is incomplete.
    bool stopped() const { return stopped_; }

 private:
    using Clock = std::chrono::steady_clock;

    void tell(FrameIndex frame);
    cv::Mat read(FrameIndex frame);
    void readAhead(FrameIndex frame);

    const RunPictures& held_;
    FrameSource& source_;
    FrameIndex first_, last_;
    ChainObserver* told_;
    std::stop_token stop_;
    bool stopped_ = false;
    RunProgress progress_;
    int lost_ = 0;
    std::optional<Clock::time_point> begun_;  ///< with the first picture
    Clock::time_point last_told_{};
    std::optional<FrameIndex> read_last_;
    FrameIndex coming_ = 0;       ///< the frame that is read ahead
    std::future<cv::Mat> ahead_;  ///< ends before what it uses
};

}  // namespace eyrie
