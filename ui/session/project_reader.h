#pragma once

#include <QObject>
#include <filesystem>
#include <memory>
#include <optional>

#include "session/run_data.h"
#include "session/task_thread.h"

namespace eyrie::ui {

/// Reads and edits the lists of a project on its own thread. Signals arrive on the thread of this object.
class ProjectReader : public QObject {
    Q_OBJECT

 public:
    enum class Opening { must_exist, create_if_missing };

    explicit ProjectReader(QObject* parent = nullptr);
    ~ProjectReader() override;

    /// Answers with opened() or openFailed().
    void open(const std::filesystem::path& project, Opening opening);
    void close();
    /// Answers with runsRead().
    void readRuns();
    /// Answers with runRead(), or failed() when there is no such run. Of several requests the newest wins.
    void readRun(int run_id);
    /// Answers with trackRead().
    void readTrack(int run_id, TrackId track);
    /// Answer with runsRead() or failed().
    void renameRun(int run_id, const QString& name);
    void removeRun(int run_id);
    /// A complete copy, also while a run writes. Answers with copied() or failed().
    void saveCopy(const std::filesystem::path& target);

 signals:
    void opened(const std::filesystem::path& project, const std::vector<RunRecord>& runs);
    void openFailed(const std::filesystem::path& project, const QString& message);
    void runsRead(const std::vector<RunRecord>& runs);
    void runRead(const std::shared_ptr<const RunData>& run);
    void trackRead(int run_id, TrackId track, const std::vector<TrackFrame>& states);
    void copied(const std::filesystem::path& target);
    void failed(const QString& message);

 private:
    class Worker;
    std::unique_ptr<Worker> worker_;
    TaskThread thread_;  ///< last: stops before the worker goes
};

}  // namespace eyrie::ui
