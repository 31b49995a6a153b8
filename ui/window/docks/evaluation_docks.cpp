#include "window/docks/evaluation_docks.h"

#include <QFileInfo>
#include <QMainWindow>
#include <algorithm>
#include <utility>

#include "canvas/layers/verdict_layer.h"
#include "canvas/video_view.h"
#include "label/label_workspace.h"
#include "tune/evaluate/error_chips.h"
#include "tune/evaluate/errors_panel.h"
#include "tune/evaluate/evaluation_panel.h"
#include "widgets/display_text.h"
#include "widgets/empty_state.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "window/docks/report_writer.h"
#include "workspace/dock_registry.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

constexpr double kShareOfView = 0.14;  ///< how large an error is shown, of the view's shorter side
constexpr double kMostZoom = 8;

QString idsText(const std::vector<int>& ids, const QString& between) {
    QStringList texts;
    for (const int id : ids) texts << QString::number(id);
    return texts.join(between);
}

ErrorRow rowOf(const DiagnosedError& one, int id) {
    const ResultError& error = one.error;
    ErrorRow row;
    row.id = id;
    row.kind = QString::fromUtf8(nameOf(error.kind));
    row.kind_order = static_cast<int>(error.kind);
    row.cause = QString::fromUtf8(nameOf(one.cause));
    row.explanation = QString::fromUtf8(explanationOf(one.cause));
    row.detail = QString::fromStdString(one.text);
    if (error.count() > 1 && one.frames_of_cause > 0 && one.frames_of_cause < error.count())
        row.detail += QObject::tr("%1in %2 of %3 frames")
                          .arg(row.detail.isEmpty() ? QString() : QStringLiteral("; "))
                          .arg(one.frames_of_cause)
                          .arg(error.count());
    row.first_frame = error.first_frame;
    row.last_frame = error.last_frame;
    row.count = error.count();
    row.objects = idsText(error.objects, QStringLiteral(", "));
    row.object_order = error.objects.empty() ? 0 : error.objects.front();
    row.tracks =
        idsText(error.tracks, error.kind == ResultErrorKind::id_switch ? QStringLiteral(" → ") : QStringLiteral(", "));
    return row;
}

const ErrorPlace& placeOf(const DiagnosedError& one) {
    return one.error.places[one.place];
}

}  // namespace

EvaluationDocks::EvaluationDocks(ProjectSession& session, EvaluationSession& evaluation, VideoView& canvas,
                                 WindowActions& actions, OverlaySettings& overlays, DockRegistry& docks,
                                 MessageBar& messages, QMainWindow& window)
    : QObject(&window),
      session_(session),
      canvas_(canvas),
      actions_(actions),
      overlays_(overlays),
      docks_(docks),
      messages_(messages),
      window_(window),
      evaluation_(&evaluation) {
    panel_ = new EvaluationPanel(session_, *evaluation_);
    model_ = new ErrorsModel(this);
    errors_ = new ErrorsPanel(model_);
    chips_ = new ErrorChips(this);
    docks_.add(DockId::evaluation, tr("Evaluation"), panel_);
    docks_.add(DockId::errors, tr("Errors"), errors_);
    const auto watch = [this](DockId id, bool& looked_at) {
        docks_.watch(id, this, [this, &looked_at](bool visible) {
            // Docks that come back tell so several times.
            if (std::exchange(looked_at, visible) != visible) updateWanted();
        });
    };
    watch(DockId::evaluation, evaluation_looked_at_);
    watch(DockId::errors, errors_looked_at_);
    whenAny(actions_.full_screen, this, &EvaluationDocks::showErrorsAlone, &QAction::toggled);
    bindCommands(this, {
                           {actions_.next_error, [this] { step(1); }},
                           {actions_.previous_error, [this] { step(-1); }},
                           {actions_.why_error, [this] { askWhy(); }},
                           {actions_.wrong_truth, [this] { correctTruth(); }},
                           {actions_.report, [this] { askForReport(); }},
                       });
    wireReport();
    connect(evaluation_, &EvaluationSession::changed, this, [this] {
        tellChange(told_);
        told_ = evaluation_->evaluation();
        showErrors();
        showMarks();
        showErrorsAlone();
    });
    connect(evaluation_, &EvaluationSession::selectionChanged, this, &EvaluationDocks::showMarks);
    wireList();
    showErrors();
}

EvaluationDocks::~EvaluationDocks() = default;

void EvaluationDocks::updateWanted() {
    evaluation_->setWanted(evaluation_looked_at_ || errors_looked_at_ || evaluation_->evaluation() != nullptr);
    showErrorsAlone();
}

/// Clusters, detections and tracks lie over the verdicts: while the docks are looked at they are switched off. Keys
/// bring them back; leaving the docks does, too.
void EvaluationDocks::showErrorsAlone() {
    if (labelling_ != nullptr && labelling_->active()) return;
    const bool looked_at = evaluation_looked_at_ || errors_looked_at_;
    const bool alone = looked_at && evaluation_->evaluation() != nullptr && !previewed_;
    if (!alone) {
        // In full screen no dock is seen; they come back, and what was shown with them is to be there.
        if (previewed_ || (!actions_.full_screen->isChecked() && !window_.isFullScreen())) giveOverlaysBack();
    } else if (!other_overlays_) {
        other_overlays_ = overlays_.profile();
        overlays_.setProfile({{VerdictLayer::kKind}, other_overlays_->detail});
    }
}

void EvaluationDocks::setPreviewed(bool previewed) {
    if (std::exchange(previewed_, previewed) != previewed) showErrorsAlone();
    if (!previewed) showMarks();
}

void EvaluationDocks::giveOverlaysBack() {
    if (!other_overlays_) return;
    OverlayProfile before = *std::exchange(other_overlays_, std::nullopt);
    // Switched off meanwhile, verdicts stay so, and so does every detail.
    if (!overlays_.isVisible(VerdictLayer::kKind)) before.set(VerdictLayer::kKind, false);
    before.detail = overlays_.profile().detail;
    overlays_.setProfile(before);
}

void EvaluationDocks::enterWorkspace(WorkspaceKind kind) {
    if (kind == WorkspaceKind::label) return giveOverlaysBack();  // a dock may have come up before labelling began
    correcting_ = false;
    showErrorsAlone();
}

// ---- the list -------------------------------------------------------------------------------------------------------

void EvaluationDocks::wireList() {
    errors_->setCommands({
        .go_to = [this](int id) { goTo(id); },
        .ask_why =
            [this](int id) {
                goTo(id);
                askWhy();
            },
        .correct_truth =
            [this](int id) {
                goTo(id);
                correctTruth();
            },
        .want_chips = [this] { wantChips(); },
    });
    panel_->setCommands({
        .label = [this] { actions_.workspaceAction(WorkspaceKind::label)->trigger(); },
        .go_to_object = [this](int object) { goToObject(object); },
        .write_report = [this] { askForReport(); },
    });
    connect(chips_, &ErrorChips::ready, model_, &ErrorsModel::setChip);
    whenChanged(session_, this, {{SessionChange::video, [this] { chips_->setMedia(session_.media()); }}});
}

void EvaluationDocks::goToObject(int object) {
    const auto& evaluation = evaluation_->evaluation();
    for (std::size_t i = 0; evaluation && i < evaluation->errors.size(); ++i) {
        const auto& objects = evaluation->errors[i].error.objects;
        if (std::find(objects.begin(), objects.end(), object) == objects.end()) continue;
        goTo(static_cast<int>(i) + 1);
        return;
    }
    for (const auto& [frame, records] : evaluation ? evaluation->truth : BoxesByFrame())
        for (const BoxRecord& record : records)
            if (record.id == object) {
                session_.goToFrame(frame);
                canvas_.centreOn(QPointF(record.box.centre.x, record.box.centre.y));
                return;
            }
}

void EvaluationDocks::showErrors() {
    const auto& evaluation = evaluation_->evaluation();
    std::vector<ErrorRow> rows;
    if (evaluation) {
        for (std::size_t i = 0; i < evaluation->errors.size(); ++i)
            rows.push_back(rowOf(evaluation->errors[i], static_cast<int>(i) + 1));
    }
    if (evaluation)
        errors_->emptyState()->setTexts(tr("No errors: every object was found in every frame."));
    else
        errors_->emptyState()->setTexts(
            evaluation_->working() ? EvaluationSession::workingText()
            : evaluation_->obstacle().isEmpty()
                ? tr("Every miss, false alarm, switch, fragment, split and merge of the run is listed here with its "
                     "probable cause, once it has been compared with ground truth.")
                : evaluation_->obstacle());
    model_->clearChips();  // numbers mean other errors now
    model_->setErrors(std::move(rows));
    errors_->selectId(evaluation_->selected() ? static_cast<int>(*evaluation_->selected()) + 1 : 0);
    wantChips();
    for (QAction* action : {actions_.next_error, actions_.previous_error, actions_.why_error, actions_.wrong_truth})
        action->setEnabled(evaluation && !evaluation->errors.empty());
    actions_.report->setEnabled(evaluation != nullptr);
}

void EvaluationDocks::wantChips() {
    const auto& evaluation = evaluation_->evaluation();
    if (!evaluation || !errors_looked_at_) return;
    std::vector<ChipWish> wishes;
    for (const int id : errors_->rowsWithoutChip()) {
        if (id < 1 || id > static_cast<int>(evaluation->errors.size())) continue;
        const ErrorPlace& place = placeOf(evaluation->errors[static_cast<std::size_t>(id) - 1]);
        wishes.push_back({id, place.frame, place.box, ErrorsPanel::kChipHeight});
    }
    chips_->request(std::move(wishes));
}

QString EvaluationDocks::nothingEvaluatedText() {
    return tr("Nothing has been evaluated yet: open the dock Evaluation.");
}

void EvaluationDocks::step(int direction) {
    const int id = errors_->neighbour(direction);
    if (id == 0) {
        messages_.showMessage(MessageKind::info,
                              evaluation_->evaluation() ? tr("No error is listed.") : nothingEvaluatedText());
        return;
    }
    goTo(id);
}

void EvaluationDocks::goTo(int id) {
    const auto& evaluation = evaluation_->evaluation();
    if (!evaluation || id < 1 || id > static_cast<int>(evaluation->errors.size())) return;
    const auto index = static_cast<std::size_t>(id) - 1;
    evaluation_->select(index);
    errors_->selectId(id);
    const DiagnosedError& one = evaluation->errors[index];
    const ErrorPlace& place = placeOf(one);
    session_.goToFrame(place.frame);
    const double size = std::max({4.0, place.box.length, place.box.width});
    const double wanted = kShareOfView * std::min(canvas_.width(), canvas_.height()) / size;
    const double zoom = std::clamp(std::max(wanted, canvas_.transform().zoom()), 0.05, kMostZoom);
    canvas_.restore(zoom, QPointF(place.box.centre.x, place.box.centre.y));
    if (labelling_ != nullptr && labelling_->active() && !one.error.objects.empty())
        labelling_->labels().select(one.error.objects.front());
    const ErrorRow row = rowOf(one, id);
    errors_->setStatus(
        tr("<b>%1 of %2: %3</b>, %4. %5%6")
            .arg(id)
            .arg(evaluation->errors.size())
            .arg(row.kind, row.cause, row.explanation,
                 row.detail.isEmpty() ? QString() : QStringLiteral("<br>") + row.detail.toHtmlEscaped()));
}

void EvaluationDocks::askWhy() {
    if (labelling_ != nullptr && labelling_->active()) actions_.workspaceAction(WorkspaceKind::tune)->trigger();
    if (evaluation_->selectedError() == nullptr) step(1);
    const DiagnosedError* one = evaluation_->selectedError();
    if (one == nullptr) return;
    const ErrorPlace place = placeOf(*one);
    session_.goToFrame(place.frame);
    const ErrorRow row = rowOf(*one, 0);
    emit whyRequested(place.box, tr("Error: %1, %2. %3").arg(row.kind, row.cause, row.explanation));
}

// ---- the canvas -----------------------------------------------------------------------------------------------------

void EvaluationDocks::showMarks() {
    const FrameIndex frame = canvas_.frame().index;
    canvas_.setVerdicts(frame, evaluation_->evaluated(frame), evaluation_->marksAt(frame), evaluation_->truthAt(frame));
}

// ---- wrong truth ----------------------------------------------------------------------------------------------------

void EvaluationDocks::join(LabelWorkspace& labelling) {
    labelling_ = &labelling;
    connect(&labelling.labels(), &LabelSession::changed, evaluation_, &EvaluationSession::labelsChanged);
    connect(&labelling.labels(), &LabelSession::opened, this, [this] {
        const DiagnosedError* one = evaluation_->selectedError();
        if (correcting_ && one != nullptr && !one->error.objects.empty())
            labelling_->labels().select(one->error.objects.front());
    });
}

void EvaluationDocks::correctTruth() {
    const DiagnosedError* one = evaluation_->selectedError();
    if (one == nullptr || labelling_ == nullptr) {
        messages_.showMessage(MessageKind::info, tr("Choose an error first."));
        return;
    }
    if (!evaluation_->settings().truth_file.empty()) {
        messages_.showMessage(
            MessageKind::info,
            tr("The ground truth is a file, which is not changed here. Import it into the project's labels "
               "(Label ▸ Import labels) and compare with these."));
        return;
    }
    correcting_ = true;
    const ResultError error = one->error;
    const ErrorPlace place = placeOf(*one);
    const double zoom = canvas_.transform().zoom();
    if (!labelling_->active()) actions_.workspaceAction(WorkspaceKind::label)->trigger();
    session_.goToFrame(place.frame);
    canvas_.restore(zoom, QPointF(place.box.centre.x, place.box.centre.y));
    docks_.raise(DockId::errors);  // the list stays, so that the next error is one key away
    if (!error.objects.empty()) {
        labelling_->labels().select(error.objects.front());
        errors_->setStatus(
            tr("Correct object %1; the run is scored again after every change.").arg(error.objects.front()));
    } else {
        labelling_->labels().select(std::nullopt);
        messages_.showMessage(
            MessageKind::info,
            tr("If an object is here, draw it or take the track over as a proposal; the run is scored again after "
               "every change."));
    }
}

// ---- report ---------------------------------------------------------------------------------------------------------

void EvaluationDocks::askForReport() {
    const auto& evaluation = evaluation_->evaluation();
    if (!evaluation) {
        messages_.showMessage(MessageKind::info, nothingEvaluatedText());
        return;
    }
    const QString name = QFileInfo(QString::fromStdString(evaluation->run.sequence.path)).completeBaseName();
    const QString path = askForReportFile(window_, tr("%1 run %2").arg(name).arg(evaluation->run.id));
    if (path.isEmpty()) return;
    writeReport(path);
}

void EvaluationDocks::writeReport(const QString& path) {
    if (report_->working()) {
        messages_.showMessage(MessageKind::info, ReportWriter::workingText());
        return;
    }
    report_->write(path.toStdString(), evaluation_->evaluation(), session_.media(), session_.project());
}

void EvaluationDocks::wireReport() {
    report_ = std::make_unique<ReportWriter>(ReportAnswers{
        .show_progress = [this](double share) { panel_->showReportProgress(share); },
        .tell_written =
            [this](const std::filesystem::path& path) {
                panel_->showReportProgress(1);
                messages_.showMessage(MessageKind::info,
                                      tr("Wrote the report %1.").arg(QString::fromStdString(path.string())));
            },
        .fail =
            [this](const QString& message) {
                panel_->showReportProgress(1);
                messages_.showMessage(MessageKind::error, message);
            },
    });
}

void EvaluationDocks::tellChange(const std::shared_ptr<const RunEvaluation>& before) {
    const auto& now = evaluation_->evaluation();
    if (!correcting_ || !before || !now || before == now || before->run.id != now->run.id) return;
    if (now->shown.detection.overlap_sum == before->shown.detection.overlap_sum &&
        now->errors.size() == before->errors.size())
        return;
    const int errors = static_cast<int>(now->errors.size()) - static_cast<int>(before->errors.size());
    errors_->setStatus(
        tr("<b>Scored again:</b> f-score %1 → %2, %3 errors (%4%5)")
            .arg(numberText(before->shown.detection.f_score, 4), numberText(now->shown.detection.f_score, 4))
            .arg(now->errors.size())
            .arg(errors > 0 ? QStringLiteral("+") : QString())
            .arg(errors));
}

}  // namespace eyrie::ui

#include "moc_evaluation_docks.cpp"
