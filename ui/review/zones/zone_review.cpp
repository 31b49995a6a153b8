#include "review/zones/zone_review.h"

#include <map>
#include <utility>

#include "canvas/video_view.h"
#include "events/zones/zone_edits.h"
#include "events/zones/zone_file.h"
#include "review/events/event_review.h"
#include "review/zones/zone_colours.h"
#include "review/zones/zone_points_tool.h"
#include "review/zones/zone_tool.h"
#include "review/zones/zones_model.h"
#include "review/zones/zones_panel.h"
#include "widgets/display_text.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

const QString kZonesTopic = QStringLiteral("zones");

QString sentence(const QString& text) {
    return capitalised(text) + QLatin1Char('.');
}

}  // namespace

ZoneReview::ZoneReview(const ZoneParts& parts, QObject* parent)
    : QObject(parent),
      parts_(parts),
      model_(new ZonesModel(this)),
      panel_(new ZonesPanel(model_, parts.actions)),
      tool_(new ZoneTool(parts.canvas, this)),
      points_tool_(new ZonePointsTool(parts.canvas, this)) {
    points_tool_->setMoved([this](std::size_t point, cv::Point2d to) { movePoint(point, to); });
    tool_->setFinished([this](ZoneShape shape, const auto& points) { add(shape, points); });
    tool_->setRefused([this](const QString& why) {
        parts_.messages.showTopic(kZonesTopic, MessageKind::warning, tr("%1 Go on, or press Esc.").arg(sentence(why)));
    });
    connect(tool_, &ZoneTool::drawingChanged, this, [this] {
        parts_.actions.draw_zone->setChecked(tool_->shape() == ZoneShape::area);
        parts_.actions.draw_line->setChecked(tool_->shape() == ZoneShape::line);
        parts_.actions.draw_arrow->setChecked(tool_->shape() == ZoneShape::arrow);
        parts_.messages.dismissTopic(kZonesTopic);
    });
    connect(&parts_.canvas, &VideoView::frameGiven, this, [this] {
        carryDrawing();
        showMarks();
    });
    connect(model_, &ZonesModel::renamed, this, [this](int id, const QString& name) {
        parts_.review.changeZones([&](const ReviewSet& set, const Judge& judge, const NewId&) {
            return changeZone(
                set, id, [&](StoredZone& zone) { zone.zone.name = name.toStdString(); }, judge);
        });
    });
    connect(model_, &ZonesModel::shownChanged, this, [this](int id, bool shown) {
        parts_.review.changeZones([&](const ReviewSet& set, const Judge& judge, const NewId&) {
            return changeZone(
                set, id, [&](StoredZone& zone) { zone.shown = shown; }, judge);
        });
    });
    // A file that is still being read was meant for the video and the project before.
    whenChanged(parts_.session, this, {{{SessionChange::video, SessionChange::project}, [this] { files_.cancel(); }}});
    bindCommands();
    showZones();
}

ZoneReview::~ZoneReview() {
    files_.cancel();
    files_.finishPosted();
}

void ZoneReview::bindCommands() {
    const WindowActions& actions = parts_.actions;
    // Switched by a person only: the tool switches them, too.
    eyrie::ui::bindCommands(this, {
                                      {actions.draw_zone, [this](bool on) { startDrawing(ZoneShape::area, on); }},
                                      {actions.draw_line, [this](bool on) { startDrawing(ZoneShape::line, on); }},
                                      {actions.draw_arrow, [this](bool on) { startDrawing(ZoneShape::arrow, on); }},
                                      {actions.deselect,
                                       [this] {
                                           tool_->cancel();
                                           points_tool_->end();
                                       }},
                                  });
    panel_->setCommands({
        .remove =
            [this](const std::vector<int>& ids) {
                parts_.review.changeZones(
                    [&](const ReviewSet& set, const Judge&, const NewId&) { return removeZones(set, ids); });
            },
        .set_colour =
            [this](int id, std::optional<QColor> colour) {
                parts_.review.changeZones([&](const ReviewSet& set, const Judge& judge, const NewId&) {
                    return changeZone(
                        set, id,
                        [&](StoredZone& zone) {
                            zone.colour =
                                colour ? static_cast<int>(colour->rgb() & 0xffffff) : StoredZone::kColourByNumber;
                        },
                        judge);
                });
            },
        .move_points = [this](int id) { startMoving(id); },
        .set_anchor = [this](int id, ZoneAnchor anchor) { setAnchor(id, anchor); },
        .read_file = [this](const QString& path) { readFile(path); },
        .write_file = [this](const QString& path) { writeFile(path); },
        .select = [this](int) { showMarks(); },
    });
}

void ZoneReview::setActive(bool active) {
    active_ = active;
    if (!active) {
        tool_->cancel();
        points_tool_->end();
    }
    enableActions();
    showMarks();
}

// ---- drawing --------------------------------------------------------------------------------------------------------

void ZoneReview::startDrawing(ZoneShape shape, bool wanted) {
    if (!wanted) {
        tool_->cancel();
        return;
    }
    tool_->cancel();
    points_tool_->end();
    emit listWanted();
    parts_.session.playback().pause();
    drawn_in_ = parts_.canvas.frame().index;
    tool_->start(shape);
}

void ZoneReview::carryDrawing() {
    const int frame = parts_.canvas.frame().index;
    if (!tool_->drawing() || frame == drawn_in_) return;
    const int from = std::exchange(drawn_in_, frame);
    if (panel_->anchor() == ZoneAnchor::image) return;
    if (auto points = carried(tool_->points(), from, frame)) tool_->movePoints(std::move(*points));
}

void ZoneReview::add(ZoneShape shape, const std::vector<cv::Point2d>& points) {
    int id = 0;
    const bool added = parts_.review.changeZones([&](const ReviewSet& set, const Judge& judge, const NewId& new_id) {
        Zone zone;
        zone.name = newZoneName(set, shape);
        zone.shape = shape;
        zone.anchor = panel_->anchor();
        zone.frame = zone.anchor == ZoneAnchor::ground ? drawn_in_ : 0;
        zone.points = points;
        ReviewEdit edit = addZones(set, {zone}, judge, new_id);
        if (!edit.zones.empty()) id = edit.zones.front().after->id;
        return edit;
    });
    if (added) panel_->editName(id);
}

void ZoneReview::setAnchor(int id, ZoneAnchor anchor) {
    const int frame = parts_.canvas.frame().index;
    const auto stored = parts_.review.zones().find(id);
    if (stored == parts_.review.zones().end() || stored->second.zone.anchor == anchor) return;
    const Zone& zone = stored->second.zone;
    const auto points = inFrameShown(zone);
    if (!points) return tellUnconnected(zone);
    parts_.review.changeZones([&](const ReviewSet& set, const Judge& judge, const NewId&) {
        return changeZone(
            set, id,
            [&](StoredZone& changed) {
                changed.zone.anchor = anchor;
                changed.zone.points = *points;
                changed.zone.frame = anchor == ZoneAnchor::ground ? frame : 0;
            },
            judge);
    });
}

void ZoneReview::tellUnconnected(const Zone& zone) {
    parts_.messages.showTopic(kZonesTopic, MessageKind::warning,
                              tr("The ground of this frame is not connected with that of frame %1, where the zone was "
                                 "drawn; go to a frame that shows it.")
                                  .arg(zone.frame));
}

// ---- moving points --------------------------------------------------------------------------------------------------

void ZoneReview::startMoving(int id) {
    const auto stored = parts_.review.zones().find(id);
    if (stored == parts_.review.zones().end() || !mayRead()) return;
    tool_->cancel();
    parts_.session.playback().pause();
    const Zone& zone = stored->second.zone;
    const auto points = inFrameShown(zone);
    if (!points) return tellUnconnected(zone);
    // What else is done on the canvas ends, or its keys would stay its own.
    const WindowActions& actions = parts_.actions;
    for (QAction* other : {actions.measure, actions.control_points, actions.add_track})
        if (other->isChecked()) other->trigger();
    moved_zone_ = id;
    points_tool_->start(*points, zone.shape == ZoneShape::area);
}

void ZoneReview::movePoint(std::size_t point, cv::Point2d to) {
    const auto stored = parts_.review.zones().find(moved_zone_);
    if (stored == parts_.review.zones().end() || point >= stored->second.zone.points.size()) return;
    // The others stay as they were drawn, where they were.
    const Zone& zone = stored->second.zone;
    const int frame = parts_.canvas.frame().index;
    const auto there =
        zone.anchor == ZoneAnchor::image ? std::optional(std::vector{to}) : carried({to}, frame, zone.frame);
    if (!there) return tellUnconnected(zone);
    parts_.review.changeZones([&](const ReviewSet& set, const Judge& judge, const NewId&) {
        return changeZone(
            set, moved_zone_, [&](StoredZone& changed) { changed.zone.points[point] = there->front(); }, judge);
    });
    followMoving();  // also where the change was refused
}

void ZoneReview::followMoving() {
    if (!points_tool_->active()) return;
    const auto stored = parts_.review.zones().find(moved_zone_);
    auto points = stored != parts_.review.zones().end() ? inFrameShown(stored->second.zone) : std::nullopt;
    if (points)
        points_tool_->setPoints(std::move(*points));
    else
        points_tool_->end();
}

// ---- files ----------------------------------------------------------------------------------------------------------

bool ZoneReview::mayRead() {
    if (!parts_.review.canMark()) parts_.messages.showTopic(kZonesTopic, MessageKind::warning, hintText());
    return parts_.review.canMark();
}

void ZoneReview::readFile(const QString& path) {
    if (!mayRead()) return;
    const auto work = [this, path](const BackgroundTask& task) {
        const std::vector<Zone> zones = readZones(path.toStdString());
        task.tell([this, path, zones] { takeFrom(path, zones); });
    };
    files_.ask(work, [this](const QString& fault) { tellFault(fault); });
}

void ZoneReview::takeFrom(const QString& path, const std::vector<Zone>& zones) {
    if (!mayRead()) return;  // another run may have been begun meanwhile
    std::optional<std::size_t> fresh;
    const bool added = parts_.review.changeZones([&](const ReviewSet& set, const Judge& judge, const NewId& new_id) {
        ReviewEdit edit = addZones(set, zones, judge, new_id);
        fresh = edit.zones.size();
        return edit;
    });
    if (!fresh || (!added && *fresh > 0)) return;  // why is told
    const QString text = zones.empty()            ? tr("%1 has no zones.")
                         : *fresh == 0            ? tr("All zones of %1 are here already.")
                         : *fresh == zones.size() ? tr("Imported the zones of %1.")
                                                  : tr("Imported the zones of %1 that were not here yet.");
    parts_.messages.showTopic(kZonesTopic, MessageKind::info, text.arg(path));
}

void ZoneReview::writeFile(const QString& path) {
    const auto work = [this, path, zones = zonesOf(parts_.review.zones())](const BackgroundTask& task) {
        writeZones(path.toStdString(), zones);
        task.tell([this, path] {
            parts_.messages.showTopic(kZonesTopic, MessageKind::info,
                                      tr("Wrote %1. On the command line: --zone %1").arg(path));
        });
    };
    files_.write(work, [this](const QString& fault) { tellFault(fault); });
}

void ZoneReview::tellFault(const QString& fault) {
    parts_.messages.showTopic(kZonesTopic, MessageKind::error, fault);
}

// ---- showing --------------------------------------------------------------------------------------------------------

void ZoneReview::showZones() {
    std::map<std::string, int> events;
    if (const auto& found = parts_.review.found())
        for (const Event& event : found->events)
            if (!event.zone.empty()) ++events[event.zone];
    model_->setZones(parts_.review.zones(), events);
    panel_->setHint(hintText());
    enableActions();
    showMarks();
}

QString ZoneReview::hintText() const {
    if (!parts_.review.canMark())
        return tr("Zones, lines and arrows are drawn over a finished run, which knows how the ground moves.");
    return tr(
        "Draw an area or a line, and the list shows which vehicles enter, leave or cross it; an arrow along a lane "
        "says which way is right there. All are kept in the project, and the command line watches them, too.");
}

void ZoneReview::enableActions() {
    const bool possible = active_ && parts_.review.canMark();
    if (!possible) {
        tool_->cancel();
        points_tool_->end();
    }
    parts_.actions.draw_zone->setEnabled(possible);
    parts_.actions.draw_line->setEnabled(possible);
    parts_.actions.draw_arrow->setEnabled(possible);
}

std::optional<std::vector<cv::Point2d>> ZoneReview::carried(const std::vector<cv::Point2d>& points, int from,
                                                            int to) const {
    if (from == to) return points;
    const auto& tracks = parts_.review.tracks();
    if (!tracks) return std::nullopt;
    const auto map = tracks->footage.camera.map(from, to);
    if (!map) return std::nullopt;
    std::vector<cv::Point2d> there;
    for (const cv::Point2d& point : points) {
        const cv::Vec3d at = map->matrix * cv::Vec3d(point.x, point.y, 1);
        if (!(at[2] * map->matrix(2, 2) > 0)) return std::nullopt;  // behind the camera
        there.emplace_back(at[0] / at[2], at[1] / at[2]);
    }
    return there;
}

std::optional<std::vector<cv::Point2d>> ZoneReview::inFrameShown(const Zone& zone) const {
    if (zone.anchor == ZoneAnchor::image) return zone.points;
    return carried(zone.points, zone.frame, parts_.canvas.frame().index);
}

void ZoneReview::showMarks() {
    const int frame = parts_.canvas.frame().index;
    std::vector<ZoneMark> marks;
    const int selected = panel_->currentId();
    for (const auto& [id, stored] : parts_.review.zones()) {
        if (!stored.shown) continue;
        const Zone& zone = stored.zone;
        const auto points = inFrameShown(zone);
        if (!points) continue;
        ZoneMark mark;
        mark.name = QString::fromStdString(zone.name);
        for (const cv::Point2d& point : *points) mark.points.emplace_back(point.x, point.y);
        mark.closed = zone.shape == ZoneShape::area;
        mark.right_way = zone.shape == ZoneShape::arrow;
        mark.colour = colourOf(stored);
        mark.selected = id == selected;
        marks.push_back(std::move(mark));
    }
    parts_.canvas.setZones(frame, std::move(marks));
    followMoving();
}

}  // namespace eyrie::ui

#include "moc_zone_review.cpp"
