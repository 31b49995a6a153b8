#pragma once

#include "formats/label_formats.h"
#include "formats/motchallenge.h"

namespace eyrie {

/// Beside upright text, our own table with the exact boxes where any was turned: gt.txt → gt.oriented.csv.
void writeOrientedSidecar(const LabelFile& labels, const std::filesystem::path& path, ExportReport& report);

/// Where that lies.
std::filesystem::path orientedSidecar(const std::filesystem::path& path);

/// A name as part of a path: everything but letters, digits, "-", "_" and "." becomes "_".
std::string pathWord(const std::string& name);

}  // namespace eyrie
