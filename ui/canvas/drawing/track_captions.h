#pragma once

#include <QString>
#include <functional>

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Whether a track is drawn at all: sure enough, and not too new.
bool isShown(const TrackState& state, const OverlayStyle& style);
/// The same, but the selected one always is.
bool isShown(const TrackState& state, const OverlayScene& scene);

/// Hands over every track of a frame, the doubtful ones too, that is shown.
void visitShown(const OverlayScene& scene, const std::function<void(const TrackState&)>& visitor);

/// Writes a text beside the box of every track that is shown and has room for it.
void paintTrackCaptions(QPainter& painter, const OverlayScene& scene,
                        const std::function<QString(const TrackState&)>& text_of);

}  // namespace eyrie::ui
