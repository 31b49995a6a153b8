#pragma once

#include <functional>
#include <list>
#include <memory>
#include <vector>

#include "io/video/frame_source.h"
#include "io/video/parts/part_list.h"

namespace eyrie {

class VideoReader;

/// Several video files as one video: frames and times of a part go on from those of the part before. Few files are open
/// at a time, however many there are.
class PartSource : public FrameSource {
 public:
    /// `list` is where the list of the parts lies, for messages and as the path of the video. Reads through every part
    /// that is not indexed yet. Throws Error(input) naming the part that is missing, has changed, is no video file, or
    /// has frames of another size or rate than the first.
    PartSource(std::filesystem::path list, std::vector<ListedPart> parts, const SourceOptions& options,
               const IndexProgress& progress, const std::stop_token& stop);
    ~PartSource() override;

    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool with_colour) override;
    std::int64_t timeOf(FrameIndex index) const override;
    std::vector<PictureStamp> pictureStamps() const override;
    bool hasGrown() const noexcept override;
    void giveUpWhen(std::function<bool()> given_up) override;

    /// The parts with all that is known of them now.
    const std::vector<ListedPart>& listed() const { return listed_; }
    /// The list lies elsewhere now.
    void movedTo(std::filesystem::path list) { info_.path = std::move(list); }

 private:
    struct OpenPart {
        std::size_t number = 0;
        std::unique_ptr<VideoReader> reader;
    };

    /// Learns what all parts hold; `rate_is_known`: theirs may differ, as one is known that holds for all.
    void survey(double frame_rate_hz, bool rate_is_known, const IndexProgress& progress, const std::stop_token& stop);
    void add(std::size_t number, const VideoReader& reader);
    void checkLike(std::size_t number, const VideoInfo& part) const;
    std::string whyOtherRate(const VideoInfo& part) const;
    [[noreturn]] void refuse(std::size_t number, const std::string& what, const std::string& remedy) const;
    void checkIndex(FrameIndex index) const;
    VideoReader& readerOf(std::size_t number) const;

    VideoInfo info_;
    std::vector<ListedPart> listed_;
    SourceOptions options_;  ///< of each part
    std::vector<std::int64_t> times_us_;
    int pictures_ = 0;      ///< coded ones, of all parts
    double rated_s_ = 0;    ///< of the frames of all parts that tell a rate, by these
    int rated_frames_ = 0;  ///< of these
    bool rates_differ_ = false;
    mutable std::list<OpenPart> open_;  ///< used last first
    std::function<bool()> given_up_;
};

/// Opens a list of parts. Throws as openSource() does.
std::unique_ptr<FrameSource> openPartList(const std::filesystem::path& list, const SourceOptions& options = {},
                                          const IndexProgress& progress = {}, const std::stop_token& stop = {});

/// Opens video files in the order given as one video, and keeps the list of them at the first of `places` that can be
/// written (keepPartList()): its path is then that of the video. Without places no list is kept. A single file is
/// opened as it is. Throws as openSource() does, and Error(output) where a list cannot be kept.
std::unique_ptr<FrameSource> openTogether(const std::vector<std::filesystem::path>& files,
                                          const std::vector<std::filesystem::path>& places,
                                          const SourceOptions& options = {}, const IndexProgress& progress = {},
                                          const std::stop_token& stop = {});

/// Opens a list some of whose parts are no longer at their place, with relocatedParts(), and writes into it where they
/// are. Throws as openTogether() does.
std::unique_ptr<FrameSource> openRelocated(const std::filesystem::path& list,
                                           const std::vector<std::filesystem::path>& chosen,
                                           const SourceOptions& options = {}, const IndexProgress& progress = {},
                                           const std::stop_token& stop = {});

/// Throws Error(input) unless all of several files may be parts of one video: video files, and each once.
void checkTogether(const std::vector<std::filesystem::path>& files);

}  // namespace eyrie
