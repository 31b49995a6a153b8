#include "review/card/event_card.h"

#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPixmap>
#include <QStackedLayout>
#include <QVBoxLayout>

#include "review/card/story_sketch.h"
#include "widgets/empty_state.h"
#include "widgets/layout/scrolled.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr int kChipPeriod_ms = 120;
constexpr int kLongestNote = 500;
constexpr int kSpeedLines = 9;  ///< greatest height of the sketch of the speed, in lines of text
}  // namespace

EventCard::EventCard(QWidget* parent) : QWidget(parent), loop_(kChipPeriod_ms, [this] { nextChip(); }) {
    empty_ = new EmptyState;
    title_ = new QLabel;
    title_->setWordWrap(true);
    picture_ = new QLabel;
    picture_->setFixedSize(StoryLoader::kChipSize, StoryLoader::kChipSize);
    picture_->setAccessibleName(tr("The vehicle, two seconds before to two after"));
    stacked_ = new QLabel;
    stacked_->setAlignment(Qt::AlignCenter);
    stacked_->setToolTip(tr("The vehicle, stacked from about 25 frames, facing right"));
    stacked_->setAccessibleName(stacked_->toolTip());
    stacked_->setFixedSize(StoryLoader::kChipSize, StoryLoader::kChipSize / 2);  // what is below does not jump
    speed_ = new StorySketch(StorySketch::Kind::speed);
    speed_->setMaximumHeight(kSpeedLines * fontMetrics().lineSpacing());
    way_ = new StorySketch(StorySketch::Kind::way);
    note_ = new QLineEdit;
    note_->setMaxLength(kLongestNote);
    note_->setPlaceholderText(tr("Note"));
    note_->setAccessibleName(tr("Note"));
    tags_ = new QLineEdit;
    tags_->setMaxLength(kLongestNote);
    tags_->setPlaceholderText(tr("Tags, with commas between them"));
    tags_->setAccessibleName(tr("Tags"));
    judged_ = new QLabel;
    judged_->setWordWrap(true);
    judged_->setTextFormat(Qt::PlainText);
    auto* card = new QWidget;
    auto* grid = new QGridLayout(card);
    grid->setContentsMargins(6, 6, 6, 6);
    grid->setSpacing(6);
    grid->addWidget(title_, 0, 0, 1, 2);
    auto* pictures = new QVBoxLayout;
    pictures->addWidget(picture_);
    pictures->addWidget(stacked_);
    pictures->addStretch();
    grid->addLayout(pictures, 1, 0);
    grid->addWidget(way_, 1, 1);
    grid->addWidget(speed_, 2, 0, 1, 2);
    grid->addWidget(note_, 3, 0, 1, 2);
    grid->addWidget(tags_, 4, 0, 1, 2);
    grid->addWidget(judged_, 5, 0, 1, 2);
    grid->setRowStretch(2, 4);
    grid->setRowStretch(6, 1);
    grid->setColumnStretch(1, 1);
    stack_ = new QStackedLayout(this);
    stack_->addWidget(empty_);
    stack_->addWidget(scrolled(card));
    onFinished(
        this,
        [this] {
            if (subject_ && subject_->event != 0 && note_->text() != subject_->note)
                commands_.write_note(subject_->event, note_->text());
        },
        note_);
    onFinished(
        this,
        [this] {
            if (subject_ && subject_->event != 0 && tags_->text() != subject_->tags)
                commands_.write_tags(subject_->event, tags_->text());
        },
        tags_);
    for (StorySketch* sketch : {speed_, way_}) sketch->setGoTo([this](FrameIndex frame) { commands_.go_to(frame); });
}

EventCard::~EventCard() = default;

void EventCard::explainNothing(const QString& text) {
    empty_->setTexts(text);
}

/// Keys, and clicks that leave the focus where it is, go on to another event while something is being written.
void EventCard::keepWritten() {
    if (!subject_ || subject_->event == 0) return;
    const int event = subject_->event;
    const QString note = note_->text(), tags = tags_->text();
    const bool note_written = note_->isModified() && note != subject_->note;
    const bool tags_written = tags_->isModified() && tags != subject_->tags;
    // The card is shown anew when one is stored: both have been read by then, and are written once.
    note_->setModified(false);
    tags_->setModified(false);
    if (note_written) commands_.write_note(event, note);
    if (tags_written) commands_.write_tags(event, tags);
}

void EventCard::show(const std::optional<CardSubject>& subject) {
    if (subject == subject_) return;
    if (subject_ && (!subject || subject->event != subject_->event)) keepWritten();
    const bool same = subject && subject_ && subject->track == subject_->track && subject->frame == subject_->frame;
    const bool same_event = subject && subject_ && subject->event == subject_->event;
    // What stands there may be half written: it stays while nothing else is stored.
    const bool same_note = same_event && subject->note == subject_->note;
    const bool same_tags = same_event && subject->tags == subject_->tags;
    subject_ = subject;
    stack_->setCurrentIndex(subject ? 1 : 0);
    if (!same) setStory(nullptr, {});
    if (!subject) return;
    title_->setText(subject->title);
    note_->setVisible(subject->event != 0);
    if (!same_note) {
        note_->setText(subject->note);
        note_->setCursorPosition(0);
    }
    tags_->setVisible(subject->event != 0);
    if (!same_tags) tags_->setText(subject->tags);
    judged_->setVisible(!subject->judged.isEmpty());
    judged_->setText(subject->judged);
}

void EventCard::setStory(const std::shared_ptr<const VehicleStory>& story, const SceneScale& scale) {
    if (story && (!subject_ || story->wish.track != subject_->track || story->wish.frame != subject_->frame)) return;
    story_ = story;
    speed_->setPoints(story ? story->points : std::vector<StoryPoint>(), scale);
    way_->setPoints(story ? story->points : std::vector<StoryPoint>(), scale);
    // The loop goes on where only the stack has come.
    if (!story_ || chip_ >= story_->chips.size()) chip_ = 0;
    const bool has_stack = story_ && !story_->stack.isNull();
    if (!has_stack)
        stacked_->setPixmap({});
    else
        stacked_->setPixmap(QPixmap::fromImage(story_->stack)
                                .scaled(StoryLoader::kChipSize, StoryLoader::kChipSize / 2, Qt::KeepAspectRatio,
                                        Qt::SmoothTransformation));
    if (!story_ || story_->chips.empty()) picture_->setPixmap({});
}

void EventCard::setFrame(FrameIndex frame) {
    speed_->setMark(frame);
    way_->setMark(frame);
}

void EventCard::nextChip() {
    if (!story_ || story_->chips.empty()) return;
    chip_ = (chip_ + 1) % story_->chips.size();
    picture_->setPixmap(QPixmap::fromImage(story_->chips[chip_]));
}

void EventCard::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    loop_.start();
}

void EventCard::hideEvent(QHideEvent* event) {
    QWidget::hideEvent(event);
    loop_.stop();
}

}  // namespace eyrie::ui

#include "moc_event_card.cpp"
