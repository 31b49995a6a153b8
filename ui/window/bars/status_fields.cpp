#include "window/bars/status_fields.h"

#include <QIcon>
#include <QLabel>
#include <QLocale>
#include <QProgressBar>
#include <QStatusBar>
#include <QToolButton>
#include <cmath>
#include <utility>

#include "core/geometry/place_text.h"
#include "core/time/time_text.h"
#include "widgets/display_text.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr int kProgressSteps = 1000;

QLabel* field(QStatusBar& bar, const QString& widest) {
    auto* label = new QLabel(&bar);
    label->setMinimumWidth(label->fontMetrics().horizontalAdvance(widest) + 12);
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
    label->setFocusPolicy(Qt::NoFocus);
    return label;
}
}  // namespace

StatusFields::StatusFields(ProjectSession& session, QStatusBar& bar) : QObject(&bar), session_(session) {
    frame_ = field(bar, QStringLiteral("frame 00000 / 00000   00:00.00"));
    clock_ = field(bar, QString());
    cursor_ = field(bar, QStringLiteral("0000.0, 0000.0 px   000.0, 000.0 m"));
    zoom_ = field(bar, QStringLiteral("0000 %"));
    place_ = field(bar, QStringLiteral("-00.000000, -000.000000"));
    work_ = new QLabel(&bar);
    bar_ = new QProgressBar(&bar);
    bar_->setRange(0, kProgressSteps);
    bar_->setTextVisible(false);
    bar_->setFixedWidth(160);
    bar_->setMaximumHeight(14);
    stop_ = new QToolButton(&bar);
    stop_->setIcon(QIcon::fromTheme(QStringLiteral("dialog-close")));
    stop_->setAutoRaise(true);
    stop_->setToolTip(tr("Stop"));
    bar.addWidget(frame_);
    bar.addWidget(clock_);
    bar.addWidget(cursor_);
    bar.addWidget(zoom_);
    bar.addWidget(place_);
    bar.addPermanentWidget(work_);
    bar.addPermanentWidget(bar_);
    bar.addPermanentWidget(stop_);
    hideProgress();

    whenChanged(session_, this,
                {
                    // The number names the picture it stands under, which may come later than it was asked for.
                    {{SessionChange::picture, SessionChange::video},
                     [this] {
                         showFrame();
                         showPlace();  // of another frame, though the cursor rests
                     }},
                    {SessionChange::run_preparing, [this] { showPreparing(); }},
                    {SessionChange::run_started,
                     [this] {
                         if (const RunRecord* run = session_.ownRun())
                             showRun({0, run->last_frame - run->first_frame + 1, 0, 0});
                     }},
                    {SessionChange::run_ended, [this] { hideProgress(); }},
                });
    connect(&session_, &ProjectSession::openingEnded, this, &StatusFields::hideProgress);
    connect(&session_, &ProjectSession::openingProgress, this, &StatusFields::showOpening);
    connect(&session_, &ProjectSession::runProgress, this, &StatusFields::showRun);
    bindCommands(this, {{stop_, [this] { stop(); }}});
}

void StatusFields::showPreparing() {
    if (session_.liveSource() != nullptr) {
        work_->setText(tr("waiting for the live source…"));
        bar_->setRange(0, 0);
        showProgress();
        return;
    }
    work_->setText(session_.settings().gsd_m_per_px > 0 ? tr("starting the run…") : tr("looking for the scale…"));
    bar_->setRange(0, 0);
    showProgress();
}

void StatusFields::stop() {
    if (session_.opening()) {
        session_.cancelOpening();
        return;
    }
    session_.stopRun();
    work_->setText(tr("stopping…"));
}

void StatusFields::showFrame() {
    const auto& video = session_.video();
    showClock();
    if (!video) {
        frame_->clear();
        return;
    }
    const FrameIndex frame = session_.shownFrame();
    const auto& times = session_.timesUs();
    const QString time = static_cast<size_t>(frame) < times.size()
                             ? QString::fromStdString(timeText(times[static_cast<size_t>(frame)]))
                             : QString();
    QString text = tr("frame %1 / %2   %3").arg(frame).arg(video->frame_count - 1).arg(time);
    if (video->frame_rate_assumed)
        text += tr("   at %1 fps (assumed)").arg(QLocale().toString(video->frame_rate_hz, 'g', 4));
    frame_->setText(text);
    frame_->setToolTip(session_.partText(frame));
}

void StatusFields::setClock(ClockOfFrames clock) {
    clock_of_frames_ = std::move(clock);
    showClock();
}

void StatusFields::showClock() {
    const QString text = session_.video() ? clock_of_frames_.text(session_.shownFrame()) : QString();
    clock_->setVisible(!text.isEmpty());
    clock_->setText(text);
    clock_->setToolTip(text.isEmpty() ? text : tr("When the frame was taken, by %1").arg(clock_of_frames_.origin()));
}

void StatusFields::setPlaces(PlacesInPicture places) {
    places_ = std::move(places);
    showPlace();
}

void StatusFields::showPlace() {
    const auto place = cursor_at_ && session_.video() ? places_.place_of(*cursor_at_) : std::nullopt;
    place_->setText(place ? QString::fromStdString(placeText(*place)) : QString());
    place_->setToolTip(place ? tr("Latitude and longitude under the cursor, degrees. %1").arg(places_.origin())
                             : QString());
}

void StatusFields::showCursor(std::optional<QPointF> image_point) {
    cursor_at_ = image_point;
    showPlace();
    if (!image_point || !session_.video()) {
        cursor_->clear();
        return;
    }
    const QLocale locale;
    QString text =
        tr("%1, %2 px").arg(locale.toString(image_point->x(), 'f', 1), locale.toString(image_point->y(), 'f', 1));
    const SceneScale scale = session_.scale().in(session_.viewFrame().index);
    // In an oblique view pixels do not add up to metres; how long one is there is told instead.
    if (scale.gsd_known && !scale.slope.isFlat())
        text += tr("   %1 m/px here")
                    .arg(locale.toString(scale.at({image_point->x(), image_point->y()}).gsd_m_per_px, 'g', 3));
    else if (scale.gsd_known)
        text += tr("   %1, %2 m")
                    .arg(locale.toString(scale.metres(image_point->x()), 'f', 1),
                         locale.toString(scale.metres(image_point->y()), 'f', 1));
    cursor_->setText(text);
}

void StatusFields::showZoom(double zoom, bool ground_held) {
    QString text = session_.video() ? tr("%1 %").arg(std::lround(zoom * 100)) : QString();
    if (!text.isEmpty() && ground_held) text += tr("   ground held still");
    zoom_->setText(text);
}

void StatusFields::showRun(const RunProgress& progress) {
    if (!session_.running()) return;
    if (session_.liveSource() != nullptr && !progress.estimating_scale) {
        work_->setText(tr("live   %1 fps").arg(QLocale().toString(progress.frames_per_second, 'f', 1)));
        work_->show();
        bar_->hide();  // nobody knows how long it is
        stop_->show();
        return;
    }
    const double share =
        progress.frames_total > 0 ? progress.frames_done / static_cast<double>(progress.frames_total) : 0;
    const int percent = static_cast<int>(share * 100);
    QString text = progress.estimating_scale ? tr("estimating the scale: %1 %").arg(percent)
                   : progress.finishing      ? tr("finishing the tracks: %1 %").arg(percent)
                                             : tr("run: %1 %").arg(percent);
    if (!progress.estimating_scale && progress.frames_per_second > 0)
        text += tr("   %1 fps   %2")
                    .arg(QLocale().toString(progress.frames_per_second, 'f', 1), leftText(progress.seconds_left));
    work_->setText(text);
    bar_->setRange(0, kProgressSteps);
    bar_->setValue(static_cast<int>(share * kProgressSteps));
    showProgress();
}

void StatusFields::showOpening(const QString& name, double share) {
    const QString shown = work_->fontMetrics().elidedText(name, Qt::ElideMiddle, 260);
    work_->setText(tr("opening %1").arg(shown));
    bar_->setRange(0, share > 0 ? kProgressSteps : 0);
    bar_->setValue(static_cast<int>(share * kProgressSteps));
    showProgress();
}

void StatusFields::showProgress() {
    work_->show();
    bar_->show();
    stop_->show();
}

void StatusFields::hideProgress() {
    if (session_.running() || session_.opening()) return;
    work_->hide();
    bar_->hide();
    stop_->hide();
}

}  // namespace eyrie::ui

#include "moc_status_fields.cpp"
