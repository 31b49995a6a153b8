#include "report/review/review_report.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/time/time_text.h"
#include "core/time/utc_time.h"
#include "georeference/video_world.h"
#include "io/tables/number_text.h"
#include "metadata/metadata_scale.h"
#include "report/report_parts.h"
#include "report/review/review_parts.h"
#include "store/project/video_start.h"
#include "store/review/control_points.h"
#include "store/review/seen_store.h"

namespace eyrie {
namespace {

constexpr double kStillWidth_mm = 92;  // two events share a page of A4
constexpr double kSmallWidth_mm = 44;
constexpr double kSpeedWidth_mm = 80;

/// What the metadata say about the scale of a run that did not take it from them.
std::string remarkOnScale(const RunRecord& run, const MetadataTimeline& timeline, const FrameSource& source) {
    const FrameIndex last = std::min(run.last_frame, source.info().frame_count - 1);
    if (last < run.first_frame || run.scale_basis.origin == ScaleOrigin::metadata) return {};
    const MetadataScale stated = scaleByMetadata(timeline, source, run.first_frame, last);
    if (!stated.usable()) return {};
    const double difference = std::abs(stated.gsd_m_per_px / run.scale.gsd_m_per_px - 1);
    return "the video's metadata (" + std::string(nameOf(stated.source)) + ") say " +
           (difference < 1e-6 ? "the same" : fixedText(stated.gsd_m_per_px, 4) + " m/px");
}

std::string tracksText(const Event& event) {
    std::string text;
    for (const TrackId id : event.tracks) text += (text.empty() ? "" : ", ") + std::to_string(id);
    return text;
}

std::string placeText(const ReviewScene& scene, const Event& event) {
    std::string text = "x " + fixedDigits(event.place.x, 0) + ", y " + fixedDigits(event.place.y, 0) + " px in frame " +
                       std::to_string(event.frame);
    if (const auto place = scene.input().places.placeOf(event.frame, event.place))
        text += "; " + fixedDigits(place->latitude_deg, 6) + ", " + fixedDigits(place->longitude_deg, 6);
    if (!event.zone.empty()) text += "; " + event.zone;
    if (event.sense != CrossingSense::none) text += std::string(" ") + nameOf(event.sense);
    return text;
}

/// Highest and mean speed of the first vehicle while it happened; empty where it is not known.
std::string speedText(const ReviewScene& scene, const Event& event) {
    const SceneScale& scale = scene.ground().footage().scale;
    const GroundPath* way = event.tracks.empty() ? nullptr : scene.pathOf(event.tracks.front(), event.frame);
    if (!scale.gsd_known || way == nullptr || !way->measured) return {};
    // What happens in a moment is told with the second about it.
    const int margin = event.first_frame == event.last_frame ? static_cast<int>(scale.frame_rate_hz / 2) : 0;
    double low = INFINITY, high = 0;
    for (const GroundSample& sample : way->samples) {
        if (sample.frame < event.first_frame - margin || sample.frame > event.last_frame + margin) continue;
        low = std::min(low, sample.speed * 3.6);
        high = std::max(high, sample.speed * 3.6);
    }
    if (!(low <= high)) return {};
    const std::string from = fixedDigits(low, 0), to = fixedDigits(high, 0);
    return (from == to ? to : from + " to " + to) + " km/h";
}

std::string factsTable(const ReviewScene& scene, const Event& event, const Verdict* verdict) {
    ReportPage table;
    table.beginTable({});
    const auto fact = [&](const char* name, const std::string& value) {
        if (!value.empty()) table.row({"<b>" + markupEscaped(name) + "</b>", markupEscaped(value)});
    };
    fact("From", scene.momentText(event.first_frame));
    if (event.last_frame != event.first_frame) fact("To", scene.momentText(event.last_frame));
    fact("Frames", event.first_frame == event.last_frame
                       ? std::to_string(event.first_frame)
                       : std::to_string(event.first_frame) + "–" + std::to_string(event.last_frame));
    fact(event.tracks.size() == 1 ? "Track" : "Tracks", tracksText(event));
    fact(figureNameOf(event.kind), figureText(event));
    fact("Speed", speedText(scene, event));
    fact("Place", placeText(scene, event));
    const auto corrected = correctionOf(event, scene.input().reviewed.tracks);
    const std::string run = "the machine, run " + std::to_string(scene.input().reviewed.run.id);
    fact("Found by", corrected == CorrectionKind::add     ? "a person, who added the track"
                     : corrected == CorrectionKind::join  ? run + ", in tracks that a person joined"
                     : corrected == CorrectionKind::split ? run + ", in a track that a person split"
                                                          : run);
    const auto& scores = scene.input().reviewed.tracks.scores;
    const auto score = event.tracks.empty() ? scores.end() : scores.find(event.tracks.front());
    if (score != scores.end()) fact("Score", fixedDigits(score->second, 2));
    if (verdict == nullptr) {
        fact("Verdict", "not judged");
    } else {
        fact("Verdict", nameOf(verdict->judgement) + std::string(verdict->starred ? " ★" : ""));
        fact("Judged by", verdict->person.empty() ? "a person without a name" : judgeText(*verdict));
        fact("Note", verdict->note);
        fact("Tags", tagText(verdict->tags));
    }
    table.endTable();
    return table.take();
}

std::string picture(const std::string& name) {
    return "<img src=\"" + name + "\">";
}

void tellEvent(ReportPage& page, const ReviewScene& scene, std::size_t index, ReportFile& report) {
    const Event& event = scene.input().reviewed.events[index];
    const std::string number = std::to_string(index + 1);
    page.subheading(number + ". " + nameOf(event.kind) + (event.zone.empty() ? "" : ": " + event.zone) + ", " +
                    videoClockText(scene.secondsOf(event.first_frame)));
    const std::string still = "still-" + number, close_up = "close-up-" + number;
    const std::string path = "path-" + number, speed = "speed-" + number;
    const std::string way = pathSketch(scene, event), speeds = speedSketch(scene, event);
    if (!way.empty()) report.add(path, ReportPicture::Kind::svg, way, kSmallWidth_mm);
    if (!speeds.empty()) report.add(speed, ReportPicture::Kind::svg, speeds, kSpeedWidth_mm);
    const auto shown = [&](const std::string& name) { return report.pictures.contains(name) ? picture(name) : ""; };
    page.beginTable({}, 1000, "event");
    page.row({shown(still), factsTable(scene, event, scene.input().reviewed.verdictOn(index))});
    page.endTable();
    const std::string row = shown(close_up) + shown(path) + shown(speed);
    if (row.empty()) return;
    page.beginTable({}, 1000, "event");
    page.row({shown(close_up), shown(path), shown(speed)});
    page.endTable();
}

/// Reads each frame once, in ascending order; answers what went wrong, if anything.
std::string addStills(const ReviewScene& scene, const std::vector<std::size_t>& chosen, FrameSource* pixels,
                      ReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop) {
    if (chosen.empty()) return {};
    if (pixels == nullptr) return "the video could not be read";
    std::vector<std::size_t> by_frame = chosen;
    const auto frameOf = [&](std::size_t i) { return scene.input().reviewed.events[i].frame; };
    std::stable_sort(by_frame.begin(), by_frame.end(),
                     [&](std::size_t a, std::size_t b) { return frameOf(a) < frameOf(b); });
    Frame frame;
    bool read = false;
    for (std::size_t k = 0; k < by_frame.size(); ++k) {
        if (stop.stop_requested()) return "the report was stopped";
        const Event& event = scene.input().reviewed.events[by_frame[k]];
        try {
            if (!read || frame.index != event.frame) frame = pixels->read(event.frame, true);
            read = true;
            const std::string number = std::to_string(by_frame[k] + 1);
            report.add("still-" + number, ReportPicture::Kind::jpeg, eventStill(scene, event, frame), kStillWidth_mm);
            report.add("close-up-" + number, ReportPicture::Kind::jpeg, eventCloseUp(scene, event, frame),
                       kSmallWidth_mm);
        } catch (const std::exception& error) {
            return error.what();
        }
        if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(by_frame.size()));
    }
    return {};
}

void tellGround(ReportPage& page, const ReviewScene& scene, const std::vector<std::size_t>& chosen, FrameSource* pixels,
                ReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop) {
    if (chosen.empty() || pixels == nullptr) return;
    GroundChapter ground;
    try {
        ground = addGround(scene, chosen, *pixels, report, progress, stop);
    } catch (const std::exception& error) {
        page.chapter("The ground");
        page.paragraph("There is no picture of the ground: " + markupEscaped(error.what()) + ".");
        return;
    }
    if (ground.pictures.empty()) return;
    page.chapter("The ground");
    std::string text =
        "What was seen of the ground, from above. Rings are the places of the events with their numbers; lines are the "
        "paths of their vehicles, blue while the event lasts.";
    if (ground.left_out > 0)
        text += " " + std::to_string(ground.left_out) + (ground.left_out == 1 ? " event lies" : " events lie") +
                " on ground that is not shown here.";
    page.paragraph(text);
    for (const std::string& name : ground.pictures) page.paragraph(picture(name));
}

}  // namespace

ReviewScene::ReviewScene(const ReviewReportInput& input)
    : input_(input),
      ground_(input.reviewed.tracks.footage),
      paths_(groundPaths(input.reviewed.tracks.tracks, ground_, input.choice.options)) {
    for (const EventTrack& track : input.reviewed.tracks.tracks) tracks_[track.id] = &track;
}

const OrientedBox* ReviewScene::boxOf(TrackId track, FrameIndex frame) const {
    const auto found = tracks_.find(track);
    if (found == tracks_.end()) return nullptr;
    const auto& boxes = found->second->boxes;
    const auto at = std::lower_bound(boxes.begin(), boxes.end(), frame,
                                     [](const TrackedBox& box, FrameIndex wanted) { return box.frame < wanted; });
    return at != boxes.end() && at->frame == frame ? &at->box : nullptr;
}

const GroundPath* ReviewScene::pathOf(TrackId track, FrameIndex frame) const {
    const GroundPath* best = nullptr;
    int least = 0;
    for (const GroundPath& path : paths_) {
        if (path.id() != track || path.samples.empty()) continue;
        const FrameIndex first = path.samples.front().frame, last = path.samples.back().frame;
        const int distance = std::max({0, first - frame, frame - last});
        if (best != nullptr && distance >= least) continue;
        best = &path;
        least = distance;
    }
    return best;
}

std::string ReviewScene::momentText(FrameIndex frame) const {
    const double seconds = secondsOf(frame);
    const auto utc = input_.clock.at(std::llround(seconds * 1e6));
    return videoClockText(seconds) + (utc ? ", " + utcTextToMilliseconds(*utc) : "");
}

ReviewReportInput gatherReviewReport(ProjectFile& project, const RunRecord& run, const EventChoice& choice,
                                     const FrameSource* pixels, std::optional<std::int64_t> start_utc_us,
                                     const std::stop_token& stop) {
    ReviewReportInput input;
    input.choice = choice;
    input.reviewed = readReviewedRun(project, run, choice);
    input.facts = factsOf(project, run);
    input.parameters = RunStore(project).parameters(run.id);
    input.seen = seenBy(project, run.sequence.id);
    const Footage& footage = input.reviewed.tracks.footage;
    VideoWorld video = videoWorldOf(pixels,
                                    {footage.image_size,
                                     footage.first_frame,
                                     footage.last_frame,
                                     footage.scale.frame_rate_hz,
                                     {},
                                     footage.camera,
                                     readControlPoints(project, run.sequence.id)},
                                    videoStartOf(project, run.sequence.id, start_utc_us), stop);
    input.clock = std::move(video.clock);
    input.places = std::move(video.places);
    if (video.metadata) input.scale_remark = remarkOnScale(run, video.metadata->timeline(), *pixels);
    return input;
}

std::vector<std::size_t> chosenEvents(const ReviewReportInput& input) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < input.reviewed.events.size(); ++i)
        if (input.choice.wants(input.reviewed.events[i].kind, input.reviewed.verdictOn(i), static_cast<int>(i) + 1))
            chosen.push_back(i);
    return chosen;
}

std::size_t countOfEvents(const ReviewReportInput& input) {
    return chosenEvents(input).size();
}

ReportFile makeReviewReport(const ReviewReportInput& input, FrameSource* pixels,
                            const std::function<void(double)>& progress, const std::stop_token& stop) {
    ReportFile report;
    const ReviewScene scene(input);
    const std::vector<std::size_t> chosen = chosenEvents(input);
    // Stills and the ground take about the same time.
    const auto halfOf = [&progress](double begin) {
        return [&progress, begin](double share) {
            if (progress) progress(begin + share / 2);
        };
    };
    const std::string trouble = addStills(scene, chosen, pixels, report, halfOf(0), stop);
    ReportPage page;
    tellReviewedVideo(page, scene);
    page.chapter("Events");
    if (!trouble.empty()) page.paragraph("Pictures are missing: " + markupEscaped(trouble) + ".");
    if (chosen.empty()) {
        page.paragraph(input.reviewed.events.empty() ? "Nothing happened that the limits call an event."
                                                     : "None of the events has such a verdict.");
    } else {
        page.paragraph(
            "Boxes and trails are those of the machine. Sketches show the way over the ground: the whole of it grey, "
            "the "
            "event blue, its place ringed; an arrow where the track ends.");
    }
    for (const std::size_t index : chosen) tellEvent(page, scene, index, report);
    tellGround(page, scene, chosen, pixels, report, halfOf(0.5), stop);
    tellRemainder(page, scene);
    const std::string name = std::filesystem::path(input.reviewed.run.sequence.path).filename().string();
    report.html = reportPage("Events of " + name + ", run " + std::to_string(input.reviewed.run.id), page.take());
    return report;
}

}  // namespace eyrie
