#pragma once

#include <QObject>
#include <set>

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Which kinds of overlay are shown, and with what: what each workspace keeps for itself.
struct OverlayProfile {
    std::set<OverlayKind> visible;
    OverlayDetail detail;

    void set(OverlayKind kind, bool shown);
    bool operator==(const OverlayProfile&) const = default;
};

/// Which overlays are shown and how. One object for the whole window; canvas, menu and settings meet here.
class OverlaySettings : public QObject {
    Q_OBJECT

 public:
    /// Shows what tuning the chain shows at first.
    explicit OverlaySettings(QObject* parent = nullptr);

    bool isVisible(OverlayKind kind) const { return visible_.contains(kind); }
    void setVisible(OverlayKind kind, bool visible);
    OverlayProfile profile() const { return {visible_, style_.detail}; }
    /// Ends the hiding of all.
    void setProfile(const OverlayProfile& profile);

    /// Hides all for the moment; which of them are shown otherwise stays as it is. Switching one on or off ends it and
    /// shows that one.
    void setHidden(bool hidden);
    bool hidden() const { return hidden_; }
    /// Whether a kind is drawn now.
    bool isDrawn(OverlayKind kind) const { return !hidden_ && isVisible(kind); }

    const OverlayStyle& style() const { return style_; }
    PaletteKind palette() const { return style_.palette; }
    void setPalette(PaletteKind palette);
    /// A factor that is shorter or longer than vectors can be drawn becomes the nearest one.
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

    std::set<OverlayKind> visible_;
    bool hidden_ = false;
    OverlayStyle style_;
};

}  // namespace eyrie::ui
