#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "annotation/edits/identity_edits.h"
#include "annotation/keyframes/interpolation.h"
#include "label/label_session.h"

namespace eyrie::ui {

/// What a key or a handle does to the labels: every function is one edit of the selected object (or objects) in the
/// frame shown, which can be undone. Functions do nothing when nothing is selected or the labels are read-only, and
/// say why by LabelSession's signals.
class LabelEditor : public QObject {
    Q_OBJECT

 public:
    /// Both must outlive it.
    LabelEditor(ProjectSession& session, LabelSession& labels, QObject* parent = nullptr);

    /// What a person sees: edits mean this frame, even while another one is on its way.
    FrameIndex frame() const { return session_.shownFrame(); }
    /// The selected object; null when there is none.
    const LabelledObject* object() const;
    /// An object's box in a frame; beyond its life where it would be if it went on as it did, which is no label yet.
    static std::optional<OrientedBox> expectedBox(const LabelledObject& object, FrameIndex frame,
                                                  const CameraMotion& camera);
    std::optional<OrientedBox> shownBox() const;

    /// A new object of the class that is drawn, alive in this one frame; it is selected.
    std::optional<ObjectId> add(const OrientedBox& box, FrameIndex frame);
    /// Sets a box; beyond the object's life it lives as long. `turned`: its heading was set by hand, too.
    bool setBox(ObjectId id, FrameIndex frame, const OrientedBox& box, bool turned, const QString& what);
    /// Whether what a hand corrects goes on to the keyframes that were computed; it does unless told otherwise.
    void setCarriesCorrections(bool carries) { carries_corrections_ = carries; }
    void nudge(double right_px, double down_px);
    void turn(double radians);
    /// The size of the box as it is shown goes to all keyframes: vehicles keep theirs.
    void spreadSize();
    /// What the keyframe shown corrects goes to all others: taken over tracks are wrong in the same way throughout.
    void spreadCorrection();
    /// A keyframe of the box as it is shown.
    void setKeyframe();
    /// The box becomes a keyframe of the next (or former) frame, carried on the ground, and that frame is shown.
    void copyOn(int frames = 1);
    /// The last keyframe goes with its object; others that are selected stay.
    void deleteKeyframe();
    void deleteObjects();
    /// The object lives up to and including this frame.
    void endHere();
    void toggleOccluded();
    void toggleOutside();
    void toggleIgnore();
    void setClass(const std::string& name);
    /// A colour of their own for the selected objects (0xRRGGBB); nothing: that of their class.
    void setColour(std::optional<std::uint32_t> colour);
    /// Of any object: who wrote may have chosen another one since.
    void setNotes(ObjectId id, const QString& notes);
    void mark(ReviewState state);
    /// Flags of the selected objects over a range of frames.
    void setFlags(FrameIndex first, FrameIndex last, const FlagChange& flags);

    /// An ignore region for the whole video, fixed to the ground where the camera's motion is known, else to the image.
    void addRegion(const std::vector<cv::Point2d>& polygon, FrameIndex frame);
    /// Changes the regions that lie over a point of the frame shown; answers how many there were.
    int changeRegionsAt(cv::Point2d point, const QString& name, const std::function<void(IgnoreRegion&)>& change);
    /// Between the ground and the image; the polygon stays where it is in this frame.
    int anchorRegionsAt(cv::Point2d point);
    /// The flags of the selected object here, for all selected ones over a range of frames.
    void spreadFlags(FrameIndex first, FrameIndex last);
    /// Deletes the regions that lie over a point of the frame shown; answers how many there were.
    int deleteRegionsAt(cv::Point2d point);

    // Identity; what cannot be done is told. A plan changes nothing yet: it can be shown first.
    struct Plan {
        AnnotationEdit edit;
        QString text;                    ///< what becomes of whom: "car 3: frames 0 to 7, car 9: frames 8 to 15"
        std::optional<ObjectId> select;  ///< afterwards
        std::uint64_t version = 0;       ///< of the labels it was made for
    };
    std::optional<Plan> planJoin(ObjectId other, GapFilling gap);
    std::optional<Plan> planFuse(ObjectId other);
    std::optional<Plan> planSplit();
    std::optional<Plan> planSwap(ObjectId other);
    std::optional<Plan> planRenumber();
    /// Does nothing where the labels are not those any more that the plan was made for.
    void carryOut(const std::optional<Plan>& plan);
    void join(ObjectId other, GapFilling gap) { carryOut(planJoin(other, gap)); }
    void fuse(ObjectId other) { carryOut(planFuse(other)); }
    void swapFrom(ObjectId other) { carryOut(planSwap(other)); }
    void deleteBefore();
    void deleteAfter();

    // Going places.
    void stepObject(int objects);
    void nextKeyframe();
    void previousKeyframe();
    void nextAttention();
    void nextUnchecked();
    /// Selects an object and shows a frame in which it lives.
    void goTo(ObjectId id, std::optional<FrameIndex> frame = std::nullopt);

 private:
    bool ready() const;
    bool carriesOn(const OrientedBox& box) const;
    /// Tells Error(parameter) of the engine's verbs; answers whether there was none.
    bool guarded(const std::function<void()>& work);
    std::optional<Plan> planOf(const QString& name, const std::function<IdentityChange()>& change);
    bool applyObject(const QString& name, LabelledObject object);
    void toggleFlag(const QString& name, const std::function<void(Keyframe&)>& change);
    QString named(const QString& verb) const;

    ProjectSession& session_;
    LabelSession& labels_;
    bool carries_corrections_ = true;
};

}  // namespace eyrie::ui
