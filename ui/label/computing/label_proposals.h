#pragma once

#include <QObject>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "annotation/review/proposals.h"
#include "label/label_session.h"

namespace eyrie::ui {

/// Tracks of the run shown, offered as objects. Nothing is a label until it is taken; what was drawn is never touched.
class LabelProposals : public QObject {
    Q_OBJECT

 public:
    /// Both must outlive it.
    LabelProposals(ProjectSession& session, LabelSession& labels, QObject* parent = nullptr);
    ~LabelProposals() override;

    /// Reads them from the run, if that was not done yet.
    void setShown(bool shown);
    bool shown() const { return shown_; }
    bool working() const { return working_; }

    /// Still to be decided: neither taken, rejected nor labelled already.
    std::vector<const Proposal*> pending() const;
    std::vector<const Proposal*> pendingIn(FrameIndex frame) const;
    const Proposal* find(TrackId track) const;

    /// The one that keys work on first: the last of the selection.
    std::optional<TrackId> selected() const;
    const std::vector<TrackId>& selection() const { return selection_; }
    bool isSelected(TrackId track) const;
    void select(std::optional<TrackId> track);
    /// Adds it to the selection, or takes it out.
    void toggle(TrackId track);

    /// How far the interpolation of a proposal may be from its track, px, on top of what the length of the box allows;
    /// smaller: more keyframes. Proposals not yet taken are made again.
    void setTolerance(double px);
    double tolerance() const { return tolerance_px_; }

    /// The next one, in this frame if there is one, else the earliest of all.
    const Proposal* next(FrameIndex frame) const;

    /// Takes proposals over, one step to undo; answers the new objects.
    std::vector<ObjectId> accept(const std::vector<TrackId>& tracks);
    /// The parts of all pending ones that lie in a range of frames.
    std::vector<ObjectId> acceptRange(FrameIndex first, FrameIndex last);
    /// They are not offered again, in other windows either, until offerAgain(); only with the right to label.
    void reject(const std::vector<TrackId>& tracks);
    /// Rejected ones of the run are offered again.
    void offerAgain();
    int rejectedCount() const { return static_cast<int>(rejected_.size()); }

 signals:
    void changed();

 private:
    void read();
    void readAnew();
    void adopt(const std::vector<Proposal>& proposals, const QString& failure);
    bool isPending(const Proposal& proposal) const;
    void forgetSelected(TrackId track);
    std::vector<ObjectId> take(const std::vector<TrackId>& tracks, FrameIndex first, FrameIndex last);

    ProjectSession& session_;
    LabelSession& labels_;
    bool shown_ = false;
    bool working_ = false;
    std::optional<int> run_;  ///< whose tracks were read
    std::vector<Proposal> proposals_;
    std::map<TrackId, ObjectId> taken_;
    std::set<TrackId> rejected_;
    std::vector<TrackId> selection_;
    double tolerance_px_ = ReductionOptions().tolerance_px;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
