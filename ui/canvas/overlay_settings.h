#pragma once

#include <QObject>
#include <array>

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Which overlays are shown and how. One object for the whole window; canvas, menu and settings meet here.
class OverlaySettings : public QObject {
    Q_OBJECT

 public:
    using QObject::QObject;

    bool isVisible(OverlayKind kind) const { return visible_[static_cast<size_t>(kind)]; }
    void setVisible(OverlayKind kind, bool visible);

    const OverlayStyle& style() const { return style_; }
    PaletteKind palette() const { return palette_; }
    void setPalette(PaletteKind palette);
    void setVectorLengthFactor(double factor);
    void setLabels(bool shown);
    void setTrails(bool shown);
    void setRejectedDetections(bool shown);
    void setTentativeTracks(bool shown);
    void setMinScore(double score);

 signals:
    void changed();

 private:
    template <class Value>
    void adopt(Value& field, Value value);

    std::array<bool, kOverlayKindCount> visible_{false, false, true, true, true, true, true, false, true};
    OverlayStyle style_;
    PaletteKind palette_ = PaletteKind::thesis;
};

}  // namespace eyrie::ui
