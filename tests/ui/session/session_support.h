#pragma once

#include <QSignalSpy>
#include <QTest>
#include <condition_variable>
#include <mutex>

#include "session/project_session.h"
#include "ui/support/ui_support.h"

namespace eyrie::ui::test {

/// A door that a run has to wait at, so that tests see it at work for as long as they need.
class Door {
 public:
    void pass(FrameIndex frame) {
        std::unique_lock lock(mutex_);
        reached_ = std::max(reached_, frame);
        changed_.notify_all();
        changed_.wait(lock, [&] { return frame < closed_from_; });
    }
    void closeFrom(FrameIndex frame) {
        const std::scoped_lock lock(mutex_);
        closed_from_ = frame;
        changed_.notify_all();
    }
    void open() { closeFrom(1 << 30); }
    FrameIndex reached() {
        const std::scoped_lock lock(mutex_);
        return reached_;
    }

 private:
    std::mutex mutex_;
    std::condition_variable changed_;
    FrameIndex reached_ = -1;
    FrameIndex closed_from_ = 1 << 30;
};

/// Answers whether the media is open in time.
inline bool openAndWait(ProjectSession& session, const Media& media) {
    QSignalSpy ready(&session, &ProjectSession::ready);
    session.openMedia(media);
    return ready.wait(kPatience_ms);
}

/// Answers whether a run was made and ended in time. Nobody looks first for how the scale changes over the picture,
/// which takes as long as such a run.
inline bool runAndWait(ProjectSession& session) {
    session.settings().options.view.oblique = false;
    QSignalSpy finished(&session, &ProjectSession::runFinished);
    session.startRun();
    return session.running() && finished.wait(kPatience_ms);
}

/// Answers whether the picture of a frame is shown in time.
inline bool shows(const ProjectSession& session, FrameIndex frame) {
    return QTest::qWaitFor([&] { return session.viewFrame().index == frame && !session.viewFrame().image.isNull(); },
                           kPatience_ms);
}

}  // namespace eyrie::ui::test
