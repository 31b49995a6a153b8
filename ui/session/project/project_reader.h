#pragma once

#include <QObject>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/geometry/control_point.h"
#include "io/video/frame_source.h"
#include "session/background/background_query.h"
#include "session/project/corrected_tracks_memo.h"
#include "session/run_data.h"

namespace eyrie::ui {

/// What a project holds, as lists.
struct ProjectLists {
    std::filesystem::path project;
    std::vector<RunRecord> runs;            ///< oldest first, without removed ones
    std::optional<RunRecord> last_removed;  ///< what can be brought back first
    std::vector<int> resumable;             ///< runs that ended early and can be gone on with
    std::vector<SequenceRecord> sequences;  ///< videos, ascending ids
    std::map<int, std::int64_t> starts;     ///< by id of those of which a person said when they began: µs since 1970
    std::map<int, std::vector<ControlPoint>> control;  ///< by id of those that a person laid on the earth
    std::string notice;                                ///< for people, when it was opened; else empty
};

/// Reads and edits the lists of a project in the background, one after the other. Signals arrive on the thread of this
/// object.
class ProjectReader : public QObject {
    Q_OBJECT

 public:
    explicit ProjectReader(std::shared_ptr<CorrectedTracksMemo> corrected_tracks, QObject* parent = nullptr);
    /// Closes the project; see close().
    ~ProjectReader() override;

    /// An existing project. Answers with opened() or openFailed(). The former one is read and edited on until takeUp().
    void open(const std::filesystem::path& project);
    /// What was opened last takes the place of the former project.
    void takeUp();
    /// What was opened last is not wanted any more.
    void forget();
    /// An existing project in place of the former one, which is closed at once. Answers with opened() or openFailed().
    void openInstead(const std::filesystem::path& project);
    /// The project of a video that was opened: `project`, or where it lies by itself (projectPlaces()); made if need
    /// be. What the project knows of the same video at a former place becomes that of this one. Answers with opened()
    /// or openFailed(): then none is open.
    void openFor(const std::string& media_name, const std::string& media_identity, const VideoInfo& video,
                 const std::filesystem::path& project);
    /// Removed runs are deleted for good.
    void close();
    /// Answers with read().
    void readLists();
    /// The same, but only if somebody changed the project or the runs may have changed their state by themselves.
    void readListsIfChanged();
    /// Answers with runRead(), or failed() when there is no such run. Of several requests the newest wins. `corrected`:
    /// with the tracks as people corrected them.
    void readRun(int run_id, bool corrected);
    /// How a run ended. Answers with factsRead().
    void readFacts(int run_id);
    /// Answers with trackRead(). `corrected` is what is shown of the run.
    void readTrack(int run_id, TrackId track, const std::shared_ptr<const CorrectedTracks>& corrected);
    /// Answer with read(), after failed() if it could not be done.
    void renameRun(int run_id, const QString& name);
    /// Takes a run out of the lists; until the project is closed it can be brought back.
    void removeRun(int run_id);
    void restoreRun(int run_id);
    /// Keeps what is known of a video now, its frame rate above all.
    void storeSequence(const SequenceRecord& sequence);
    /// A video lies elsewhere now.
    void relocateSequence(int sequence_id, const std::string& path);
    /// A complete copy, also while a run writes. Answers with copied() or failed().
    void saveCopy(const std::filesystem::path& target);
    /// Makes a complete copy, in which work is to go on. Answers with copiedForMove() or failed().
    void copyForMove(const std::filesystem::path& target);
    /// Puts that copy in place, with all that was done in the project since, and opens it in place of the project.
    /// Answers with movedTo(), or moveFailed(): then the former one is still open. Nobody else of this program may
    /// write into the former one from here on.
    void move();
    /// Drops that copy: work goes on where it was.
    void dropMove();

 signals:
    void opened(const ProjectLists& lists);
    void openFailed(const std::filesystem::path& project, const QString& message);
    void read(const ProjectLists& lists);
    void runRead(const std::shared_ptr<const RunData>& run);
    void factsRead(const RunRecord& run, const RunFacts& facts);
    void trackRead(int run_id, TrackId track, const std::vector<TrackFrame>& states);
    void copied(const std::filesystem::path& target);
    void copiedForMove();
    void movedTo(const ProjectLists& lists);
    void moveFailed(const QString& message);
    void failed(const QString& message);

 private:
    class Worker;
    std::shared_ptr<CorrectedTracksMemo> corrected_tracks_;
    template <class Work>
    void post(Work work);
    template <class Work>
    void write(Work work);
    std::unique_ptr<Worker> worker_;
    BackgroundQuery query_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
