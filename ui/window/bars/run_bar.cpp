#include "window/bars/run_bar.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSettings>
#include <QSpinBox>
#include <QToolButton>
#include <cmath>

#include "core/values/scene_scale.h"
#include "review/runs/run_text.h"
#include "widgets/gsd_text.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

/// What messages are about a GSD that cannot be used.
const QString kGsdTopic = QStringLiteral("gsd");
const QString kRateTopic = QStringLiteral("frame rate");
const QString kKeptSetting = QStringLiteral("window/kept_details");

QToolButton* toolButtonOf(QAction* action, QWidget* parent) {
    auto* button = new QToolButton(parent);
    button->setDefaultAction(action);
    button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    button->setFocusPolicy(Qt::NoFocus);
    return button;
}

}  // namespace

RunBar::RunBar(ProjectSession& session, const WindowActions& actions, MessageBar& messages, QWidget* parent)
    : QWidget(parent), session_(session), messages_(messages) {
    run_button_ = toolButtonOf(actions.run, this);
    stop_button_ = toolButtonOf(actions.stop, this);
    stop_button_->setToolButtonStyle(Qt::ToolButtonIconOnly);
    auto* continue_button = toolButtonOf(actions.continue_run, this);
    continue_button->setText(tr("Continue"));
    const auto offer = [continue_button, action = actions.continue_run] {
        continue_button->setText(tr("Continue"));
        continue_button->setVisible(action->isEnabled());
    };
    connect(actions.continue_run, &QAction::enabledChanged, continue_button, offer);
    offer();

    gsd_ = new QLineEdit(this);
    gsd_->setObjectName(QStringLiteral("gsd"));
    gsd_->setPlaceholderText(unknownGsdText());
    gsd_->setAccessibleName(tr("Ground sampling distance, metres per pixel"));
    gsd_->setClearButtonEnabled(true);
    gsd_->setFixedWidth(fontMetrics().horizontalAdvance(gsd_->placeholderText()) + 16);
    onFinished(this, &RunBar::takeGsd, gsd_);
    connect(gsd_, &QLineEdit::textEdited, this, &RunBar::forgetRefusal);
    connect(gsd_, &QLineEdit::returnPressed, this, &RunBar::editingDone);

    frame_rate_ = new QDoubleSpinBox(this);
    frame_rate_->setObjectName(QStringLiteral("frame_rate"));
    frame_rate_->setRange(0, 1000);  // 0: no video
    frame_rate_->setDecimals(3);
    frame_rate_->setSuffix(tr(" fps"));
    frame_rate_->setSpecialValueText(QStringLiteral("–"));
    frame_rate_->setKeyboardTracking(false);
    frame_rate_->setAccessibleName(tr("Frames per second"));
    onFinished(this, &RunBar::frameRateEdited, frame_rate_);

    const auto frameBox = [this](const QString& name) {
        auto* box = new QSpinBox(this);
        box->setKeyboardTracking(false);
        box->setAccessibleName(name);
        box->setToolTip(name);
        onFinished(this, &RunBar::rangeEdited, box);
        return box;
    };
    first_frame_ = frameBox(tr("First frame to process"));
    last_frame_ = frameBox(tr("Last frame to process"));

    makeDetails();

    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(4, 2, 4, 2);
    layout->addWidget(run_button_);
    layout->addWidget(stop_button_);
    layout->addWidget(continue_button);
    const auto named = [&](const QString& name, QWidget* field) {
        auto* label = new QLabel(name, this);
        label->setBuddy(field);
        layout->addSpacing(4);
        layout->addWidget(label);
        layout->addWidget(field);
    };
    named(tr("GSD (m/px)"), gsd_);
    named(tr("Rate"), frame_rate_);
    named(tr("Frames"), first_frame_);
    layout->addWidget(new QLabel(QStringLiteral("–"), this));
    layout->addWidget(last_frame_);
    named(tr("Keep"), details_);
    layout->addStretch(1);

    whenChanged(
        session_, this,
        {
            {{SessionChange::video, SessionChange::opened, SessionChange::scale}, [this] { refresh(); }},
            // Asked for once, when the project is known that may remember it.
            {SessionChange::opened, [this] { tellAssumedRate(); }},
            {SessionChange::video,
             [this] {
                 if (!session_.video() || !session_.video()->frame_rate_assumed) messages_.dismissTopic(kRateTopic);
             }},
            {{SessionChange::runs, SessionChange::current_run}, [this] { showOrigin(); }},
            {{SessionChange::following, SessionChange::run_started, SessionChange::run_ended}, [this] { enable(); }},
        });
    refresh();
}

void RunBar::makeDetails() {
    RecordingOptions& kept = session_.settings().recording;
    const std::string kept_last = QSettings().value(kKeptSetting).toString().toStdString();
    if (!kept_last.empty()) kept.details = RecordingOptions::among({{"recording.details", kept_last}}).details;
    details_ = new QComboBox(this);
    details_->setObjectName(QStringLiteral("kept_details"));
    details_->setAccessibleName(tr("What the run keeps beside its tracks"));
    // The bar has to fit into small windows; the room of an icon that there is none of holds the rest of the words.
    details_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    details_->setMinimumContentsLength(6);
    const auto choice = [this](const QString& text, KeptDetails details) {
        details_->addItem(text, static_cast<int>(details));
    };
    choice(tr("automatic"), KeptDetails::automatic);
    choice(tr("all details"), KeptDetails::all);
    choice(tr("1 frame in %1").arg(kept.details_every), KeptDetails::sampled);
    choice(tr("only tracks"), KeptDetails::none);
    details_->setToolTip(
        tr("Of which frames the next run keeps what its tracks were made from (recording.details): some 30 to 60 kB a "
           "frame, about 5 GB for an hour at 25 frames per second.\n\n"
           "Why?, Stages, Stacks, the motion vectors and detections over the video, causes of errors and sweeps need "
           "it. Tracks, events, measures, exports and reports do not, and what is found is the same.\n\n"
           "automatic: of all frames of a run of up to %1 frames, of none of a longer one.")
            .arg(locale().toString(kept.details_up_to)));
    bindCommands(this, {{details_, [this] {
                             session_.settings().recording.details =
                                 static_cast<KeptDetails>(details_->currentData().toInt());
                             QSettings().setValue(kKeptSetting,
                                                  QString::fromUtf8(nameOf(session_.settings().recording.details)));
                             emit editingDone();
                         }}});
}

void RunBar::forgetRefusal() {
    messages_.dismissTopic(kGsdTopic);
}

void RunBar::tellDoubt() {
    const double gsd = session_.settings().gsd_m_per_px;
    const std::string doubt = gsd > 0 && session_.video() ? doubtOfGsd(gsd) : std::string();
    if (doubt.empty())
        forgetRefusal();
    else
        messages_.showTopic(kGsdTopic, MessageKind::warning,
                            tr("GSD %1: %2.").arg(gsdOfSettings(), QString::fromStdString(doubt)));
}

void RunBar::refresh() {
    refreshing_ = true;
    const RunSettings& settings = session_.settings();
    gsd_->setText(gsdOfSettings());
    details_->setCurrentIndex(details_->findData(static_cast<int>(settings.recording.details)));
    if (const auto& video = session_.video()) {
        frame_rate_->setValue(video->frame_rate_hz);
        frame_rate_->setSuffix(video->frame_rate_assumed ? tr(" fps?") : tr(" fps"));
        frame_rate_->setToolTip(video->frame_rate_assumed
                                    ? tr("Assumed: it is not known how many frames per second these pictures have. "
                                         "Type the rate and press Return; the project remembers it.")
                                    : tr("Frames per second of the video. Folders of images do not "
                                         "state it: give it here. The project remembers it."));
        const int last = std::max(0, video->frame_count - 1);
        first_frame_->setRange(0, last);
        last_frame_->setRange(0, last);
        first_frame_->setValue(settings.range.first);
        last_frame_->setValue(settings.range.last < 0 ? last : settings.range.last);
    } else {
        frame_rate_->setValue(0);
    }
    refreshing_ = false;
    tellDoubt();
    showOrigin();
    enable();
}

QString RunBar::gsdOfSettings() const {
    const double gsd = session_.settings().gsd_m_per_px;
    return gsd > 0 ? locale().toString(gsd, 'g', 6) : QString();
}

void RunBar::showOrigin() {
    const RunRecord* run = session_.shownRun();
    // Without a run nothing was estimated yet.
    QString known = unknownGsdText();
    if (run != nullptr && run->scale_basis.origin == ScaleOrigin::estimated)
        known = tr("unknown; estimated %1").arg(locale().toString(run->scale.gsd_m_per_px, 'g', 3));
    else if (run != nullptr && run->scale_basis.origin == ScaleOrigin::metadata)
        known = tr("%1 from the metadata").arg(locale().toString(run->scale.gsd_m_per_px, 'g', 3));
    gsd_->setPlaceholderText(known);
    QString tip =
        tr("Ground sampling distance: metres on the ground per pixel. Without it the run takes it from the "
           "video's metadata, or else looks at the traffic for a scale to work with; then results are shown in pixels "
           "instead of metres and km/h.");
    if (run != nullptr) tip += QStringLiteral("\n\n") + tr("The run shown: %1.").arg(scaleText(*run));
    gsd_->setToolTip(tip);
}

bool RunBar::takeEdits() {
    // A click on Run or its key leaves the focus where it is; what was typed counts all the same.
    frame_rate_->interpretText();
    first_frame_->interpretText();
    last_frame_->interpretText();
    takeRange();
    takeFrameRate(false);
    return takeGsd();
}

void RunBar::enable() {
    const bool idle = session_.video().has_value() && !session_.running();
    for (QWidget* field : std::initializer_list<QWidget*>{gsd_, first_frame_, last_frame_}) field->setEnabled(idle);
    details_->setEnabled(!session_.running());  // a live source needs no video to begin with
    frame_rate_->setEnabled(idle && !session_.videoMissing());
    stop_button_->setVisible(session_.running());
}

bool RunBar::takeGsd() {
    if (refreshing_) return true;
    const auto value = gsdFromText(gsd_->text());
    if (!value) {
        messages_.showTopic(kGsdTopic, MessageKind::error, gsdFaultText(gsd_->text()));
        return false;
    }
    // What nobody changed keeps its digits that are not shown, and where it comes from.
    if (gsd_->text() != gsdOfSettings()) session_.settings().useGsd(*value);
    tellDoubt();
    return true;
}

void RunBar::frameRateEdited() {
    if (refreshing_ || !session_.video()) return;
    // Return in the field says that what stands there is right; leaving it says nothing.
    const bool confirmed = frame_rate_->hasFocus();
    emit editingDone();
    takeFrameRate(confirmed);
}

void RunBar::askForFrameRate() {
    frame_rate_->setFocus();
    frame_rate_->selectAll();
}

void RunBar::tellAssumedRate() {
    const auto& video = session_.video();
    if (!video || !video->frame_rate_assumed || session_.videoMissing()) {
        messages_.dismissTopic(kRateTopic);
        return;
    }
    messages_.showTopic(kRateTopic, MessageKind::warning,
                        tr("A folder of pictures does not state its frame rate: %1 frames per second are assumed until "
                           "you enter it. Times, speeds and what a run finds depend on it.")
                            .arg(locale().toString(video->frame_rate_hz, 'g', 4)),
                        tr("Enter the rate"), [this] { askForFrameRate(); });
}

void RunBar::takeFrameRate(bool confirmed) {
    if (!session_.video() || !frame_rate_->isEnabled()) return;
    if (frame_rate_->value() <= 0) {
        refresh();
        return;
    }
    const bool same = std::abs(frame_rate_->value() - session_.video()->frame_rate_hz) < 5e-4;
    if (same && !(confirmed && session_.video()->frame_rate_assumed)) return;
    session_.setFrameRate(frame_rate_->value());
}

void RunBar::rangeEdited() {
    if (refreshing_ || !session_.video()) return;
    takeRange();
    emit editingDone();
}

void RunBar::takeRange() {
    if (!session_.video()) return;
    if (last_frame_->value() < first_frame_->value()) last_frame_->setValue(first_frame_->value());
    FrameRange& range = session_.settings().range;
    range.first = first_frame_->value();
    range.last = last_frame_->value() >= session_.video()->frame_count - 1 ? -1 : last_frame_->value();
}

}  // namespace eyrie::ui

#include "moc_run_bar.cpp"
