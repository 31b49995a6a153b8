#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/video/frame_source.h"

namespace eyrie {

/// The images of a folder (png, jpg, jpeg, tif, tiff, pgm, bmp) in natural order of their names: frame2 before frame10.
/// Hidden files and files of other kinds are skipped. A single image file is a sequence of one.
///
/// Images of 16 bit are brought to 8 by one straight line for the whole sequence, fixed by the first image: from 0 to
/// the largest number of 8, 10, 12, 14 or 16 bit that its brightest pixel needs. If all but 0.2 % of its pixels lie in
/// less than a quarter of that range, as with thermal cameras, the line spans twice what they cover, centred on it.
class ImageSequence : public FrameSource {
 public:
    /// Throws Error(input) for a folder without images or a first image that cannot be read.
    ImageSequence(const std::filesystem::path& path, const SourceOptions& options);

    static bool isImageFile(const std::filesystem::path& path);

    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool with_colour) override;
    std::int64_t timeOf(FrameIndex index) const override;
    bool hasGrown() const noexcept override;

 private:
    void checkIndex(FrameIndex index) const;

    VideoInfo info_;
    std::vector<std::filesystem::path> files_;
    double black_ = 0;      ///< 16 bit value that becomes 0
    double white_ = 65535;  ///< 16 bit value that becomes 255
};

/// The images of a folder that make a sequence, in its order. Throws Error(input) for a folder without images.
std::vector<std::filesystem::path> imagesIn(const std::filesystem::path& folder);

/// Whether `a` comes before `b` when runs of digits are compared as numbers.
bool naturalOrder(const std::string& a, const std::string& b);

}  // namespace eyrie
