#include "review/earth/ground_control.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QInputDialog>
#include <algorithm>
#include <utility>

#include "canvas/video_view.h"
#include "core/geometry/place_text.h"
#include "review/earth/control_point_tool.h"
#include "review/earth/control_points_model.h"
#include "review/earth/control_points_panel.h"
#include "review/earth/video_earth.h"
#include "session/project_session.h"
#include "store/labels/annotation_store.h"
#include "store/review/control_points.h"
#include "widgets/display_text.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/session_reactions.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

const QString kControlTopic = QStringLiteral("ground control");

QString noPlaceText(const QString& text) {
    return QObject::tr("“%1” is not a place: enter latitude and longitude in degrees, such as 48.137154, 11.576124.")
        .arg(text);
}

std::optional<QString> askForPlace(const QString& text, const QString& why) {
    bool accepted = false;
    const QString question = QObject::tr(
        "Latitude and longitude of the place, as a map gives them\n(48.137154, 11.576124 or 48°08'13.8\"N "
        "11°34'34\"E):");
    const QString written = QInputDialog::getText(QApplication::activeWindow(), QObject::tr("Ground control point"),
                                                  why.isEmpty() ? question : why + QLatin1String("\n\n") + question,
                                                  QLineEdit::Normal, text, &accepted);
    return accepted ? std::optional(written.trimmed()) : std::nullopt;
}

/// What was copied from a map, if it is a place.
QString copiedPlace() {
    const QString text = QApplication::clipboard()->text().trimmed();
    return placeOfText(text.toStdString()) ? text : QString();
}

}  // namespace

GroundControl::GroundControl(const GroundControlParts& parts, QObject* parent)
    : QObject(parent),
      parts_(parts),
      model_(new ControlPointsModel(this)),
      panel_(new ControlPointsPanel(model_, parts.actions)),
      tool_(new ControlPointTool(parts.canvas, this)),
      ask_(askForPlace) {
    bindCommands();
    followSession(parts_.session, this,
                  {{{SessionChange::video, SessionChange::project}, [this] { forget(); }},
                   {SessionChange::opened, [this] { enableActions(); }}});
    whenAny(&parts_.earth, this, &GroundControl::adoptStored, &VideoEarth::changed);
    whenAny(&parts_.canvas, this, &GroundControl::showMarks, &VideoView::frameGiven);
    connect(model_, &ControlPointsModel::placeEdited, this, &GroundControl::editPlace);
    forget();
}

GroundControl::~GroundControl() = default;

void GroundControl::bindCommands() {
    const WindowActions& actions = parts_.actions;
    eyrie::ui::bindCommands(this, {{actions.control_points,
                                    [this](bool on) {
                                        parts_.session.playback().pause();
                                        on ? tool_->start() : tool_->end();
                                    }},
                                   {actions.draw_zone, [this] { tool_->end(); }},
                                   {actions.draw_line, [this] { tool_->end(); }},
                                   {actions.draw_arrow, [this] { tool_->end(); }},
                                   {actions.deselect, [this] { tool_->end(); }}});
    whenAny(
        tool_, this,
        [this] {
            parts_.actions.control_points->setChecked(tool_->active());
            parts_.messages.dismissTopic(kControlTopic);
        },
        &ControlPointTool::activeChanged);
    tool_->setCommands({.add = [this](QPointF px) { add(px); },
                        .move = [this](int number, QPointF px) { move(number, px); },
                        .undo = [this] { undo(); },
                        .redo = [this] { redo(); }});
    panel_->setCommands({.go_to = [this](int number) { goTo(number); },
                         .remove = [this](const std::vector<int>& numbers) { remove(numbers); },
                         .undo = [this] { undo(); },
                         .redo = [this] { redo(); }});
}

void GroundControl::setActive(bool active) {
    active_ = active;
    enableActions();
}

void GroundControl::enableActions() {
    // What a person says is kept in the project, which has to be there.
    const bool possible = active_ && parts_.session.video() && !parts_.session.project().empty();
    if (!possible) tool_->end();
    parts_.actions.control_points->setEnabled(possible);
}

void GroundControl::forget() {
    undo_.clear();
    redo_.clear();
    points_.clear();
    outdated_.reset();
    tool_->end();
    enableActions();
    showPoints();
}

void GroundControl::adoptStored() {
    const std::vector<ControlPoint>& known = parts_.earth.control();
    if (outdated_ != known) outdated_.reset();
    if (writing_ == 0 && !outdated_ && points_ != known) {
        points_ = known;
        // Another program's version is not what the steps lead back from.
        undo_.clear();
        redo_.clear();
    }
    showPoints();
}

// ---- changing -------------------------------------------------------------------------------------------------------

void GroundControl::add(QPointF px) {
    const FrameIndex frame = parts_.canvas.frame().index;
    tool_->setDraft(px);
    QString text = copiedPlace(), why;
    std::optional<GeoPoint> place;
    while (!place) {
        const auto written = ask_(text, why);
        if (!written) break;
        text = *written;
        place = placeOfText(text.toStdString());
        why = noPlaceText(text);
    }
    tool_->setDraft(std::nullopt);
    if (!place) return;
    std::vector<ControlPoint> after = points_;
    after.push_back({frame, {px.x(), px.y()}, *place});
    change(std::move(after));
}

void GroundControl::move(int number, QPointF px) {
    std::vector<ControlPoint> after = points_;
    const auto index = static_cast<std::size_t>(number - 1);
    if (number < 1 || index >= after.size()) return;
    after[index].px = {px.x(), px.y()};
    change(std::move(after));
}

void GroundControl::editPlace(int number, const QString& text) {
    std::vector<ControlPoint> after = points_;
    const auto index = static_cast<std::size_t>(number - 1);
    if (number < 1 || index >= after.size()) return;
    const auto place = placeOfText(text.toStdString());
    if (!place) {
        parts_.messages.showTopic(kControlTopic, MessageKind::warning, noPlaceText(text));
        return;
    }
    after[index].place = *place;
    change(std::move(after));
}

void GroundControl::remove(const std::vector<int>& numbers) {
    std::vector<ControlPoint> after;
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (std::find(numbers.begin(), numbers.end(), static_cast<int>(i) + 1) == numbers.end())
            after.push_back(points_[i]);
    change(std::move(after));
}

void GroundControl::change(std::vector<ControlPoint> after) {
    if (after == points_) return;
    undo_.push_back(points_);
    redo_.clear();
    store(std::move(after));
}

void GroundControl::undo() {
    if (undo_.empty()) return;
    redo_.push_back(points_);
    std::vector<ControlPoint> after = std::move(undo_.back());
    undo_.pop_back();
    store(std::move(after));
}

void GroundControl::redo() {
    if (redo_.empty()) return;
    undo_.push_back(points_);
    std::vector<ControlPoint> after = std::move(redo_.back());
    redo_.pop_back();
    store(std::move(after));
}

void GroundControl::store(std::vector<ControlPoint> after) {
    if (!parts_.session.video() || !parts_.session.media()) return;
    parts_.messages.dismissTopic(kControlTopic);
    const std::vector<ControlPoint> before = std::exchange(points_, after);
    ++writing_;
    showPoints();
    const auto settle = [this, project = parts_.session.project()](const QString& problem) {
        --writing_;
        outdated_.reset();
        if (problem.isEmpty()) {
            outdated_ = parts_.earth.control();
        } else {
            undo_.clear();
            redo_.clear();
            parts_.messages.showTopic(kControlTopic, MessageKind::error, problem);
        }
        if (project == parts_.session.project()) parts_.earth.layOnEarth();
    };
    query_.write(
        [project_path = parts_.session.project(), sequence = parts_.session.sequenceToStore(), before,
         after = std::move(after), settle](const BackgroundTask& task) {
            ProjectFile project = ProjectFile::open(project_path);
            const bool stored = exchangeControlPoints(project, ensureSequence(project, sequence), before, after);
            task.tell([settle, stored] {
                settle(stored ? QString()
                              : tr("The control points were changed by another program in the meantime; its version is "
                                   "shown now, and your change was not made."));
            });
        },
        settle);
}

// ---- showing --------------------------------------------------------------------------------------------------------

void GroundControl::goTo(int number) {
    const auto index = static_cast<std::size_t>(number - 1);
    if (number < 1 || index >= points_.size()) return;
    parts_.session.playback().pause();
    parts_.session.goToFrame(points_[index].frame);
    if (!parts_.canvas.transform().fitted()) parts_.canvas.centreOn(QPointF(points_[index].px.x, points_[index].px.y));
}

void GroundControl::showPoints() {
    std::vector<ControlPointRow> rows;
    for (std::size_t i = 0; i < points_.size(); ++i)
        rows.push_back({static_cast<int>(i) + 1, points_[i], std::nullopt, false});
    // A fit of other points says nothing of these.
    if (const VideoWorld* world = parts_.earth.world(); world != nullptr && parts_.earth.control() == points_) {
        for (const ControlFit& fit : world->places.controlFits()) {
            for (const ControlResidual& residual : fit.residuals) rows.at(residual.point).off_m = residual.metres;
            if (fit.suspect) rows.at(*fit.suspect).suspect = true;
        }
    }
    model_->setRows(std::move(rows));
    panel_->enableUndo(!undo_.empty(), !redo_.empty());
    showState();
    showMarks();
}

void GroundControl::showState() {
    if (points_.empty()) {
        panel_->setState(tr("Ground control by hand: find at least four places that a map also shows, not on one line "
                            "and near the corners of the picture. It takes precedence over the metadata."),
                         false);
        return;
    }
    const VideoWorld* world = parts_.earth.world();
    if (world == nullptr || parts_.earth.control() != points_) {
        panel_->setState(tr("Working out the places…"), false);
        return;
    }
    QStringList lines;
    for (const std::string& remark : world->control_remarks)
        lines << capitalised(QString::fromStdString(remark)) + QLatin1Char('.');
    const bool doubtful = !lines.isEmpty();
    if (world->places.isByHand()) {
        const FrameIndex frame = world->places.controlFits().front().frame;
        const auto gsd = world->places.gsdOf(frame), course = world->places.courseOf(frame);
        QString text = capitalised(QString::fromStdString(world->places.origin())) + QLatin1Char('.');
        if (gsd && course)
            text += tr(" In frame %1 a pixel is %2 m, and the picture's top points to %3°.")
                        .arg(frame)
                        .arg(numberText(*gsd, 3), numberText(*course, 1));
        if (points_.size() == 4) text += tr(" Four points always fit; a fifth tells how well.");
        lines << text;
    }
    panel_->setState(lines.join(QLatin1Char('\n')), doubtful);
}

void GroundControl::showMarks() {
    const FrameIndex frame = parts_.canvas.frame().index;
    std::vector<ControlPointMark> marks;
    for (int row = 0; row < model_->rowCount(); ++row) {
        const ControlPointRow& entry = *model_->recordAt(row);
        const auto px = parts_.earth.carried({entry.point.px.x, entry.point.px.y}, entry.point.frame, frame);
        if (px) marks.push_back({entry.id, *px, entry.point.frame == frame, entry.suspect});
    }
    tool_->setMarks(std::move(marks));
}

}  // namespace eyrie::ui

#include "moc_ground_control.cpp"
