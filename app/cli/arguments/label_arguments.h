#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/label_formats.h"
#include "io/output_files.h"

namespace CLI {
class App;
}

namespace eyrie::cli {

/// How a foreign file of labels is to be read, as `import` and `export --from` take it from the command line.
struct LabelArguments {
    std::string format = "auto";
    std::vector<std::string> class_map;  ///< "from=to"
    int shift = 0;
    double scale = 1;
    std::string columns;
    std::optional<int> first_frame;
    std::optional<double> pixel_origin;
    std::string size;
    std::string sequence;
};

/// Adds --format (or `format_name`), --class-map, --shift, --scale, --columns (or `columns_name`) and their like.
void addLabelOptions(CLI::App& command, LabelArguments& arguments, const char* format_name, const char* columns_name);

/// Throws Error(parameter) for a mapping without "=" or a size that is none.
ImportOptions importOptionsOf(const LabelArguments& arguments);

/// The names of all formats that can be read, or written, with commas.
std::string formatNames(bool to_write);

/// The files of an export, for the check of outputs. Throws Error(parameter) for an unknown format.
std::vector<OutputFile> outputFiles(const std::string& path, const std::string& format,
                                    const ExportOptions& options = {});

/// What a file holds, for people.
std::string reportText(const std::string& file, const LabelFile& labels, const LabelReport& report);
/// What was written and what was lost on the way, for people.
std::string reportText(const ExportReport& report);

}  // namespace eyrie::cli
