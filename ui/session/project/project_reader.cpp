#include "session/project/project_reader.h"

#include <algorithm>
#include <exception>
#include <functional>
#include <utility>

#include "chain/recording/run_resume.h"
#include "core/error.h"
#include "correction/corrected_run.h"
#include "session/project/project_copy.h"
#include "session/project/project_location.h"
#include "store/database/change_watch.h"
#include "store/labels/annotation_store.h"
#include "store/project/project_file.h"
#include "store/project/video_start.h"
#include "store/review/control_points.h"
#include "store/review/review_store.h"
#include "store/runs/doubtful_tracks.h"

namespace eyrie::ui {

/// What is used in the background alone.
class ProjectReader::Worker {
 public:
    explicit Worker(ProjectReader& owner) : owner_(owner) {}
    ~Worker() { close(); }

    void open(const std::filesystem::path& path) {
        opened_.reset();
        try {
            auto fresh = std::make_unique<ProjectFile>(ProjectFile::open(path));
            ProjectLists lists = listsOf(*fresh);
            lists.notice = fresh->notice();
            opened_ = std::move(fresh);
            tell([this, lists = std::move(lists)] { emit owner_.opened(lists); });
        } catch (const std::exception& error) {
            openFailed(path, error);
        }
    }

    void takeUp() {
        const std::unique_ptr<ProjectFile> opened = std::move(opened_);
        if (!opened) return;  // it took its place at once
        close();
        adopt(std::move(*opened));
        any_running_ = true;  // perhaps; the next look tells
    }

    void forget() { opened_.reset(); }
    void dropMove() { move_.reset(); }

    void openInstead(const std::filesystem::path& path) {
        close();
        try {
            adopt(ProjectFile::open(path));
            tellOpened();
        } catch (const std::exception& error) {
            project_.reset();
            openFailed(path, error);
        }
    }

    void openFor(const std::string& name, const std::string& identity, const VideoInfo& video,
                 const std::filesystem::path& chosen) {
        close();
        std::vector<std::filesystem::path> places{chosen};
        if (chosen.empty()) places = projectPlaces(name, identity);
        try {
            openFirst(places);
            const auto sequences = sequencesOf(*project_);
            if (const SequenceRecord* former = formerPlaceOf(video, identity, sequences))
                eyrie::relocateSequence(*project_, former->id, identity);
            tellOpened();
        } catch (const std::exception& error) {
            project_.reset();
            openFailed(places.back(), error);
        }
    }

    void close() {
        opened_.reset();
        move_.reset();
        if (!project_) return;
        try {
            RunStore(*project_).purgeRemoved();
        } catch (const std::exception&) {
            // They stay marked as removed; the next close deletes them.
        }
        project_.reset();
    }

    void readLists() {
        guarded([this](RunStore&) { tell([this, lists = lists()] { emit owner_.read(lists); }); });
    }

    void readListsIfChanged() {
        guarded([this](RunStore&) {
            if (watch_->changed() || any_running_) readLists();
        });
    }

    void readRun(int run_id, bool corrected) {
        guarded([this, run_id, corrected](RunStore& store) {
            auto data = std::make_shared<RunData>();
            data->record = runOf(store, run_id);
            data->parameters = store.parameters(run_id);
            data->frames = store.frameSummaries(run_id);
            readCorrections(store, *data, corrected);
            data->tracks = trackSummaries(store, run_id, *data->corrected);
            for (const auto& left_out :
                 {store.doubtful().summaries(run_id), rejectedSummaries(store, run_id, *data->corrected)})
                data->tracks.insert(data->tracks.end(), left_out.begin(), left_out.end());
            std::stable_sort(data->tracks.begin(), data->tracks.end(),
                             [](const TrackSummary& a, const TrackSummary& b) { return a.id < b.id; });
            data->score_threshold = store.doubtful().scoreThreshold(run_id);
            data->facts = factsOf(*project_, data->record);
            tell([this, data = std::shared_ptr<const RunData>(std::move(data))] { emit owner_.runRead(data); });
        });
    }

    void readFacts(int run_id) {
        guarded([this, run_id](RunStore& store) {
            const RunRecord run = runOf(store, run_id);
            tell([this, run, facts = factsOf(*project_, run)] { emit owner_.factsRead(run, facts); });
        });
    }

    void readTrack(int run_id, TrackId track, const CorrectedTracks& corrected) {
        guarded([this, run_id, track, &corrected](RunStore& store) {
            std::vector<TrackFrame> states = trackStates(store, run_id, track, corrected);
            if (const auto rejected = corrected.rejected.find(track); rejected != corrected.rejected.end())
                states = rejected->second.states;
            if (states.empty()) states = store.doubtful().statesOf(run_id, track);
            tell([this, run_id, track, states = std::move(states)] { emit owner_.trackRead(run_id, track, states); });
        });
    }

    void saveCopy(const std::filesystem::path& target) {
        guarded([this, &target](RunStore&) {
            copyProject(*project_, target, StepsMeanwhile::left_out);
            tell([this, target] { emit owner_.copied(target); });
        });
    }

    void copyForMove(const std::filesystem::path& target) {
        move_.reset();
        guarded([this, &target](RunStore&) {
            move_ = std::make_unique<ProjectMove>(*project_, target);
            tell([this] { emit owner_.copiedForMove(); });
        });
    }

    void move() {
        if (!move_) {
            tell([this] { emit owner_.moveFailed(ProjectReader::tr("The copy of the project could not be made.")); });
            return;
        }
        try {
            move_->finish();
            ProjectFile copy = ProjectFile::open(move_->target());
            close();
            adopt(std::move(copy));
            tell([this, lists = lists()] { emit owner_.movedTo(lists); });
        } catch (const std::exception& error) {
            move_.reset();
            tell([this, message = QString::fromUtf8(error.what())] { emit owner_.moveFailed(message); });
        }
    }

    /// Changes something and reads the lists anew.
    template <class Work>
    void change(Work&& work) {
        guarded(std::forward<Work>(work));
        readLists();
    }

    template <class Work>
    void guarded(Work&& work) {
        if (!project_) return;
        try {
            RunStore store(*project_);
            work(store);
        } catch (const std::exception& error) {
            failed_ = true;
            tell([this, message = QString::fromUtf8(error.what())] { emit owner_.failed(message); });
        }
    }

    /// Whether anything was told to have failed since this was asked last.
    bool takeFailure() { return std::exchange(failed_, false); }

    ProjectFile& project() { return *project_; }

 private:
    void tell(std::function<void()> call) { owner_.query_.tell(std::move(call)); }

    void adopt(ProjectFile&& project) {
        project_ = std::make_unique<ProjectFile>(std::move(project));
        watch_ = std::make_unique<ChangeWatch>(*project_);
        watch_->changed();
    }

    /// The first place where a project can be opened or made. One that is there and cannot be used is an error: another
    /// in its stead would hide its runs.
    void openFirst(const std::vector<std::filesystem::path>& places) {
        for (const std::filesystem::path& place : places) {
            const bool last = &place == &places.back();
            std::error_code ignored;  // openOrCreate says what is wrong with the folder
            if (last) std::filesystem::create_directories(place.parent_path(), ignored);
            try {
                adopt(ProjectFile::openOrCreate(place));
                return;
            } catch (const std::exception&) {
                if (last || std::filesystem::exists(place, ignored)) throw;
            }
        }
    }

    void readCorrections(const RunStore& store, RunData& data, bool wanted) {
        std::map<int, TrackCorrection> corrections;
        try {
            corrections = readReview(*project_, data.record.sequence.id).corrections;
        } catch (const Error&) {
            return;  // whoever reads the verdicts says so; the run can be shown
        }
        data.correctable = !corrections.empty();
        if (wanted) data.corrected = owner_.corrected_tracks_->of(store, project_->path(), data.record, corrections);
    }

    static RunRecord runOf(const RunStore& store, int run_id) {
        auto record = store.run(run_id);
        if (!record) throw Error(ErrorKind::project, "the project has no run " + std::to_string(run_id));
        return std::move(*record);
    }

    static ProjectLists listsOf(ProjectFile& project) {
        const RunStore store(project);
        ProjectLists lists{project.path(), store.runs(), store.lastRemoved(), {}, sequencesOf(project), {}, {}, {}};
        for (const SequenceRecord& sequence : lists.sequences) readSaid(project, sequence.id, lists);
        for (const RunRecord& run : resumableRuns(store)) lists.resumable.push_back(run.id);
        return lists;
    }

    ProjectLists lists() {
        ProjectLists lists = listsOf(*project_);
        any_running_ = std::any_of(lists.runs.begin(), lists.runs.end(), [](const RunRecord& run) { return run.live; });
        return lists;
    }

    /// When and where a video was taken, as a person said.
    static void readSaid(ProjectFile& project, int sequence_id, ProjectLists& lists) {
        try {
            if (const auto start_us = videoStartOf(project, sequence_id)) lists.starts[sequence_id] = *start_us;
            std::vector<ControlPoint> points = readControlPoints(project, sequence_id);
            if (!points.empty()) lists.control[sequence_id] = std::move(points);
        } catch (const Error&) {
            // What cannot be read was not said; the rest of the project can be shown.
        }
    }

    void tellOpened() {
        ProjectLists opened = lists();
        opened.notice = project_->notice();
        tell([this, opened = std::move(opened)] { emit owner_.opened(opened); });
    }

    void openFailed(const std::filesystem::path& path, const std::exception& error) {
        tell([this, path, message = QString::fromUtf8(error.what())] { emit owner_.openFailed(path, message); });
    }

    ProjectReader& owner_;
    std::unique_ptr<ProjectFile> project_;
    std::unique_ptr<ProjectFile> opened_;  ///< it may take the place of the project
    std::unique_ptr<ProjectMove> move_;    ///< of the project, to be gone on in
    std::unique_ptr<ChangeWatch> watch_;   ///< of the project
    bool any_running_ = false;             ///< when it was read last; that one was killed commits nothing
    bool failed_ = false;
};

ProjectReader::ProjectReader(std::shared_ptr<CorrectedTracksMemo> corrected_tracks, QObject* parent)
    : QObject(parent), corrected_tracks_(std::move(corrected_tracks)), worker_(std::make_unique<Worker>(*this)) {}

ProjectReader::~ProjectReader() = default;

template <class Work>
void ProjectReader::post(Work work) {
    query_.post([worker = worker_.get(), work = std::move(work)](const BackgroundTask&) { work(*worker); });
}

template <class Work>
void ProjectReader::write(Work work) {
    query_.write([worker = worker_.get(), work = std::move(work)](const BackgroundTask&) {
        worker->takeFailure();
        work(*worker);
        // It was told; whoever waits for writes is to know, too, and leaves the message to be read.
        if (worker->takeFailure()) throw Error(ErrorKind::output, "the project could not be written");
    });
}

void ProjectReader::open(const std::filesystem::path& project) {
    post([project](Worker& worker) { worker.open(project); });
}

void ProjectReader::takeUp() {
    post([](Worker& worker) { worker.takeUp(); });
}

void ProjectReader::forget() {
    post([](Worker& worker) { worker.forget(); });
}

void ProjectReader::openInstead(const std::filesystem::path& project) {
    post([project](Worker& worker) { worker.openInstead(project); });
}

void ProjectReader::openFor(const std::string& media_name, const std::string& media_identity, const VideoInfo& video,
                            const std::filesystem::path& project) {
    post([=](Worker& worker) { worker.openFor(media_name, media_identity, video, project); });
}

void ProjectReader::close() {
    post([](Worker& worker) { worker.close(); });
}

void ProjectReader::readLists() {
    post([](Worker& worker) { worker.readLists(); });
}

void ProjectReader::readListsIfChanged() {
    post([](Worker& worker) { worker.readListsIfChanged(); });
}

void ProjectReader::readRun(int run_id, bool corrected) {
    query_.ask(
        [worker = worker_.get(), run_id, corrected](const BackgroundTask&) { worker->readRun(run_id, corrected); }, {},
        BackgroundQuery::Former::finish);
}

void ProjectReader::readFacts(int run_id) {
    post([run_id](Worker& worker) { worker.readFacts(run_id); });
}

void ProjectReader::readTrack(int run_id, TrackId track, const std::shared_ptr<const CorrectedTracks>& corrected) {
    post([run_id, track, corrected](Worker& worker) { worker.readTrack(run_id, track, *corrected); });
}

void ProjectReader::renameRun(int run_id, const QString& name) {
    write([run_id, text = name.toStdString()](Worker& worker) {
        worker.change([&](RunStore& store) { store.rename(run_id, text); });
    });
}

void ProjectReader::removeRun(int run_id) {
    write([run_id](Worker& worker) { worker.change([&](RunStore& store) { store.remove(run_id); }); });
}

void ProjectReader::restoreRun(int run_id) {
    write([run_id](Worker& worker) { worker.change([&](RunStore& store) { store.restore(run_id); }); });
}

void ProjectReader::storeSequence(const SequenceRecord& sequence) {
    write(
        [sequence](Worker& worker) { worker.change([&](RunStore&) { ensureSequence(worker.project(), sequence); }); });
}

void ProjectReader::relocateSequence(int sequence_id, const std::string& path) {
    write([sequence_id, path](Worker& worker) {
        worker.change([&](RunStore&) { eyrie::relocateSequence(worker.project(), sequence_id, path); });
    });
}

void ProjectReader::saveCopy(const std::filesystem::path& target) {
    write([target](Worker& worker) { worker.saveCopy(target); });
}

void ProjectReader::copyForMove(const std::filesystem::path& target) {
    post([target](Worker& worker) { worker.copyForMove(target); });
}

void ProjectReader::dropMove() {
    post([](Worker& worker) { worker.dropMove(); });
}

void ProjectReader::move() {
    write([](Worker& worker) { worker.move(); });
}

}  // namespace eyrie::ui

#include "moc_project_reader.cpp"
