#pragma once

#include <QObject>
#include <functional>
#include <opencv2/core/types.hpp>
#include <vector>

#include "annotation/review/proposals.h"
#include "label/label_parts.h"
#include "session/project_session.h"

class QAction;

namespace eyrie::ui {

class IdentityCommands;

/// What the commands of the label workspace do, as lists: drawing, edits, going places, proposals, tracking and files.
/// Those that say which object is which are IdentityCommands.
class LabelCommands : public QObject {
    Q_OBJECT

 public:
    /// `identity` must outlive it: Esc takes back what that shows.
    LabelCommands(const LabelParts& parts, IdentityCommands& identity, QObject* parent);

 private:
    void bindDrawing();
    void bindRegions();
    void bindEdits();
    void bindNudges();
    void bindGoing();
    void bindProposals();
    void bindTracking();
    void bindFiles();
    /// Draws as long as the command is on, if labels may be changed.
    void drawWith(QAction* action, bool on, const std::function<void()>& start);
    /// Changes the ignore regions under the cursor, or asks to point at one.
    void changeRegions(const std::function<int(cv::Point2d)>& change);
    void turnBy(double radians);
    /// One step out of what is going on.
    void escape();
    void selectProposal(const Proposal* proposal);
    void selectNextProposal();
    /// The selected proposals; where none is, the one under the cursor, or a word that asks for one.
    std::vector<TrackId> meantProposals();
    void acceptMeant();
    void acceptHere();
    void acceptMarkedRange();
    void rejectMeant();
    void chooseTolerance();
    /// The range of frames set above the canvas; the whole video where none is.
    FrameRange markedRange() const;

    LabelParts parts_;
    IdentityCommands& identity_;
};

}  // namespace eyrie::ui
