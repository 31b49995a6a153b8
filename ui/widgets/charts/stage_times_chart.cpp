#include "widgets/charts/stage_times_chart.h"

#include <qcustomplot.h>

#include <QApplication>
#include <QClipboard>
#include <QLabel>
#include <QMenu>
#include <QStackedLayout>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "widgets/charts/focus_ring.h"
#include "widgets/charts/plot_colours.h"
#include "widgets/elided_label.h"
#include "widgets/empty_state.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {
namespace {

constexpr int kRefreshMs = 60;
// Several frames share a point where they would not be told apart anyway; thousands of points would draw for seconds.
constexpr std::size_t kPixelsPerBin = 3;
constexpr int kNarrowPx = 480;  ///< below this width the legend goes under the chart
constexpr int kLegendColumnPx = 190;
constexpr int kClickPx = 4;
// The marker follows the canvas at 25 Hz; on a layer of its own the bands need not be drawn again for it.
const QString kMarkerLayer = QStringLiteral("marker");

}  // namespace

StageTimesChart::StageTimesChart(QWidget* parent)
    : QWidget(parent),
      stack_(new QStackedLayout(this)),
      empty_(new EmptyState(this)),
      readout_(new ElidedLabel(Qt::ElideRight, this)),
      plot_(new QCustomPlot(this)) {
    empty_->setTexts(
        tr("No times yet. During a run, or when a run is chosen, this shows where the time of each frame goes."));
    readout_->setContentsMargins(4, 2, 4, 2);
    readout_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
    auto* chart = new QWidget(this);
    auto* layout = new QVBoxLayout(chart);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(readout_);
    layout->addWidget(plot_, 1);
    stack_->addWidget(empty_);
    stack_->addWidget(chart);
    setFocusPolicy(Qt::StrongFocus);
    plot_->setObjectName(QStringLiteral("plot"));
    plot_->setFocusPolicy(Qt::NoFocus);
    makePlot();
    connectPlot();
    applyColours();
    new FocusRing(*this);
}

StageTimesChart::~StageTimesChart() = default;

void StageTimesChart::makePlot() {
    for (int i = 0; i < kStageCount; ++i) {
        QCPGraph* graph = plot_->addGraph();
        graph->setName(shownName(static_cast<Stage>(i)));
        if (i > 0) graph->setChannelFillGraph(graphs_[static_cast<std::size_t>(i) - 1]);
        graphs_[static_cast<std::size_t>(i)] = graph;
    }
    peaks_ = plot_->addGraph();
    peaks_->setName(tr("slowest"));
    peaks_->removeFromLegend();
    plot_->xAxis->setLabel(tr("frame"));
    plot_->yAxis->setLabel(tr("time (ms)"));
    plot_->xAxis->setNumberFormat(QStringLiteral("f"));
    plot_->xAxis->setNumberPrecision(0);
    plot_->setNotAntialiasedElements(QCP::aeFills);  // smooth fills cost thirty times as much and look the same
    plot_->setNoAntialiasingOnDrag(true);
    plot_->setInteractions(QCP::iRangeDrag | QCP::iRangeZoom);
    plot_->axisRect()->setRangeDrag(Qt::Horizontal);
    plot_->axisRect()->setRangeZoom(Qt::Horizontal);

    plot_->addLayer(kMarkerLayer, plot_->layer(QStringLiteral("main")), QCustomPlot::limAbove);
    plot_->layer(kMarkerLayer)->setMode(QCPLayer::lmBuffered);
    marker_ = new QCPItemStraightLine(plot_);
    marker_->setLayer(kMarkerLayer);
    budget_ = new QCPItemStraightLine(plot_);
    budget_->setLayer(kMarkerLayer);
    budget_->setVisible(false);

    side_ = new QCPLayoutGrid;
    plot_->plotLayout()->addElement(0, 1, side_);
    side_->addElement(0, 0, plot_->legend);
    side_->addElement(1, 0, new QCPLayoutElement(plot_));
    side_->setRowStretchFactor(0, 0.001);
    plot_->legend->setVisible(true);
    placeLegend(false);
}

/// Beside the bands, where it covers nothing; below them where the chart is narrow.
void StageTimesChart::placeLegend(bool below) {
    QCPLayoutGrid* layout = plot_->plotLayout();
    layout->take(side_);
    layout->simplify();
    layout->addElement(below ? 1 : 0, below ? 0 : 1, side_);
    if (below)
        layout->setRowStretchFactor(1, 0.001);
    else
        layout->setColumnStretchFactor(1, 0.001);
    legend_below_ = below;
    arrangeLegend();
}

void StageTimesChart::arrangeLegend() {
    const int columns = std::max(1, width() / kLegendColumnPx);
    plot_->legend->setWrap(legend_below_ ? columns : 0);
    plot_->legend->setFillOrder(legend_below_ ? QCPLegend::foColumnsFirst : QCPLegend::foRowsFirst, true);
    refreshLater();
}

void StageTimesChart::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    const bool below = width() < kNarrowPx;
    if (below != legend_below_)
        placeLegend(below);
    else if (below)
        arrangeLegend();
}

void StageTimesChart::connectPlot() {
    connect(plot_, &QCustomPlot::mouseMove, this, [this](QMouseEvent* event) {
        if (event->buttons().testFlag(Qt::LeftButton)) follows_ = false;
        describeFrame(static_cast<FrameIndex>(std::lround(plot_->xAxis->pixelToCoord(event->position().x()))));
    });
    // Dragging moves the range; only what stays in place is a click.
    connect(plot_, &QCustomPlot::mouseRelease, this, [this](QMouseEvent* event) {
        const QPoint way = event->globalPosition().toPoint() - property("pressed").toPoint();
        if (event->button() != Qt::LeftButton || way.manhattanLength() > kClickPx || data_.size() == 0) return;
        const auto frame = static_cast<FrameIndex>(std::lround(plot_->xAxis->pixelToCoord(event->position().x())));
        const auto position = data_.positionOf(frame);
        if (position) emit frameActivated(data_.frameAt(*position));
    });
    connect(plot_, &QCustomPlot::mousePress, this,
            [this](QMouseEvent* event) { setProperty("pressed", event->globalPosition().toPoint()); });
    connect(plot_, &QCustomPlot::mouseDoubleClick, this, &StageTimesChart::showAll);
    connect(plot_, &QCustomPlot::mouseWheel, this, [this] { follows_ = false; });
    connect(plot_->xAxis, qOverload<const QCPRange&>(&QCPAxis::rangeChanged), this, &StageTimesChart::refreshLater);
}

void StageTimesChart::setFrames(const std::vector<FrameSummary>& frames) {
    const bool continues = data_.size() <= frames.size() && data_.size() > 0 &&
                           data_.frameAt(0) == frames.front().frame &&
                           data_.frameAt(data_.size() - 1) == frames[data_.size() - 1].frame;
    if (!continues) clear();
    for (std::size_t i = data_.size(); i < frames.size(); ++i) append(frames[i]);
}

void StageTimesChart::append(const FrameSummary& frame) {
    const std::size_t before = data_.size();
    data_.append(frame);
    if (data_.size() == before) return;
    refreshLater();
}

void StageTimesChart::fillGraphs() {
    const auto pixels = static_cast<std::size_t>(std::max(plot_->axisRect()->width(), 1));
    const auto bins =
        data_.bins(static_cast<FrameIndex>(std::floor(plot_->xAxis->range().lower)),
                   static_cast<FrameIndex>(std::ceil(plot_->xAxis->range().upper)), pixels / kPixelsPerBin);
    QVector<QCPGraphData> points(static_cast<qsizetype>(bins.size()));
    for (std::size_t stage = 0; stage < graphs_.size(); ++stage) {
        std::transform(bins.begin(), bins.end(), points.begin(),
                       [&](const StageTimesData::Bin& bin) { return QCPGraphData(bin.frame, bin.tops[stage]); });
        graphs_[stage]->data()->set(points, true);
    }
    std::transform(bins.begin(), bins.end(), points.begin(),
                   [](const StageTimesData::Bin& bin) { return QCPGraphData(bin.frame, bin.peak); });
    peaks_->data()->set(points, true);
    peaks_->setVisible(bins.size() < data_.size());
}

void StageTimesChart::clear() {
    data_.clear();
    follows_ = true;
    readout_->clear();
    refreshLater();
}

void StageTimesChart::refreshLater() {
    if (refresh_scheduled_) return;
    refresh_scheduled_ = true;
    QTimer::singleShot(kRefreshMs, this, &StageTimesChart::refresh);
}

void StageTimesChart::refresh() {
    refresh_scheduled_ = false;
    stack_->setCurrentIndex(data_.size() == 0 ? 0 : 1);
    if (data_.size() == 0) return;
    listUsedStages();
    if (follows_)
        plot_->xAxis->setRange(data_.frameAt(0), std::max(data_.frameAt(data_.size() - 1), data_.frameAt(0) + 1));
    plot_->yAxis->setRange(0, data_.axisMaximum());
    fillGraphs();
    if (readout_->text().isEmpty()) describeFrame(current_frame_);
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

/// Puts the stages that took time into the legend, from top to bottom as their bands lie.
void StageTimesChart::listUsedStages() {
    bool changed = false;
    for (int i = 0; i < kStageCount; ++i) {
        QCPGraph* graph = graphs_[static_cast<std::size_t>(i)];
        const bool used = data_.isUsed(static_cast<Stage>(i));
        changed = changed || used != graph->visible() || used != plot_->legend->hasItemWithPlottable(graph);
        graph->setVisible(used);
    }
    if (!changed) return;
    plot_->legend->clearItems();
    for (auto graph = graphs_.rbegin(); graph != graphs_.rend(); ++graph) {
        if ((*graph)->visible()) (*graph)->addToLegend();
    }
}

void StageTimesChart::showAll() {
    follows_ = true;
    refresh();
}

void StageTimesChart::setCurrentFrame(FrameIndex frame) {
    current_frame_ = frame;
    marker_->point1->setCoords(frame, 0);
    marker_->point2->setCoords(frame, 1);
    describeFrame(frame);
    if (data_.size() > 0 && isVisible()) plot_->layer(kMarkerLayer)->replot();
}

void StageTimesChart::setBudgetMs(double ms) {
    budget_->setVisible(ms > 0);
    budget_->point1->setCoords(0, ms);
    budget_->point2->setCoords(1, ms);
    refreshLater();
}

void StageTimesChart::describeFrame(FrameIndex frame) {
    const auto position = data_.positionOf(frame);
    readout_->setText(position ? data_.describe(*position) : QString());
}

void StageTimesChart::applyColours() {
    const QColor text = palette().color(QPalette::WindowText);
    const QColor quiet = quietText(palette());
    const QColor ground = palette().color(QPalette::Base);
    applyTheme(*plot_, *this);
    plot_->legend->setBrush(Qt::NoBrush);
    for (int i = 0; i < kStageCount; ++i) {
        const QColor colour = stageColour(static_cast<Stage>(i), palette());
        graphs_[static_cast<std::size_t>(i)]->setPen(QPen(colour, 1));
        graphs_[static_cast<std::size_t>(i)]->setBrush(blend(ground, colour, 0.75));
    }
    peaks_->setPen(QPen(quiet, 1));
    marker_->setPen(QPen(text, 1));
    budget_->setPen(QPen(text, 1, Qt::DashLine));
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void StageTimesChart::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) applyColours();
    QWidget::changeEvent(event);
}

QPixmap StageTimesChart::picture() const {
    return plot_->toPixmap(plot_->width(), plot_->height(), 2);
}

void StageTimesChart::copyPicture() const {
    QApplication::clipboard()->setPixmap(picture());
}

void StageTimesChart::copyText() const {
    QApplication::clipboard()->setText(text());
}

void StageTimesChart::contextMenuEvent(QContextMenuEvent* event) {
    if (data_.size() == 0) return;
    QMenu menu;
    menu.addAction(tr("Show all frames"), this, &StageTimesChart::showAll);
    menu.addAction(tr("Copy as text"), QKeySequence::Copy, this, &StageTimesChart::copyText);
    menu.addAction(tr("Copy as picture"), this, &StageTimesChart::copyPicture);
    menu.exec(event->globalPos());
}

void StageTimesChart::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Copy) && data_.size() > 0) {
        copyText();
        return;
    }
    QWidget::keyPressEvent(event);
}

}  // namespace eyrie::ui

#include "moc_stage_times_chart.cpp"
