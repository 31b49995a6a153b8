#pragma once

#include <QObject>
#include <QTableView>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "canvas/overlay_settings.h"
#include "review/events/events_panel.h"
#include "ui/support/ui_support.h"
#include "workspace/window_actions.h"

namespace eyrie::ui::test {

inline Event happening(EventKind kind, TrackId track, FrameIndex frame) {
    Event event;
    event.kind = kind;
    event.tracks = {track};
    event.first_frame = event.frame = event.last_frame = frame;
    return event;
}

inline std::shared_ptr<const FoundEvents> found(std::vector<Event> events, int frames = 100, bool searched = true,
                                                const std::shared_ptr<const FoundEvents>& former = nullptr) {
    auto run = std::make_shared<StoredTracks>();
    if (searched) run->footage.camera = CameraMotion::standing(0, frames - 1);
    run->footage.image_size = {240, 180};
    run->footage.last_frame = frames - 1;
    run->footage.scale.frame_rate_hz = 25;
    return inOrder(run, {std::move(events), {}, {}}, {}, {}, former);
}

/// Six stops, a U-turn and a vehicle that was lost.
inline std::vector<Event> someEvents() {
    std::vector<Event> events;
    for (int i = 0; i < 6; ++i) events.push_back(happening(EventKind::stops, i + 1, 10 * i));
    events.push_back(happening(EventKind::turns_back, 7, 50));
    events.push_back(happening(EventKind::lost, 8, 80));
    return events;
}

/// What tests of the list of events need: a home of their own, the window's actions, and verdicts.
class ListedEvents : public QObject {
 protected:
    void begin() {
        home_ = std::make_unique<OwnHome>();
        overlays_ = std::make_unique<OverlaySettings>();
        window_ = std::make_unique<QWidget>();
        actions_ = std::make_unique<WindowActions>(*overlays_, window_.get());
        verdicts_.clear();
    }
    void end() {
        actions_.reset();
        window_.reset();
        overlays_.reset();
        home_.reset();
    }

    const Verdict* verdictAt(std::size_t position) const {
        const auto at = verdicts_.find(position);
        return at == verdicts_.end() ? nullptr : &at->second;
    }
    void give(EventsModel& model, const std::shared_ptr<const FoundEvents>& events) const {
        model.setEvents(events, [this](std::size_t position) { return verdictAt(position); });
    }
    void judge(EventsModel& model, std::size_t position, Judgement judgement) {
        verdicts_[position].judgement = judgement;
        model.setVerdict(position, verdictAt(position));
    }
    static QStringList kindsShown(const EventsPanel& panel) {
        QStringList kinds;
        const auto* shown = panel.table()->model();
        for (int row = 0; row < shown->rowCount(); ++row)
            kinds << shown->index(row, EventsModel::kind_column).data().toString();
        return kinds;
    }

    std::unique_ptr<WindowActions> actions_;
    std::map<std::size_t, Verdict> verdicts_;

 private:
    std::unique_ptr<OwnHome> home_;
    std::unique_ptr<OverlaySettings> overlays_;
    std::unique_ptr<QWidget> window_;
};

}  // namespace eyrie::ui::test
