#pragma once

#include "label/lists/objects_model.h"
#include "widgets/tables/table_panel.h"

class QComboBox;
class QDoubleSpinBox;
class QProgressBar;
class QToolButton;

namespace eyrie::ui {

/// The labelled objects: clicking one goes to it. Filters by class, state, length of life, speed and by what lives in
/// the frame shown; below, how much is checked.
class ObjectsPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit ObjectsPanel(ObjectsModel* model, QWidget* parent = nullptr);

    /// Classes to filter by.
    void setClasses(const QStringList& classes);
    void setFrame(FrameIndex frame);
    void setCheckedShare(double share, int objects);
    /// Only objects of the frame shown.
    void setThisFrameOnly(bool only);

 signals:
    void objectSelected(int object);
    /// The user wants to see an object: its first frame, or the last where that was clicked.
    void objectActivated(int object, int frame);

 protected:
    void fillMenu(QMenu& menu, int object) override;

 private:
    void refilter();
    bool passes(const ObjectRow& row) const;
    void activate(int object, int column);

    ObjectsModel* objects_;
    QComboBox* class_;
    QComboBox* state_;
    QToolButton* this_frame_;
    QDoubleSpinBox* shortest_;
    QDoubleSpinBox* slowest_;
    QProgressBar* coverage_;
    FrameIndex frame_ = 0;
};

}  // namespace eyrie::ui
