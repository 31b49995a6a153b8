#pragma once

#include "formats/label_formats.h"
#include "formats/mot/motchallenge.h"

namespace eyrie {

struct LabelFormat;
/// MOTChallenge as it is specified, from which CVAT's differs a little.
LabelFormat motFormat();

/// Beside upright text, our own table with the exact boxes where any was turned: gt.txt → gt.oriented.csv.
void writeOrientedSidecar(const VisitFrames& frames, const std::filesystem::path& path, ExportReport& report);

/// Where that lies.
std::filesystem::path orientedSidecar(const std::filesystem::path& path);

/// The list of classes that CVAT and datumaro put beside a gt.txt or det.txt.
std::optional<std::filesystem::path> motClassListBeside(const std::filesystem::path& file);
/// How to read a text with such a list: its classes, pixels from 0 unless `first_pixel_edge` says otherwise, frames
/// from 0 where one has that number. Says so in `labels`.
MotOptions listedMotOptions(const std::filesystem::path& file, const std::filesystem::path& list,
                            std::optional<double> first_pixel_edge, LabelFile& labels);

/// A name as part of a path: everything but letters, digits, "-", "_" and "." becomes "_".
std::string pathWord(const std::string& name);

}  // namespace eyrie
