#include "tune/evaluate/evaluation_session.h"

#include <QSettings>
#include <exception>

#include "core/error.h"
#include "scoring/ground_truth.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr int kSettle_ms = 60;  ///< several changes at once are answered once

QString truthKey(const std::filesystem::path& project) {
    return QStringLiteral("evaluation/truth/%1").arg(qHash(QString::fromStdString(project.string())), 0, 16);
}

bool sameThing(const ResultError& a, const ResultError& b) {
    return a.kind == b.kind && a.objects == b.objects && a.tracks == b.tracks && a.last_frame >= b.first_frame &&
           a.first_frame <= b.last_frame;
}

}  // namespace

EvaluationOptions storedWishes() {
    const QSettings stored;
    EvaluationOptions wishes;
    wishes.overlap = std::clamp(stored.value(QStringLiteral("evaluation/overlap"), 0.1).toDouble(), 0.01, 1.0);
    wishes.vehicles_only = stored.value(QStringLiteral("evaluation/vehicles_only")).toBool();
    try {
        wishes.one_class =
            scoredClass(stored.value(QStringLiteral("evaluation/classes"), "all").toString().toStdString());
    } catch (const Error&) {
        // Another version wrote the settings.
    }
    if (wishes.one_class) wishes.vehicles_only = false;
    wishes.upright = stored.value(QStringLiteral("evaluation/upright")).toBool();
    const double border_px = stored.value(QStringLiteral("evaluation/border")).toDouble();
    if (border_px > 0) wishes.border = border_px;
    return wishes;
}

EvaluationSession::EvaluationSession(ProjectSession& session, QObject* parent)
    : QObject(parent),
      session_(session),
      soon_(kSettle_ms, [this] { refresh(); }),
      evaluator_(std::make_unique<RunEvaluator>()) {
    settings_.wishes = storedWishes();
    whenChanged(session_, this,
                {{SessionChange::current_run, [this] { forgetRun(); }},
                 {SessionChange::project, [this] { readTruthOfProject(); }},
                 {SessionChange::run_ended, [this] { refreshLater(); }},
                 {SessionChange::run_data, [this] {
                      // A run at work grows every other second; its evaluation waits for the end.
                      if (!session_.running() && !evaluation_) refreshLater();
                  }}});
}

EvaluationSession::~EvaluationSession() = default;

void EvaluationSession::forgetRun() {
    forget();
    settings_.other_run.reset();
    emit settingsChanged();
    refreshLater();
}

void EvaluationSession::readTruthOfProject() {
    settings_.truth_file = QSettings().value(truthKey(session_.project())).toString().toStdString();
    forget();
    emit settingsChanged();
    refreshLater();
}

void EvaluationSession::setWanted(bool wanted) {
    if (wanted == wanted_) return;
    wanted_ = wanted;
    if (wanted_ && stale_) refreshLater();
}

void EvaluationSession::setSettings(const EvaluationSettings& settings) {
    if (settings == settings_) return;
    settings_ = settings;
    const EvaluationOptions& wishes = settings_.wishes;
    QSettings stored;
    stored.setValue(QStringLiteral("evaluation/overlap"), wishes.overlap);
    stored.setValue(QStringLiteral("evaluation/vehicles_only"), wishes.vehicles_only);
    stored.setValue(QStringLiteral("evaluation/classes"), QString::fromStdString(wordOfScored(wishes.one_class)));
    stored.setValue(QStringLiteral("evaluation/upright"), wishes.upright);
    stored.setValue(QStringLiteral("evaluation/border"), wishes.border.value_or(0));
    if (settings_.truth_file.empty())
        stored.remove(truthKey(session_.project()));
    else
        stored.setValue(truthKey(session_.project()), QString::fromStdString(settings_.truth_file.string()));
    emit settingsChanged();
    refreshLater();
}

void EvaluationSession::labelsChanged() {
    if (settings_.truth_file.empty()) refreshLater();
}

EvaluationRequest EvaluationSession::request() const {
    EvaluationRequest request;
    request.project = session_.project();
    request.run_id = session_.currentRun().value_or(0);
    request.truth.file = settings_.truth_file;
    request.detections = settings_.detections;
    request.options = settings_.wishes;
    request.other_run = settings_.other_run;
    return request;
}

void EvaluationSession::refreshLater() {
    stale_ = true;
    if (wanted_) soon_.start();
}

void EvaluationSession::refresh() {
    if (!wanted_ || !stale_) return;
    if (!session_.currentRun() || session_.project().empty() || session_.running()) {
        obstacle_ = session_.running() ? tr("Wait until the run has ended; it is evaluated then.")
                                       : tr("Choose a run, or run the video first. Then it is compared with the labels "
                                            "of the project or with a file of ground truth.");
        emit changed();
        return;
    }
    stale_ = false;
    setWorking(true);
    const auto work = [this, wish = request()](const BackgroundTask& task) {
        try {
            const auto evaluation = evaluator_->evaluate(wish, task.stop());
            if (evaluation) task.tell([this, evaluation] { adopt(evaluation, {}); });
        } catch (const NothingLabelled&) {
            task.tell([this] {
                adopt(nullptr,
                      tr("Nobody has labelled this video yet. Draw or import labels in the workspace Label, or "
                         "choose a file of ground truth."));
            });
        }
    };
    query_.ask(work, [this](const QString& obstacle) { adopt(nullptr, obstacle); });
}

void EvaluationSession::forget() {
    query_.cancel();
    stale_ = true;
    const bool had = evaluation_ != nullptr || !obstacle_.isEmpty();
    evaluation_.reset();
    matches_.clear();
    errors_.clear();
    obstacle_.clear();
    setWorking(false);
    const bool selected = selected_.has_value();
    selected_.reset();
    if (had) emit changed();
    if (selected) emit selectionChanged();
}

void EvaluationSession::adopt(const std::shared_ptr<const RunEvaluation>& evaluation, const QString& obstacle) {
    const auto before = evaluation_;
    evaluation_ = evaluation;
    obstacle_ = obstacle;
    matches_.clear();
    errors_.clear();
    if (evaluation_) {
        for (std::size_t i = 0; i < evaluation_->matches.size(); ++i) matches_[evaluation_->matches[i].frame] = i;
        for (std::size_t i = 0; i < evaluation_->errors.size(); ++i) {
            const ResultError& error = evaluation_->errors[i].error;
            if (error.kind == ResultErrorKind::id_switch || error.kind == ResultErrorKind::fragment)
                errors_[error.places.front().frame].push_back(i);
        }
    }
    keepSelection(before);
    setWorking(false);
    emit changed();
}

/// After scoring again the same error is looked at, if it is still there.
void EvaluationSession::keepSelection(const std::shared_ptr<const RunEvaluation>& before) {
    if (!selected_) return;
    const ResultError* looked_at =
        before && *selected_ < before->errors.size() ? &before->errors[*selected_].error : nullptr;
    std::optional<std::size_t> found;
    for (std::size_t i = 0; looked_at != nullptr && evaluation_ && i < evaluation_->errors.size() && !found; ++i)
        if (sameThing(evaluation_->errors[i].error, *looked_at)) found = i;
    if (found == selected_) return;
    selected_ = found;
    emit selectionChanged();
}

void EvaluationSession::setWorking(bool working) {
    if (working == working_) return;
    working_ = working;
    emit workingChanged(working);
}

void EvaluationSession::select(std::optional<std::size_t> error) {
    if (error && (!evaluation_ || *error >= evaluation_->errors.size())) error.reset();
    if (error == selected_) return;
    selected_ = error;
    emit selectionChanged();
}

const DiagnosedError* EvaluationSession::selectedError() const {
    return selected_ && evaluation_ ? &evaluation_->errors[*selected_] : nullptr;
}

std::vector<BoxRecord> EvaluationSession::truthAt(FrameIndex frame) const {
    if (!evaluation_) return {};
    const auto found = evaluation_->truth.find(frame);
    return found == evaluation_->truth.end() ? std::vector<BoxRecord>() : found->second;
}

std::vector<VerdictMark> EvaluationSession::marksAt(FrameIndex frame) const {
    std::vector<VerdictMark> marks;
    const auto at = matches_.find(frame);
    if (at == matches_.end()) return marks;
    const FrameMatch& match = evaluation_->matches[at->second];
    const std::vector<BoxRecord> truth = truthAt(frame);
    const auto found = evaluation_->result.find(frame);
    const auto& results = found == evaluation_->result.end() ? std::vector<BoxRecord>() : found->second;
    std::map<int, const ResultError*> switches;  // by true object
    std::map<int, const ResultError*> fragments;
    if (const auto here = errors_.find(frame); here != errors_.end())
        for (const std::size_t index : here->second) {
            const ResultError& error = evaluation_->errors[index].error;
            if (error.places.front().truth.empty()) continue;
            auto& of = error.kind == ResultErrorKind::id_switch ? switches : fragments;
            of[error.places.front().truth.front()] = &error;
        }
    const DiagnosedError* looked_at = selectedError();
    const ErrorPlace* place = nullptr;
    for (std::size_t i = 0; looked_at != nullptr && i < looked_at->error.places.size(); ++i)
        if (looked_at->error.places[i].frame == frame) place = &looked_at->error.places[i];
    const auto mark = [&](VerdictKind kind, const BoxRecord& record, const QString& text) {
        VerdictMark one{kind, record.box, text, false};
        one.selected = place != nullptr && place->box.centre == record.box.centre;
        marks.push_back(one);
    };
    const auto at_index = [](const std::vector<BoxRecord>& records, int index) -> const BoxRecord& {
        return records[static_cast<std::size_t>(index)];
    };
    const auto objectText = [](const BoxRecord& record) {
        return record.id ? tr("object %1").arg(*record.id) : QString();
    };
    for (const int index : match.ignored_results) mark(VerdictKind::ignored, at_index(results, index), {});
    for (const int index : match.border_results) mark(VerdictKind::ignored, at_index(results, index), {});
    for (const int index : match.other_class_results) mark(VerdictKind::ignored, at_index(results, index), {});
    for (const MatchedPair& pair : match.pairs) {
        const auto switched = switches.find(pair.truth);
        if (switched == switches.end()) {
            mark(VerdictKind::found, at_index(results, pair.result), {});
            continue;
        }
        const auto& tracks = switched->second->tracks;
        mark(VerdictKind::switched, at_index(results, pair.result),
             QStringLiteral("%1 → %2").arg(tracks.front()).arg(tracks.back()));
        if (place != nullptr && place->truth == std::vector<int>{pair.truth}) marks.back().selected = true;
    }
    for (const int index : match.missed) {
        const BoxRecord& record = at_index(truth, index);
        mark(fragments.contains(index) ? VerdictKind::fragment : VerdictKind::missed, record, objectText(record));
    }
    for (const int index : match.false_results) {
        const BoxRecord& record = at_index(results, index);
        mark(VerdictKind::false_alarm, record, record.id ? tr("track %1").arg(*record.id) : QString());
    }
    return marks;
}

}  // namespace eyrie::ui

#include "moc_evaluation_session.cpp"
