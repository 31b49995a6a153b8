#include "window/handover/track_export.h"

#include <QCoreApplication>

#include "correction/corrected_run.h"
#include "exchange/project_labels.h"
#include "exchange/run_export.h"
#include "exchange/vmti_export.h"
#include "formats/track_world.h"
#include "label/files/label_files_export.h"
#include "label/files/label_files_text.h"
#include "session/project_session.h"
#include "store/database/snapshot.h"
#include "store/project/project_file.h"

namespace eyrie::ui {

namespace {

QString tell(const char* text) {
    return QCoreApplication::translate("TrackExport", text);
}

/// The run and where it and its video are.
struct ExportedRun {
    RunRecord record;
    std::filesystem::path project;
    std::optional<Media> media;
};

ExportOffer vmtiOffer() {
    ExportOffer offer;
    offer.name = QString::fromLatin1(kVmtiFormat);
    offer.title = tell("MISB ST 0903 VMTI in a copy of the video");
    offer.ending = QStringLiteral("ts");
    offer.holds = tell("targets with ids, confidence, boxes, and places where they are known; not: rotation");
    return offer;
}

QString vmtiText(const VmtiReport& report, const LabelStream& labels) {
    return tell("Wrote a copy of the video with %1 sets of %2 targets.\n").arg(report.frames).arg(report.targets) +
           lines(remarksOn(report, labels.about.world->no_place)) + lines(labels.about.notes);
}

std::optional<QString> writeTracks(const ExportedRun& run, const ExportWish& wish, const ExportProgress& progress,
                                   const std::stop_token& stop) {
    ProjectFile project = ProjectFile::open(run.project, ProjectFile::Mode::read_only);
    const RunStore store(project);
    const CorrectedTracks corrected = readCorrectedTracks(project, run.record);
    const Snapshot unchanging(project);
    LabelStream labels = labelStreamOf(store, run.record, corrected);
    const auto open = [&] { return run.media ? run.media->open({}, stop) : nullptr; };
    const auto video = openVideoFor(wish.format, run.record, open, stop);
    addWorld(labels, wish.format, project, run.record, video.get(), {}, stop);
    if (wish.format != kVmtiFormat) {
        const ExportReport report =
            writeLabels(labels, wish.path, wish.format, exportOptionsOf(wish, run.record.sequence.path), stop);
        return exportText(report) + lines(labels.about.notes);
    }
    const VmtiReport report = writeVmti(labels, *video, wish.path, progress, stop);
    if (stop.stop_requested()) return std::nullopt;
    return vmtiText(report, labels);
}

}  // namespace

ExportSource trackExport(const ProjectSession& session) {
    const ExportedRun run{session.runData()->record, session.project(), session.media()};
    ExportSource source;
    source.title = tell("Export tracks");
    source.name =
        tell("%1 tracks").arg(QString::fromStdString(std::filesystem::path(run.record.sequence.path).stem().string()));
    for (const LabelFormatInfo& format : labelFormats())
        if (format.writes) source.offers << offerOf(format);
    if (run.media && !isScene(run.record.sequence.path)) source.offers << vmtiOffer();
    source.read = {run.project, run.record.sequence.path};
    source.files = [run](const ExportWish& wish) -> std::vector<OutputFile> {
        if (wish.format == kVmtiFormat) return {{wish.path, FileKind::video}};
        return labelOutputs(wish, exportOptionsOf(wish, run.record.sequence.path));
    };
    source.begin = [run](const ExportWish& wish) -> ExportWork {
        return [run, wish](const ExportProgress& progress, const std::stop_token& stop) {
            return writeTracks(run, wish, progress, stop);
        };
    };
    return source;
}

}  // namespace eyrie::ui
