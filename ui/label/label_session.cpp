#include "label/label_session.h"

#include <exception>
#include <utility>

#include "exchange/project_labels.h"
#include "session/project/person_name.h"
#include "store/labels/rejected_proposals.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr int kReread_ms = 2000;
}

/// Labels as they were read in the background.
struct LabelSession::Opened {
    std::unique_ptr<ProjectFile> project;
    std::unique_ptr<AnnotationStore> store;
    int sequence_id = 0;
};

LabelSession::LabelSession(ProjectSession& session, QObject* parent)
    : QObject(parent), session_(session), reread_(kReread_ms, [this] { rereadReadOnly(); }) {
    whenChanged(
        session_, this,
        {
            {SessionChange::video, [this] { close(); }},
            {{SessionChange::project, SessionChange::opened}, [this] { refreshOpen(); }},
            {{SessionChange::run_data, SessionChange::current_run, SessionChange::run_ended}, [this] { readCamera(); }},
        });
}

LabelSession::~LabelSession() = default;

void LabelSession::setWanted(bool wanted) {
    wanted_ = wanted;
    if (wanted_) refreshOpen();
}

void LabelSession::refreshOpen() {
    if (session_.project().empty()) close();  // what is done now would be lost: it is becoming another file
    const auto& video = session_.video();
    if (!wanted_ || !video || !session_.media() || session_.project().empty() || session_.opening()) return;
    if (project_path_ == session_.project() && sequence_.path == session_.media()->identity) return;
    close();
    project_path_ = session_.project();
    sequence_.path = session_.media()->identity;
    sequence_.size = video->size;
    sequence_.frame_count = video->frame_count;
    sequence_.frame_rate_hz = video->frame_rate_hz;
    sequence_.rate_assumed = video->frame_rate_assumed;
    const auto work = [this, path = project_path_, sequence = sequence_](const BackgroundTask& task) {
        auto opened = std::make_shared<Opened>();
        opened->project = std::make_unique<ProjectFile>(ProjectFile::open(path));
        opened->sequence_id = ensureSequence(*opened->project, sequence);
        opened->store = std::make_unique<AnnotationStore>(*opened->project, opened->sequence_id);
        task.tell([this, opened] { adopt(opened); });
    };
    labels_query_.ask(work, [this](const QString& text) {
        project_path_.clear();
        emit problem(text);
    });
    readCamera();
}

void LabelSession::adopt(const std::shared_ptr<Opened>& opened) {
    project_ = std::move(opened->project);
    store_ = std::move(opened->store);
    sequence_.id = opened->sequence_id;
    wasChanged();
    emit this->opened();
    if (store_->readOnly()) reread_.start();
}

void LabelSession::rereadReadOnly() {
    if (!store_ || !store_->readOnly()) {
        reread_.stop();
        return;
    }
    const auto work = [this, path = project_path_, sequence_id = sequence_.id,
                       known = store_->changes()](const BackgroundTask& task) {
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        task.tell([this, reading = AnnotationStore::readIfChanged(project, sequence_id, known)] { follow(reading); });
    };
    // What cannot be read now may be the next time: it is tried on.
    const auto failed = [this](const QString& message) {
        if (!std::exchange(reread_fault_told_, true)) emit problem(message);
    };
    labels_query_.ask(work, failed, BackgroundQuery::Former::finish);
}

void LabelSession::follow(std::optional<AnnotationStore::Reading> reading) {
    reread_fault_told_ = false;
    if (store_ && reading && store_->follow(std::move(*reading))) wasChanged();
}

void LabelSession::readCamera() {
    if (!wanted_ || session_.project().empty()) return;
    const auto work = [this, path = session_.project(), run = session_.currentRun(),
                       video = sequence_.path](const BackgroundTask& task) {
        auto camera = std::make_shared<CameraMotion>();
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        const RunStore store(project);
        if (run) {
            *camera = CameraMotion::fromRegistrations(store.registrations(*run));
        } else {
            for (const SequenceRecord& sequence : sequencesOf(project))
                if (sequence.path == video) *camera = cameraMotionOf(store, sequence.id);
        }
        task.tell([this, camera] { adoptCamera(camera); });
    };
    camera_query_.ask(work, [this](const QString& failure) {
        emit problem(failure);
        adoptCamera(std::make_shared<CameraMotion>());
    });
}

void LabelSession::adoptCamera(const std::shared_ptr<const CameraMotion>& camera) {
    camera_ = camera;
    wasChanged();
}

void LabelSession::close() {
    labels_query_.cancel();
    camera_query_.cancel();
    project_path_.clear();
    reread_fault_told_ = false;
    const bool was_open = store_ != nullptr;
    store_.reset();
    project_.reset();
    camera_ = std::make_shared<CameraMotion>();
    selected_.reset();
    selection_.clear();
    sequence_ = {};
    if (!was_open) return;
    wasChanged();
    emit selectionChanged();
    emit closed();
}

void LabelSession::wasChanged() {
    ++version_;
    review_.reset();
    attention_.reset();
    emit changed();
}

const LabelledObject* LabelSession::object(ObjectId id) const {
    const auto found = annotations().objects.find(id);
    return found == annotations().objects.end() ? nullptr : &found->second;
}

const ReviewIndex& LabelSession::review() const {
    if (!review_) review_.emplace(annotations());
    return *review_;
}

const std::vector<AttentionItem>& LabelSession::attention() const {
    if (!attention_) {
        AttentionOptions options;
        options.image = sequence_.size;
        options.frame_count = sequence_.frame_count;
        attention_ = attentionList(annotations(), *camera_, options);
    }
    return *attention_;
}

// ---- changing -------------------------------------------------------------------------------------------------------

bool LabelSession::mayEdit() {
    if (store_ && store_->readOnly()) emit refused();
    return canEdit();
}

template <class Work>
bool LabelSession::guarded(Work&& work) {
    if (!mayEdit()) return false;
    try {
        work();
        return true;
    } catch (const std::exception& error) {
        TaskPool::common()->countFailedWrite();  // also whoever is about to close the window is to know
        emit problem(QString::fromUtf8(error.what()));
        return false;
    }
}

bool LabelSession::apply(const AnnotationEdit& edit) {
    if (edit.empty()) return false;
    if (!guarded([&] { store_->apply(edit); })) return false;
    wasChanged();
    const std::set<ObjectId> before = selection_;
    std::erase_if(selection_, [this](ObjectId id) { return object(id) == nullptr; });
    if (selected_ && object(*selected_) == nullptr) selected_.reset();
    if (before != selection_) emit selectionChanged();
    return true;
}

bool LabelSession::rejectProposals(int run_id, const std::vector<TrackId>& tracks) {
    return guarded([&] { eyrie::rejectProposals(*project_, run_id, tracks, person().toStdString()); });
}

bool LabelSession::offerProposalsAgain(int run_id) {
    return guarded([&] { forgetRejectedProposals(*project_, run_id); });
}

void LabelSession::selectOf(const AnnotationEdit& edit) {
    std::set<ObjectId> ids;
    for (const auto& change : edit.objects)
        for (const auto& side : {change.before, change.after})
            if (side && object(side->id) != nullptr) ids.insert(side->id);
    if (ids.empty() || ids.size() > 50) {
        std::erase_if(selection_, [this](ObjectId id) { return object(id) == nullptr; });
        if (selected_ && object(*selected_) == nullptr) selected_.reset();
        emit selectionChanged();
        return;
    }
    const ObjectId main = selected_ && ids.contains(*selected_) ? *selected_ : *ids.begin();
    setSelection(std::move(ids), main);
}

void LabelSession::undo() {
    std::optional<AnnotationEdit> step;
    if (!guarded([&] { step = store_->undo(); }) || !step) return;
    wasChanged();
    selectOf(*step);
}

void LabelSession::redo() {
    std::optional<AnnotationEdit> step;
    if (!guarded([&] { step = store_->redo(); }) || !step) return;
    wasChanged();
    selectOf(*step);
}

QString LabelSession::undoName() const {
    return store_ ? QString::fromStdString(store_->undoName()) : QString();
}

QString LabelSession::redoName() const {
    return store_ ? QString::fromStdString(store_->redoName()) : QString();
}

void LabelSession::tryToWrite() {
    if (!store_) return;
    try {
        const bool may = store_->tryToWrite();
        wasChanged();
        emit opened();
        emit notice(may ? tr("You can label in this window now.") : tr("Labels are still read-only here."));
    } catch (const std::exception& error) {
        emit problem(QString::fromUtf8(error.what()));
    }
}

// ---- selection ------------------------------------------------------------------------------------------------------

void LabelSession::select(std::optional<ObjectId> object) {
    setSelection(object ? std::set<ObjectId>{*object} : std::set<ObjectId>(), object);
}

void LabelSession::setSelection(std::set<ObjectId> objects, std::optional<ObjectId> main) {
    if (main) objects.insert(*main);
    if (objects == selection_ && main == selected_) return;
    selection_ = std::move(objects);
    selected_ = main;
    emit selectionChanged();
}

void LabelSession::toggle(ObjectId object) {
    std::set<ObjectId> objects = selection_;
    if (objects.erase(object) == 0) {
        objects.insert(object);
        setSelection(std::move(objects), selected_ ? selected_ : object);
        return;
    }
    std::optional<ObjectId> main = selected_;
    if (main == object) main = objects.empty() ? std::nullopt : std::optional(*objects.begin());
    setSelection(std::move(objects), main);
}

void LabelSession::setDrawnClass(const std::string& name) {
    if (name == drawn_class_) return;
    drawn_class_ = name;
    emit drawnClassChanged();
}

QString LabelSession::person() {
    return personName();
}

}  // namespace eyrie::ui

#include "moc_label_session.cpp"
