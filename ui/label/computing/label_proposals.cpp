#include "label/computing/label_proposals.h"

#include <algorithm>
#include <exception>
#include <limits>

#include "annotation/edits/identity_edits.h"
#include "annotation/keyframes/interpolation.h"
#include "label/label_classes.h"
#include "store/labels/rejected_proposals.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

std::vector<DenseTrack> tracksOf(ProjectFile& project, int run_id, const std::stop_token& stop) {
    const RunStore store(project);
    std::vector<DenseTrack> tracks;
    for (const TrackSummary& summary : store.tracks(run_id)) {
        if (stop.stop_requested()) break;
        if (!summary.confirmed) continue;
        DenseTrack track;
        track.id = summary.id;
        track.track_class = summary.track_class;
        for (const TrackFrame& state : store.trackStates(run_id, summary.id))
            track.boxes.push_back({state.frame, state.state.box});
        if (!track.boxes.empty()) tracks.push_back(std::move(track));
    }
    return tracks;
}

bool livesIn(const Proposal& proposal, FrameIndex frame) {
    return proposal.object.keyframes.front().frame <= frame && proposal.object.last_frame >= frame;
}

}  // namespace

LabelProposals::LabelProposals(ProjectSession& session, LabelSession& labels, QObject* parent)
    : QObject(parent), session_(session), labels_(labels) {
    const auto forget = [this] {
        proposals_.clear();
        taken_.clear();
        rejected_.clear();
        selection_.clear();
        readAnew();
        emit changed();
    };
    whenChanged(session_, this, {{{SessionChange::current_run, SessionChange::run_ended}, forget}});
    whenAny(&labels_, this, forget, &LabelSession::opened, &LabelSession::closed);
}

LabelProposals::~LabelProposals() = default;

void LabelProposals::setShown(bool shown) {
    if (shown_ == shown) return;
    shown_ = shown;
    if (!shown_) selection_.clear();
    if (shown_) read();
    emit changed();
}

void LabelProposals::read() {
    if (working_ || !labels_.isOpen() || !session_.currentRun() || run_ == session_.currentRun()) return;
    working_ = true;
    run_ = session_.currentRun();
    const auto work = [this, path = session_.project(), run = *run_, labelled = labels_.annotations(),
                       camera = labels_.sharedCamera(), tolerance = tolerance_px_](const BackgroundTask& task) {
        ProposalOptions options;
        options.reduction.tolerance_px = tolerance;
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        auto proposals = proposeTracks(tracksOf(project, run, task.stop()), labelled, *camera, options);
        std::erase_if(proposals, [](const Proposal& p) { return p.object.keyframes.empty(); });
        task.tell([this, proposals = std::move(proposals), rejected = rejectedProposals(project, run)] {
            rejected_ = rejected;
            adopt(proposals, {});
        });
    };
    query_.ask(work, [this](const QString& failure) { adopt({}, failure); });
}

void LabelProposals::adopt(const std::vector<Proposal>& proposals, const QString& failure) {
    working_ = false;
    if (!failure.isEmpty()) emit labels_.problem(failure);
    proposals_ = proposals;
    emit changed();
}

bool LabelProposals::isPending(const Proposal& proposal) const {
    if (rejected_.contains(proposal.track)) return false;
    if (proposal.same_as != 0 && labels_.object(proposal.same_as) != nullptr) return false;
    const auto taken = taken_.find(proposal.track);
    return taken == taken_.end() || labels_.object(taken->second) == nullptr;  // taking over may have been undone
}

std::vector<const Proposal*> LabelProposals::pending() const {
    std::vector<const Proposal*> found;
    if (!shown_) return found;
    for (const Proposal& proposal : proposals_)
        if (isPending(proposal)) found.push_back(&proposal);
    return found;
}

std::vector<const Proposal*> LabelProposals::pendingIn(FrameIndex frame) const {
    std::vector<const Proposal*> found = pending();
    std::erase_if(found, [&](const Proposal* proposal) { return !livesIn(*proposal, frame); });
    return found;
}

const Proposal* LabelProposals::find(TrackId track) const {
    for (const Proposal& proposal : proposals_)
        if (proposal.track == track) return &proposal;
    return nullptr;
}

const Proposal* LabelProposals::next(FrameIndex frame) const {
    const auto here = pendingIn(frame);
    if (!here.empty()) return here.front();
    const Proposal* earliest = nullptr;
    for (const Proposal* proposal : pending())
        if (earliest == nullptr || proposal->object.keyframes.front().frame < earliest->object.keyframes.front().frame)
            earliest = proposal;
    return earliest;
}

std::optional<TrackId> LabelProposals::selected() const {
    return selection_.empty() ? std::nullopt : std::optional(selection_.back());
}

bool LabelProposals::isSelected(TrackId track) const {
    return std::find(selection_.begin(), selection_.end(), track) != selection_.end();
}

void LabelProposals::select(std::optional<TrackId> track) {
    std::vector<TrackId> selection;
    if (track) selection.push_back(*track);
    if (selection_ == selection) return;
    selection_ = std::move(selection);
    emit changed();
}

void LabelProposals::toggle(TrackId track) {
    if (isSelected(track))
        forgetSelected(track);
    else
        selection_.push_back(track);
    emit changed();
}

void LabelProposals::forgetSelected(TrackId track) {
    std::erase(selection_, track);
}

void LabelProposals::setTolerance(double px) {
    if (tolerance_px_ == px) return;
    tolerance_px_ = px;
    // Those taken stay what they are.
    std::erase_if(proposals_, [this](const Proposal& proposal) { return isPending(proposal); });
    selection_.clear();
    readAnew();
    emit changed();
}

void LabelProposals::readAnew() {
    query_.cancel();
    working_ = false;
    run_.reset();
    if (shown_) read();
}

std::vector<ObjectId> LabelProposals::accept(const std::vector<TrackId>& tracks) {
    return take(tracks, 0, std::numeric_limits<FrameIndex>::max());
}

std::vector<ObjectId> LabelProposals::acceptRange(FrameIndex first, FrameIndex last) {
    std::vector<TrackId> tracks;
    for (const Proposal* proposal : pending())
        if (proposal->object.keyframes.front().frame <= last && proposal->object.last_frame >= first)
            tracks.push_back(proposal->track);
    return take(tracks, first, last);
}

std::vector<ObjectId> LabelProposals::take(const std::vector<TrackId>& tracks, FrameIndex first, FrameIndex last) {
    std::vector<ObjectId> ids;
    if (tracks.empty() || !labels_.mayEdit()) return ids;
    AnnotationEdit edit;
    std::map<TrackId, ObjectId> taken;
    for (const TrackId track : tracks) {
        const Proposal* proposal = find(track);
        if (proposal == nullptr || !isPending(*proposal)) continue;
        const ObjectId id = labels_.newObjectId();
        const ObjectClass object_class =
            classNamed(labels_.annotations(),
                       classOfProposal(*proposal, labels_.annotations(), labels_.camera(), labels_.drawnClass()));
        LabelledObject object = accepted(*proposal, id, object_class.colour);
        object.object_class = object_class.name;
        if (firstFrameOf(object) < first || object.last_frame > last)
            object = cutToRange(object, first, last, labels_.camera());
        if (object.keyframes.empty()) continue;
        edit.objects.push_back({std::nullopt, std::move(object)});
        taken[track] = id;
        ids.push_back(id);
    }
    edit.name = (ids.size() == 1 ? tr("Accept track %1").arg(taken.empty() ? 0 : taken.begin()->first)
                                 : tr("Accept %1 tracks").arg(ids.size()))
                    .toStdString();
    if (!labels_.apply(edit)) return {};
    for (const auto& [track, object] : taken) taken_[track] = object;
    for (const auto& [track, object] : taken) forgetSelected(track);
    emit changed();
    return ids;
}

void LabelProposals::reject(const std::vector<TrackId>& tracks) {
    std::vector<TrackId> offered;
    for (const TrackId track : tracks)
        if (find(track) != nullptr) offered.push_back(track);
    if (offered.empty() || !run_ || !labels_.rejectProposals(*run_, offered)) return;
    for (const TrackId track : offered) {
        rejected_.insert(track);
        forgetSelected(track);
    }
    emit changed();
}

void LabelProposals::offerAgain() {
    if (!run_ || !labels_.offerProposalsAgain(*run_)) return;
    rejected_.clear();
    if (working_) readAnew();  // what is being read knows them as rejected
    emit changed();
}

}  // namespace eyrie::ui

#include "moc_label_proposals.cpp"
