#include "review/events/event_review.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "core/error.h"
#include "store/database/snapshot.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr int kSearchDelay_ms = 250;  ///< while a threshold is being changed
constexpr int kRereadVerdicts_ms = 2000;
constexpr int kLookAgain_ms = 1000;
/// Between two looks at a run that works; at least so long, and so many times as long as one takes.
constexpr double kBetweenLooks_s = 5;
constexpr double kLooksShare = 20;

using LookClock = std::chrono::steady_clock;

std::vector<int> correctionsIn(const ReviewStore& store) {
    std::vector<int> ids;  // what a number stands for never changes
    for (const auto& [id, correction] : store.review().corrections) ids.push_back(id);
    return ids;
}
}  // namespace

/// Verdicts as they were read in the background.
struct EventReview::Opened {
    std::unique_ptr<ProjectFile> project;
    std::unique_ptr<ReviewStore> store;
};

EventReview::EventReview(ProjectSession& session, EventReviewAnswers answers, QObject* parent)
    : QObject(parent),
      session_(session),
      answers_(std::move(answers)),
      search_due_(kSearchDelay_ms, [this] { search(); }),
      reread_(kRereadVerdicts_ms, [this] { rereadReadOnly(); }),
      look_again_(kLookAgain_ms, [this] { searchSoFar(); }) {
    whenChanged(
        session_, this,
        {
            {SessionChange::video, [this] { otherVideo(); }},
            {{SessionChange::project, SessionChange::current_run, SessionChange::run_data, SessionChange::run_ended},
             [this] { refresh(); }},
        });
}

EventReview::~EventReview() = default;

void EventReview::setWanted() {
    if (std::exchange(wanted_, true)) return;
    refresh();
}

void EventReview::setOptions(const EventOptions& options) {
    options_ = options;
    if (key_) search_due_.start();
    next_look_ = {};
}

// ---- following the session ------------------------------------------------------------------------------------------

void EventReview::refresh() {
    if (!wanted_) return;
    const auto& data = session_.runData();
    const auto current = session_.currentRun();
    if (!data || !current || data->record.id != *current || session_.project().empty()) {
        // Of another run, whose tracks are not yet read, nothing may be shown that is this one's.
        const auto is_of_another = [&] {
            return (key_ && (key_->run != *current || key_->project != session_.project())) ||
                   (watched_ && watched_->id != *current);
        };
        if (!current || is_of_another()) close();
        readAhead();
        return;
    }
    const RunKey key{session_.project(), data->record.id, data->frames.size(), ownTracks(*data)};
    const RunRecord* own = session_.ownRun();
    if (data->record.live || (own != nullptr && own->id == data->record.id && session_.running())) {
        if (!watched_ || watched_->id != data->record.id) watchRun(data->record);
        return;
    }
    const bool goes_on = endWatching(data->record.id);
    if (key_ == key) return;
    const bool other_run = !goes_on && (!key_ || key_->project != key.project || key_->run != key.run);
    key_ = key;
    data_ = data;
    tracks_.reset();
    search_query_.cancel();
    if (other_run) {
        found_.reset();
        setState(State::searching);
    }
    if (store_ && store_project_ == key.project && store_sequence_ == data->record.sequence.id)
        search();
    else
        openStore(data->record.sequence.id);
}

/// Of a run that is done, what events are searched in, while the session reads its lists.
void EventReview::readAhead() {
    const RunRecord* run = session_.shownRun();
    if (run == nullptr || run->live || session_.running() || session_.project().empty()) return;
    ahead_.begin(session_.project(), *run);
}

/// When a live source has ended, its recording is opened: what was found in it stays.
void EventReview::otherVideo() {
    const bool recorded = live_ && session_.currentRun() == live_->run && session_.project() == live_->project &&
                          session_.media() && session_.media()->identity == live_->recording;
    if (!recorded) close();
}

/// Answers whether what was found so far is listed on until the whole run is searched.
bool EventReview::endWatching(int run_id) {
    if (!watched_) return false;
    if (watched_->id != run_id || !so_far_ || !found_) {
        close();
        return false;
    }
    look_again_.stop();
    search_query_.cancel();
    watched_.reset();
    return true;
}

void EventReview::close() {
    store_query_.cancel();
    search_query_.cancel();
    search_due_.stop();
    reread_.stop();
    reread_fault_told_ = false;
    look_again_.stop();
    ahead_.forget();
    key_.reset();
    data_.reset();
    watched_.reset();
    live_.reset();
    so_far_ = false;
    tracks_.reset();
    found_.reset();
    store_.reset();
    project_.reset();
    answers_.show_zones();
    setState(State::nothing);
}

void EventReview::setState(State state) {
    state_ = state;
    answers_.show_events();
}

void EventReview::fail(const QString& message) {
    found_.reset();
    so_far_ = false;
    key_.reset();  // so that it is tried again
    answers_.tell_problem(message);
    setState(State::failed);
}

void EventReview::openStore(int sequence_id) {
    store_.reset();
    project_.reset();
    store_project_ = key_->project;
    store_sequence_ = sequence_id;
    const auto work = [this, path = store_project_, sequence_id](const BackgroundTask& task) {
        auto opened = std::make_shared<Opened>();
        try {
            opened->project = std::make_unique<ProjectFile>(ProjectFile::open(path));
        } catch (const Error&) {  // events of a project that cannot be written can be looked at
            opened->project = std::make_unique<ProjectFile>(ProjectFile::open(path, ProjectFile::Mode::read_only));
        }
        opened->store = std::make_unique<ReviewStore>(*opened->project, sequence_id);
        task.tell([this, opened] {
            project_ = std::move(opened->project);
            store_ = std::move(opened->store);
            answers_.show_zones();
            if (store_->readOnly()) reread_.start();
            search();
        });
    };
    store_query_.ask(work, [this](const QString& message) { fail(message); });
}

void EventReview::search() {
    search_due_.stop();
    if (!key_ || !store_) return;
    // What is listed was found in other tracks of the same run: before it was done, or before they were corrected.
    const auto former = found_ && found_->run != tracks_ ? found_ : nullptr;
    const auto work = [this, key = *key_, data = data_, tracks = tracks_, options = options_,
                       verdicts = store_->review().verdicts, corrections = store_->review().corrections,
                       zones = zonesOf(store_->review().zones), version = store_->version(),
                       memo = session_.correctedTracks(), former, number = ++searches_,
                       corrections_made = corrections_made_,
                       ahead = ahead_.take(key_->project, data_->record)](const BackgroundTask& task) mutable {
        if (!tracks) {
            ProjectFile project = ProjectFile::open(key.project, ProjectFile::Mode::read_only);
            const RunStore store(project);
            const auto corrected = memo->of(store, key.project, data->record, corrections);
            if (corrected->empty()) tracks = ahead.wait();
            if (!tracks)
                tracks =
                    std::make_shared<const StoredTracks>(readTracks(store, data->record, data->frames, *corrected));
            task.tell([this, tracks, made = corrections_made] {
                if (made != corrections_made_) return;  // others by now: they are read next
                tracks_ = tracks;
                answers_.show_zones();
            });
        }
        if (task.stop().stop_requested()) return;
        const auto found = findAndOrder(tracks, options, verdicts, zones, former);
        task.tell([this, found, version, number] { adopt(found, version, number); });
    };
    search_query_.ask(
        work, [this](const QString& message) { fail(message); }, BackgroundQuery::Former::finish);
}

// ---- while a run works ----------------------------------------------------------------------------------------------

void EventReview::watchRun(const RunRecord& run) {
    close();
    watched_ = run;
    next_look_ = {};
    setState(State::at_work);
    // Who watches a live source acts on what happens now; of a file all is there soon.
    if (session_.liveSource() == nullptr) return;
    live_ = LiveRunKey{session_.project(), run.id, run.sequence.path};
    look_again_.start();
}

void EventReview::searchSoFar() {
    if (!watched_ || session_.liveSource() == nullptr || LookClock::now() < next_look_) return;
    next_look_ = LookClock::time_point::max();  // until this look has ended
    const auto work = [this, path = session_.project(), run = *watched_, options = options_,
                       former = found_](const BackgroundTask& task) {
        const LookClock::time_point begin = LookClock::now();
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        const auto tracks = [&] {
            const Snapshot unchanging(project);  // frames and tracks of the same moment
            return std::make_shared<const StoredTracks>(readTracks(RunStore(project), run));
        }();
        const std::vector<Zone> zones = zonesOf(readReview(project, run.sequence.id).zones);
        if (task.stop().stop_requested()) return;
        const auto found = findAndOrder(tracks, options, {}, zones, former);
        const double seconds = std::chrono::duration<double>(LookClock::now() - begin).count();
        task.tell([this, found, run_id = run.id, seconds] { adoptSoFar(found, run_id, seconds); });
    };
    // What cannot be read now may be at the next look; at the latest the end of the run tells.
    search_query_.ask(work, [this](const QString&) {
        next_look_ = LookClock::now() + std::chrono::seconds(static_cast<int>(kBetweenLooks_s));
    });
}

void EventReview::adoptSoFar(const std::shared_ptr<const FoundEvents>& found, int run_id, double seconds) {
    if (!watched_ || watched_->id != run_id) return;
    const double pause_s = std::max(kBetweenLooks_s, kLooksShare * seconds);
    // Zero: limits were changed meanwhile, which is to be seen at once.
    if (next_look_ != LookClock::time_point{})
        next_look_ = LookClock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(1000 * pause_s));
    if (found->run->shown_s.empty()) return;  // no frame is done yet
    found_ = found;
    carried_ = found->carried;  // no verdict on any
    so_far_ = true;
    setState(State::at_work);
}

std::optional<FrameIndex> EventReview::asOf() const {
    if (!so_far_ || !found_) return std::nullopt;
    return found_->run->footage.last_frame;
}

// ---- events of a whole run ------------------------------------------------------------------------------------------

void EventReview::adopt(const std::shared_ptr<const FoundEvents>& found, std::uint64_t version, std::uint64_t number) {
    // While they were searched for, another run may have been chosen, or something judged.
    if (!key_ || found->run != tracks_ || !store_) return;
    if (version != store_->version()) {
        search();
        return;
    }
    // Of several that follow the list shown the newest takes its place: the others would leave it nothing to follow.
    if (found_ && found_->run != tracks_ && number != searches_) return;
    found_ = found;
    carried_ = found->carried;
    so_far_ = false;
    setState(State::found);
}

void EventReview::rereadReadOnly() {
    if (!store_ || !store_->readOnly()) {
        reread_.stop();
        return;
    }
    const auto work = [this, path = store_project_, sequence_id = store_sequence_,
                       known = store_->changes()](const BackgroundTask& task) {
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        task.tell([this, reading = ReviewStore::readIfChanged(project, sequence_id, known)] { follow(reading); });
    };
    store_query_.ask(
        work, [this](const QString& message) { tellOnce(message); }, BackgroundQuery::Former::finish);
}

void EventReview::follow(std::optional<ReviewStore::Reading> reading) {
    if (!store_ || !store_->readOnly()) return;
    try {
        // Events of verdicts that another window made are found; when it is closed, the right to judge is ours.
        const auto corrections = correctionsIn(*store_);
        const bool others = reading && store_->follow(std::move(*reading));
        const bool may_write = store_->tryToWrite();
        reread_fault_told_ = false;
        if (!may_write && !others) return;
        answers_.show_zones();
        if (correctionsIn(*store_) != corrections)
            useOtherCorrections();
        else
            search();
    } catch (const std::exception& error) {
        tellOnce(QString::fromUtf8(error.what()));
    }
}

/// What cannot be read now may be the next time: it is tried on.
void EventReview::tellOnce(const QString& fault) {
    if (!std::exchange(reread_fault_told_, true)) answers_.tell_problem(fault);
}

}  // namespace eyrie::ui

#include "moc_event_review.cpp"
