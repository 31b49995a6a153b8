#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "session/media.h"
#include "session/playback.h"
#include "session/project_reader.h"
#include "session/result_loader.h"
#include "session/run_controller.h"
#include "session/run_settings.h"

namespace eyrie::ui {

/// The one state the whole window shows: video, project, run, frame, selection. Everything that could block happens on
/// other threads; calls return at once and signals tell what came of them.
class ProjectSession : public QObject {
    Q_OBJECT

 public:
    static constexpr int kTrailLength = 40;  ///< frames

    explicit ProjectSession(QObject* parent = nullptr);
    ~ProjectSession() override;

    /// Opens a video with its project: the given one, or the one in the user's data folder. Both are created if need
    /// be.
    void openMedia(Media media, const std::filesystem::path& project = {});
    /// Opens a project and the video of its newest run.
    void openProject(const std::filesystem::path& project);
    /// A project file, a video or a folder of images.
    void open(const std::filesystem::path& path);
    void saveProjectCopy(const std::filesystem::path& target);
    /// Reads the video anew with this many frames per second (for folders of images); 0: its own.
    void setFrameRate(double frames_per_second);
    bool opening() const { return pending_.has_value(); }
    void cancelOpening();

    const std::optional<Media>& media() const { return media_; }
    /// Nothing when no video is open; a missing video of a project has its size and length from the project.
    const std::optional<VideoInfo>& video() const { return video_; }
    const std::vector<std::int64_t>& timesUs() const { return times_us_; }
    const std::filesystem::path& project() const { return project_; }
    const std::vector<RunRecord>& runs() const { return runs_; }
    std::optional<int> currentRun() const { return current_run_; }
    /// Lists of the current run; null until they were read.
    const std::shared_ptr<const RunData>& runData() const { return run_data_; }
    /// The scale that numbers on screen are given with: that of the current run, else of the settings.
    SceneScale scale() const;

    void showRun(int run_id);
    void renameRun(int run_id, const QString& name) { reader_.renameRun(run_id, name); }
    void removeRun(int run_id);

    RunSettings& settings() { return settings_; }
    void startRun();
    void stopRun() { controller_.stop(); }
    bool running() const { return controller_.running(); }
    /// Whether the picture follows the running run.
    bool following() const { return following_; }
    void follow();

    Playback& playback() { return playback_; }
    FrameIndex currentFrame() const { return current_frame_; }
    /// 0 without a video.
    FrameIndex lastFrame() const { return video_ ? std::max(0, video_->frame_count - 1) : 0; }
    const ViewFrame& viewFrame() const { return view_frame_; }
    void goToFrame(FrameIndex frame);
    void step(int frames);
    void togglePlay();
    /// J, K and L of editors: −1 backwards, 0 stop, +1 forwards; again doubles the speed.
    void shuttle(int direction);

    std::optional<TrackId> selectedTrack() const { return selected_track_; }
    void selectTrack(std::optional<TrackId> track);
    /// Selects a track and shows its first frame, unless it is alive in the present one.
    void goToTrack(TrackId track);

    const ResultLoader& loader() const { return loader_; }

 signals:
    void openingProgress(const QString& name, double share);
    void openingEnded();
    /// Another video, or none.
    void videoChanged();
    void projectChanged();
    /// Video and project are open; `has_finished_run` tells whether the run shown is a finished one.
    void ready(bool has_finished_run);
    void runsChanged();
    void currentRunChanged();
    void runDataChanged();
    void frameChanged(FrameIndex frame);
    void viewFrameChanged(const ViewFrame& frame);
    void selectionChanged(std::optional<TrackId> track);
    /// All stored states of the selected track; follows selectionChanged() and grows with a running run.
    void trackStatesRead(TrackId track, const std::vector<TrackFrame>& states);
    /// A run was asked for; runStarted() follows once it is prepared, which takes some seconds without a GSD.
    void runPreparing();
    void runStarted(const RunRecord& record);
    void runProgress(const RunProgress& progress);
    void liveFrames(const std::vector<FrameSummary>& frames);
    void runFinished(const RunSummary& summary);
    void followingChanged(bool following);
    /// Something went wrong; the text names it, the place and the remedy.
    void problem(const QString& message);
    void notice(const QString& message);

 private:
    /// A video that is being opened.
    struct Pending {
        Media media;
        std::filesystem::path project;  ///< empty: the default one
        std::optional<RunRecord> run;   ///< show this run then; the video may be missing
        bool keep_place = false;
    };

    void beginOpening(Pending pending);
    void mediaOpened(int ticket, const OpenedVideo& video);
    void mediaFailed(int ticket, const QString& message);
    void projectOpened(const std::filesystem::path& project, const std::vector<RunRecord>& runs);
    void projectFailed(const std::filesystem::path& project, const QString& message);
    void adoptVideo(Media media, const OpenedVideo& video, bool keep_place);
    void showWithoutVideo(const RunRecord& run);
    void adoptGsd(const RunRecord& run);
    void useRun(std::optional<int> run_id);
    const RunRecord* findRun(int run_id) const;
    /// The newest run over this video that finished, or that has any frames; null when there is none.
    const RunRecord* newestRun(bool finished) const;
    void runRead(const std::shared_ptr<const RunData>& run);
    void runsRead(const std::vector<RunRecord>& runs);
    void liveRunStarted(const RunRecord& record);
    void liveFrameCame();
    void liveRunEnded(const RunSummary& summary, int run_id);
    void showFrame(FrameIndex frame);
    void request();
    void frameLoaded(const ViewFrame& frame);
    void setFollowing(bool following);

    std::optional<Pending> pending_;
    int ticket_ = 0;
    std::optional<Media> media_;
    std::optional<VideoInfo> video_;
    std::vector<std::int64_t> times_us_;
    std::filesystem::path project_;
    bool project_open_ = false;
    bool project_opens_video_ = false;  ///< the project that is being opened decides which video to show
    std::vector<RunRecord> runs_;
    std::optional<int> current_run_;
    std::shared_ptr<const RunData> run_data_;
    std::filesystem::path run_project_;  ///< the project the running run writes to
    RunSettings settings_;
    FrameIndex current_frame_ = 0;
    int direction_ = 1;
    ViewFrame view_frame_;
    std::optional<TrackId> selected_track_;
    bool following_ = false;
    QTimer list_refresh_;  ///< reads the growing lists of a running run
    Playback playback_;
    ResultLoader loader_;
    ProjectReader reader_;
    RunController controller_;
};

}  // namespace eyrie::ui
