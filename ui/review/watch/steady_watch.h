#pragma once

#include <QObject>
#include <optional>

#include "ground/followed_pose.h"

namespace eyrie::ui {

class MessageBar;
class ProjectSession;
class VideoView;
class WatchedGround;
class WindowActions;

/// What the steady view works on. All must outlive it.
struct SteadyParts {
    ProjectSession& session;
    VideoView& canvas;
    WindowActions& actions;
    MessageBar& messages;
    WatchedGround& ground;
};

/// How the canvas moves while one watches: as filmed; with the ground standing still as one frame shows it; and with
/// the selected vehicle in the middle, heading up, near enough to be seen.
class SteadyWatch : public QObject {
    Q_OBJECT

 public:
    explicit SteadyWatch(const SteadyParts& parts, QObject* parent = nullptr);

    /// Labelling moves the canvas otherwise.
    void setActive(bool active);
    /// What can be switched on depends on what is known of the ground.
    void enableActions();

 private:
    void setSteady(bool on);
    void groundChanged();
    void setFollowing(bool on);
    void showFrame();
    void layOnGround();
    void follow();
    std::optional<FollowedPose> poseOf(int track) const;
    /// Says so where there is nothing to follow, and what to do.
    void tellWhetherFollowed();
    void tellNotInFrame(int track);

    SteadyParts parts_;
    bool active_ = true;
    bool laying_ = false;      ///< sheets were asked for
    std::optional<int> near_;  ///< the track that the view was brought near to
    bool following_ = false;
    bool was_fitted_ = true;  ///< before it was followed
};

}  // namespace eyrie::ui
