#pragma once

#include <QObject>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "annotation/keyframes/camera_motion.h"
#include "annotation/review/attention.h"
#include "annotation/review/review_state.h"
#include "session/background/background_query.h"
#include "session/project_session.h"
#include "store/labels/annotation_store.h"
#include "widgets/repeated_call.h"

namespace eyrie::ui {

/// The labels of the video shown: read in the background as soon as they are wanted, changed on the window's own, where
/// an edit takes a few milliseconds. Knows how the camera moved from the run shown, and which objects are selected.
class LabelSession : public QObject {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit LabelSession(ProjectSession& session, QObject* parent = nullptr);
    ~LabelSession() override;

    /// Somebody wants to label: the labels are read, now and whenever another video is opened. Until then nothing is
    /// read and the right to label is not taken.
    void setWanted(bool wanted);

    bool isOpen() const { return store_ != nullptr; }
    bool readOnly() const { return !store_ || store_->readOnly(); }
    bool canEdit() const { return store_ && !store_->readOnly(); }
    /// The same, and tells why not.
    bool mayEdit();
    /// Tries to become the one that labels; what another window changed is read.
    void tryToWrite();

    /// Empty while nothing is open.
    const AnnotationSet& annotations() const { return store_ ? store_->annotations() : nothing_; }
    const LabelledObject* object(ObjectId id) const;
    /// Grows with every change of labels, of the camera's motion, or of the video.
    std::uint64_t version() const { return version_; }
    const CameraMotion& camera() const { return *camera_; }
    std::shared_ptr<const CameraMotion> sharedCamera() const { return camera_; }
    const SequenceRecord& sequence() const { return sequence_; }
    /// The project that holds the labels open, or on their way.
    const std::filesystem::path& projectPath() const { return project_path_; }
    /// For import, which needs new ids. Null while nothing is open.
    AnnotationStore* store() { return store_.get(); }
    ObjectId newObjectId() { return store_->newObjectId(); }

    /// Brought into order when asked for after a change.
    const ReviewIndex& review() const;
    const std::vector<AttentionItem>& attention() const;

    /// Carries an edit out, commits it and tells everyone. What goes wrong is told by problem(); answers whether it was
    /// done.
    bool apply(const AnnotationEdit& edit);
    /// Tracks of a run are not to be offered as objects any more, or all of it are again. They answer as apply() does;
    /// no steps that can be undone.
    bool rejectProposals(int run_id, const std::vector<TrackId>& tracks);
    bool offerProposalsAgain(int run_id);
    void undo();
    void redo();
    bool canUndo() const { return canEdit() && store_->canUndo(); }
    bool canRedo() const { return canEdit() && store_->canRedo(); }
    QString undoName() const;
    QString redoName() const;

    /// The object that keys act on.
    std::optional<ObjectId> selected() const { return selected_; }
    /// All selected ones, the one above included.
    const std::set<ObjectId>& selection() const { return selection_; }
    void select(std::optional<ObjectId> object);
    void setSelection(std::set<ObjectId> objects, std::optional<ObjectId> main);
    /// Adds an object to the selection, or takes it out.
    void toggle(ObjectId object);

    /// The class of what is drawn next.
    const std::string& drawnClass() const { return drawn_class_; }
    void setDrawnClass(const std::string& name);
    /// Who checks: the user's name on this machine.
    static QString person();

 signals:
    /// Labels were read, or are gone.
    void opened();
    void closed();
    /// Labels, the camera's motion or states of review changed.
    void changed();
    void selectionChanged();
    void drawnClassChanged();
    void problem(const QString& message);
    void notice(const QString& message);
    /// Labels were to be changed that are read-only here.
    void refused();

 private:
    struct Opened;
    void refreshOpen();
    void adopt(const std::shared_ptr<Opened>& opened);
    void readCamera();
    void adoptCamera(const std::shared_ptr<const CameraMotion>& camera);
    void rereadReadOnly();
    void follow(std::optional<AnnotationStore::Reading> reading);
    void close();
    void wasChanged();
    void selectOf(const AnnotationEdit& edit);
    template <class Work>
    bool guarded(Work&& work);

    ProjectSession& session_;
    bool wanted_ = false;
    std::filesystem::path project_path_;  ///< of the labels open or on their way
    SequenceRecord sequence_;
    std::unique_ptr<ProjectFile> project_;
    std::unique_ptr<AnnotationStore> store_;
    std::shared_ptr<const CameraMotion> camera_ = std::make_shared<CameraMotion>();
    AnnotationSet nothing_;
    std::uint64_t version_ = 0;
    mutable std::optional<ReviewIndex> review_;
    mutable std::optional<std::vector<AttentionItem>> attention_;
    std::optional<ObjectId> selected_;
    std::set<ObjectId> selection_;
    RepeatedCall reread_;             ///< what another window changes is read now and then
    bool reread_fault_told_ = false;  ///< and it could not be read since
    std::string drawn_class_ = "car";
    BackgroundQuery labels_query_;
    BackgroundQuery camera_query_;  ///< last: both stop before the rest goes
};

}  // namespace eyrie::ui
