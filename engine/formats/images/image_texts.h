#pragma once

#include "formats/format_functions.h"

namespace eyrie {

/// One text of labels per image, as DOTA and YOLO have them.
struct ImageText {
    std::filesystem::path file;
    FrameIndex frame = 0;
};

/// The texts below `path`: the file itself, the folder's, or those in its folder `labels_name` (there, in a single
/// folder such as "train"). Frames are the places of the images in a folder "images" or "img1" beside the texts where
/// there is one, otherwise the numbers that the names end with, otherwise the order of the names; a note says which.
/// Image names, and the image folder where there is one, go into `labels`. Throws Error(input) when there is no text,
/// or one without its image.
std::vector<ImageText> findImageTexts(const std::filesystem::path& path, const char* labels_name, LabelFile& labels);

/// Whether the folder, or `labels_name` in it, holds such texts; the first of them for looking at.
std::optional<std::filesystem::path> firstImageText(const std::filesystem::path& folder, const char* labels_name);

/// The folder of images that belongs to a folder of texts.
std::optional<std::filesystem::path> imageFolderFor(const std::filesystem::path& texts);

/// Makes `folder` for a text per image. Throws Error(output) when it holds texts already, which would mix.
void makeTextFolder(const std::filesystem::path& folder);
/// A small file that need not survive a crash of the machine. Throws Error(output).
void writePlainFile(const std::filesystem::path& file, const std::string& text);

/// Name of a frame's text: that of its image without ending, or its number.
std::string imageStem(const LabelFile& labels, FrameIndex frame);

/// Reads four corners from field `first` on and makes a box of them; `departures` counts quadrangles that are no
/// rectangle within 2 px or a tenth of their size; of those the best fitting of two rectangles is taken, the mean one
/// and the smallest around them.
OrientedBox boxByFourCorners(const TextLine& line, std::size_t first, cv::Point2d scale, int& departures);
/// Notes how many quadrangles were no rectangles, and how many boxes by corners are wider than long.
void tellFourCorners(int departures, int across, std::vector<std::string>& notes);
/// The corners front left, front right, rear right, rear left with pixels from 0; cut at the border of `clip`.
std::array<cv::Point2d, 4> cornersToWrite(const OrientedBox& box, std::optional<cv::Size> clip, int& cut);

}  // namespace eyrie
