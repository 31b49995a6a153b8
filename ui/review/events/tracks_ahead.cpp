#include "review/events/tracks_ahead.h"

#include <exception>
#include <utility>

#include "store/database/snapshot.h"

namespace eyrie::ui {

std::shared_ptr<const StoredTracks> TracksAhead::Reading::wait() const {
    if (!read_.valid()) return nullptr;
    try {
        return read_.get();
    } catch (const std::exception&) {
        return nullptr;
    }
}

void TracksAhead::begin(const std::filesystem::path& project, const RunRecord& run) {
    if (begun_ && begun_->project == project && begun_->run == run.id) return;
    using Tracks = std::shared_ptr<const StoredTracks>;
    const auto promise = std::make_shared<std::promise<Tracks>>();  // broken where the task is dropped
    begun_ = Begun{project, run.id, run.frames_done, {}};
    begun_->reading.read_ = promise->get_future().share();
    query_.ask([promise, project, run](const BackgroundTask&) {
        try {
            ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
            const Snapshot unchanging(file);  // frames and tracks of the same moment
            promise->set_value(std::make_shared<const StoredTracks>(readTracks(RunStore(file), run)));
        } catch (...) {
            promise->set_exception(std::current_exception());
        }
    });
}

TracksAhead::Reading TracksAhead::take(const std::filesystem::path& project, const RunRecord& run) {
    if (!begun_ || begun_->project != project || begun_->run != run.id || begun_->frames_done != run.frames_done)
        return {};
    // The run stays begun: nothing of it is read ahead again.
    return std::exchange(begun_->reading, {});
}

}  // namespace eyrie::ui
