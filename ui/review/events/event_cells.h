#pragma once

#include <QStyledItemDelegate>

namespace eyrie::ui {

/// How cells of the list of events are painted and written in.
class EventCells : public QStyledItemDelegate {
    Q_OBJECT

 public:
    using QStyledItemDelegate::QStyledItemDelegate;

    /// A line as wide as a note needs, within what is seen of the list, however narrow the column is.
    void updateEditorGeometry(QWidget* editor, const QStyleOptionViewItem& option,
                              const QModelIndex& index) const override;

 protected:
    /// Verdict and kind stay readable in a row that is selected.
    void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override;
};

}  // namespace eyrie::ui
