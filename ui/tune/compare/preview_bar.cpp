#include "tune/compare/preview_bar.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QSpinBox>

#include "widgets/elided_label.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
constexpr int kMostRange = 120;        ///< frames
constexpr int kMostInTip = 25;         ///< differences listed in the tool tip
constexpr std::size_t kMostNamed = 2;  ///< … and in the bar itself
}  // namespace

PreviewBar::PreviewBar(LivePreview& preview, PreviewCommands commands, QWidget* parent)
    : QFrame(parent), preview_(preview), commands_(std::move(commands)) {
    setObjectName(QStringLiteral("preview_bar"));
    setAutoFillBackground(true);  // it lies over the picture
    setFrameShape(QFrame::StyledPanel);
    text_ = new ElidedLabel(Qt::ElideRight, this);
    text_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    range_ = new QSpinBox(this);
    range_->setRange(0, kMostRange);
    range_->setValue(preview_.range());
    range_->setSuffix(tr(" frames back"));
    range_->setKeyboardTracking(false);
    range_->setToolTip(
        tr("Earlier frames that are processed with the new parameters, too, so that tracks follow from them; 0: none"));
    run_ = new QPushButton(QIcon::fromTheme(QStringLiteral("media-record")), tr("Run with these values"), this);
    discard_ = new QPushButton(tr("Discard"), this);
    discard_->setToolTip(tr("Back to the parameters and the results of the run"));
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(8, 3, 8, 3);
    layout->addWidget(text_, 1);
    layout->addWidget(range_);
    layout->addWidget(run_);
    layout->addWidget(discard_);
    onEdited(
        this, [this] { preview_.setRange(range_->value()); }, range_);
    bindCommands(this, {{run_, [this] { commands_.run(); }}, {discard_, [this] { commands_.discard(); }}});
    connect(&preview_, &LivePreview::changed, this, &PreviewBar::refresh);
    refresh();
}

QString PreviewBar::text() const {
    return text_->text();
}

void PreviewBar::refresh() {
    setVisible(preview_.active());
    if (!preview_.active()) return;
    const auto& differences = preview_.differences();
    QStringList named;
    QStringList listed;
    for (const ParameterDifference& d : differences) {
        const QString change =
            QStringLiteral("%1 %2 → %3")
                .arg(QString::fromStdString(d.name), QString::fromStdString(d.first), QString::fromStdString(d.second));
        if (listed.size() < kMostInTip) listed << change;
        if (differences.size() <= kMostNamed) named << change;
    }
    if (named.isEmpty()) named << tr("%1 parameters differ from the run").arg(differences.size());
    QString text = named.join(QStringLiteral(", "));
    const auto view = preview_.view();
    if (!preview_.problem().isEmpty()) {
        text = preview_.problem();
    } else if (view) {
        text += tr(" · from %1 on · %2 ms")
                    .arg(QString::fromLatin1(nameOf(view->previewed.start)))
                    .arg(view->milliseconds, 0, 'f', 0);
        if (preview_.framesLeft() > 0) text += tr(" · tracks: %1 frames left").arg(preview_.framesLeft());
        if (view->previewed.approximate) text += tr(" · motion vectors recomputed, a run may differ slightly");
        if (view->previewed.start == ChainStage::finishing) text += tr(" · takes effect in finished runs only");
    } else {
        text += tr(" · computing…");
    }
    text_->setText(text);
    text_->setToolTip(listed.join(QLatin1Char('\n')));
}

}  // namespace eyrie::ui

#include "moc_preview_bar.cpp"
