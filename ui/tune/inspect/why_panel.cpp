#include "tune/inspect/why_panel.h"

#include <QEvent>
#include <QLabel>
#include <QScrollBar>
#include <QStackedLayout>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "widgets/empty_state.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"
#include "workspace/first_step.h"

namespace eyrie::ui {

namespace {

const QString kScheme = QStringLiteral("parameter:");

QString escaped(const std::string& text) {
    return QString::fromStdString(text).toHtmlEscaped();
}

QString linkTo(const std::string& parameter, const QString& text) {
    return QStringLiteral("<a href=\"%1%2\">%3</a>").arg(kScheme, QString::fromStdString(parameter), text);
}

/// The sentence, in which the name of the parameter that decided is a link.
QString sentenceOf(const Explanation& told) {
    QString sentence = escaped(told.sentence);
    if (told.parameter.empty()) return sentence;
    const QString name = escaped(told.parameter);
    const auto at = sentence.lastIndexOf(name);
    if (at >= 0) sentence.replace(at, name.size(), linkTo(told.parameter, name));
    return sentence;
}

}  // namespace

WhyPanel::WhyPanel(ProjectSession& session, Why& why, QWidget* parent) : QWidget(parent), session_(session), why_(why) {
    title_ = new QLabel(this);
    title_->setWordWrap(true);
    title_->setTextFormat(Qt::PlainText);
    title_->setContentsMargins(6, 4, 6, 0);
    title_->setForegroundRole(QPalette::PlaceholderText);
    empty_ = new EmptyState;
    steps_ = new QTextBrowser;
    steps_->setOpenLinks(false);
    steps_->setFrameShape(QFrame::NoFrame);
    steps_->setAccessibleName(tr("Why"));
    pages_ = new QStackedLayout;
    pages_->addWidget(empty_);
    pages_->addWidget(steps_);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(title_);
    layout->addLayout(pages_, 1);
    connect(steps_, &QTextBrowser::anchorClicked, this, [this](const QUrl& link) {
        const QString target = link.toString();
        if (target.startsWith(kScheme)) emit parameterChosen(target.mid(kScheme.size()));
    });
    connect(&why_, &Why::changed, this, &WhyPanel::refresh);
    whenChanged(session_, this, {{SessionChange::picture, [this] { refresh(); }}});
    refresh();
}

void WhyPanel::setLookedAt(bool looked_at) {
    why_.want(looked_at);
    refresh();
}

QString WhyPanel::text() const {
    return steps_->toPlainText();
}

QString WhyPanel::explanation() const {
    return pages_->currentWidget() == empty_ ? empty_->explanation() : QString();
}

void WhyPanel::refresh() {
    const auto view = why_.view();
    const auto empty = [&](const QString& text) {
        empty_->setTexts(text);
        pages_->setCurrentWidget(empty_);
        title_->clear();
        shown_.reset();
    };
    if (!session_.currentRun())
        return empty(
            tr("Answers why something was found at a place of a frame, or was not. Run the "
               "video first, or choose a run."));
    if (session_.following()) return empty(tr("To ask during the run, go to a frame that it has processed."));
    if (!why_.asked())
        return empty(
            tr("Choose “Why?” from the context menu of a place in the picture, hit or missed, or point at it and press "
               "the key of “Why?” in the menu View. Every comparison that was made there is listed, and the one that "
               "decided."));
    if (!why_.problem().isEmpty()) return empty(why_.problem());
    if (!view) return empty(why_.waiting() ? tr("Looking at the frames before this one…") : notProcessedText());
    const bool current = view->frame == session_.viewFrame().index && !why_.waiting();
    QString title = why_.about();
    if (!title.isEmpty()) title += QLatin1Char('\n');
    title_->setText(title + tr("Frame %1, at %2, %3%4")
                                .arg(view->frame)
                                .arg(qRound(view->area.centre.x))
                                .arg(qRound(view->area.centre.y))
                                .arg(current          ? QString()
                                     : why_.waiting() ? tr(" · looking at the frame shown…")
                                                      : tr(" · not the frame shown")));
    pages_->setCurrentWidget(steps_);
    if (shown_ == view) return;
    shown_ = view;
    steps_->setHtml(htmlOf(*view));
    steps_->verticalScrollBar()->setValue(0);
}

QString WhyPanel::htmlOf(const ExplanationView& view) const {
    const bool dark = isDark(palette());
    const QString good = dark ? QStringLiteral("#6fd08c") : QStringLiteral("#1a7f37");
    const QString bad = dark ? QStringLiteral("#ff8a7a") : QStringLiteral("#c62828");
    const QString quiet = quietText(palette()).name();
    const QString ground = blend(palette().color(QPalette::Base), QColor(view.told.found ? good : bad), 0.14).name();
    QString html = QStringLiteral(
                       "<table width=\"100%\" cellpadding=\"8\"><tr><td bgcolor=\"%1\"><b>%2</b></td></tr>"
                       "</table><table width=\"100%\" cellpadding=\"2\">")
                       .arg(ground, sentenceOf(view.told));
    std::string stage;
    for (const ExplanationStep& step : view.told.steps) {
        if (step.stage != stage) {
            stage = step.stage;
            QString title = escaped(stage);
            title[0] = title[0].toUpper();
            html +=
                QStringLiteral("<tr><td colspan=\"2\"><b><font color=\"%1\">%2</font></b></td></tr>").arg(quiet, title);
        }
        const bool failed = step.verdict == StepVerdict::failed;
        const bool passed = step.verdict == StepVerdict::passed;
        QString line = escaped(step.text);
        if (!step.parameter.empty())
            line += QStringLiteral(" <small>%1</small>").arg(linkTo(step.parameter, escaped(step.parameter)));
        html +=
            QStringLiteral("<tr><td width=\"18\" align=\"center\"><font color=\"%1\">%2</font></td><td>%3</td></tr>")
                .arg(passed   ? good
                     : failed ? bad
                              : quiet,
                     passed   ? QStringLiteral("✓")
                     : failed ? QStringLiteral("✗")
                              : QStringLiteral("·"),
                     line);
    }
    return html + QStringLiteral("</table>");
}

void WhyPanel::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange) {
        shown_.reset();
        refresh();
    }
    QWidget::changeEvent(event);
}

}  // namespace eyrie::ui

#include "moc_why_panel.cpp"
