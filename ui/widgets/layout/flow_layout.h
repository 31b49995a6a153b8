#pragma once

#include <QLayout>
#include <QList>

namespace eyrie::ui {

/// Widgets beside each other, in as many rows as the width asks for.
class FlowLayout : public QLayout {
 public:
    explicit FlowLayout(QWidget* parent = nullptr, int spacing = 4);
    ~FlowLayout() override;

    void addItem(QLayoutItem* item) override { items_.append(item); }
    int count() const override { return static_cast<int>(items_.size()); }
    QLayoutItem* itemAt(int index) const override { return items_.value(index); }
    QLayoutItem* takeAt(int index) override;
    Qt::Orientations expandingDirections() const override { return {}; }
    bool hasHeightForWidth() const override { return true; }
    int heightForWidth(int width) const override { return arrange(QRect(0, 0, width, 0), false); }
    QSize sizeHint() const override { return minimumSize(); }
    QSize minimumSize() const override;
    void setGeometry(const QRect& rectangle) override;

 private:
    /// Puts the widgets into rows, or only answers how high these are.
    int arrange(const QRect& rectangle, bool place) const;

    QList<QLayoutItem*> items_;
};

}  // namespace eyrie::ui
