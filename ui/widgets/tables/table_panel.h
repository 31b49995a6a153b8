#pragma once

#include <QHash>
#include <QList>
#include <QWidget>
#include <functional>
#include <optional>

#include "widgets/delayed_call.h"
#include "widgets/tables/table_sort_proxy.h"

class QHBoxLayout;
class QLineEdit;
class QMenu;
class QStackedLayout;
class QTableView;

namespace eyrie::ui {

class EmptyState;

/// A list in a dock: a line to filter by, a table that sorts, copies as text and remembers its columns, and an
/// explanation while it is empty. Rows are named by the number in `id_role`.
class TablePanel : public QWidget {
    Q_OBJECT
 public:
    /// `model` must outlive the panel. `settings_key` names the columns' memory in QSettings. `sort_column` is the one
    /// that it is sorted by at first; none: rows stand as in the model, and a third click on a header brings that back.
    TablePanel(QAbstractItemModel* model, const QString& settings_key, QWidget* parent = nullptr,
               std::optional<int> sort_column = 0);
    ~TablePanel() override;

    /// Id of the selected row, 0 when there is none.
    int currentId() const;
    /// Selects the row without telling anyone, and scrolls to it; 0 or a row that is filtered away: none.
    void selectId(int id);
    /// The selected rows, or all shown ones when none is selected, as tab-separated text with headers.
    QString selectedText() const;
    /// Does what brings other rows; where one has scrolled down, the row at the top stays there, if it is still shown.
    void keepPlace(const std::function<void()>& change);
    /// Ids of all selected rows, from top to bottom.
    QList<int> selectedIds() const;
    void setFilterText(const QString& text);

    QTableView* table() const { return table_; }
    EmptyState* emptyState() const { return empty_; }

 protected:
    TableSortProxy& proxy() { return *proxy_; }
    /// Moves a column to the right of another one.
    void placeBeside(int column, int beside);
    /// Columns that stand right of `beside` until a person moves them. For constructors.
    void placeAtFirst(const QList<int>& columns, int beside);
    /// Columns that are hidden, and stand right of `beside`, until a person shows or moves them. For constructors.
    void hideAtFirst(const QList<int>& columns, int beside);
    /// Place for buttons right of the filter line.
    QHBoxLayout* toolRow() const { return tool_row_; }
    /// The user selected another row.
    virtual void rowSelected(int /*id*/) {}
    /// The user clicked a row; `column` of the model.
    virtual void rowClicked(int /*id*/, int /*column*/) {}
    /// The user double-clicked a row or pressed Enter on it.
    virtual void rowDoubleClicked(int /*id*/) {}
    /// How many characters of a column of the model are shown at most; none: all. What is longer is in its tooltip.
    virtual std::optional<int> mostCharacters(int /*column*/) const { return std::nullopt; }
    /// Adds entries to the menu of a row.
    virtual void fillMenu(QMenu&, int /*id*/) {}
    /// What is said, and what the button beside it does, while there are rows but none is shown.
    virtual QString hiddenText() const;
    virtual void showHidden() {}
    /// Whether showHidden() helps.
    virtual bool canShowHidden() const { return false; }
    bool eventFilter(QObject* watched, QEvent* event) override;
    /// The row as it is shown now; −1 for none, or one that is filtered out. Quick in lists of thousands.
    int shownRowOf(int id) const;

 private:
    void buildTable(std::optional<int> sort_column);
    void restoreColumns();
    void saveColumns() const;
    void showHeaderMenu(const QPoint& place);
    /// Which columns are shown, and by which the rows are ordered: titles do not take the keyboard's focus.
    void fillColumns(QMenu& menu);
    void fillOrders(QMenu& menu);
    void showRowMenu(const QPoint& place);
    void showTableOrEmptyState();
    void keepSelection();
    /// From the filter line to the row that is selected, or the first one: letters are keys again there.
    void goToRows();
    void fitColumns();
    /// Columns whose width nobody chose grow with what they hold; none gets narrower.
    void widenColumns();
    void widenColumnsSoon();
    int neededWidth(int column) const;
    /// The whole text of a cell that shows only part of it, above what the model says of the row.
    bool showToolTip(const QPoint& place, const QPoint& global_place);
    int idOf(const QModelIndex& index) const;
    QList<int> shownColumns() const;

    QAbstractItemModel* model_;
    mutable QHash<int, int> rows_;  ///< of the model by id, as they were when one was looked for last
    QString settings_key_;
    TableSortProxy* proxy_;
    QLineEdit* filter_;
    QHBoxLayout* tool_row_;
    QTableView* table_;
    EmptyState* empty_;
    EmptyState* nothing_found_;
    QStackedLayout* stack_;
    QList<int> fitted_widths_;  ///< of a column with another width somebody chose it
    DelayedCall widening_due_;
    int all_columns_ = 0;         ///< of the model
    int known_columns_ = 0;       ///< that the memory tells of
    bool columns_fit_ = false;    ///< widths were remembered, or fitted to the first rows
    int kept_id_ = 0;             ///< selected by user or program; selected again when its row comes back
    bool selection_due_ = false;  ///< rows came or went while another filter was applied
    bool telling_ = true;         ///< false while the program selects
    int told_id_ = 0;             ///< the row that rowSelected() is being told of
};

}  // namespace eyrie::ui
