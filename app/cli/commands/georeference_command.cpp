#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "cli/arguments/earlier_state.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/labels_of_project.h"
#include "core/error.h"
#include "core/geometry/place_text.h"
#include "exchange/project_labels.h"
#include "georeference/control_fit.h"
#include "georeference/geo_reference.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"
#include "store/review/control_points.h"

namespace eyrie::cli {
namespace {

struct GeoreferenceArguments {
    std::string project;
    std::string points;
    std::optional<int> sequence;
    bool clear = false;
};

std::vector<ControlPoint> readPoints(const std::string& path) {
    CsvReader csv(path, {"frame", "x", "y", "latitude", "longitude"});
    std::vector<ControlPoint> points;
    while (csv.next()) {
        ControlPoint point;
        point.frame = csv.whole("frame");
        point.px = {csv.real("x"), csv.real("y")};
        point.place = {csv.real("latitude"), csv.real("longitude")};
        if (point.frame < 0) csv.refuse("frame", "a whole number, 0 or more");
        if (!(std::abs(point.place.latitude_deg) <= 90)) csv.refuse("latitude", "degrees, -90 to 90");
        if (!(std::abs(point.place.longitude_deg) <= 180)) csv.refuse("longitude", "degrees, -180 to 180");
        if (!isPossible(point)) csv.refuse("x", "a place in the picture");
        points.push_back(point);
    }
    if (points.size() < static_cast<std::size_t>(kFewestControlPoints))
        throw Error(ErrorKind::input,
                    path + ": holds " + std::to_string(points.size()) + " control points; at least four are needed");
    return points;
}

/// What the points say, with the registration of the last run over the video.
void tell(const std::vector<ControlPoint>& points, const SequenceRecord& sequence, const CameraMotion& camera) {
    GeoFootage footage{sequence.size, 0, sequence.frame_count - 1, sequence.frame_rate_hz, {}, camera, points};
    std::vector<std::string> why_not;
    const GeoReference places = GeoReference::byControl(footage, &why_not);
    for (const std::string& why : why_not) std::printf("  note        %s\n", why.c_str());
    for (const ControlFit& fit : places.controlFits())
        if (const std::string remark = remarkOn(fit); !remark.empty())
            std::printf("  note        %s\n", remark.c_str());
    if (!places.known()) return;
    std::printf("  places      %s\n", places.origin().c_str());
    const FrameIndex frame = points.front().frame;
    const cv::Point2d middle((sequence.size.width - 1) / 2.0, (sequence.size.height - 1) / 2.0);
    const auto place = places.placeOf(frame, middle);
    const auto gsd = places.gsdOf(frame), course = places.courseOf(frame);
    if (!place || !gsd || !course) return;
    std::printf("  frame %d    the middle is at %s; %s m/px (--gsd); up is %s degrees from north\n", frame,
                placeText(*place).c_str(), fixedText(*gsd, 4).c_str(), fixedText(*course, 1).c_str());
}

/// Answers the exit code.
int georeference(const GeoreferenceArguments& arguments) {
    const InterruptGuard interrupt;
    const bool changes = arguments.clear || !arguments.points.empty();
    const std::vector<ControlPoint> given =
        arguments.points.empty() ? std::vector<ControlPoint>{} : readPoints(arguments.points);
    if (changes && !keepEarlierState(arguments.project, interrupt.token())) return exit_stopped;
    ProjectFile project = changes ? ProjectFile::open(arguments.project) : openForReading(arguments.project);
    const SequenceRecord sequence = chosenSequence(project, arguments.sequence);
    for (const ControlPoint& point : given) {
        if (point.frame >= sequence.frame_count)
            throw Error(ErrorKind::input, arguments.points + ": frame " + std::to_string(point.frame) + " is not in " +
                                              sequence.path + ", which has frames 0 to " +
                                              std::to_string(sequence.frame_count - 1));
    }
    if (changes) replaceControlPoints(project, sequence.id, given);
    const std::vector<ControlPoint> points = readControlPoints(project, sequence.id);
    std::printf("%s: %zu control points\n", sequence.path.c_str(), points.size());
    for (const ControlPoint& point : points)
        std::printf("  frame %d    %s, %s px is %s, %s\n", point.frame, shortestText(point.px.x).c_str(),
                    shortestText(point.px.y).c_str(), fixedText(point.place.latitude_deg, 7).c_str(),
                    fixedText(point.place.longitude_deg, 7).c_str());
    if (!points.empty()) tell(points, sequence, cameraMotionOf(RunStore(project), sequence.id));
    return exit_ok;
}

}  // namespace

void addGeoreferenceCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<GeoreferenceArguments>();
    CLI::App* command = app.add_subcommand(
        "georeference", "Place a video on the earth by points that a person found in it and on a map; lists them");
    command->add_option("--project", arguments->project, "Project with the video")->required();
    CLI::Option* points =
        command->add_option("--points", arguments->points,
                            "Table frame,x,y,latitude,longitude of at least four points; replaces the earlier ones");
    command->add_flag("--clear", arguments->clear, "Forget the points")->excludes(points);
    addSequenceNumber(*command, arguments->sequence);
    command->callback([arguments, &exit_code] { exit_code = georeference(*arguments); });
}

}  // namespace eyrie::cli
