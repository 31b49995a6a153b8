#pragma once

#include <QColor>
#include <QString>
#include <memory>
#include <vector>

#include "canvas/layers/overlay_layer.h"

namespace eyrie::ui {

/// Everything there is to say of an overlay besides how it is drawn. Keys, menu, legend, canvas and what each workspace
/// shows at first follow from it.
struct OverlayRow {
    OverlayKind kind;
    const char* name;  ///< to be translated: overlayName()
    Qt::Key key;       ///< with Alt
    bool in_review;    ///< whether it is shown when the workspace is opened for the first time
    bool in_label;
    bool in_tune;
    QColor (*colour)(const OverlayStyle&);
    std::unique_ptr<OverlayLayer> (*make)();
};

/// One row for each kind, in the order they are painted.
const std::vector<OverlayRow>& overlayTable();

/// With its mnemonic, for menus.
QString overlayName(const OverlayRow& row);

}  // namespace eyrie::ui
