#pragma once

#include <QWidget>
#include <functional>
#include <memory>

#include "review/card/story_loader.h"
#include "widgets/repeated_call.h"

class QLabel;
class QLineEdit;
class QStackedLayout;

namespace eyrie::ui {

class EmptyState;
class StorySketch;

/// What stands on a card.
struct CardSubject {
    QString title;  ///< "Stops · 0:12.4 · track 7"
    int event = 0;  ///< 0: a track that no event was chosen of, which has no note
    QString note;
    QString tags;    ///< "gate 3, lorry"
    QString judged;  ///< "Relevant: Anna, 14:03"; empty where nothing was said
    TrackId track = 0;
    FrameIndex frame = 0;

    bool operator==(const CardSubject&) const = default;
};

/// What is done on a card.
struct CardCommands {
    std::function<void(FrameIndex)> go_to = [](FrameIndex) {};
    std::function<void(int event, const QString& note)> write_note = [](int, const QString&) {};
    std::function<void(int event, const QString& tags)> write_tags = [](int, const QString&) {};
};

/// One event, or track, at a glance: its vehicle in a loop and stacked, how fast it was, which way it drove, note and
/// tags on it, and who judged it.
class EventCard : public QWidget {
    Q_OBJECT

 public:
    explicit EventCard(QWidget* parent = nullptr);
    ~EventCard() override;

    void setCommands(CardCommands commands) { commands_ = std::move(commands); }
    /// Nothing: no card. What is being written on the card of another event is kept first.
    void show(const std::optional<CardSubject>& subject);
    /// Keeps what is being written on the card.
    void keepWritten();
    const std::optional<CardSubject>& subject() const { return subject_; }
    /// What is said while there is no card.
    void explainNothing(const QString& text);
    /// The story of the subject; of another one it is not shown.
    void setStory(const std::shared_ptr<const VehicleStory>& story, const SceneScale& scale);
    /// The frame that is shown in the canvas.
    void setFrame(FrameIndex frame);

    const std::shared_ptr<const VehicleStory>& story() const { return story_; }
    StorySketch& speed() { return *speed_; }
    StorySketch& way() { return *way_; }
    QLabel& stacked() { return *stacked_; }
    QLineEdit& note() { return *note_; }
    QLineEdit& tags() { return *tags_; }
    QLabel& judged() { return *judged_; }
    /// The number of the chip shown; it goes on by itself.
    std::size_t chip() const { return chip_; }

 protected:
    void showEvent(QShowEvent* event) override;
    void hideEvent(QHideEvent* event) override;

 private:
    void nextChip();

    CardCommands commands_;
    std::optional<CardSubject> subject_;
    std::shared_ptr<const VehicleStory> story_;
    std::size_t chip_ = 0;
    QStackedLayout* stack_;
    EmptyState* empty_;
    QLabel* title_;
    QLabel* picture_;
    QLabel* stacked_;
    StorySketch* speed_;
    StorySketch* way_;
    QLineEdit* note_;
    QLineEdit* tags_;
    QLabel* judged_;
    RepeatedCall loop_;
};

}  // namespace eyrie::ui
