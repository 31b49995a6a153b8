#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <vector>

#include "session/background/background_query.h"
#include "session/project_session.h"
#include "sweep/results/sweep_best.h"
#include "widgets/repeated_call.h"

namespace eyrie::ui {

struct OpenedRuns;

/// What a sweep over the run shown, and perhaps others, is to try.
struct SweepRequest {
    std::vector<std::string> axes;     ///< "gradient.quantile=0.05:0.01:0.5", one or two
    std::vector<int> other_runs;       ///< swept over, too, with the parameters of the run shown
    std::filesystem::path truth_file;  ///< empty: the labels of the project; for runs of one video only
    std::vector<double> overlaps{0.1, 0.2, 0.3};
    EvaluationOptions wishes{};      ///< what counts
    bool many_points_meant = false;  ///< the user was asked
};

/// What of the sweeps is another than it was.
enum class SweepChange {
    sweeps,  ///< the list
    table,
    running  ///< one began or ended
};

/// Sweeps over the stored run that is shown, on threads of their own; points are kept in the project as they come. Also
/// reads the sweeps that the project holds. Signals arrive on the thread of this object.
class SweepSession : public QObject {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit SweepSession(ProjectSession& session, QObject* parent = nullptr);
    /// A sweep at work stops; what it has done is in the project and is resumed from there.
    ~SweepSession() override;

    /// Sweeps with the parameters of the run that is shown. Nothing while another sweep works.
    void start(const SweepRequest& request);
    /// Does the points of a stored sweep that are missing.
    void resume(int sweep_id);
    void cancel();
    bool running() const { return running_; }
    const SweepProgress& progress() const { return progress_; }

    /// Those of the project, oldest first.
    const std::vector<SweepRecord>& sweeps() const { return sweeps_; }
    /// Shows a sweep; its table follows.
    void select(int sweep_id);
    void remove(int sweep_id);
    /// Null until one is read. Grows while a sweep works.
    const std::shared_ptr<const SweepTable>& table() const { return table_; }

 signals:
    void changed(SweepChange change);
    void progressed(const SweepProgress& progress);
    /// The sweep ended by itself or was cancelled.
    void finished(bool whole);
    /// The text names what went wrong, the place and the remedy.
    void failed(const QString& message);
    /// Begun only when start() is called again with `many_points_meant`.
    void consentNeeded(const SweepRequest& request, double points);

 private:
    struct Job;
    void begin(Job job);
    static OpenedRuns openResumed(const Job& job, SweepPlan& plan, const std::stop_token& stop);
    void work(const Job& job, const BackgroundTask& task);
    void projectChanged();
    void refreshList();
    void take();
    void ended(bool whole, const QString& problem);

    ProjectSession& session_;
    std::vector<SweepRecord> sweeps_;
    std::shared_ptr<const SweepTable> table_;
    int selected_ = 0;
    bool running_ = false;
    SweepProgress progress_;
    std::stop_source stop_;
    std::shared_ptr<SweepTable> growing_;  ///< of the sweep at work
    QElapsedTimer since_shown_;            ///< the table that grows
    qint64 showing_took_ms_ = 0;
    bool grown_ = false;  ///< since it was shown
    RepeatedCall pulse_;  ///< takes over what the threads have reported

    std::mutex mutex_;  ///< of what follows
    std::vector<SweepPoint> new_points_;
    std::optional<SweepProgress> new_progress_;

    BackgroundQuery reader_;
    BackgroundQuery worker_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
