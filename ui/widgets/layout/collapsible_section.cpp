#include "widgets/layout/collapsible_section.h"

#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/wiring.h"

namespace eyrie::ui {

CollapsibleSection::CollapsibleSection(const QString& title, QWidget* parent)
    : QWidget(parent), header_(new QToolButton(this)), rows_(new QWidget(this)), rows_layout_(new QVBoxLayout(rows_)) {
    header_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    header_->setAutoRaise(true);
    header_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    QFont font = header_->font();
    font.setBold(true);
    header_->setFont(font);
    rows_layout_->setContentsMargins(12, 0, 0, 4);
    rows_layout_->setSpacing(0);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(header_);
    layout->addWidget(rows_);
    bindCommands(this, {{header_, [this] { setExpanded(!expanded_); }}});
    setTitle(title);
    update();
}

void CollapsibleSection::addRow(QWidget* row) {
    rows_layout_->addWidget(row);
}

void CollapsibleSection::setTitle(const QString& title) {
    header_->setText(title);
}

void CollapsibleSection::setExpanded(bool expanded) {
    expanded_ = expanded;
    update();
}

void CollapsibleSection::setForcedOpen(bool forced) {
    forced_ = forced;
    update();
}

void CollapsibleSection::update() {
    header_->setArrowType(expanded_ || forced_ ? Qt::DownArrow : Qt::RightArrow);
    rows_->setVisible(expanded_ || forced_);
}

}  // namespace eyrie::ui

#include "moc_collapsible_section.cpp"
