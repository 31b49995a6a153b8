#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "cli/reports/console_progress.h"
#include "cli/reports/figure_text.h"
#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"
#include "io/video/parts/part_list.h"
#include "metadata/metadata_tables.h"
#include "metadata/metadata_text.h"

namespace eyrie::cli {
namespace {

using Json = nlohmann::ordered_json;

struct MetadataArguments {
    std::vector<std::string> files;  ///< several: the parts of one video
    std::string file;                ///< of one its name, of several that of their list
    std::optional<int> stream;
    std::optional<int> frame;
    std::string csv;
    std::string json;
    OutputArguments outputs;
};

std::string counted(int count, const char* what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string trackName(const MetadataStream& stream, std::size_t number) {
    char text[64];
    if (stream.track.number < 0) return "Stream 0 (the file itself)";
    std::snprintf(text, sizeof text, "Stream %zu (track %d, PID 0x%x)", number, stream.track.number, stream.track.id);
    return text;
}

void printCounts(const MetadataStream& stream) {
    std::printf("  %s: %d of ST 0601, %d of the older universal set",
                counted(static_cast<int>(stream.packets.size()), "set").c_str(), stream.local_sets,
                stream.universal_sets);
    const int targets = stream.targetSets();
    int others = -targets;
    for (const auto& [key, count] : stream.other_sets) others += count;
    if (targets > 0) std::printf("; %d of moving targets (VMTI, ST 0903), not read", targets);
    if (others > 0) std::printf("; %d of other kinds, not read", others);
    std::puts("");
    if (stream.damaged() == 0)
        std::puts("  Nothing damaged");
    else
        std::printf("  Damaged, skipped: %s\n", damageText(stream).c_str());
    if (stream.without_checksum > 0) std::printf("  %d without a checksum, believed\n", stream.without_checksum);
}

void printClock(const MetadataStream& stream, const MetadataTimeline* timeline) {
    std::optional<std::int64_t> first, last;
    for (const MetadataPacket& packet : stream.packets) {
        if (!packet.utc_us) continue;
        if (!first) first = packet.utc_us;
        last = packet.utc_us;
    }
    if (first) std::printf("  Clock: %s to %s\n", utcText(*first).c_str(), utcText(*last).c_str());
    if (stream.without_time > 0) std::printf("  %d without a time\n", stream.without_time);
    if (stream.steps_back > 0 || stream.leaps > 0)
        std::printf("  Clock goes back %d×, leaps ahead by more than 10 s %d×%s\n", stream.steps_back, stream.leaps,
                    firstPlaceText(stream.first_jump).c_str());
    if (timeline != nullptr && timeline->placedByStamp() + timeline->placedByFile() > 0)
        std::printf("  Placed in the video: %d by their stamp, %d by where they lie in the file\n",
                    timeline->placedByStamp(), timeline->placedByFile());
}

void printTags(const MetadataStream& stream) {
    if (stream.tags.empty()) return;
    std::printf("  %-5s %-45s %7s %10s  %s\n", "tag", "name", "sets", "unreadable", "values");
    for (const auto& [number, summary] : stream.tags) {
        const TagInfo* info = infoOf(number);
        std::string values;
        if (number != tag::kTime && summary.has_numbers) {
            values = fixedText(summary.least, 6);
            if (summary.greatest > summary.least) values += " … " + fixedText(summary.greatest, 6);
            if (info != nullptr && info->unit[0] != '\0') values += std::string(" ") + info->unit;
        } else if (!summary.text.empty()) {
            values = summary.text + (summary.text_changes ? " (changes)" : "");
        }
        std::printf("  %-5s %-45s %7d %10d  %s\n", number == 0 ? "-" : std::to_string(number).c_str(),
                    number == 0 ? "items of unknown key" : nameOfTag(number).c_str(), summary.packets,
                    summary.unreadable, values.c_str());
    }
}

void printView(const GroundView& view, const MetadataState& state, FrameIndex frame, const FrameSource& source) {
    std::printf("Frame %d (%.3f s)\n", frame, static_cast<double>(source.timeOf(frame)) / 1e6);
    std::printf("  Time: %s\n", state.utc_us ? utcText(*state.utc_us).c_str() : "unknown");
    if (view.gsd_x_m_per_px && view.gsd_y_m_per_px) {
        std::printf("  Scale: %s m/px (%s across, %s down), from %s\n", numberText(*view.gsd()).c_str(),
                    numberText(*view.gsd_x_m_per_px).c_str(), numberText(*view.gsd_y_m_per_px).c_str(),
                    nameOf(view.scale_source));
    } else if (view.gsd()) {
        std::printf("  Scale: %s m/px across, from %s\n", numberText(*view.gsd()).c_str(), nameOf(view.scale_source));
    } else {
        std::puts("  Scale: unknown");
    }
    if (view.north_deg) {
        std::printf("  North: %.1f° clockwise from the image's right\n", *view.north_deg);
    } else {
        std::puts("  North: unknown");
    }
    if (view.footprint) {
        static constexpr const char* names[] = {"upper left", "upper right", "lower right", "lower left"};
        std::printf("  Footprint, from %s:\n", nameOf(view.source));
        for (std::size_t i = 0; i < view.footprint->size(); ++i)
            std::printf("    %-12s %11.7f %12.7f\n", names[i], (*view.footprint)[i].latitude_deg,
                        (*view.footprint)[i].longitude_deg);
    } else {
        std::puts("  Footprint: unknown");
    }
    for (const std::string& remark : view.remarks) std::printf("  Remark: %s\n", remark.c_str());
}

/// The first frame that the metadata place on the ground; else the first with any; else the first.
FrameIndex tellingFrame(const MetadataTimeline& timeline, const FrameSource& source) {
    constexpr int frames_to_try = 100;
    const int frames = source.info().frame_count;
    FrameIndex with_any = -1;
    for (int i = 0; i < std::min(frames, frames_to_try); ++i) {
        const FrameIndex frame =
            i < 2 ? i : static_cast<FrameIndex>(static_cast<std::int64_t>(i) * frames / frames_to_try);
        if (frame >= frames) break;
        const MetadataState state = timeline.at(source.timeOf(frame));
        if (groundViewOf(state, source.info().size).gsd()) return frame;
        if (with_any < 0 && !state.numbers.empty()) with_any = frame;
    }
    return std::max(with_any, 0);
}

std::size_t chosenStream(const MetadataRecording& recording, const MetadataArguments& arguments) {
    if (!arguments.stream) return static_cast<std::size_t>(std::max(recording.mostUseful(), 0));
    const auto count = static_cast<int>(recording.streams.size());
    if (*arguments.stream >= 0 && *arguments.stream < count) return static_cast<std::size_t>(*arguments.stream);
    throw Error(ErrorKind::parameter,
                "--stream " + std::to_string(*arguments.stream) + ": " + arguments.file + " has " +
                    (count == 0 ? "no stream of metadata" : "the streams 0 to " + std::to_string(count - 1)));
}

void checkFrame(const MetadataArguments& arguments, const FrameSource* source) {
    if (!arguments.frame) return;
    if (source == nullptr) throw Error(ErrorKind::parameter, "--frame: " + arguments.file + " has no frames");
    if (*arguments.frame >= 0 && *arguments.frame < source->info().frame_count) return;
    throw Error(ErrorKind::parameter, "--frame " + std::to_string(*arguments.frame) + ": " + arguments.file +
                                          " has frames 0 to " + std::to_string(source->info().frame_count - 1));
}

/// The video whose metadata are asked for; null for a file without pictures, `no_pictures` says why.
std::unique_ptr<FrameSource> videoOf(const MetadataArguments& arguments, const std::stop_token& stop,
                                     std::string& no_pictures) {
    const bool parts = arguments.files.size() > 1 || hasPartListName(arguments.file);
    if (parts) return openInputs(arguments.files, 0, stop, {});
    checkReadableFile(arguments.file);
    if (isRawKlv(arguments.file)) return nullptr;
    try {
        return openInput(arguments.file, 0, stop);
    } catch (const Error& error) {
        // Metadata are worth reading without pictures, too; what is no container at all fails below.
        if (error.kind() != ErrorKind::input || stop.stop_requested()) throw;
        no_pictures = error.what();
        return nullptr;
    }
}

/// Answers the exit code.
int tellMetadata(const MetadataArguments& arguments) {
    arguments.outputs.check({{arguments.csv, FileKind::text}, {arguments.json, FileKind::json}},
                            {arguments.files.begin(), arguments.files.end()});
    return untilStopped([&](const std::stop_token& stop) {
        std::string no_pictures;
        const auto source = videoOf(arguments, stop, no_pictures);
        checkFrame(arguments, source.get());
        ConsoleProgress progress("% read");
        const auto share = [&](double done) { progress.showShare(done); };
        const MetadataRecording recording =
            source ? readMetadata(source->info(), share, stop) : readMetadata(arguments.file, share, stop);
        const std::size_t chosen = chosenStream(recording, arguments);
        std::optional<MetadataTimeline> timeline;
        if (source && chosen < recording.streams.size())
            timeline.emplace(recording.streams[chosen], source->pictureStamps(), timelineOptionsOf(source->info()));

        Json facts{{"file", arguments.file}, {"streams", Json::array()}, {"other_tracks", Json::array()}};
        std::printf("%s\n", arguments.file.c_str());
        if (!no_pictures.empty()) std::fprintf(stderr, "eyrie-cli: %s\n", no_pictures.c_str());
        if (recording.streams.empty()) std::puts("No metadata (KLV)");
        for (std::size_t i = 0; i < recording.streams.size(); ++i) {
            const MetadataStream& stream = recording.streams[i];
            std::printf("%s%s\n", trackName(stream, i).c_str(),
                        i == chosen && recording.streams.size() > 1 ? ", the one that is used" : "");
            printCounts(stream);
            printClock(stream, i == chosen && timeline ? &*timeline : nullptr);
            printTags(stream);
            facts["streams"].push_back(jsonOf(stream));
        }
        for (const DataStream& track : recording.foreign_tracks) {
            std::printf("Track %d (PID 0x%x): data that is not KLV (%s)\n", track.number,
                        static_cast<unsigned>(track.id), track.codec.c_str());
            facts["other_tracks"].push_back({{"track", track.number}, {"id", track.id}, {"codec", track.codec}});
        }
        facts["used_stream"] = recording.streams.empty() ? Json(nullptr) : Json(chosen);
        if (timeline && !recording.streams[chosen].packets.empty()) {
            const FrameIndex frame = arguments.frame ? *arguments.frame : tellingFrame(*timeline, *source);
            const MetadataState state = timeline->at(source->timeOf(frame));
            const GroundView view = groundViewOf(state, source->info().size);
            printView(view, state, frame, *source);
            facts["frame"] = {{"frame", frame}, {"ground", jsonOf(view)}, {"values", jsonOf(state)}};
        }
        if (!arguments.csv.empty()) {
            if (recording.streams.empty())
                throw Error(ErrorKind::input, arguments.file + ": there is no metadata to write into " + arguments.csv);
            writeMetadataCsv(arguments.csv, recording.streams[chosen], timeline ? &*timeline : nullptr);
        }
        if (!arguments.json.empty())
            writeFileAtomically(arguments.json, facts.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
        return exit_ok;
    });
}

}  // namespace

void addMetadataCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<MetadataArguments>();
    CLI::App* command = app.add_subcommand(
        "metadata", "Show what a video says about its camera (MISB KLV): time, place, scale, north and footprint");
    command
        ->add_option("FILE", arguments->files,
                     "Video, e.g. a transport stream, or a file of nothing but KLV; several video files count as one "
                     "video, in their order")
        ->required();
    command->add_option("--frame", arguments->frame,
                        "Frame whose scale, north and footprint to show (default: the first that has them)");
    command->add_option("--stream", arguments->stream,
                        "Number of the stream to use, where there are several (default: the one that says most)");
    command
        ->add_option("--csv", arguments->csv,
                     "Write the sets of the stream as a table: a row for each set, a column for each tag")
        ->type_name("FILE");
    command->add_option("--json", arguments->json, "Write what is shown as JSON, too")->type_name("FILE");
    arguments->outputs.addTo(*command);
    command->callback([arguments, &exit_code] {
        const std::vector<std::filesystem::path> files(arguments->files.begin(), arguments->files.end());
        arguments->file = files.size() == 1 ? arguments->files.front() : partListName(files);
        exit_code = tellMetadata(*arguments);
    });
}

}  // namespace eyrie::cli
