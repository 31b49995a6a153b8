#include "widgets/empty_state.h"

#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

namespace eyrie::ui {

EmptyState::EmptyState(QWidget* parent) : QWidget(parent), label_(new QLabel(this)), button_(new QPushButton(this)) {
    label_->setWordWrap(true);
    label_->setAlignment(Qt::AlignCenter);
    label_->setTextFormat(Qt::PlainText);
    button_->hide();
    auto* layout = new QVBoxLayout(this);
    layout->addStretch(1);
    layout->addWidget(label_);
    layout->addWidget(button_, 0, Qt::AlignHCenter);
    layout->addStretch(2);
}

void EmptyState::setTexts(const QString& explanation, const QString& action) {
    label_->setText(explanation);
    button_->setText(action);
    button_->setVisible(!action.isEmpty());
}

QString EmptyState::explanation() const {
    return label_->text();
}

QAbstractButton* EmptyState::button() const {
    return button_;
}

}  // namespace eyrie::ui

#include "moc_empty_state.cpp"
