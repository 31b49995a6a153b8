#pragma once

#include <functional>
#include <utility>

#include "label/lists/objects_model.h"
#include "widgets/tables/table_panel.h"

class QComboBox;
class QDoubleSpinBox;
class QProgressBar;
class QToolButton;

namespace eyrie::ui {

/// What the list of objects does with one of them.
struct ObjectListCommands {
    std::function<void(int object)> select = [](int) {};
    /// Its first frame is wanted, or the last where that was clicked.
    std::function<void(int object, int frame)> go_to = [](int, int) {};
};

/// The labelled objects: clicking one goes to it. Filters by class, state, length of life, speed and by what lives in
/// the frame shown; below, how much is checked.
class ObjectsPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit ObjectsPanel(ObjectsModel* model, QWidget* parent = nullptr);
    void setCommands(ObjectListCommands commands) { commands_ = std::move(commands); }

    /// Says why the list is empty, and what to do.
    void explainNothing(bool with_video);
    /// Classes to filter by.
    void setClasses(const QStringList& classes);
    void setFrame(FrameIndex frame);
    void setCheckedShare(double share, int objects);
    /// Only objects of the frame shown.
    void setThisFrameOnly(bool only);

 protected:
    void rowSelected(int object) override { commands_.select(object); }
    void rowClicked(int object, int column) override { activate(object, column); }
    void rowDoubleClicked(int object) override { activate(object, ObjectsModel::first_column); }
    void fillMenu(QMenu& menu, int object) override;

 private:
    void showSpeedUnit();
    void refilter();
    bool passes(const ObjectRow& row) const;
    void activate(int object, int column);

    ObjectsModel* objects_;
    ObjectListCommands commands_;
    QComboBox* class_;
    QComboBox* state_;
    QToolButton* this_frame_;
    QDoubleSpinBox* shortest_;
    QDoubleSpinBox* slowest_;
    QProgressBar* coverage_;
    FrameIndex frame_ = 0;
};

}  // namespace eyrie::ui
