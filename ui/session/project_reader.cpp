#include "session/project_reader.h"

#include <exception>
#include <utility>

#include "core/error.h"
#include "session/project_copy.h"
#include "session/queued_call.h"
#include "store/project_file.h"

namespace eyrie::ui {

/// What lives on the reader's thread.
class ProjectReader::Worker {
 public:
    explicit Worker(ProjectReader& owner) : owner_(owner) {}

    void open(const std::filesystem::path& path, Opening opening) {
        project_.reset();
        try {
            if (opening == Opening::create_if_missing) {
                std::error_code ignored;  // openOrCreate says what is wrong with the folder
                std::filesystem::create_directories(path.parent_path(), ignored);
                project_ = std::make_unique<ProjectFile>(ProjectFile::openOrCreate(path));
            } else {
                project_ = std::make_unique<ProjectFile>(ProjectFile::open(path));
            }
            queuedCall(&owner_,
                       [owner = &owner_, path, runs = RunStore(*project_).runs()] { emit owner->opened(path, runs); });
        } catch (const std::exception& error) {
            project_.reset();
            queuedCall(&owner_, [owner = &owner_, path, message = QString::fromUtf8(error.what())] {
                emit owner->openFailed(path, message);
            });
        }
    }

    void close() { project_.reset(); }

    void readRuns() {
        guarded([this](RunStore& store) {
            queuedCall(&owner_, [owner = &owner_, runs = store.runs()] { emit owner->runsRead(runs); });
        });
    }

    void readRun(int run_id) {
        guarded([this, run_id](RunStore& store) {
            auto record = store.run(run_id);
            if (!record) throw Error(ErrorKind::project, "the project has no run " + std::to_string(run_id));
            auto data = std::make_shared<RunData>();
            data->record = std::move(*record);
            data->parameters = store.parameters(run_id);
            data->frames = store.frameSummaries(run_id);
            data->tracks = store.tracks(run_id);
            queuedCall(&owner_, [owner = &owner_, data = std::shared_ptr<const RunData>(std::move(data))] {
                emit owner->runRead(data);
            });
        });
    }

    void readTrack(int run_id, TrackId track) {
        guarded([this, run_id, track](RunStore& store) {
            queuedCall(&owner_, [owner = &owner_, run_id, track, states = store.trackStates(run_id, track)] {
                emit owner->trackRead(run_id, track, states);
            });
        });
    }

    void saveCopy(const std::filesystem::path& target) {
        guarded([this, &target](RunStore&) {
            copyProject(*project_, target);
            queuedCall(&owner_, [owner = &owner_, target] { emit owner->copied(target); });
        });
    }

    template <class Work>
    void guarded(Work&& work) {
        if (!project_) return;
        try {
            RunStore store(*project_);
            work(store);
        } catch (const std::exception& error) {
            queuedCall(&owner_,
                       [owner = &owner_, message = QString::fromUtf8(error.what())] { emit owner->failed(message); });
        }
    }

 private:
    ProjectReader& owner_;
    std::unique_ptr<ProjectFile> project_;
};

ProjectReader::ProjectReader(QObject* parent) : QObject(parent), worker_(std::make_unique<Worker>(*this)) {}

ProjectReader::~ProjectReader() = default;

void ProjectReader::open(const std::filesystem::path& project, Opening opening) {
    thread_.post(
        [worker = worker_.get(), project, opening](const std::stop_token&) { worker->open(project, opening); });
}

void ProjectReader::close() {
    thread_.post([worker = worker_.get()](const std::stop_token&) { worker->close(); });
}

void ProjectReader::readRuns() {
    thread_.post([worker = worker_.get()](const std::stop_token&) { worker->readRuns(); });
}

void ProjectReader::readRun(int run_id) {
    thread_.postNewest([worker = worker_.get(), run_id](const std::stop_token&) { worker->readRun(run_id); });
}

void ProjectReader::readTrack(int run_id, TrackId track) {
    thread_.post([worker = worker_.get(), run_id, track](const std::stop_token&) { worker->readTrack(run_id, track); });
}

void ProjectReader::renameRun(int run_id, const QString& name) {
    thread_.post([worker = worker_.get(), run_id, text = name.toStdString()](const std::stop_token&) {
        worker->guarded([&](RunStore& store) { store.rename(run_id, text); });
        worker->readRuns();
    });
}

void ProjectReader::removeRun(int run_id) {
    thread_.post([worker = worker_.get(), run_id](const std::stop_token&) {
        worker->guarded([&](RunStore& store) { store.remove(run_id); });
        worker->readRuns();
    });
}

void ProjectReader::saveCopy(const std::filesystem::path& target) {
    thread_.post([worker = worker_.get(), target](const std::stop_token&) { worker->saveCopy(target); });
}

}  // namespace eyrie::ui
