#include "workspace/key_sheet.h"

#include <QDialogButtonBox>
#include <QFrame>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>

namespace eyrie::ui {

namespace {

QLabel* keyLabel(const QString& text, QWidget* parent) {
    auto* label = new QLabel(text, parent);
    QFont font = label->font();
    font.setBold(true);
    label->setFont(font);
    label->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    return label;
}

QWidget* sectionWidget(const QString& title, const QList<std::pair<QString, QString>>& rows, QWidget* parent) {
    auto* widget = new QWidget(parent);
    auto* grid = new QGridLayout(widget);
    grid->setContentsMargins(0, 0, 0, 12);
    grid->setHorizontalSpacing(14);
    grid->setVerticalSpacing(3);
    auto* heading = new QLabel(title, widget);
    QFont font = heading->font();
    font.setPointSizeF(font.pointSizeF() * 1.15);
    font.setBold(true);
    heading->setFont(font);
    grid->addWidget(heading, 0, 0, 1, 2);
    int row = 1;
    for (const auto& [keys, text] : rows) {
        grid->addWidget(keyLabel(keys, widget), row, 0);
        grid->addWidget(new QLabel(text, widget), row++, 1);
    }
    grid->setColumnMinimumWidth(0, 110);
    grid->setColumnStretch(1, 1);
    return widget;
}

}  // namespace

KeySheet::KeySheet(const WindowActions& actions, QWidget* parent, const QList<ActionSection>& more) : QDialog(parent) {
    setWindowTitle(tr("Keys"));
    auto* content = new QWidget;
    auto* columns = new QHBoxLayout(content);
    columns->setSpacing(28);
    QVBoxLayout* column[3];
    int filled[3] = {0, 0, 0};
    for (auto& c : column) {
        c = new QVBoxLayout;
        columns->addLayout(c, 1);
    }
    const auto place = [&](const QString& title, const QList<std::pair<QString, QString>>& rows) {
        const auto emptiest = std::min_element(std::begin(filled), std::end(filled)) - std::begin(filled);
        column[emptiest]->addWidget(sectionWidget(title, rows, content));
        filled[emptiest] += static_cast<int>(rows.size()) + 2;
    };
    for (const ActionSection& section : more + actions.sections()) {
        QList<std::pair<QString, QString>> rows;
        for (const QAction* action : section.actions) {
            if (action->shortcuts().isEmpty()) continue;
            QStringList keys;
            for (const QKeySequence& key : action->shortcuts()) keys << key.toString(QKeySequence::NativeText);
            rows.append({keys.join(tr(" or ")), action->text().remove(QLatin1Char('&')).remove(QStringLiteral("…"))});
        }
        if (!rows.isEmpty()) place(section.title, rows);
    }
    place(tr("Mouse"), {{tr("Wheel"), tr("Zoom to the cursor")},
                        {tr("Drag"), tr("Move the picture (also with Space held)")},
                        {tr("Click"), tr("Select a track")},
                        {tr("Double click"), tr("Zoom in, again: fit")},
                        {tr("Drag the timeline"), tr("Scrub")},
                        {tr("Wheel on it"), tr("Zoom the timeline; Shift scrolls")}});
    for (auto* c : column) c->addStretch(1);

    auto* scroll = new QScrollArea(this);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setWidgetResizable(true);
    scroll->setWidget(content);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(scroll);
    layout->addWidget(buttons);
    resize(1060, 620);
}

}  // namespace eyrie::ui
