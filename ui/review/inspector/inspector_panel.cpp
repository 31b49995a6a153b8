#include "review/inspector/inspector_panel.h"

#include <QFormLayout>
#include <QLabel>
#include <QLocale>
#include <QPainter>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "review/inspector/track_inspector.h"
#include "review/tracks/tracks_model.h"
#include "widgets/display_text.h"
#include "widgets/wiring.h"
#include "workspace/first_step.h"

namespace eyrie::ui {

namespace {

constexpr double kSurroundings = 1.8;  ///< the chip shows this many box lengths

QString registrationText(const Registration& registration) {
    switch (registration.state) {
        case RegistrationState::first:
            return QObject::tr("first frame");
        case RegistrationState::frozen:
            return QObject::tr("frozen picture");
        case RegistrationState::failed:
            return QObject::tr("failed: %1").arg(QString::fromStdString(describe(registration.failure)));
        case RegistrationState::registered:
            break;
    }
    const QString text = QObject::tr("rms %1 px, %2 corners agree")
                             .arg(numberText(registration.current_from_previous.rms_px, 3))
                             .arg(QLocale().toString(registration.current_from_previous.inliers));
    return registration.elapsed == 1 ? text
                                     : QObject::tr("%1; %2 frames have passed").arg(text).arg(registration.elapsed);
}

/// "1.8 times as large as in the first frame", as the camera zooms.
QString zoomText(double zoom) {
    const QString times = numberText(zoom > 1 ? zoom : 1 / zoom, 2);
    return zoom > 1 ? QObject::tr("%1 times as large as in the first frame").arg(times)
                    : QObject::tr("%1 times as small as in the first frame").arg(times);
}

TrackClass classOfTrack(const ProjectSession& session, TrackId track) {
    const TrackSummary* summary = session.trackSummary(track);
    return summary != nullptr ? summary->track_class : TrackClass::unknown;
}

/// The score of a track and what became of it: "0.12, below 0.2: left out of the result", "0.8, rejected by a person".
QString scoreOfTrack(const ProjectSession& session, TrackId track) {
    const TrackSummary* summary = session.trackSummary(track);
    if (summary == nullptr) return {};
    const QString score = numberText(summary->score, 2);
    if (isRejected(*summary)) return QObject::tr("%1, rejected by a person").arg(score);
    return summary->doubtful ? QObject::tr("%1, below %2: left out of the result")
                                   .arg(score, numberText(session.runData()->score_threshold, 2))
                             : score;
}

QString shadowOfTrack(const ProjectSession& session, TrackId track) {
    const TrackSummary* summary = session.trackSummary(track);
    return summary != nullptr && summary->trim ? capitalised(QString::fromStdString(describe(*summary->trim)))
                                               : QString();
}

/// Where shadows fall to in the frame shown; where that is not known, why.
QString lightOf(const ProjectSession& session, const ViewFrame& frame) {
    if (frame.shadow) return QObject::tr("fall %1").arg(QString::fromStdString(describe(*frame.shadow, frame.scale)));
    const RunRecord* run = session.shownRun();
    if (run != nullptr) {
        for (const LightFinding& finding : run->light) {
            if (finding.first_frame <= frame.index && frame.index <= finding.last_frame)
                return capitalised(QString::fromStdString(describe(std::vector{finding}, run->scale)));
        }
    }
    return QObject::tr("not known");
}

/// Stands for what a run found but did not keep.
QString notKept() {
    return QObject::tr("not kept (recording.details)");
}

/// How likely the detection in a track's box is a moving vehicle.
QString detectionText(const FrameResult& result, const OrientedBox& box) {
    const Detection* best = nullptr;
    double most = 0;
    for (const Detection& detection : result.detections) {
        if (detection.rejection != Rejection::none) continue;
        const double shared = overlap(detection.box, box);
        if (shared <= most) continue;
        most = shared;
        best = &detection;
    }
    if (best == nullptr) return QObject::tr("none here");
    if (std::isnan(best->probability)) return QObject::tr("score %1").arg(numberText(best->score, 2));
    return QObject::tr("%1 by this frame alone").arg(numberText(best->probability, 2));
}

}  // namespace

void ChipView::show(const QImage& image, const OrientedBox& box) {
    image_ = image;
    box_ = box;
    setVisible(!image.isNull());
    update();
}

void ChipView::paintEvent(QPaintEvent*) {
    if (image_.isNull()) return;
    QPainter painter(this);
    painter.fillRect(rect(), QColor(34, 36, 40));
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setRenderHint(QPainter::Antialiasing);
    const double wanted = std::max({box_.length, box_.width, 8.0}) * kSurroundings;
    const double scale = std::min(width(), height()) / wanted;
    painter.translate(width() / 2.0, height() / 2.0);
    painter.scale(scale, scale);
    painter.rotate(-90 - box_.heading * 180 / kPi);
    painter.translate(-box_.centre.x - 0.5, -box_.centre.y - 0.5);
    painter.drawImage(QPointF(0, 0), image_);
}

InspectorPanel::InspectorPanel(ProjectSession& session, QWidget* parent) : QWidget(parent), session_(session) {
    facts_ = new QWidget(this);
    title_ = new QLabel(facts_);
    QFont font = title_->font();
    font.setBold(true);
    font.setPointSizeF(font.pointSizeF() * 1.1);
    title_->setFont(font);
    rows_ = new QFormLayout;
    rows_->setLabelAlignment(Qt::AlignRight);
    rows_->setVerticalSpacing(3);
    rows_->setHorizontalSpacing(10);
    auto* facts_layout = new QVBoxLayout(facts_);
    facts_layout->addWidget(title_);
    facts_layout->addLayout(rows_);
    facts_layout->addStretch(1);

    track_page_ = new QWidget(this);
    chip_ = new ChipView(track_page_);
    track_ = new TrackInspector(track_page_);
    auto* track_layout = new QVBoxLayout(track_page_);
    track_layout->setContentsMargins(0, 0, 0, 0);
    track_layout->addWidget(chip_);
    track_layout->addWidget(track_, 1);

    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(facts_);
    layout->addWidget(track_page_);

    whenChanged(session_, this,
                {{SessionChange::picture, [this] { showFrame(session_.viewFrame()); }},
                 {SessionChange::video, [this] { showFrame({}); }},
                 {{SessionChange::current_run, SessionChange::run_preparing, SessionChange::run_started,
                   SessionChange::run_ended},
                  [this] { showFrame(session_.viewFrame()); }},
                 {SessionChange::selection, [this] { showSelection(); }}});
    connect(&session_, &ProjectSession::trackStatesRead, this,
            [this](TrackId track, const std::vector<TrackFrame>& states) {
                const RunRecord* run = session_.shownRun();
                track_->showTrack(track, states, session_.scale(), classOfTrack(session_, track),
                                  run != nullptr && run->rate_assumed);
                track_->showScore(scoreOfTrack(session_, track));
                track_->showShadow(shadowOfTrack(session_, track));
                track_->setCurrentFrame(session_.currentFrame());
            });
    connect(track_, &TrackInspector::frameActivated, &session_, &ProjectSession::goToFrame);
    showSelection();
}

void InspectorPanel::showSelection() {
    const auto track = session_.selectedTrack();
    facts_->setVisible(!track);
    track_page_->setVisible(track.has_value());
    if (!track) track_->clear();
    showFrame(session_.viewFrame());
}

void InspectorPanel::showFrame(const ViewFrame& frame) {
    if (session_.selectedTrack()) {
        track_->setCurrentFrame(frame.index);
        showChip();
    } else {
        showFacts();
    }
}

void InspectorPanel::showChip() {
    const ViewFrame& frame = session_.viewFrame();
    const TrackState* shown = stateOf(frame, *session_.selectedTrack());
    QString detection;
    if (shown != nullptr && frame.result)
        detection = session_.detailsKept(frame.index) ? detectionText(*frame.result, shown->box) : notKept();
    track_->showDetection(detection);
    if (shown != nullptr)
        chip_->show(frame.image, shown->box);
    else
        chip_->show({}, {});
}

void InspectorPanel::showFacts() {
    const ViewFrame& frame = session_.viewFrame();
    if (!frame.result) {
        title_->setText(tr("Nothing selected"));
        setRows({{QString(),
                  afterFirstStep(
                      session_,
                      tr("Click a track in the video or in the list: its life, speed and size are shown here."))}});
        return;
    }
    title_->setText(tr("Frame %1").arg(frame.index));
    const FrameResult& result = *frame.result;
    const bool details = session_.detailsKept(frame.index);
    const FrameSummary counts = details ? summaryOf(result) : *session_.frameSummary(frame.index);
    const Registration& registration = result.motion.registration;
    QList<std::pair<QString, QString>> rows{
        {tr("Registration"), registrationText(registration)},
        {tr("Corners"), QLocale().toString(counts.corners)},
        {tr("Motion vectors"), QLocale().toString(counts.motion_vectors)},
        {tr("Clusters"), details ? QLocale().toString(static_cast<int>(result.clusters.size())) : notKept()},
        {tr("Detections"), details ? tr("%1 of %2 kept").arg(counts.detections).arg(result.detections.size())
                                   : QLocale().toString(counts.detections)},
        {tr("Tracks"), QLocale().toString(counts.tracks)},
        {tr("Shadows"), lightOf(session_, frame)}};
    // Most cameras do not zoom.
    if (registration.zoom != 1) rows.insert(1, {tr("Zoom"), zoomText(registration.zoom)});
    setRows(rows);
}

void InspectorPanel::setRows(const QList<std::pair<QString, QString>>& rows) {
    // Labels are reused: this runs for every frame that is played.
    while (values_.size() < rows.size()) {
        names_.append(new QLabel(this));
        values_.append(new QLabel(this));
        names_.back()->setForegroundRole(QPalette::PlaceholderText);
        values_.back()->setWordWrap(true);
        values_.back()->setTextInteractionFlags(Qt::TextSelectableByMouse);
        rows_->addRow(names_.back(), values_.back());
    }
    for (qsizetype i = 0; i < values_.size(); ++i) {
        const bool used = i < rows.size();
        names_[i]->setText(used ? rows[i].first : QString());
        values_[i]->setText(used ? rows[i].second : QString());
        names_[i]->setVisible(used && !rows[i].first.isEmpty());
        values_[i]->setVisible(used);
    }
}

}  // namespace eyrie::ui

#include "moc_inspector_panel.cpp"
