#include "window/welcome_panel.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPainter>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
constexpr int kMostShown = 6;
constexpr int kWidth = 620;

QPushButton* welcomeButtonOf(QAction* action, QWidget* parent) {
    auto* button = new QPushButton(action->icon(), action->text().remove(QLatin1Char('&')), parent);
    button->setToolTip(action->toolTip());
    button->setMinimumHeight(34);
    bindCommands(button, {{button, [action] { action->trigger(); }}});
    return button;
}
}  // namespace

WelcomePanel::WelcomePanel(const WindowActions& actions, QWidget* parent) : QWidget(parent) {
    auto* title = new QLabel(tr("Drop a video here"), this);
    QFont font = title->font();
    font.setPointSizeF(font.pointSizeF() * 2);
    title->setFont(font);
    title->setAlignment(Qt::AlignCenter);
    auto* text =
        new QLabel(tr("or a folder of images, or a project. Eyrie finds, outlines and follows the small moving "
                      "vehicles in it, and keeps what it found in a project."),
                   this);
    text->setWordWrap(true);
    text->setAlignment(Qt::AlignCenter);
    text->setMinimumHeight(text->heightForWidth(kWidth - 48) + 4);
    auto* buttons = new QHBoxLayout;
    buttons->addWidget(welcomeButtonOf(actions.open_video, this));
    buttons->addWidget(welcomeButtonOf(actions.open_folder, this));
    buttons->addWidget(welcomeButtonOf(actions.demo, this));

    recent_box_ = new QWidget(this);
    recent_layout_ = new QVBoxLayout(recent_box_);
    recent_layout_->setContentsMargins(0, 18, 0, 0);
    recent_layout_->setSpacing(2);

    column_ = new QWidget(this);
    column_->setFixedWidth(kWidth);
    auto* rows = new QVBoxLayout(column_);
    rows->setContentsMargins(24, 24, 24, 24);
    rows->setSpacing(12);
    rows->addWidget(title);
    rows->addWidget(text);
    rows->addLayout(buttons);
    rows->addWidget(recent_box_);
    auto* layout = new QVBoxLayout(this);
    layout->addStretch(2);
    layout->addWidget(column_, 0, Qt::AlignHCenter);
    layout->addStretch(3);
    setRecent({});
}

void WelcomePanel::paintEvent(QPaintEvent*) {
    // A dashed frame says that things can be dropped here.
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(palette().color(QPalette::Mid), 2, Qt::DashLine));
    const QRectF around = QRectF(column_->geometry()).adjusted(-12, -12, 12, 12);
    painter.drawRoundedRect(around.intersected(QRectF(rect()).adjusted(2, 2, -2, -2)), 10, 10);
}

void WelcomePanel::setRecent(const QList<RecentProject>& projects) {
    while (QLayoutItem* item = recent_layout_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    recent_box_->setVisible(!projects.isEmpty());
    if (projects.isEmpty()) return;
    auto* heading = new QLabel(tr("Recent projects"), recent_box_);
    heading->setForegroundRole(QPalette::PlaceholderText);
    heading->setAlignment(Qt::AlignCenter);
    recent_layout_->addWidget(heading);
    for (const RecentProject& project : projects.mid(0, kMostShown)) {
        auto* button = new QToolButton(recent_box_);
        const QString full =
            project.folder().isEmpty() ? project.name() : tr("%1  –  %2").arg(project.name(), project.folder());
        button->setText(button->fontMetrics().elidedText(full, Qt::ElideMiddle, kWidth - 64));
        button->setToolTip(project.project);
        button->setAutoRaise(true);
        button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
        bindCommands(this, {{button, [this, project] { emit recentChosen(project); }}});
        recent_layout_->addWidget(button);
    }
}

}  // namespace eyrie::ui

#include "moc_welcome_panel.cpp"
