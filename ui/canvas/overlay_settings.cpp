#include "canvas/overlay_settings.h"

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
    for (const OverlayRow& row : overlayTable()) profile_.set(row.kind, row.in_tune);
}

template <class Value>
void OverlaySettings::adopt(Value& field, Value value) {
    if (field == value) return;
    field = value;
    emit changed();
}

void OverlaySettings::setVisible(OverlayKind kind, bool visible) {
    OverlayProfile profile = profile_;
    profile.set(kind, visible || hidden_);
    setProfile(profile);
}

void OverlaySettings::setProfile(const OverlayProfile& profile) {
    if (!std::exchange(hidden_, false)) return adopt(profile_, profile);
    profile_ = profile;
    emit changed();
}

void OverlaySettings::setHidden(bool hidden) {
    adopt(hidden_, hidden);
}

void OverlaySettings::setPalette(PaletteKind palette) {
    style_.colours = overlayColours(palette);
    style_.palette = palette;
    adopt(palette_, palette);
}

void OverlaySettings::setVectorLengthFactor(double factor) {
    adopt(style_.vector_length_factor, factor);
}

void OverlaySettings::setLabels(bool shown) {
    adopt(style_.labels, shown);
}

void OverlaySettings::setTrails(bool shown) {
    adopt(style_.trails, shown);
}

void OverlaySettings::setRejectedDetections(bool shown) {
    adopt(style_.rejected_detections, shown);
}

void OverlaySettings::setTentativeTracks(bool shown) {
    adopt(style_.tentative_tracks, shown);
}

void OverlaySettings::setMinScore(double score) {
    adopt(style_.min_score, score);
}

}  // namespace eyrie::ui
