#pragma once

#include <QWidget>
#include <functional>
#include <vector>

class QLabel;
class QTableView;
class QToolButton;

namespace eyrie::ui {

class ControlPointsModel;
class WindowActions;

/// What the list of control points asks for. Points are named by their numbers.
struct ControlPointListCommands {
    std::function<void(int number)> go_to = [](int) {};
    std::function<void(const std::vector<int>& numbers)> remove = [](const auto&) {};
    std::function<void()> undo = [] {};
    std::function<void()> redo = [] {};
};

/// The control points of a video: list, buttons, and what they amount to. Small, to stand below the metadata.
class ControlPointsPanel : public QWidget {
    Q_OBJECT

 public:
    /// `model` and `actions` must outlive the panel.
    ControlPointsPanel(ControlPointsModel* model, const WindowActions& actions, QWidget* parent = nullptr);

    void setCommands(ControlPointListCommands commands) { commands_ = std::move(commands); }
    /// What the points amount to, or what is wrong with them.
    void setState(const QString& text, bool doubtful);
    QString state() const;
    void enableUndo(bool undo, bool redo);
    QTableView* table() const { return table_; }
    QToolButton* undoButton() const { return undo_; }
    QToolButton* redoButton() const { return redo_; }
    std::vector<int> selectedNumbers() const;

 private:
    void buildButtons(const WindowActions& actions);
    void showRows();
    bool eventFilter(QObject* watched, QEvent* event) override;

    ControlPointsModel* model_;
    ControlPointListCommands commands_;
    QTableView* table_;
    QLabel* state_;
    QToolButton* undo_ = nullptr;
    QToolButton* redo_ = nullptr;
    QToolButton* remove_ = nullptr;
};

}  // namespace eyrie::ui
