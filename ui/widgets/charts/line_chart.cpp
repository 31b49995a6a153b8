#include "widgets/charts/line_chart.h"

#include <qcustomplot.h>

#include <QContextMenuEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <limits>

#include "widgets/charts/copy_menu.h"
#include "widgets/charts/plot_colours.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {
constexpr double kCurve = 1.6;
constexpr double kHeadroom = 1.12;
constexpr double kLegendRoom = 1.3;

QColor themed(const QColor& colour, const QPalette& palette) {
    return isDark(palette) ? colour.lighter(125) : colour;
}

QString valueText(double value, int decimals) {
    return std::isfinite(value) ? QString::number(value, 'f', decimals) : QStringLiteral("–");
}
}  // namespace

QString LineData::text() const {
    QStringList heading{place_label};
    for (const Series& one : series) heading << one.name;
    QStringList lines{heading.join(QLatin1Char('\t'))};
    for (std::size_t i = 0; i < places.size(); ++i) {
        QStringList fields{QString::number(places[i])};
        for (const Series& one : series)
            fields << (i < one.values.size() && std::isfinite(one.values[i])
                           ? QString::number(one.values[i], 'f', decimals)
                           : QString());
        lines << fields.join(QLatin1Char('\t'));
    }
    return lines.join(QLatin1Char('\n'));
}

LineChart::LineChart(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(plot_);
    plot_->setFocusPolicy(Qt::NoFocus);
    plot_->setMouseTracking(true);
    plot_->installEventFilter(this);
    plot_->axisRect()->insetLayout()->setInsetAlignment(0, Qt::AlignHCenter | Qt::AlignTop);
    plot_->legend->setFillOrder(QCPLegend::foColumnsFirst);
    plot_->legend->setWrap(6);
    marker_ = new QCPItemStraightLine(plot_);
    marker_->setVisible(false);
    applyColours();
}

void LineChart::setData(LineData data) {
    data_ = std::move(data);
    fill();
}

void LineChart::setMarker(std::optional<double> place) {
    marker_->setVisible(place.has_value());
    marker_->point1->setCoords(place.value_or(0), 0);
    marker_->point2->setCoords(place.value_or(0), 1);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void LineChart::fill() {
    plot_->clearGraphs();
    plot_->xAxis->setLabel(data_.place_label);
    plot_->yAxis->setLabel(data_.value_label);
    const QVector<double> places(data_.places.begin(), data_.places.end());
    std::vector<double> below(data_.places.size(), 0);
    double largest = 0;
    QCPGraph* lower = nullptr;
    for (const LineData::Series& one : data_.series) {
        QCPGraph* graph = plot_->addGraph();
        graph->setName(one.name);
        const QColor colour = themed(one.colour, palette());
        QVector<double> values;
        for (std::size_t i = 0; i < one.values.size() && i < below.size(); ++i) {
            double value = one.values[i];
            if (data_.filled) value = below[i] += std::isfinite(value) ? value : 0;
            values << value;
            if (std::isfinite(value)) largest = std::max(largest, value);
        }
        graph->setData(places, values, true);
        graph->setPen(QPen(colour, data_.filled ? 1.0 : kCurve));
        if (data_.filled) {
            QColor area = colour;
            area.setAlphaF(0.55F);
            graph->setBrush(area);
            if (lower != nullptr) graph->setChannelFillGraph(lower);
            lower = graph;
        }
    }
    if (!places.isEmpty()) plot_->xAxis->setRange(places.front(), std::max(places.front() + 1, places.back()));
    const double top = data_.top.value_or(std::max(1.0, largest) * kHeadroom);
    // The legend lies above the curves.
    plot_->yAxis->setRange(0, data_.series.size() > 1 ? top * kLegendRoom : top);
    plot_->legend->setVisible(data_.series.size() > 1);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void LineChart::applyColours() {
    const QColor text = palette().color(QPalette::WindowText);
    const QColor ground = palette().color(QPalette::Base);
    applyTheme(*plot_, *this);
    plot_->legend->setBrush(Qt::NoBrush);
    plot_->legend->setIconSize(14, 10);
    marker_->setPen(QPen(blend(ground, text, 0.6), 1, Qt::DashLine));
    fill();
}

QString LineChart::readoutAt(double place) const {
    if (data_.places.empty()) return {};
    const auto next = std::lower_bound(data_.places.begin(), data_.places.end(), place);
    auto index = static_cast<std::size_t>(next - data_.places.begin());
    if (index >= data_.places.size()) index = data_.places.size() - 1;
    if (index > 0 && place - data_.places[index - 1] < data_.places[index] - place) --index;
    QStringList lines{QStringLiteral("%1: %2").arg(data_.place_label).arg(data_.places[index])};
    for (const LineData::Series& one : data_.series)
        if (index < one.values.size())
            lines << QStringLiteral("%1: %2").arg(one.name, valueText(one.values[index], data_.decimals));
    return lines.join(QLatin1Char('\n'));
}

bool LineChart::eventFilter(QObject* watched, QEvent* event) {
    if (watched != plot_) return QWidget::eventFilter(watched, event);
    if (event->type() == QEvent::MouseMove) {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        const bool inside = plot_->axisRect()->rect().contains(mouse->position().toPoint());
        if (inside)
            QToolTip::showText(mouse->globalPosition().toPoint(),
                               readoutAt(plot_->xAxis->pixelToCoord(mouse->position().x())), plot_);
        else
            QToolTip::hideText();
    }
    if (event->type() == QEvent::MouseButtonRelease) {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        if (mouse->button() == Qt::LeftButton && !data_.places.empty())
            emit placeActivated(std::clamp(plot_->xAxis->pixelToCoord(mouse->position().x()), data_.places.front(),
                                           data_.places.back()));
    }
    return QWidget::eventFilter(watched, event);
}

void LineChart::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) applyColours();
    QWidget::changeEvent(event);
}

void LineChart::contextMenuEvent(QContextMenuEvent* event) {
    offerCopies(*this, data_.text(), event->globalPos());
}

}  // namespace eyrie::ui

#include "moc_line_chart.cpp"
