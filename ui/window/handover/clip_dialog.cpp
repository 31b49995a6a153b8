#include "window/handover/clip_dialog.h"

#include <QCheckBox>
#include <QDoubleSpinBox>

#include "report/clip/run_clip.h"
#include "session/project_session.h"
#include "store/project/project_file.h"

namespace eyrie::ui {

namespace {
constexpr double kMostAround_s = 600;
}  // namespace

ClipDialog::ClipDialog(const ProjectSession& session, const ClipSubject& subject, QWidget* parent)
    : ExportDialog(sourceFor(this, session, subject), parent),
      around_(new QDoubleSpinBox),
      overlay_(new QCheckBox(tr("Draw the tracks with their numbers and trails"))) {
    around_->setRange(0, kMostAround_s);
    around_->setDecimals(1);
    around_->setSuffix(tr(" s"));
    around_->setValue(kAroundClip_s);
    around_->setToolTip(tr("How much is kept before and after"));
    overlay_->setChecked(true);
    addRow(QString(), overlay_);
    addRow(tr("Before and after"), around_);
}

void ClipDialog::setAround(double seconds) {
    around_->setValue(seconds);
}

void ClipDialog::setOverlay(bool overlay) {
    overlay_->setChecked(overlay);
}

ExportSource ClipDialog::sourceFor(const ClipDialog* self, const ProjectSession& session, const ClipSubject& subject) {
    ExportSource source;
    source.title = subject.title;
    source.name = subject.title;
    source.offers << ExportOffer{QStringLiteral("mp4"), tr("Video (mp4)"), QStringLiteral("mp4"), {}};
    const RunRecord run = session.runData()->record;
    const std::filesystem::path project = session.project();
    source.read = {project, run.sequence.path};
    source.files = [](const ExportWish& wish) -> std::vector<OutputFile> { return {{wish.path, FileKind::video}}; };
    // What is open now: the dialog may outlast it.
    const auto times_us = std::make_shared<const std::vector<std::int64_t>>(session.timesUs());
    source.begin = [self, times_us, media = *session.media(), subject, run,
                    project](const ExportWish& wish) -> ExportWork {
        const FrameIndex end = static_cast<FrameIndex>(times_us->size()) - 1;
        const FrameRange whole{std::min(run.first_frame, end), std::min(run.last_frame, end)};
        ClipWish clip;
        clip.range = framesAround(subject.frames, self->around_->value(), whole, [&](FrameIndex frame) {
            return 1e-6 * static_cast<double>(times_us->at(static_cast<std::size_t>(frame)));
        });
        clip.overlay = self->overlay_->isChecked();
        return [clip, run, project, wish, media](const ExportProgress& progress,
                                                 const std::stop_token& stop) -> std::optional<QString> {
            ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
            const auto pixels = media.open({}, stop);
            const auto written = writeClip(clip, file, run, *pixels, wish.path, progress, stop);
            if (!written) return std::nullopt;
            return tr("Wrote frames %1 to %2.\n%3")
                .arg(written->first)
                .arg(written->last)
                .arg(QString::fromStdString(wish.path.string()));
        };
    };
    return source;
}

}  // namespace eyrie::ui

#include "moc_clip_dialog.cpp"
