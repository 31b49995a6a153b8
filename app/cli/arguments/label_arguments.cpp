#include "cli/arguments/label_arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/arguments/described_sequence.h"
#include "core/error.h"

namespace eyrie::cli {
namespace {

std::string line(const std::string& name, const std::string& value) {
    return "  " + name + std::string(name.size() < 12 ? 12 - name.size() : 1, ' ') + value + "\n";
}

std::string nounOf(int count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

void addLabelOptions(CLI::App& command, LabelArguments& arguments, const char* format_name, const char* columns_name) {
    command.add_option(format_name, arguments.format, "Format of the file: auto, " + formatNames(false))
        ->capture_default_str();
    command.add_option("--class-map", arguments.class_map,
                       "Class of the file and the class it becomes, as a=b; may be repeated");
    command.add_option("--shift", arguments.shift, "Number to add to every frame number of the file")
        ->capture_default_str();
    command.add_option("--scale", arguments.scale, "Factor on all lengths, for labels of another image size")
        ->capture_default_str();
    command.add_option(columns_name, arguments.columns,
                       "Columns of your own table, such as frame,id,cname,x1,y1,x2,y2 or frame,n,[id,x,y,w,h]");
    command.add_option("--first-frame", arguments.first_frame,
                       "Number of a video's first frame in such a table (default 0)");
    command.add_option("--pixel-origin", arguments.pixel_origin,
                       "Where the first pixel begins in such a table (default 0) and in MOTChallenge text (default 1; "
                       "0 with labels.txt beside it)");
    command.add_option("--size", arguments.size, "Size of the image, WIDTHxHEIGHT, for formats relative to it");
}

ImportOptions importOptionsOf(const LabelArguments& arguments) {
    ImportOptions options;
    for (const std::string& mapping : arguments.class_map) {
        const std::size_t equals = mapping.find('=');
        if (equals == std::string::npos || equals + 1 == mapping.size()) {
            throw Error(ErrorKind::parameter,
                        "--class-map " + mapping + ", expected a class of the file and the class it becomes: a=b");
        }
        options.class_map[mapping.substr(0, equals)] = mapping.substr(equals + 1);
    }
    options.frame_shift = arguments.shift;
    options.scale = arguments.scale;
    options.columns = arguments.columns;
    options.first_frame_number = arguments.first_frame;
    options.first_pixel_edge = arguments.pixel_origin;
    options.sequence = arguments.sequence;
    if (!arguments.size.empty()) options.image_size = parseSize(arguments.size);
    return options;
}

std::vector<OutputFile> outputFiles(const std::string& path, const std::string& format, const ExportOptions& options) {
    const auto& formats = labelFormats();
    const bool folder = std::any_of(formats.begin(), formats.end(),
                                    [&](const LabelFormatInfo& info) { return info.name == format && info.folder; });
    std::vector<OutputFile> files;
    for (const ExportFile& file : filesToWrite(path, format, options))
        files.push_back({file.path, file.kind, file.grows, folder});
    return files;
}

std::string formatNames(bool to_write) {
    std::string names;
    for (const LabelFormatInfo& info : labelFormats()) {
        if (to_write ? info.writes : info.reads) names += (names.empty() ? "" : ", ") + info.name;
    }
    return names;
}

std::string reportText(const std::string& file, const LabelFile& labels, const LabelReport& report) {
    std::string text = file + "\n" + line("format", report.format);
    for (const auto& further : labels.further_files) text += line("read too", further.string());
    if (report.boxes == 0) {
        text += line("boxes", "none");
        for (const std::string& note : report.notes) text += line("note", note);
        return text;
    }
    text += line("frames", nounOf(report.frames, "frame", "frames") + " with boxes, " +
                               std::to_string(report.first_frame) + " to " + std::to_string(report.last_frame) +
                               (report.first_frame_number == 0
                                    ? ""
                                    : "; the file calls the first frame " + std::to_string(report.first_frame_number)) +
                               (report.frame_count ? "; " + std::to_string(*report.frame_count) + " declared" : ""));
    if (report.image_size) {
        text += line("image", std::to_string(report.image_size->width) + "×" +
                                  std::to_string(report.image_size->height) + " px");
    }
    text += line("boxes", std::to_string(report.boxes) + ": " + std::to_string(report.turned) + " turned, " +
                              std::to_string(report.ignored) + " ignored, " + std::to_string(report.occluded) +
                              " occluded");
    text += line(
        "ids", report.ids == 0
                   ? "none"
                   : std::to_string(report.ids) + ", " + std::to_string(report.lowest_id) + " to " +
                         std::to_string(report.highest_id) +
                         (report.without_id == 0 ? "" : "; " + nounOf(report.without_id, "box", "boxes") + " without"));
    if (report.keyframes > 0) text += line("keyframes", std::to_string(report.keyframes));
    std::string classes;
    for (const auto& [name, count] : report.boxes_of_class) {
        classes += (classes.empty() ? "" : ", ") + (name.empty() ? "(none)" : name) + " " + std::to_string(count);
    }
    text += line("classes", classes);
    for (const std::string& note : report.notes) text += line("note", note);
    return text;
}

std::string reportText(const ExportReport& report) {
    std::string text = nounOf(report.boxes, "box", "boxes") + " written as " + report.format + "\n";
    for (const auto& file : report.files) text += line("file", file.string());
    for (const ExportLoss& loss : report.losses) text += line("lost", loss.remark);
    for (const std::string& note : report.notes) text += line("note", note);
    return text;
}

}  // namespace eyrie::cli
