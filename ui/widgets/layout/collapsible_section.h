#pragma once

#include <QWidget>

class QToolButton;
class QVBoxLayout;

namespace eyrie::ui {

/// A titled group of rows that folds away.
class CollapsibleSection : public QWidget {
    Q_OBJECT
 public:
    explicit CollapsibleSection(const QString& title, QWidget* parent = nullptr);
    void addRow(QWidget* row);
    void setTitle(const QString& title);
    void setExpanded(bool expanded);
    /// Shows the rows whether folded or not, as while searching; the user's choice comes back afterwards.
    void setForcedOpen(bool forced);

 private:
    void update();
    QToolButton* header_;
    QWidget* rows_;
    QVBoxLayout* rows_layout_;
    bool expanded_ = true;
    bool forced_ = false;
};

}  // namespace eyrie::ui
