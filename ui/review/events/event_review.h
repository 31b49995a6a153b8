#pragma once

#include <QObject>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "events/review/judging.h"
#include "review/events/found_events.h"
#include "review/events/tracks_ahead.h"
#include "session/background/background_query.h"
#include "session/project_session.h"
#include "store/review/review_store.h"
#include "widgets/delayed_call.h"
#include "widgets/repeated_call.h"

namespace eyrie::ui {

/// Whom a review of events tells what. All are called on its thread.
struct EventReviewAnswers {
    using Positions = std::vector<std::size_t>;  ///< in the queue

    /// Another state, or other events.
    std::function<void()> show_events;
    std::function<void(const Positions& positions)> show_verdicts;
    /// The zones or the bookmarks of the video are others, or were read.
    std::function<void()> show_zones;
    /// Verdicts on these events were undone or done again.
    std::function<void(const Positions& positions)> go_back_to;
    /// The text names what went wrong, the place and the remedy.
    std::function<void(const QString& text)> tell_problem;
    /// Why nothing was changed.
    std::function<void(const QString& text)> tell_notice;
};

/// The events of the run shown and what is said about them: searched for in the background as soon as they are wanted,
/// judged on the window's own thread, where a verdict takes a few milliseconds. Events are named by their place in the
/// queue.
class EventReview : public QObject {
    Q_OBJECT

 public:
    enum class State {
        nothing,    ///< no run
        at_work,    ///< the run is not done yet; of a live source, what was found so far
        searching,  ///< for the first time in this run
        found,
        failed
    };

    /// The session must outlive it.
    EventReview(ProjectSession& session, EventReviewAnswers answers, QObject* parent = nullptr);
    ~EventReview() override;

    /// Somebody wants to see events, now and of every run to come. Until then nothing is read, and the right to judge
    /// is not taken.
    void setWanted();
    /// Searches with other thresholds; of several in a short time the last counts.
    void setOptions(const EventOptions& options);

    State state() const { return state_; }
    /// Null unless events were found, or some so far.
    const std::shared_ptr<const FoundEvents>& found() const { return found_; }
    /// The last frame that was searched while a live source was watched; nothing when the list is that of a whole run.
    std::optional<FrameIndex> asOf() const;
    std::size_t count() const { return found_ ? found_->queue.size() : 0; }

    /// What is said about an event; null: nothing.
    const Verdict* verdictAt(std::size_t position) const;
    bool isJudged(std::size_t position) const;
    std::size_t judgedCount() const;
    /// Verdicts on this video for which this run has no event.
    std::size_t leftCount() const { return found_ ? found_->carried.left.size() : 0; }
    /// These, and why; to be used before anything else is judged.
    std::vector<std::pair<const Verdict*, CarryFault>> left() const;

    /// The zones that are watched; none until the verdicts were read.
    const std::map<int, StoredZone>& zones() const;
    /// Whether there is a place for zones and bookmarks: a run that is done, whose verdicts were read.
    bool canMark() const { return store_ != nullptr; }
    /// Changes zones by a step made from what was said and watched so far; searches anew where it makes a difference.
    bool changeZones(const std::function<ReviewEdit(const ReviewSet&, const Judge&, const NewId&)>& step);
    /// Places of the video that a person marked; none until the verdicts were read.
    const std::map<int, Bookmark>& bookmarks() const;
    /// Marks a frame, or gives the bookmark that is there another note. Steps that can be undone, as all below.
    bool setBookmark(FrameIndex frame, const QString& note);
    bool removeBookmark(int id);
    /// Corrections of the video's tracks; none until the verdicts were read.
    const std::map<int, TrackCorrection>& corrections() const;
    /// The number of the next one. Only where canMark().
    int newCorrectionId() { return store_->newCorrectionId(); }
    /// Makes some of new numbers, as one step; the person is named here. Answers whether they were made.
    bool correct(std::vector<TrackCorrection> corrections, const QString& step);
    /// Takes them back.
    bool removeCorrections(const std::vector<int>& ids, const QString& step);
    /// The tracks as people corrected them, and how the camera moved over the ground; null until the run was read.
    const std::shared_ptr<const StoredTracks>& tracks() const { return tracks_; }

    /// Each is one step that can be undone. What goes wrong is told as a problem, or as a notice where another window
    /// judges; they answer whether anything was changed.
    bool judge(const std::vector<std::size_t>& positions, Judgement judgement);
    bool setStarred(const std::vector<std::size_t>& positions, bool starred);
    bool setNote(std::size_t position, const QString& note);
    /// "gate 3, lorry".
    bool setTags(std::size_t position, const QString& tags);
    void undo();
    void redo();
    bool canUndo() const { return store_ && !store_->readOnly() && store_->canUndo(); }
    bool canRedo() const { return store_ && !store_->readOnly() && store_->canRedo(); }
    /// "Judge 12 events not relevant"; empty when there is nothing to undo.
    QString undoName() const { return store_ ? QString::fromStdString(store_->undoName()) : QString(); }
    QString redoName() const { return store_ ? QString::fromStdString(store_->redoName()) : QString(); }

 private:
    struct Opened;
    /// What of a run the events depend on; it is read again while the project changes otherwise.
    struct RunKey {
        std::filesystem::path project;
        int run = 0;
        std::size_t frames = 0;
        std::size_t tracks = 0;
        bool operator==(const RunKey&) const = default;
    };
    /// The run of a live source.
    struct LiveRunKey {
        std::filesystem::path project;
        int run = 0;
        std::string recording;  ///< its video
    };

    void refresh();
    void readAhead();
    void close();
    void otherVideo();
    bool endWatching(int run_id);
    void openStore(int sequence_id);
    void search();
    void watchRun(const RunRecord& run);
    void searchSoFar();
    void adoptSoFar(const std::shared_ptr<const FoundEvents>& found, int run_id, double seconds);
    void adopt(const std::shared_ptr<const FoundEvents>& found, std::uint64_t version, std::uint64_t number);
    void setState(State state);
    void fail(const QString& message);
    void rereadReadOnly();
    void follow(std::optional<ReviewStore::Reading> reading);
    void tellOnce(const QString& fault);
    int& verdictIdAt(std::size_t position);
    int verdictIdAt(std::size_t position) const;
    bool mayWrite();
    bool mayJudge();
    bool applyStep(const std::function<ReviewEdit()>& step);
    /// Tells it, also whoever is about to close the window.
    void notStored(const std::exception& error);
    void useOtherCorrections();
    bool apply(const ReviewEdit& edit, const std::vector<std::size_t>& positions);
    std::vector<Judged> judgedAt(const std::vector<std::size_t>& positions) const;
    Judge whoJudges() const;
    void goBack(const std::function<std::optional<ReviewEdit>()>& step);

    ProjectSession& session_;
    EventReviewAnswers answers_;
    bool wanted_ = false;
    State state_ = State::nothing;
    std::optional<RunKey> key_;
    std::shared_ptr<const RunData> data_;
    std::optional<RunRecord> watched_;                   ///< the run that is not done yet
    std::optional<LiveRunKey> live_;                     ///< what is watched, or was
    bool so_far_ = false;                                ///< what is found is what was found while it was watched
    std::chrono::steady_clock::time_point next_look_{};  ///< at what it found so far
    EventOptions options_;
    std::shared_ptr<const StoredTracks> tracks_;  ///< of the run above, once they were read
    std::uint64_t corrections_made_ = 0;          ///< grows with every change of corrections
    std::uint64_t searches_ = 0;                  ///< that were asked for
    std::shared_ptr<const FoundEvents> found_;
    CarriedVerdicts carried_;  ///< which event has which verdict now
    std::filesystem::path store_project_;
    int store_sequence_ = 0;
    std::unique_ptr<ProjectFile> project_;
    std::unique_ptr<ReviewStore> store_;
    DelayedCall search_due_;
    RepeatedCall reread_;             ///< what another window judges is read now and then
    bool reread_fault_told_ = false;  ///< and it could not be read since
    RepeatedCall look_again_;
    TracksAhead ahead_;
    BackgroundQuery store_query_;
    BackgroundQuery search_query_;  ///< last: all stop before the rest goes
};

}  // namespace eyrie::ui
