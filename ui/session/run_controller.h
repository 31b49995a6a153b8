#pragma once

#include <QObject>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>

#include "chain/chain_options.h"
#include "chain/chain_run.h"
#include "chain/live/live_run.h"
#include "session/background/background_query.h"
#include "session/live_feed.h"
#include "session/project/media.h"

namespace eyrie::ui {

/// Everything a run needs, by value.
struct RunRequest {
    Media media;
    std::filesystem::path project;
    ChainOptions options;
    std::string preset;
    std::string name;                             ///< for the list; may be empty
    double gsd_m_per_px = 0;                      ///< ≤ 0: not known
    ScaleOrigin gsd_origin = ScaleOrigin::given;  ///< of a GSD that is known
    FrameRange range;
    RecordingOptions recording;
    int trail_length = 40;
    int resume_run = 0;  ///< > 0: goes on with this run of the project; all but media and project are the run's
};

/// The only object of the window that starts the engine. One run at a time, in the background; what it finds goes into
/// the project there. Signals arrive on the thread of this object.
class RunController : public QObject {
    Q_OBJECT

 public:
    explicit RunController(QObject* parent = nullptr);
    /// Stops a run and waits until its frames are stored.
    ~RunController() override;

    bool running() const { return feed_ != nullptr; }
    bool stopping() const { return running() && run_.stop_requested(); }
    /// Returns at once. Nothing happens while a run works.
    void start(RunRequest request);
    /// The same over a live source, which is recorded as it comes. started() follows once it answers.
    void watch(LiveRequest request, int trail_length);
    /// How the live source stands; nothing before it answers, and when none is watched.
    std::optional<LiveStatus> liveStatus() const;
    /// Returns at once; finished() follows.
    void stop() { run_.request_stop(); }

    /// For receivers of frameAvailable(): the newest frame, unless it was fetched before.
    std::optional<ViewFrame> takeFrame();
    std::vector<FrameSummary> takeSummaries();

 signals:
    /// The run has its number and is in the project.
    void started(const RunRecord& record);
    void progress(const RunProgress& progress);
    void frameAvailable();
    /// The last signal of a run. `run_id` is 0 when it failed before it was in the project.
    void finished(const RunSummary& summary, int run_id);

 private:
    struct Watched;
    void begin(int trail_length);
    void work(const RunRequest& request, LiveFeed& feed, const BackgroundTask& task);
    void workLive(const LiveRequest& request, LiveFeed& feed, Watched& watched, const BackgroundTask& task);
    void close(const RunSummary& summary, int run_id, LiveFeed& feed, const BackgroundTask& task);
    void fetch();
    void end(const RunSummary& summary, int run_id);

    QTimer poll_;                       ///< fetches what a run that hangs on a frame has not told yet
    std::shared_ptr<LiveFeed> feed_;    ///< exists while a run works
    std::shared_ptr<Watched> watched_;  ///< exists while a live source is watched or waited for
    std::stop_source run_;
    BackgroundQuery query_;  ///< last: ends the run before the rest goes
};

}  // namespace eyrie::ui
