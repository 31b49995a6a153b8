#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "session/background/written_wait.h"
#include "session/frames/playback.h"
#include "session/frames/result_loader.h"
#include "session/project/media.h"
#include "session/project/project_reader.h"
#include "session/run_controller.h"
#include "session/run_settings.h"

namespace eyrie::ui {

/// What of a session's state is another than it was. What it is now, the session tells.
enum class SessionChange {
    work_ends,     ///< nothing yet: work whose result goes into the project ends now, with what it has found
    keep_written,  ///< nothing yet, but it is about to be: what is being written is kept now, where it belongs
    video,         ///< another one, or none
    length,        ///< more of the same video: it is being recorded
    project,       ///< another one, or none
    opened,        ///< video and project are open
    runs,          ///< the list of runs, givenStart() and givenControl() were read anew
    current_run,
    run_data,  ///< the lists of the current run were read
    frame,     ///< currentFrame()
    picture,   ///< viewFrame()
    selection,
    scale,  ///< the settings took over the GSD of the run shown
    following,
    run_preparing,  ///< a run was asked for; it starts once it is prepared, which takes some seconds without a GSD
    run_started,    ///< ownRun()
    run_ended
};

/// The one state the whole window shows: video, project, run, frame, selection. Everything that could block happens on
/// other threads; calls return at once and signals tell what came of them.
class ProjectSession : public QObject {
    Q_OBJECT

 public:
    static constexpr int kTrailLength = 40;  ///< frames

    explicit ProjectSession(QObject* parent = nullptr);
    ~ProjectSession() override;

    /// Opens a video with its project: the given one, or the one beside it (see projectPlaces()), made if need be.
    void openMedia(Media media, const std::filesystem::path& project = {});
    /// Opens a project and the video of its newest run, or its newest video.
    void openProject(const std::filesystem::path& project);
    /// A project file, a video or a folder of images.
    void open(const std::filesystem::path& path);
    /// Several video files as one video; a single file as above.
    void open(const std::vector<std::filesystem::path>& files);
    /// Writes a copy; work goes on in the project.
    void saveProjectCopy(const std::filesystem::path& target);
    /// Writes a copy and goes on working in it, with all that is done until then. Not while a run works.
    void saveProjectAs(const std::filesystem::path& target);
    /// Has what is being written kept, as before the window is closed.
    void keepWritten() { emit changed(SessionChange::keep_written); }
    /// The same before what is open is left: what is at work in the background ends, too, with what it has by now.
    void endWork() {
        emit changed(SessionChange::work_ends);
        keepWritten();
    }
    /// Reads the video anew with this many frames per second, and keeps the rate in the project.
    void setFrameRate(double frames_per_second);
    /// The video as the project keeps it; only with a video.
    SequenceRecord sequenceToStore() const;
    /// Shows nothing any more; connections to the project are closed as soon as what they are used for is done.
    void closeProject();
    bool opening() const { return pending_.has_value(); }
    void cancelOpening();
    /// Whether the project's video is not where it should be, nor beside the project.
    bool videoMissing() const { return missing_.has_value(); }
    /// The missing video lies here, or the parts of it that are missing, or one of them; kept if it is the same.
    void locateVideo(const std::vector<std::filesystem::path>& files);

    const std::optional<Media>& media() const { return media_; }
    /// Nothing when no video is open; a missing video of a project has its size and length from the project.
    const std::optional<VideoInfo>& video() const { return video_; }
    const std::vector<std::int64_t>& timesUs() const { return times_us_; }
    /// When the video began, as a person said and the project kept it when it was read last: µs since 1970-01-01.
    std::optional<std::int64_t> givenStart() const;
    /// Where it lies on the earth, as a person said and the project kept it when it was read last.
    std::vector<ControlPoint> givenControl() const;
    /// For people: which of the files of a video in parts a frame lies in, and where; empty where it is one file.
    QString partText(FrameIndex frame) const;
    const std::filesystem::path& project() const { return project_; }
    const std::vector<RunRecord>& runs() const { return runs_; }
    /// The run that this window is making, if it is one of runs().
    const RunRecord* ownRun() const;
    std::optional<int> currentRun() const { return current_run_; }
    /// The record of the current run; null without one.
    const RunRecord* shownRun() const { return current_run_ ? findRun(*current_run_) : nullptr; }
    /// Lists of the current run; null until they were read.
    const std::shared_ptr<const RunData>& runData() const { return run_data_; }
    /// What the current run tells of a frame; null where it tells nothing. Lives as long as runData().
    const FrameSummary* frameSummary(FrameIndex frame) const;
    /// Whether the current run kept of a frame what its tracks were made from (recording.details), as far as is known.
    bool detailsKept(FrameIndex frame) const;
    /// The same of a track; doubtful ones, too.
    const TrackSummary* trackSummary(TrackId track) const;
    /// The scale that numbers on screen are given with: that of the current run, else of the settings.
    SceneScale scale() const;

    void showRun(int run_id);
    /// Whether tracks are shown as people corrected them, or as the run found them.
    void showCorrected(bool corrected);
    /// What corrections make of tracks, for whoever needs it; never null.
    const std::shared_ptr<CorrectedTracksMemo>& correctedTracks() const { return corrected_tracks_; }
    /// The corrections of tracks in the project are others now.
    void correctionsChanged();
    void renameRun(int run_id, const QString& name) { reader_.renameRun(run_id, name); }
    /// Takes a run out of the project; until that is closed it can be brought back.
    void removeRun(int run_id);
    void restoreRun(int run_id) { reader_.restoreRun(run_id); }
    /// The run that can be brought back; after it the one removed before it.
    const std::optional<RunRecord>& lastRemovedRun() const { return last_removed_run_; }

    RunSettings& settings() { return settings_; }
    /// A new run with the settings.
    void startRun();
    void stopRun() { controller_.stop(); }
    /// Watches a live source: once it answers, its recording is the video, and the run over it works in its project,
    /// which is opened. Until then all stays as it is; see liveRefused(). Ends by stopRun(). Parameters, preset and
    /// what is kept are those of the settings. Not while a run works.
    void watchLive(LiveRequest request);
    /// The live source that is watched or waited for; null: none.
    const LiveRequest* liveSource() const { return live_ ? &*live_ : nullptr; }
    /// How it stands; nothing before it answers.
    std::optional<LiveStatus> liveStatus() const { return controller_.liveStatus(); }
    /// Whether a run ended early and can be gone on with now: its video is shown, and no run works.
    bool canContinue(int run_id) const;
    /// Goes on with it; the result is that of a run that was never stopped.
    void continueRun(int run_id);
    bool running() const { return controller_.running(); }
    /// Whether the running run is about to end because somebody stopped it.
    bool stopping() const { return controller_.stopping(); }
    /// Whether the picture follows the running run.
    bool following() const { return following_; }
    void follow();

    Playback& playback() { return playback_; }
    /// The frame that is wanted. While one plays, scrubs or steps, its picture may still be on its way.
    FrameIndex currentFrame() const { return current_frame_; }
    /// The frame whose picture is shown: what numbers beside the picture must name.
    FrameIndex shownFrame() const { return view_frame_.index; }
    /// 0 without a video.
    FrameIndex lastFrame() const { return video_ ? std::max(0, video_->frame_count - 1) : 0; }
    const ViewFrame& viewFrame() const { return view_frame_; }
    /// How pictures are shown, not what is found in them. Live ones are shown as they are.
    const PictureLook& pictureLook() const { return look_; }
    void setPictureLook(const PictureLook& look);
    void goToFrame(FrameIndex frame);
    /// Frames that a person may well look at next, the likeliest first: their pictures are read beforehand.
    void expectFrames(std::vector<FrameIndex> frames);
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
    /// Tells whoever shows the session what to read anew; the other signals carry what the session does not keep.
    void changed(SessionChange change);
    void openingProgress(const QString& name, double share);
    void openingEnded();
    /// Follows SessionChange::opened; `has_finished_run` tells whether the run shown is a finished one.
    void ready(bool has_finished_run);
    /// All stored states of the selected track; follows its selection and grows with a running run.
    void trackStatesRead(TrackId track, const std::vector<TrackFrame>& states);
    void runProgress(const RunProgress& progress);
    void liveFrames(const std::vector<FrameSummary>& frames);
    /// Follows SessionChange::run_ended: a live source did not answer, or could not be recorded. Nothing was made, and
    /// nothing is another than before.
    void liveRefused(const QString& why);
    /// Follows SessionChange::run_ended: how it ended.
    void runFinished(const RunSummary& summary);
    /// Follows runFinished() when the run was stored: what came of it.
    void runSummarised(const RunRecord& run, const RunFacts& facts);
    void runRemoved(const RunRecord& run);
    /// The project is shown without its video; locateVideo() helps. `message` says so.
    void videoNotFound(const QString& message);
    /// Something went wrong; the text names it, the place and the remedy.
    void problem(const QString& message);
    void notice(const QString& message);

 private:
    enum class Purpose {
        another_video,    ///< with a project of its own
        of_project,       ///< a video of the project that is open; it may be missing
        moved,            ///< the same, at a place where it may lie now
        recorded,         ///< the recording of a live source, as far as it goes
        remembered_rate,  ///< the same video anew, with the frame rate that its project knows
        other_rate        ///< the same video anew, with a frame rate that a person gave
    };
    /// A video that is being opened.
    struct Pending {
        Media media;
        Purpose purpose = Purpose::another_video;
        std::filesystem::path project = {};           ///< of another video; empty: where it lies by itself
        std::optional<SequenceRecord> sequence = {};  ///< what the project that is open knows of it
        std::optional<int> run = {};                  ///< show this run then; else the newest
    };

    void beginOpening(Pending pending);
    void mediaOpened(int ticket, const OpenedVideo& video);
    bool isOfAnother(const Pending& pending, const VideoInfo& video) const;
    void mediaFailed(int ticket, const QString& message);
    void projectOpened(const ProjectLists& lists);
    void projectFailed(const std::filesystem::path& project, const QString& message);
    void awaitProject(bool opens_video);
    bool isAwaited();
    void beginMove();
    void leaveForMove();
    void finishMove(bool all_written);
    void endMove();
    /// Where what the project holds can be read.
    const std::filesystem::path& fileOfProject() const { return moved_from_ ? *moved_from_ : project_; }
    void projectMovedTo(const ProjectLists& lists);
    void moveFailed(const QString& message);
    void takeLists(const ProjectLists& lists);
    void openVideoOfProject();
    void closeVideo();
    void adoptVideo(Media media, const OpenedVideo& video, bool keep_place);
    void adoptMovedVideo(const SequenceRecord& known, const std::string& identity);
    void findMovedVideo(const Pending& pending, const QString& message);
    void showWithoutVideo(const SequenceRecord& sequence, std::optional<int> run_id, const QString& message);
    void showProject(std::optional<int> run_id);
    const SequenceRecord* sequenceOfVideo() const;
    void keepFrameRate();
    void adoptGsd();
    void useRun(std::optional<int> run_id);
    const RunRecord* findRun(int run_id) const;
    /// The newest run over this video that finished, or that has any frames; null when there is none.
    const RunRecord* newestRun(bool finished) const;
    void runRead(const std::shared_ptr<const RunData>& run);
    void listsRead(const ProjectLists& lists);
    void beginRun(RunRequest request);
    void adoptLive(const RunRecord& record);
    void adoptLiveProject();
    void growVideo(const std::vector<FrameSummary>& frames);
    void readRecording(const RunRecord& run);
    void adoptRecording(const Pending& pending, const OpenedVideo& video);
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
    bool project_opens_video_ = false;                 ///< the project that is being opened decides which video to show
    int projects_due_ = 0;                             ///< that are being opened; what was asked for last counts
    bool project_overtaken_ = false;                   ///< something else was asked for since
    std::optional<std::filesystem::path> moved_from_;  ///< while no project is shown as it becomes another file
    std::vector<RunRecord> runs_;
    std::optional<RunRecord> last_removed_run_;
    std::vector<int> resumable_runs_;
    std::vector<SequenceRecord> sequences_;
    std::map<int, std::int64_t> starts_;                ///< ProjectLists::starts
    std::map<int, std::vector<ControlPoint>> control_;  ///< ProjectLists::control
    std::optional<SequenceRecord> missing_;             ///< the video shown, if it cannot be found
    std::optional<int> current_run_;
    std::shared_ptr<const RunData> run_data_;
    bool corrected_ = true;
    std::filesystem::path run_project_;  ///< the project the running run writes to
    std::optional<int> own_run_;         ///< the running run, once it has its number
    std::optional<LiveRequest> live_;    ///< while a live source is watched or waited for
    int told_length_ = 0;                ///< frames of its recording that were told of
    int readable_length_ = 0;            ///< frames of it that pictures can be read of
    bool run_when_open_ = false;         ///< a run was asked for while the frame rate changes
    RunSettings settings_;
    FrameIndex current_frame_ = 0;
    int direction_ = 1;
    ViewFrame view_frame_;
    PictureLook look_;
    std::optional<TrackId> selected_track_;
    bool following_ = false;
    QTimer list_refresh_;  ///< reads what runs, here or in other programs, add to the project
    Playback playback_;
    ResultLoader loader_;
    std::shared_ptr<CorrectedTracksMemo> corrected_tracks_ = std::make_shared<CorrectedTracksMemo>();
    ProjectReader reader_{corrected_tracks_};
    WrittenWait move_wait_;  ///< for what is at work, and then for what goes into the former file still
    RunController controller_;
};

}  // namespace eyrie::ui
