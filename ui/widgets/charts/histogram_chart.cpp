#include "widgets/charts/histogram_chart.h"

#include <qcustomplot.h>

#include <QContextMenuEvent>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/charts/copy_menu.h"
#include "widgets/charts/plot_colours.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {
constexpr double kAxisWidth = 70;     ///< about what the vertical axis takes, logical px
constexpr double kFilled = 0.86;      ///< share of a bin that its bars take
constexpr double kLeastHeight = 0.7;  ///< bottom of logarithmic heights, so that single ones are seen
}  // namespace

QString HistogramData::text() const {
    QStringList heading{value_label};
    std::size_t count = 0;
    for (const Series& one : series) {
        heading << one.name;
        count = std::max(count, one.counts.size());
    }
    QStringList lines{heading.join(QLatin1Char('\t'))};
    for (std::size_t i = 0; i < count; ++i) {
        const auto index = static_cast<qsizetype>(i);
        QStringList fields{index < bins.size() ? bins[index] : QString::number(static_cast<double>(i) * bin_width)};
        for (const Series& one : series) fields << QString::number(i < one.counts.size() ? one.counts[i] : 0);
        lines << fields.join(QLatin1Char('\t'));
    }
    return lines.join(QLatin1Char('\n'));
}

HistogramChart::HistogramChart(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(plot_);
    plot_->setFocusPolicy(Qt::NoFocus);
    plot_->setAttribute(Qt::WA_TransparentForMouseEvents);
    plot_->axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignRight | Qt::AlignTop);
    applyColours();
}

void HistogramChart::setData(HistogramData data) {
    data_ = std::move(data);
    fill();
}

double HistogramChart::largestCount() const {
    double largest = 1;
    for (const auto& series : data_.series)
        for (const double count : series.counts) largest = std::max(largest, count);
    return largest;
}

void HistogramChart::fill() {
    plot_->clearPlottables();
    plot_->xAxis->setLabel(data_.value_label);
    plot_->yAxis->setLabel(data_.count_label);
    const bool named = !data_.bins.isEmpty();
    const double width = named ? 1 : data_.bin_width;
    std::size_t bins = 1;
    double shift = -kFilled / 2 * width;
    const double bar = kFilled * width / std::max<double>(1, static_cast<double>(data_.series.size()));
    for (const auto& series : data_.series) {
        auto* bars = new QCPBars(plot_->xAxis, plot_->yAxis);
        bars->setName(series.name);
        bars->setWidth(bar);
        bars->setPen(Qt::NoPen);
        bars->setBrush(series.colour);
        bars->setBaseValue(data_.logarithmic ? kLeastHeight : 0);
        for (std::size_t i = 0; i < series.counts.size(); ++i) {
            const double centre = (static_cast<double>(i) + 0.5) * width + shift + bar / 2;
            if (series.counts[i] > 0) bars->addData(centre, series.counts[i]);
        }
        shift += bar;
        bins = std::max(bins, series.counts.size());
    }
    if (named) {
        const QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
        // Texts that would touch each other are left out.
        const double room = std::max(1.0, (this->width() - kAxisWidth) / static_cast<double>(bins));
        const double text = fontMetrics().horizontalAdvance(QStringLiteral("000–000 "));
        const int step = std::max(1, static_cast<int>(std::ceil(text / room)));
        for (qsizetype i = 0; i < data_.bins.size(); i += step)
            ticker->addTick(static_cast<double>(i) + 0.5, data_.bins[i]);
        plot_->xAxis->setTicker(ticker);
    } else {
        plot_->xAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
    }
    plot_->xAxis->setRange(0, static_cast<double>(bins) * width);
    if (data_.logarithmic) {
        plot_->yAxis->setScaleType(QCPAxis::stLogarithmic);
        plot_->yAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTickerLog));
        plot_->yAxis->setNumberFormat(QStringLiteral("f"));
        plot_->yAxis->setNumberPrecision(0);
        plot_->yAxis->setRange(kLeastHeight, largestCount() * 2);
    } else {
        plot_->yAxis->setScaleType(QCPAxis::stLinear);
        plot_->yAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
        plot_->yAxis->setRange(0, largestCount() * 1.08);
    }
    plot_->legend->setVisible(data_.series.size() > 1);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void HistogramChart::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fill();
}

void HistogramChart::applyColours() {
    const QColor ground = palette().color(QPalette::Base);
    applyTheme(*plot_, *this);
    plot_->legend->setBrush(ground);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void HistogramChart::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) applyColours();
    QWidget::changeEvent(event);
}

void HistogramChart::contextMenuEvent(QContextMenuEvent* event) {
    offerCopies(*this, data_.text(), event->globalPos());
}

}  // namespace eyrie::ui

#include "moc_histogram_chart.cpp"
