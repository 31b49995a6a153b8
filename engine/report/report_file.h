#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "io/file_kind.h"

namespace eyrie {

/// A picture of a report.
struct ReportPicture {
    enum class Kind { svg, png, jpeg };
    Kind kind = Kind::png;
    std::string bytes;      ///< of the file; SVG as text
    double width_mm = 160;  ///< on paper, of the 180 mm between the margins
};

/// A document: HTML that a browser and a simple printer understand, and its pictures by name. In `html` they stand as
/// <img src="NAME">.
struct ReportFile {
    std::string html;
    std::map<std::string, ReportPicture> pictures;

    void add(const std::string& name, ReportPicture::Kind kind, std::string bytes, double width_mm) {
        pictures[name] = {kind, std::move(bytes), width_mm};
    }
};

/// A whole page around `body`, which is HTML; `title` is text.
std::string reportPage(const std::string& title, const std::string& body);

/// The document with its pictures inside, for one file without network.
std::string selfContained(const ReportFile& report);
/// What a report is written as: PDF where its name ends so, else HTML.
FileKind kindOfReport(const std::filesystem::path& path);
/// Throws Error(output); the file is either complete or as it was before.
void writeHtmlReport(const std::filesystem::path& path, const ReportFile& report);

}  // namespace eyrie
