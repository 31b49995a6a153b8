#include "review/mosaic/coverage_legend.h"

#include <QPainter>
#include <algorithm>

#include "review/mosaic/coverage_tint.h"

namespace eyrie::ui {

namespace {

constexpr int kLegendMargin = 6;
constexpr int kBarHeight = 8;
constexpr int kBarGap = 2;  ///< to the times
constexpr int kTimesApart = 8;

}  // namespace

CoverageLegend::CoverageLegend(QWidget* parent) : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Legend of the coverage in time"));
}

void CoverageLegend::setTimes(const QStringList& times) {
    if (times == times_) return;
    times_ = times;
    setAccessibleDescription(times_.join(QStringLiteral(" … ")));
    update();
}

QSize CoverageLegend::sizeHint() const {
    return {240, kBarHeight + kBarGap + fontMetrics().height() + 4};
}

QSize CoverageLegend::minimumSizeHint() const {
    return {80, sizeHint().height()};
}

void CoverageLegend::paintEvent(QPaintEvent*) {
    if (times_.isEmpty()) return;
    QPainter painter(this);
    const QRect bar(kLegendMargin, 2, width() - 2 * kLegendMargin, kBarHeight);
    for (int x = 0; x < bar.width(); ++x) {
        const double share = times_.size() == 1 ? 1 : static_cast<double>(x) / std::max(1, bar.width() - 1);
        painter.fillRect(bar.left() + x, bar.top(), 1, bar.height(), coverageColour(share));
    }
    painter.setPen(palette().color(QPalette::WindowText));
    const QRect line(bar.left(), bar.bottom() + 1 + kBarGap, bar.width(), fontMetrics().height());
    painter.drawText(line, Qt::AlignLeft, times_.front());
    if (times_.size() == 1) return;
    painter.drawText(line, Qt::AlignRight, times_.back());
    // The one in the middle goes where it would touch the others.
    const auto wide = [this](const QString& text) { return fontMetrics().horizontalAdvance(text); };
    const int beside = std::max(wide(times_.front()), wide(times_.back())) + kTimesApart;
    const QString& middle = times_.at(times_.size() / 2);
    if (times_.size() > 2 && line.width() / 2 - wide(middle) / 2 > beside)
        painter.drawText(line, Qt::AlignHCenter, middle);
}

}  // namespace eyrie::ui

#include "moc_coverage_legend.cpp"
