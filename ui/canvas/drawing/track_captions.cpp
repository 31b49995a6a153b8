#include "canvas/drawing/track_captions.h"

#include <QFontMetricsF>
#include <QPainter>
#include <algorithm>
#include <utility>
#include <vector>

#include "canvas/drawing/caption_placer.h"
#include "canvas/upright_in_view.h"

namespace eyrie::ui {

bool isShown(const TrackState& state, const OverlayStyle& style) {
    return (state.status != TrackStatus::tentative || style.detail.tentative_tracks) && state.score >= style.min_score;
}

bool isShown(const TrackState& state, const OverlayScene& scene) {
    return isShown(state, scene.style) || scene.selected_track == state.id;
}

void visitShown(const OverlayScene& scene, const std::function<void(const TrackState&)>& visitor) {
    for (const auto* states : {&scene.result.tracks, &scene.frame.doubtful})
        for (const TrackState& state : *states)
            if (isShown(state, scene)) visitor(state);
}

void paintTrackCaptions(QPainter& painter, const OverlayScene& scene,
                        const std::function<QString(const TrackState&)>& text_of) {
    struct Labelled {
        const TrackState* state;
        QRectF object;
    };
    std::vector<Labelled> labelled;
    std::vector<QRectF> objects;
    visitShown(scene, [&](const TrackState& state) {
        const QRectF object = uprightInView(state.box, scene.transform);
        if (!object.intersects(scene.view)) return;
        labelled.push_back({&state, object});
        objects.push_back(object);
    });
    // The order decides who is left out in a crowd: never the selected one, of the others what a person drew goes last,
    // and then the younger (higher) id, so that labels do not flicker from frame to frame.
    const auto rank = [&](const Labelled& l) {
        if (scene.selected_track == l.state->id) return 0;
        return l.state->origin == StateOrigin::by_hand ? 1 : 2;
    };
    std::stable_sort(labelled.begin(), labelled.end(),
                     [&](const Labelled& a, const Labelled& b) { return rank(a) < rank(b); });
    scene.captions.keepClearOf(std::move(objects));
    const QFontMetricsF metrics(painter.font());
    for (const Labelled& label : labelled) {
        const QString text = text_of(*label.state);
        const QSizeF size(metrics.horizontalAdvance(text) + 6, metrics.height());
        const auto rectangle = scene.captions.place(label.object, size);
        if (!rectangle) continue;
        const bool is_selected = scene.selected_track == label.state->id;
        painter.setPen(Qt::NoPen);
        painter.setBrush(is_selected ? scene.style.colours.selected_track : QColor(0, 0, 0, 165));
        painter.drawRoundedRect(*rectangle, 2.5, 2.5);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(is_selected ? QColor(0, 0, 0) : scene.style.colours.track);
        painter.drawText(*rectangle, Qt::AlignCenter, text);
    }
}

}  // namespace eyrie::ui
