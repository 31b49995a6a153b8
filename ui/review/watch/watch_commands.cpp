#include "review/watch/watch_commands.h"

#include <QBuffer>
#include <QFileDialog>
#include <QFileInfo>

#include "canvas/overlay_settings.h"
#include "canvas/video_view.h"
#include "core/error.h"
#include "ground/moving_spans.h"
#include "io/atomic_file.h"
#include "io/output_files.h"
#include "review/watch/measure_tool.h"
#include "review/watch/watched_ground.h"
#include "session/project_session.h"
#include "widgets/display_text.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

const QString kSnapshotTopic = QStringLiteral("snapshot");
const QString kMovingTopic = QStringLiteral("moving");

}  // namespace

WatchCommands::WatchCommands(const WatchParts& parts, QObject* parent)
    : QObject(parent), parts_(parts), measure_(new MeasureTool(parts.session, parts.canvas, parts.ground, this)) {
    const WindowActions& actions = parts_.actions;
    bindCommands(this, {{actions.measure, [this](bool on) { on ? measure_->start() : measure_->end(); }},
                        {actions.draw_zone, [this] { measure_->end(); }},
                        {actions.draw_line, [this] { measure_->end(); }},
                        {actions.draw_arrow, [this] { measure_->end(); }},
                        {actions.deselect, [this] { measure_->end(); }},
                        {actions.snapshot, [this] { askForSnapshot(SnapshotKind::as_seen); }},
                        {actions.snapshot_plain, [this] { askForSnapshot(SnapshotKind::alone); }}});
    bindSwitches(this, {{actions.only_moving, [this] { playMoving(); }}});
    whenAny(
        measure_, this, [this] { parts_.actions.measure->setChecked(measure_->measuring()); },
        &MeasureTool::measuringChanged);
    whenAny(
        &parts_.ground, this,
        [this] {
            if (parts_.actions.only_moving->isChecked()) playMoving();
        },
        &WatchedGround::changed);
    whenAny(&parts_.overlays, this, &WatchCommands::followSensitivity, &OverlaySettings::changed);
}

WatchCommands::~WatchCommands() = default;

void WatchCommands::setActive(bool active) {
    active_ = active;
    if (!active) measure_->end();
    enableActions();
}

void WatchCommands::enableActions() {
    parts_.actions.measure->setEnabled(active_ && parts_.session.video().has_value());
}

// ---- playing --------------------------------------------------------------------------------------------------------

void WatchCommands::playMoving() {
    spans_query_.cancel();
    Playback& playback = parts_.session.playback();
    const auto ground = parts_.ground.ground();
    played_score_.reset();
    if (!parts_.actions.only_moving->isChecked() || !ground) {
        playback.setSpans(std::nullopt);
        parts_.messages.dismissTopic(kMovingTopic);
        if (parts_.actions.only_moving->isChecked())
            parts_.messages.showTopic(kMovingTopic, MessageKind::info, whyAllIsPlayed());
        return;
    }
    const double min_score = parts_.overlays.style().min_score;
    played_score_ = min_score;
    spans_query_.ask([this, ground, min_score](const BackgroundTask& task) {
        const auto spans = movingSpans(*ground->run, ground->stretches, {}, min_score);
        task.tell([this, ground, spans] {
            if (ground != parts_.ground.ground()) return;
            parts_.session.playback().setSpans(spans);
            const Footage& footage = ground->run->footage;
            const std::int64_t all = footage.last_frame - footage.first_frame + 1;
            const double seconds = static_cast<double>(framesIn(spans)) / footage.scale.frame_rate_hz;
            const double of_all = static_cast<double>(all) / footage.scale.frame_rate_hz;
            QString text = tr("Something moves, or could not be searched, in %1 of %2: only that is played.")
                               .arg(durationText(seconds), durationText(of_all));
            if (framesIn(spans) == all)
                text = tr("Something moves, or could not be searched, all the time: everything is played.");
            if (spans.empty()) text = tr("Nothing moves in this run: there is nothing to play.");
            parts_.messages.showTopic(kMovingTopic, MessageKind::info, text);
        });
    });
}

QString WatchCommands::whyAllIsPlayed() const {
    const auto& run = parts_.session.runData();
    if (parts_.session.running() || (run && run->record.live))
        return tr(
            "The run is still running; where something moves is known once it has finished. Until then everything is "
            "played.");
    if (!parts_.session.currentRun())
        return tr("Where something moves is known once a run has finished; until then everything is played.");
    return tr("Where something moves is not known yet; until then everything is played.");
}

void WatchCommands::followSensitivity() {
    if (played_score_ && *played_score_ != parts_.overlays.style().min_score) playMoving();
}

// ---- pictures -------------------------------------------------------------------------------------------------------

void WatchCommands::askForSnapshot(SnapshotKind kind) {
    // What is seen now is meant, whatever is shown by the time that the file has a name.
    const QImage picture = snapshotOf(parts_.canvas, parts_.session, kind);
    if (picture.isNull()) return;
    const QFileInfo project(QString::fromStdString(parts_.session.project().string()));
    const QString path = QFileDialog::getSaveFileName(
        &parts_.canvas, kind == SnapshotKind::as_seen ? tr("Save what is seen") : tr("Save the picture"),
        project.dir().filePath(snapshotName(parts_.canvas, parts_.session)), tr("PNG pictures (*.png)"));
    if (path.isEmpty()) return;
    const bool named = QFileInfo(path).suffix().compare(QStringLiteral("png"), Qt::CaseInsensitive) == 0;
    writeSnapshot((named ? path : path + QStringLiteral(".png")).toStdString(), picture);
}

void WatchCommands::writeSnapshot(const std::filesystem::path& path, const QImage& picture) {
    std::vector<std::filesystem::path> inputs{parts_.session.project()};
    if (parts_.session.media() && !isScene(parts_.session.media()->identity))
        inputs.emplace_back(parts_.session.media()->identity);
    snapshot_query_.write(
        [this, path, picture, inputs](const BackgroundTask& task) {
            filesToReplace({{path, FileKind::image}}, inputs);  // the dialog has asked whether to replace one
            QByteArray bytes;
            QBuffer buffer(&bytes);
            if (!picture.save(&buffer, "PNG")) throw Error(ErrorKind::internal, "the picture cannot be written as PNG");
            writeFileAtomically(path, {bytes.constData(), static_cast<std::size_t>(bytes.size())});
            task.tell([this, path] {
                parts_.messages.showTopic(kSnapshotTopic, MessageKind::info,
                                          tr("Saved %1.").arg(QString::fromStdString(path.string())));
            });
        },
        [this](const QString& message) { parts_.messages.showTopic(kSnapshotTopic, MessageKind::error, message); });
}

}  // namespace eyrie::ui

#include "moc_watch_commands.cpp"
