#include "cli/batch/batch.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>

#include "cli/command.h"
#include "core/error.h"
#include "core/project_name.h"
#include "core/time/utc_time.h"
#include "io/file_digest.h"
#include "io/folder.h"
#include "io/video/image_sequence.h"
#include "store/labels/annotation_store.h"
#include "store/runs/run_counts.h"
#include "store/runs/run_store.h"
#include "store/runs/source_digest.h"

namespace eyrie::cli {
namespace {

constexpr std::chrono::seconds kBetweenLooks{5};
constexpr int kBegunAtOnce = 16;  ///< rows

std::string signalText(int number) {
    std::string text = "ended by signal " + std::to_string(number);
    if (const char* name = sigabbrev_np(number)) text += std::string(" (SIG") + name + ")";
    if (number == SIGKILL) text += "; perhaps there is too little memory for so many files at once (--jobs)";
    return text;
}

/// What stands where the project of a video might go.
enum class Place { nothing, its_project, vacant, taken };

Place placeFor(const std::filesystem::path& project, const std::filesystem::path& video) {
    if (isFolder(project)) return Place::taken;
    if (!isFile(project)) return Place::nothing;
    try {
        ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
        const std::vector<SequenceRecord> sequences = sequencesOf(file);
        if (sequences.empty()) return Place::vacant;
        const bool holds = std::any_of(sequences.begin(), sequences.end(),
                                       [&](const SequenceRecord& known) { return known.path == video.string(); });
        return holds ? Place::its_project : Place::taken;
    } catch (const Error&) {
        return Place::vacant;  // the command that works on it will say what is wrong
    }
}

/// The run that the batch is about, if its project has it.
std::optional<RunRecord> runOf(const RunStore& store, const BatchRow& row, ResumeWishes wishes) {
    wishes.video = row.input.path.string();
    return chooseRun(store, row.project.string(), wishes).run;
}

/// Whether an input may have been written after a run of it began, so that the run is one of other contents. When in
/// doubt it was: doing it once more costs less than a result of something else. Runs of older versions know only the
/// second in which they began.
bool isNewer(const BatchInput& input, const RunRecord& run) {
    const auto began_us = run.started_us ? run.started_us : utcOf(run.started_utc);
    if (!began_us) return true;
    // A clock that ticks tells the times of files. Some disks keep every second, or every other one, alone.
    constexpr std::int64_t kTick_ns = 10'000'000;
    constexpr std::int64_t kSecond_ns = 1'000'000'000;
    const std::int64_t step_ns = input.changed_ns % kSecond_ns == 0 ? 2 * kSecond_ns : kTick_ns;
    return (input.changed_ns + step_ns) / 1000 >= *began_us;
}

/// Whether the files of an input lie there otherwise than when a run of it began: some were put in, taken away or
/// replaced, be it by older ones. Of a run of before schema 27 it is known of pictures only how many they were.
bool isOfOtherFiles(const BatchInput& input, const RunRecord& run, ProjectFile& project) {
    if (const std::string then = sourceDigestOf(project, run.id); !then.empty()) {
        const std::string now = listingDigestOf(input.path);
        return !now.empty() && now != then;
    }
    return isFolder(input.path) && imagesIn(input.path).size() != static_cast<std::size_t>(run.sequence.frame_count);
}

/// What a project holds of an input.
struct Begun {
    RunRecord run;
    bool has_changed = false;  ///< the input may be another than when the run began

    bool isFinished() const { return run.state == RunState::finished; }
};

/// Takes over what a project says of a run.
void takeFacts(BatchRow& row, ProjectFile& project, const RunRecord& run) {
    row.frames = run.frames_done;
    const RunCounts counts = countRun(project, run.id);
    row.unregistered = counts.unregistered;
    row.tracks = counts.tracks;
}

/// Whether it matters to who looks up a run that its input may have changed: that means to read a folder through.
enum class ChangesOfInput { looked_for, ignored };

/// Answers the run of an input, if its project has one, whose facts are in its row then.
std::optional<Begun> lookedUp(BatchRow& row, const ResumeWishes& wishes, ChangesOfInput changes) {
    if (!isFile(row.project)) return std::nullopt;
    ProjectFile file = ProjectFile::open(row.project, ProjectFile::Mode::read_only);
    const std::optional<RunRecord> run = runOf(RunStore(file), row, wishes);
    if (!run) return std::nullopt;
    takeFacts(row, file, *run);
    const bool has_changed =
        changes == ChangesOfInput::looked_for && (isNewer(row.input, *run) || isOfOtherFiles(row.input, *run, file));
    return Begun{*run, has_changed};
}

bool isOver(BatchState state) {
    return state != BatchState::waiting && state != BatchState::working;
}

}  // namespace

Batch::Batch(BatchOptions options)
    : options_(std::move(options)), record_(options_.out, options_.record, options_.shard) {}

Batch::~Batch() = default;

void Batch::add(const std::vector<BatchInput>& inputs, bool anew) {
    summary_due_ = true;  // of a part that nothing falls to, too
    for (const BatchInput& input : inputs) {
        if (!options_.shard.takes(nameOfWork(input))) continue;
        BatchRow row;
        row.input = input;
        row.project = projectFor(input);
        row.anew = anew;
        rows_.push_back(std::move(row));
    }
}

std::filesystem::path Batch::projectFor(const BatchInput& input) {
    std::optional<std::filesystem::path> free;
    for (int attempt = 0;; ++attempt) {
        std::filesystem::path project = options_.out / (attempt == 0 ? nameOf(input) : input.name);
        project += (attempt < 2 ? "" : "-" + std::to_string(attempt)) + std::string(kProjectEnding);
        const auto known = projects_.find(project);
        if (known != projects_.end() && known->second == input.path) return project;
        if (known != projects_.end()) continue;
        const Place place = placeFor(project, input.path);
        if (place == Place::taken) continue;
        // What was begun in one of the places goes on there, whichever have come free since.
        if (place != Place::its_project) {
            if (!free) free = project;
            if (attempt < 2 || place != Place::nothing) continue;
            project = *free;
        }
        projects_[project] = input.path;
        return project;
    }
}

bool Batch::atWork(const std::filesystem::path& project) const {
    return std::any_of(works_.begin(), works_.end(),
                       [&](const auto& work) { return rows_[work.first].project == project; });
}

void Batch::collect() {
    for (auto at = works_.begin(); at != works_.end();) {
        const auto how = at->second.program->ended();
        if (!how) {
            lookAt(at->second, rows_[at->first]);
            ++at;
            continue;
        }
        const std::size_t row = at->first;
        rows_[row].seconds = std::chrono::duration<double>(Clock::now() - at->second.begun).count();
        at = works_.erase(at);
        end(row, *how);
    }
}

bool Batch::step() {
    collect();
    // Those that were done before take no time, but there may be many.
    for (int begun = 0; begun < kBegunAtOnce && !stopping_ && next_ < rows_.size() &&
                        works_.size() < static_cast<std::size_t>(options_.jobs) && !atWork(rows_[next_].project);
         ++begun)
        begin(next_++);
    const bool more = !works_.empty() || (!stopping_ && next_ < rows_.size());
    if (std::exchange(summary_due_, false)) record_.summarise(rows_);
    return more;
}

void Batch::stop() {
    if (std::exchange(stopping_, true)) return;
    for (auto& [row, work] : works_) work.program->stop();
}

void Batch::begin(std::size_t number) {
    BatchRow& row = rows_[number];
    if (!row.input.fault.empty()) return close(number, BatchState::failed, row.input.fault);
    try {
        const auto begun = row.anew ? std::nullopt : lookedUp(row, options_.wishes, ChangesOfInput::looked_for);
        if (begun && begun->isFinished() && !begun->has_changed) return close(number, BatchState::done_before, "");
        row.anew = row.anew || (begun && begun->isFinished());
        // Whoever goes on looks at the pictures again. One that another program writes is left to it.
        row.may_differ = begun && !begun->isFinished() && begun->has_changed && !begun->run.live;
    } catch (const Error& error) {
        return close(number, BatchState::failed, error.what());
    }
    std::error_code failed;
    std::filesystem::create_directories(row.project.parent_path(), failed);
    if (failed) {
        return close(number, BatchState::failed,
                     row.project.parent_path().string() + ": the folder cannot be made (" + failed.message() +
                         "); make it writable, or choose another with --out");
    }
    std::vector<std::string> words{"run", row.input.path.string(), "--project", row.project.string(), "--quiet"};
    if (!row.anew) words.emplace_back("--resume");
    words.insert(words.end(), options_.run_words.begin(), options_.run_words.end());
    Work work;
    try {
        work.program = std::make_unique<ChildProgram>(words);
    } catch (const Error& error) {
        return close(number, BatchState::failed, error.what());
    }
    work.begun = work.looked = Clock::now();
    row.state = BatchState::working;
    works_.emplace(number, std::move(work));
    record_.log(row);
}

void Batch::end(std::size_t number, const ChildEnd& how) {
    BatchRow& row = rows_[number];
    std::string fault = "ended without a finished run; perhaps somebody else works on its project";
    std::string remark;
    try {
        const auto worked_on = lookedUp(row, options_.wishes, ChangesOfInput::ignored);
        if (worked_on && worked_on->isFinished()) {
            fault.clear();
            remark = worked_on->run.message;
        }
    } catch (const Error& error) {
        fault = error.what();
    }
    // Who ends a job tells all its processes at once, and this one may hear of it last.
    if (how.exit_code == exit_stopped || how.signal == SIGTERM) return close(number, BatchState::stopped, "");
    if (how.signal != 0) return close(number, BatchState::failed, signalText(how.signal));
    if (how.exit_code != exit_ok && std::exchange(row.may_differ, false)) {
        row.anew = true;
        return begin(number);
    }
    if (how.exit_code != exit_ok) return close(number, BatchState::failed, how.lastWords());
    close(number, fault.empty() ? BatchState::done : BatchState::failed, fault.empty() ? remark : fault);
}

void Batch::close(std::size_t number, BatchState state, const std::string& message) {
    rows_[number].state = state;
    rows_[number].message = message;
    record_.log(rows_[number]);
    summary_due_ = true;
}

void Batch::lookAt(Work& work, const BatchRow& row) {
    if (Clock::now() - work.looked < kBetweenLooks) return;
    work.looked = Clock::now();
    try {
        if (!isFile(row.project)) return;
        ProjectFile file = ProjectFile::open(row.project, ProjectFile::Mode::read_only);
        const auto run = runOf(RunStore(file), row, options_.wishes);
        if (run) work.share = run->frames_done / std::max(1.0, run->last_frame - run->first_frame + 1.0);
    } catch (const Error&) {
        // It is only looked at for the time that is left.
    }
}

double Batch::share() const {
    double done = 0;
    double all = 0;
    for (std::size_t at = 0; at < rows_.size(); ++at) {
        const double bytes = static_cast<double>(rows_[at].input.bytes) + 1;
        const auto work = works_.find(at);
        all += bytes;
        if (isOver(rows_[at].state)) done += bytes;
        if (work != works_.end()) done += bytes * std::clamp(work->second.share, 0.0, 1.0);
    }
    return all > 0 ? done / all : 1;
}

double Batch::secondsLeft() const {
    double done = 0;
    double left = 0;
    for (std::size_t at = 0; at < rows_.size(); ++at) {
        const double bytes = static_cast<double>(rows_[at].input.bytes) + 1;
        const BatchState state = rows_[at].state;
        const auto work = works_.find(at);
        const double share = work != works_.end() ? std::clamp(work->second.share, 0.0, 1.0) : 0;
        if (state == BatchState::done) done += bytes;
        if (state == BatchState::working) done += bytes * share;
        if (!isOver(state)) left += bytes * (1 - share);
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - begun_).count();
    return done > 0 ? seconds * left / done : -1;
}

}  // namespace eyrie::cli
