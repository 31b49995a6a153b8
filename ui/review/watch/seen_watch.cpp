#include "review/watch/seen_watch.h"

#include <QEvent>
#include <QWidget>
#include <utility>

#include "canvas/video_view.h"
#include "session/project/person_name.h"
#include "store/review/seen_store.h"
#include "workspace/session_reactions.h"

namespace eyrie::ui {

namespace {
constexpr int kWriteSeen_ms = 5000;
}

SeenWatch::SeenWatch(ProjectSession& session, VideoView& canvas, QWidget& window, ShowWatched show_watched,
                     QObject* parent)
    : QObject(parent),
      session_(session),
      canvas_(canvas),
      window_(window),
      show_watched_(std::move(show_watched)),
      due_(kWriteSeen_ms, [this] { flush(); }) {
    clock_.start();
    window_.installEventFilter(this);
    whenAny(&canvas_, this, &SeenWatch::showFrame, &VideoView::frameGiven);
    followSession(session_, this,
                  {{SessionChange::video, [this] { told_ = false; }},
                   {{SessionChange::video, SessionChange::project, SessionChange::run_data}, [this] {
                        recorder_.interrupt(wallSeconds());
                        flush();
                    }}});
    due_.start();
}

SeenWatch::~SeenWatch() = default;

bool SeenWatch::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::WindowDeactivate || event->type() == QEvent::Close) {
        recorder_.interrupt(wallSeconds());
        flush();
    }
    return QObject::eventFilter(watched, event);
}

void SeenWatch::showFrame() {
    const ViewFrame& frame = canvas_.frame();
    if (!window_.isActiveWindow() || frame.image.isNull()) return;
    recorder_.show(frame.index, static_cast<double>(frame.time_us) / 1e6, wallSeconds());
}

void SeenWatch::flush() {
    std::vector<FrameSpan> seen = recorder_.take();
    // What was seen belongs to the video that was shown meanwhile.
    const std::filesystem::path project = std::exchange(project_, session_.project());
    const int sequence = sequence_;
    const RunRecord* run = session_.shownRun();
    sequence_ = run != nullptr ? run->sequence.id : 0;
    const FrameSpan searched_before = searched_;
    searched_ = run != nullptr ? FrameSpan{run->first_frame, run->last_frame} : FrameSpan{0, -1};
    if (sequence == 0) seen.clear();
    if (sequence_ == 0) show_watched_(std::nullopt);
    if (sequence == 0 && sequence_ == 0) return;
    const bool nothing_new =
        told_ && seen.empty() && sequence == sequence_ && project == project_ && searched_ == searched_before;
    if (nothing_new) return;
    told_ = true;
    const bool anything = !seen.empty() && !project.empty();
    const auto work = [this, seen = std::move(seen), project, sequence, anything, now = project_, shown = sequence_,
                       searched = searched_, person = personName().toStdString()](const BackgroundTask& task) {
        if (anything) {
            ProjectFile file = ProjectFile::open(project);
            addSeen(file, sequence, person, seen);
        }
        if (shown == 0 || now.empty()) return;
        ProjectFile file = ProjectFile::open(now, ProjectFile::Mode::read_only);
        WatchedFrames watched{seenByAnybody(file, shown), 0};
        watched.share = seenShare(watched.spans, searched);
        task.tell([this, shown, watched = std::move(watched)] {
            if (shown == sequence_) show_watched_(watched);
        });
    };
    // A project that cannot be written can be watched all the same; nobody is troubled.
    const auto failed = [this](const QString&) {
        told_ = false;  // it is asked for again
        show_watched_(std::nullopt);
    };
    if (anything)
        query_.write(work, failed);
    else
        query_.post(work, failed);
}

}  // namespace eyrie::ui

#include "moc_seen_watch.cpp"
