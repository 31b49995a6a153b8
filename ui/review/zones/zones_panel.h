#pragma once

#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "core/review/zone.h"

class QColor;
class QComboBox;
class QLabel;
class QMenu;
class QTableView;
class QToolButton;

namespace eyrie::ui {

class WindowActions;
class ZonesModel;

/// What the list of zones asks for.
struct ZonesPanelCommands {
    std::function<void(const std::vector<int>& ids)> remove = [](const auto&) {};
    /// Nothing: the colour by number.
    std::function<void(int id, std::optional<QColor> colour)> set_colour = [](int, std::optional<QColor>) {};
    std::function<void(int id)> move_points = [](int) {};
    std::function<void(int id, ZoneAnchor anchor)> set_anchor = [](int, ZoneAnchor) {};
    std::function<void(const QString& path)> read_file = [](const QString&) {};
    std::function<void(const QString& path)> write_file = [](const QString&) {};
    /// Another row is selected; 0: none.
    std::function<void(int id)> select = [](int) {};
};

/// The zones of a video: list, what is drawn next, and what is done with those selected. Small, to stand below the list
/// of events.
class ZonesPanel : public QWidget {
    Q_OBJECT

 public:
    /// `model` and `actions` must outlive the panel.
    ZonesPanel(ZonesModel* model, const WindowActions& actions, QWidget* parent = nullptr);

    void setCommands(ZonesPanelCommands commands) { commands_ = std::move(commands); }
    QTableView* table() const { return table_; }
    /// What zones are fixed to that are drawn from now on.
    ZoneAnchor anchor() const;
    void setAnchor(ZoneAnchor anchor);
    int currentId() const;
    std::vector<int> selectedIds() const;
    void selectId(int id);
    /// Starts writing the name of a zone.
    void editName(int id);
    /// What there is to know where the list is empty; and whether anything may be drawn.
    void setHint(const QString& text);

 private:
    void buildButtons(const WindowActions& actions);
    void fillMenu(QMenu& menu);
    void enableButtons();
    void askForFile(bool reading);
    bool eventFilter(QObject* watched, QEvent* event) override;

    ZonesModel* model_;
    ZonesPanelCommands commands_;
    QTableView* table_;
    QLabel* hint_;
    QComboBox* anchor_;
    QToolButton* remove_ = nullptr;
    QToolButton* more_ = nullptr;
};

}  // namespace eyrie::ui
