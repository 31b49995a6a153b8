#include "canvas/overlay_settings.h"

#include <algorithm>
#include <utility>

#include "canvas/layers/overlay_table.h"

namespace eyrie::ui {

void OverlayProfile::set(OverlayKind kind, bool shown) {
    if (shown)
        visible.insert(kind);
    else
        visible.erase(kind);
}

OverlaySettings::OverlaySettings(QObject* parent) : QObject(parent) {
    for (const OverlayRow& row : overlayTable())
        if (row.in_tune) visible_.insert(row.kind);
}

template <class Value>
void OverlaySettings::adopt(Value& field, Value value) {
    if (field == value) return;
    field = value;
    emit changed();
}

void OverlaySettings::setVisible(OverlayKind kind, bool visible) {
    OverlayProfile changed_one = profile();
    changed_one.set(kind, visible || hidden_);
    setProfile(changed_one);
}

void OverlaySettings::setProfile(const OverlayProfile& profile) {
    const bool was_hidden = std::exchange(hidden_, false);
    if (!was_hidden && profile == this->profile()) return;
    visible_ = profile.visible;
    style_.detail = profile.detail;
    emit changed();
}

void OverlaySettings::setHidden(bool hidden) {
    adopt(hidden_, hidden);
}

void OverlaySettings::setPalette(PaletteKind palette) {
    style_.colours = overlayColours(palette);
    adopt(style_.palette, palette);
}

void OverlaySettings::setVectorLengthFactor(double factor) {
    adopt(style_.detail.vector_length_factor, std::clamp(factor, kShortestVectors, kLongestVectors));
}

void OverlaySettings::setLabels(bool shown) {
    adopt(style_.detail.labels, shown);
}

void OverlaySettings::setTrails(bool shown) {
    adopt(style_.detail.trails, shown);
}

void OverlaySettings::setRejectedDetections(bool shown) {
    adopt(style_.detail.rejected_detections, shown);
}

void OverlaySettings::setTentativeTracks(bool shown) {
    adopt(style_.detail.tentative_tracks, shown);
}

void OverlaySettings::setMinScore(double score) {
    adopt(style_.min_score, score);
}

}  // namespace eyrie::ui

#include "moc_overlay_settings.cpp"
