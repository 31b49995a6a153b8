#include "review/inspector/track_inspector.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QRegularExpression>
#include <QStackedLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/angle.h"
#include "widgets/charts/origin_bar.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/wiring.h"

namespace eyrie::ui {
namespace {

double speedOf(const TrackState& state) {
    return std::hypot(state.velocity.x, state.velocity.y);
}

QString sizeText(double length_px, double width_px, const SceneScale& scale) {
    return QStringLiteral("%1 × %2 %3")
        .arg(numberText(shownLength(length_px, scale), 1), numberText(shownLength(width_px, scale), 1),
             lengthUnit(scale));
}

}  // namespace

TrackInspector::TrackInspector(QWidget* parent)
    : QWidget(parent), stack_(new QStackedLayout(this)), empty_(new EmptyState(this)) {
    empty_->setTexts(
        tr("Nothing selected. Click a track in the video, in the list or on the timeline to see its life, "
           "speed and size."));
    auto* page = new QWidget(this);
    auto* layout = new QVBoxLayout(page);
    title_ = new QLabel(page);
    QFont large = title_->font();
    large.setPointSizeF(large.pointSizeF() * 1.3);
    large.setBold(true);
    title_->setFont(large);
    origins_ = new OriginBar(page);
    form_ = new QFormLayout;
    form_->setHorizontalSpacing(12);
    auto* first = new QToolButton(page);
    first->setText(tr("First frame"));
    auto* last = new QToolButton(page);
    last->setText(tr("Last frame"));
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(first);
    buttons->addWidget(last);
    buttons->addStretch(1);
    layout->addWidget(title_);
    layout->addWidget(origins_);
    layout->addLayout(buttons);
    layout->addLayout(form_);
    layout->addStretch(1);
    stack_->addWidget(empty_);
    stack_->addWidget(page);

    class_ = addLine(tr("Class"));
    score_ = addLine(tr("Score"));
    life_ = addLine(tr("Life"));
    speed_ = addLine(tr("Mean speed"));
    size_ = addLine(tr("Mean size"));
    origin_counts_ = addLine(tr("Boxes"));
    shadow_ = addLine(tr("Shadow"));
    now_ = addLine(tr("In this frame"));
    position_ = addLine(tr("Position"));
    heading_ = addLine(tr("Heading"));
    speed_now_ = addLine(tr("Speed"));
    size_now_ = addLine(tr("Size"));
    detection_ = addLine(tr("Detection"));
    origin_counts_->setTextFormat(Qt::RichText);

    connect(origins_, &OriginBar::frameActivated, this, &TrackInspector::frameActivated);
    bindCommands(this, {{first, [this] { activate(false); }}, {last, [this] { activate(true); }}});
}

QLabel* TrackInspector::addLine(const QString& name) {
    auto* value = new QLabel(this);
    value->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    value->setWordWrap(true);
    form_->addRow(name, value);
    return value;
}

void TrackInspector::showOrDash(QLabel* label, const QString& text) {
    label->setText(text.isEmpty() ? QStringLiteral("–") : text);
}

void TrackInspector::activate(bool last) {
    if (!states_.empty()) emit frameActivated(last ? states_.back().frame : states_.front().frame);
}

void TrackInspector::showTrack(TrackId track, std::vector<TrackFrame> states, const SceneScale& scale,
                               TrackClass track_class, bool rate_assumed) {
    rate_assumed_ = rate_assumed;
    track_ = track;
    track_class_ = track_class;
    states_ = std::move(states);
    scale_ = scale;
    origins_->setStates(states_);
    if (states_.empty()) {
        clear();
        return;
    }
    showWhole();
    showNow();
    stack_->setCurrentIndex(1);
}

void TrackInspector::clear() {
    track_ = 0;
    states_.clear();
    stack_->setCurrentWidget(empty_);
}

void TrackInspector::setCurrentFrame(FrameIndex frame) {
    frame_ = frame;
    origins_->setCurrentFrame(frame);
    if (!states_.empty()) showNow();
}

void TrackInspector::showWhole() {
    const auto count = static_cast<double>(states_.size());
    double speed = 0;
    double fastest = 0;
    double length = 0;
    double width = 0;
    std::array<int, kStateOrigins> origins{};
    bool confirmed = false;
    for (const TrackFrame& state : states_) {
        // In pixels of the middle of the first picture, where they are to become metres.
        const double factor = scale_.gsd_known ? scale_.enlargementAt(state.frame, state.state.box.centre) : 1;
        speed += speedOf(state.state) / factor / count;
        fastest = std::max(fastest, speedOf(state.state) / factor);
        length += state.state.box.length / factor / count;
        width += state.state.box.width / factor / count;
        ++origins[static_cast<std::size_t>(state.state.origin)];
        confirmed = confirmed || state.state.status != TrackStatus::tentative;
    }
    const int first = states_.front().frame;
    const int last = states_.back().frame;
    title_->setText(confirmed ? tr("Track %1").arg(track_) : tr("Track %1 (tentative)").arg(track_));
    class_->setText(shownName(track_class_));
    life_->setText(tr("frames %1 to %2, %3")
                       .arg(first)
                       .arg(last)
                       .arg(durationText((last - first + 1) / std::max(scale_.frame_rate_hz, 1e-9))));
    QString speeds = tr("%1, at most %2").arg(speedText(speed, scale_), speedText(fastest, scale_));
    if (rate_assumed_ && scale_.gsd_known)
        speeds += tr(" (if there are %1 frames per second, which is assumed)").arg(numberText(scale_.frame_rate_hz, 0));
    speed_->setText(speeds);
    size_->setText(sizeText(length, width, scale_));
    QStringList counts;
    for (int i = 0; i < kStateOrigins; ++i) {
        const auto origin = static_cast<StateOrigin>(i);
        const bool rare = origin == StateOrigin::standing || origin == StateOrigin::by_hand;
        if (rare && origins[static_cast<std::size_t>(i)] == 0) continue;
        counts << QStringLiteral("<font color=\"%1\">■</font> %2 %3")
                      .arg(originColour(origin, palette()).name())
                      .arg(origins[static_cast<std::size_t>(i)])
                      .arg(shownName(origin));
    }
    origin_counts_->setText(counts.join(QStringLiteral(", ")));
}

void TrackInspector::showNow() {
    const auto at = std::lower_bound(states_.begin(), states_.end(), frame_,
                                     [](const TrackFrame& state, FrameIndex frame) { return state.frame < frame; });
    const bool lives = at != states_.end() && at->frame == frame_;
    for (QLabel* label : {position_, heading_, speed_now_, size_now_}) label->setText(QStringLiteral("–"));
    heading_->setToolTip({});
    if (!lives) {
        now_->setText(tr("absent"));
        return;
    }
    const TrackState& state = at->state;
    now_->setText(QString::fromLatin1(nameOf(state.status)) + QStringLiteral(", ") + shownName(state.origin));
    position_->setText(tr("%1, %2 px").arg(numberText(state.box.centre.x, 1), numberText(state.box.centre.y, 1)));
    showHeading(state.box);
    const SceneScale here = scale_.at(frame_, state.box.centre);
    speed_now_->setText(speedText(speedOf(state), here));
    size_now_->setText(sizeText(state.box.length, state.box.width, here));
}

void TrackInspector::showHeading(const OrientedBox& box) {
    // What rounds to a whole turn is none.
    const auto text = [](double degrees) { return numberText(std::fmod(std::round(degrees), 360), 0); };
    if (const auto course_deg = course_of_(frame_, box)) {
        heading_->setText(tr("%1° from north").arg(text(*course_deg)));
        heading_->setToolTip(tr("Over the ground, clockwise from north. In the image: %1° clockwise from the right")
                                 .arg(text(degreesFromRadians(box.heading))));
        return;
    }
    heading_->setText(tr("%1° in the image").arg(text(degreesFromRadians(box.heading))));
    heading_->setToolTip(
        tr("Clockwise from the right of the image; it changes when the camera turns. The course from "
           "north is shown where metadata or control points tell where the video lies on the earth"));
}

void TrackInspector::showCourse() {
    if (!states_.empty()) showNow();
}

QString TrackInspector::text() const {
    if (states_.empty()) return {};
    QString text = title_->text() + QLatin1Char('\n');
    for (int row = 0; row < form_->rowCount(); ++row) {
        const auto* name = qobject_cast<QLabel*>(form_->itemAt(row, QFormLayout::LabelRole)->widget());
        const auto* value = qobject_cast<QLabel*>(form_->itemAt(row, QFormLayout::FieldRole)->widget());
        QString plain = value->text();
        if (value->textFormat() == Qt::RichText) plain.remove(QRegularExpression(QStringLiteral("<[^>]*>")));
        text += name->text() + QLatin1Char('\t') + plain + QLatin1Char('\n');
    }
    return text;
}

}  // namespace eyrie::ui

#include "moc_track_inspector.cpp"
