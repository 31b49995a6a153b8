#pragma once

#include <QObject>
#include <vector>

#include "annotation/pictures/object_stack.h"
#include "core/labels/annotation.h"
#include "label/label_parts.h"
#include "widgets/delayed_call.h"

class QStackedWidget;

namespace eyrie::ui {

class ChipGrid;
class LabelChips;
class LabelStacks;
struct LabelChip;

/// What the selected object looks like: cut out over time in a dock of its own, and stacked in the loupe.
class ObjectPictures : public QObject {
    Q_OBJECT

 public:
    ObjectPictures(const LabelParts& parts, QObject* parent);

    ChipGrid& chips() { return *grid_; }
    /// Cuts the object out anew, once the hand rests.
    void showChipsSoon() { chips_due_.start(); }

 private:
    void wireChips();
    void wireStacks();
    void showChips();
    void takeChips(ObjectId id, const std::vector<LabelChip>& chips);
    void showStack();
    void takeStack(ObjectId id, const ObjectStack& stack);

    LabelParts parts_;
    LabelChips* chips_;
    LabelStacks* stacks_;
    QStackedWidget* pages_ = nullptr;  ///< why there is nothing, then the grid
    ChipGrid* grid_;
    DelayedCall chips_due_;
    bool chips_looked_at_ = false;
};

}  // namespace eyrie::ui
