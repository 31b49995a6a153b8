#pragma once

#include <QObject>
#include <QPointer>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "correction/drawn_vehicle.h"
#include "review/correct/correction_trial.h"
#include "session/background/background_query.h"
#include "session/background/due_write.h"

namespace eyrie::ui {

class EventReview;
class MessageBar;
class ProjectSession;
class TracksPanel;
class VehicleBoxTool;
class VideoView;
class WindowActions;

/// What correcting works on. All must outlive it.
struct CorrectingParts {
    ProjectSession& session;
    VideoView& canvas;
    WindowActions& actions;
    MessageBar& messages;
    EventReview& review;
};

/// Tracks added, joined, split and rejected by hand. What is asked for is tried on the run that is shown, in the
/// background, and kept if something comes of it; it can be undone as verdicts are. When the window closes, or another
/// video is opened, a vehicle is followed no further, and what was found of it is waited for and kept.
class TrackCorrecting : public QObject {
    Q_OBJECT

 public:
    explicit TrackCorrecting(const CorrectingParts& parts, QObject* parent = nullptr);
    ~TrackCorrecting() override;

    /// Where several tracks are selected at once, to be rejected or taken back together. enableActions() is to be
    /// called when it comes into view or goes.
    void setList(const TracksPanel& list);
    /// Whether keys are wanted: labelling has others.
    void setActive(bool active);
    /// To be called when verdicts were read or changed.
    void enableActions();
    /// Whether something is tried or followed now.
    bool working() const { return working_.has_value(); }
    /// "Following the vehicle forwards: frame 212, at most 0:05 left."
    static QString followingText(const DrawnVehicleAdvance& advance, double seconds_left);

 private:
    using Kept = std::function<void(const TriedCorrections&)>;

    void startDrawing(bool wanted);
    void follow(const OrientedBox& box);
    void startJoin(bool wanted);
    void endJoin();
    void joinWithSelected();
    void split();
    void reject();
    void removeLast();
    /// The selected track, with it all that are selected in the list where a person sees it.
    std::vector<TrackId> chosen() const;
    bool isListSeen() const;
    bool areSeveralChosen() const;
    /// Tries what is made, at most as many as `most`.
    void attempt(const QString& step, const MakeCorrections& make, const Kept& kept, std::size_t most = 1);
    void finish(const QString& step, const TriedCorrections& tried, const Kept& kept);
    void tellRefused(const TriedCorrections& tried);
    /// What was told of a correction need not be true any more.
    void forgetWhatWasTold();
    void tell(const QString& text);
    void warn(const QString& text);
    void showFollowing(const QString& text);

    CorrectingParts parts_;
    VehicleBoxTool* tool_;
    QPointer<const TracksPanel> list_;
    bool active_ = true;
    std::optional<DueWrite> working_;
    std::optional<TrackId> join_with_;  ///< waits for the other one to be selected
    std::stop_source following_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
