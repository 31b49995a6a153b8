#include "widgets/charts/sweep_chart.h"

#include <qcustomplot.h>

#include <QApplication>
#include <QClipboard>
#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMenu>
#include <QMouseEvent>
#include <QPoint>
#include <QToolTip>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "widgets/charts/focus_ring.h"
#include "widgets/charts/plot_colours.h"
#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {

constexpr double kClickReach = 14;    ///< logical px from a point that still count as on it
constexpr double kMostMarkers = 120;  ///< points of a line that are drawn as dots

/// From dark blue to yellow with steadily growing brightness, so that it reads without colours too.
QCPColorGradient brightnessGradient() {
    QCPColorGradient gradient;
    gradient.setColorInterpolation(QCPColorGradient::ciRGB);
    const std::vector<std::pair<double, QColor>> stops{{0.0, QColor(68, 1, 84)},
                                                       {0.25, QColor(59, 82, 139)},
                                                       {0.5, QColor(33, 145, 140)},
                                                       {0.75, QColor(94, 201, 98)},
                                                       {1.0, QColor(253, 231, 37)}};
    gradient.clearColorStops();
    for (const auto& [at, colour] : stops) gradient.setColorStopAt(at, colour);
    gradient.setNanHandling(QCPColorGradient::nhTransparent);
    return gradient;
}

/// To the right and up, as an arrow key says; nothing by other keys.
QPoint stepOf(const QKeyEvent& key) {
    if ((key.modifiers() & ~Qt::KeypadModifier) != Qt::NoModifier) return {};
    switch (key.key()) {
        case Qt::Key_Left:
            return {-1, 0};
        case Qt::Key_Right:
            return {1, 0};
        case Qt::Key_Up:
            return {0, 1};
        case Qt::Key_Down:
            return {0, -1};
        default:
            return {};
    }
}

}  // namespace

SweepChart::SweepChart(QWidget* parent) : QWidget(parent), plot_(new QCustomPlot(this)) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(plot_);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Chart of the sweep"));
    plot_->setFocusPolicy(Qt::NoFocus);
    plot_->setMouseTracking(true);
    plot_->installEventFilter(this);
    // Above the curves, where it hides none of them.
    plot_->plotLayout()->insertRow(0);
    plot_->plotLayout()->addElement(0, 0, plot_->legend);
    plot_->plotLayout()->setRowStretchFactor(0, 0.001);
    plot_->legend->setFillOrder(QCPLayoutGrid::foColumnsFirst);
    plot_->legend->setWrap(6);
    plot_->legend->setMargins(QMargins(2, 2, 2, 2));
    margins_ = new QCPMarginGroup(plot_);
    plot_->setAntialiasedElements(QCP::aePlottables);
    applyColours();
    new FocusRing(*this);
}

void SweepChart::setData(SweepChartData data) {
    data_ = std::move(data);
    fill();
}

QColor SweepChart::colourOf(int index) const {
    static const std::vector<QColor> light{QColor(25, 103, 210), QColor(200, 90, 10), QColor(24, 128, 56),
                                           QColor(150, 60, 170), QColor(120, 100, 10)};
    static const std::vector<QColor> dark{QColor(110, 170, 255), QColor(255, 160, 80), QColor(105, 210, 130),
                                          QColor(215, 140, 235), QColor(225, 205, 90)};
    const auto& colours = isDark(palette()) ? dark : light;
    return colours[static_cast<std::size_t>(index) % colours.size()];
}

void SweepChart::fill() {
    plot_->clearPlottables();
    plot_->clearItems();
    if (scale_ != nullptr) {
        plot_->axisRect()->setMarginGroup(QCP::msTop | QCP::msBottom, nullptr);
        plot_->plotLayout()->remove(scale_);
        plot_->plotLayout()->simplify();
        scale_ = nullptr;
    }
    plot_->xAxis->setLabel(data_.x_label);
    plot_->yAxis->setLabel(data_.y_label);
    if (data_.isMap())
        fillMap();
    else
        fillCurves();
    applyColours();
}

void SweepChart::setTexts(const QStringList& texts, bool vertical, double room) {
    const QSharedPointer<QCPAxisTickerText> ticker(new QCPAxisTickerText);
    double widest = 1;
    for (const QString& text : texts)
        widest =
            std::max<double>(widest, vertical ? fontMetrics().height() : fontMetrics().horizontalAdvance(text) + 10);
    const auto count = static_cast<double>(std::max<qsizetype>(1, texts.size()));
    const auto step = std::max<qsizetype>(1, static_cast<qsizetype>(std::ceil(widest * count / std::max(room, 1.0))));
    for (qsizetype i = 0; i < texts.size(); i += step) ticker->addTick(static_cast<double>(i), texts[i]);
    (vertical ? plot_->yAxis : plot_->xAxis)->setTicker(ticker);
}

void SweepChart::fillCurves() {
    constexpr double kWorst = std::numeric_limits<double>::infinity();
    double left = kWorst, right = -kWorst, bottom = kWorst, top = -kWorst;
    for (const SweepChartData::Series& series : data_.series) {
        // A line through the points in their order, which need not be that of x.
        auto* curve = new QCPCurve(plot_->xAxis, plot_->yAxis);
        curve->setName(series.name);
        curve->setPen(QPen(colourOf(series.colour), series.bold ? 2.6 : 1.5));
        const bool dots = static_cast<double>(series.x.size()) <= kMostMarkers;
        if (dots) curve->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, series.bold ? 5 : 4));
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            curve->addData(static_cast<double>(i), series.x[i], series.y[i]);
            if (!std::isfinite(series.y[i])) continue;
            left = std::min(left, series.x[i]);
            right = std::max(right, series.x[i]);
            bottom = std::min(bottom, series.y[i]);
            top = std::max(top, series.y[i]);
        }
    }
    if (!(left <= right)) left = right = bottom = top = 0;
    const double x_margin = right > left ? (right - left) * 0.03 : std::max(0.5, std::abs(left) * 0.1);
    const double y_margin = top > bottom ? (top - bottom) * 0.08 : std::max(0.02, std::abs(top) * 0.05);
    plot_->xAxis->setRange(left - x_margin, right + x_margin);
    plot_->yAxis->setRange(bottom - y_margin, top + y_margin);
    if (data_.share && plot_->yAxis->range().upper > 1.02) plot_->yAxis->setRangeUpper(1.02);
    plot_->yAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
    if (data_.x_words.isEmpty())
        plot_->xAxis->setTicker(QSharedPointer<QCPAxisTicker>(new QCPAxisTicker));
    else
        setTexts(data_.x_words, false, std::max(60, width() - 90));
    if (data_.band) {
        auto* band = new QCPItemRect(plot_);
        band->setObjectName(QStringLiteral("band"));
        band->topLeft->setTypeY(QCPItemPosition::ptAxisRectRatio);
        band->bottomRight->setTypeY(QCPItemPosition::ptAxisRectRatio);
        const double half = data_.band->first == data_.band->second ? x_margin / 4 : 0;
        band->topLeft->setCoords(data_.band->first - half, 0);
        band->bottomRight->setCoords(data_.band->second + half, 1);
        band->setPen(Qt::NoPen);
    }
    for (const QPointF& best : data_.best) {
        auto* mark = new QCPCurve(plot_->xAxis, plot_->yAxis);
        mark->setObjectName(QStringLiteral("best"));
        mark->setName(tr("best"));
        if (&best != &data_.best.front()) mark->removeFromLegend();  // one entry tells of all
        mark->setLineStyle(QCPCurve::lsNone);
        mark->addData(0, best.x(), best.y());
        mark->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(Qt::black, 2), Qt::NoBrush, 12));
    }
    int widest = 1;
    for (const SweepChartData::Series& series : data_.series)
        widest = std::max(widest, fontMetrics().horizontalAdvance(series.name));
    plot_->legend->setWrap(std::max(1, (width() - 20) / (widest + 56)));
    plot_->legend->setVisible(!data_.series.empty());
}

void SweepChart::fillMap() {
    const auto columns = static_cast<int>(data_.columns.size());
    const auto rows = static_cast<int>(data_.rows.size());
    auto* map = new QCPColorMap(plot_->xAxis, plot_->yAxis);
    map->data()->setSize(columns, rows);
    map->data()->setRange(QCPRange(0, columns - 1), QCPRange(0, rows - 1));
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const double value = data_.cells[static_cast<std::size_t>(r * columns + c)];
            map->data()->setCell(c, r, value);
            if (!std::isfinite(value)) continue;
            lowest = std::min(lowest, value);
            highest = std::max(highest, value);
        }
    }
    map->setInterpolate(false);
    map->setTightBoundary(false);
    map->setGradient(brightnessGradient());
    scale_ = new QCPColorScale(plot_);
    plot_->plotLayout()->addElement(1, 1, scale_);
    plot_->axisRect()->setMarginGroup(QCP::msTop | QCP::msBottom, margins_);
    scale_->setMarginGroup(QCP::msTop | QCP::msBottom, margins_);
    scale_->setType(QCPAxis::atRight);
    map->setColorScale(scale_);
    scale_->setGradient(brightnessGradient());
    scale_->axis()->setLabel(data_.value_label);
    if (lowest <= highest) {
        const double least = std::max(1e-9, std::abs(highest) * 1e-6);
        map->setDataRange(QCPRange(lowest, std::max(highest, lowest + least)));
    }
    plot_->xAxis->setRange(-0.5, columns - 0.5);
    plot_->yAxis->setRange(-0.5, rows - 0.5);
    setTexts(data_.columns, false, std::max(60, width() - 190));
    setTexts(data_.rows, true, std::max(60, height() - 70));
    const auto frame = [&](const char* name, std::pair<int, int> across, std::pair<int, int> down) {
        auto* rect = new QCPItemRect(plot_);
        rect->setObjectName(QLatin1String(name));
        rect->topLeft->setCoords(across.first - 0.5, down.second + 0.5);
        rect->bottomRight->setCoords(across.second + 0.5, down.first - 0.5);
    };
    if (data_.best_cell && data_.best_rows_columns) {
        const auto [row, column] = *data_.best_cell;
        frame("along", data_.best_rows_columns->second, {row, row});
        frame("along", {column, column}, data_.best_rows_columns->first);
        frame("best", {column, column}, {row, row});
    }
    plot_->legend->setVisible(false);
}

void SweepChart::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    fill();
}

void SweepChart::applyColours() {
    const QColor text = palette().color(QPalette::WindowText);
    const QColor ground = palette().color(QPalette::Base);
    applyTheme(*plot_, *this, scale_ != nullptr ? std::vector<QCPAxis*>{scale_->axis()} : std::vector<QCPAxis*>());
    for (int i = 0; i < plot_->itemCount(); ++i) {
        auto* rect = qobject_cast<QCPItemRect*>(plot_->item(i));
        if (rect == nullptr) continue;
        if (rect->objectName() == QStringLiteral("band")) {
            rect->setBrush(blend(ground, colourOf(2), 0.16));
            rect->setLayer(QStringLiteral("background"));
        } else {
            // On dark and on bright cells alike.
            const bool best = rect->objectName() == QStringLiteral("best");
            rect->setPen(QPen(best ? QColor(255, 255, 255) : QColor(255, 255, 255, 190), best ? 3 : 1.5,
                              best ? Qt::SolidLine : Qt::DashLine));
        }
    }
    for (int i = 0; i < plot_->plottableCount(); ++i) {
        auto* curve = qobject_cast<QCPCurve*>(plot_->plottable(i));
        if (curve != nullptr && curve->objectName() == QStringLiteral("best"))
            curve->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(text, 2), Qt::NoBrush, 12));
    }
    plot_->legend->setBrush(blend(ground, text, 0.04));
    plot_->replot(QCustomPlot::rpQueuedReplot);
}

void SweepChart::changeEvent(QEvent* event) {
    if (event->type() == QEvent::PaletteChange || event->type() == QEvent::FontChange) fill();
    QWidget::changeEvent(event);
}

int SweepChart::pointAt(QPointF place, QString& text) const {
    const double x = plot_->xAxis->pixelToCoord(place.x());
    const double y = plot_->yAxis->pixelToCoord(place.y());
    if (data_.isMap()) {
        const int column = static_cast<int>(std::lround(x));
        const int row = static_cast<int>(std::lround(y));
        if (column < 0 || row < 0 || column >= data_.columns.size() || row >= data_.rows.size()) return -1;
        const int position = row * static_cast<int>(data_.columns.size()) + column;
        const double value = data_.cells[static_cast<std::size_t>(position)];
        text = tr("%1 = %2\n%3 = %4\n%5")
                   .arg(data_.y_label, data_.rows[row], data_.x_label, data_.columns[column],
                        std::isfinite(value)
                            ? data_.value_label + QStringLiteral(" = ") + QString::number(value, 'f', data_.decimals)
                            : tr("not computed"));
        return position;
    }
    double nearest = kClickReach;
    int found = -1;
    for (const SweepChartData::Series& series : data_.series) {
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            const double distance = std::hypot(plot_->xAxis->coordToPixel(series.x[i]) - place.x(),
                                               plot_->yAxis->coordToPixel(series.y[i]) - place.y());
            if (!(distance < nearest)) continue;
            nearest = distance;
            found = series.positions[i];
            const auto word = static_cast<qsizetype>(series.x[i]);
            const QString at =
                data_.x_words.isEmpty() ? QString::number(series.x[i], 'g', 6) : data_.x_words.value(word);
            text = tr("%1\n%2 = %3\n%4 = %5")
                       .arg(series.name, data_.x_label, at, data_.y_label,
                            QString::number(series.y[i], 'f', data_.decimals));
        }
    }
    return found;
}

int SweepChart::pointBeside(int right, int up) const {
    if (data_.isMap()) {
        const auto columns = static_cast<int>(data_.columns.size());
        const int column = chosen_ % columns + right;
        const int row = chosen_ / columns + up;
        const bool there = column >= 0 && row >= 0 && column < columns && row < data_.rows.size();
        return chosen_ >= 0 && there ? row * columns + column : -1;
    }
    for (std::size_t line = 0; line < data_.series.size(); ++line) {
        const std::vector<int>& points = data_.series[line].positions;
        const auto at = std::find(points.begin(), points.end(), chosen_);
        if (at == points.end()) continue;
        const std::ptrdiff_t beside = at - points.begin() + right;
        const std::ptrdiff_t other = static_cast<std::ptrdiff_t>(line) + up;
        if (other < 0 || other >= std::ssize(data_.series)) return -1;
        const std::vector<int>& there = data_.series[static_cast<std::size_t>(other)].positions;
        return beside >= 0 && beside < std::ssize(there) ? there[static_cast<std::size_t>(beside)] : -1;
    }
    return -1;
}

bool SweepChart::event(QEvent* event) {
    // Elsewhere arrows step through the video.
    if (event->type() == QEvent::ShortcutOverride && stepOf(*static_cast<QKeyEvent*>(event)) != QPoint()) {
        event->accept();
        return true;
    }
    return QWidget::event(event);
}

void SweepChart::keyPressEvent(QKeyEvent* event) {
    const QPoint step = stepOf(*event);
    if (step.isNull()) {
        QWidget::keyPressEvent(event);
        return;
    }
    if (const int position = pointBeside(step.x(), step.y()); position >= 0) emit pointClicked(position);
}

bool SweepChart::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::MouseMove || event->type() == QEvent::MouseButtonPress) {
        const auto* mouse = static_cast<QMouseEvent*>(event);
        QString text;
        const int position = pointAt(mouse->position(), text);
        if (event->type() == QEvent::MouseMove)
            QToolTip::showText(mouse->globalPosition().toPoint(), position < 0 ? QString() : text, plot_);
        else if (position >= 0 && mouse->button() == Qt::LeftButton)
            emit pointClicked(position);
    }
    return QWidget::eventFilter(watched, event);
}

void SweepChart::copyText() const {
    QApplication::clipboard()->setText(data_.text());
}

void SweepChart::copyPicture() {
    QApplication::clipboard()->setPixmap(plot_->toPixmap(plot_->width(), plot_->height(), 2));
}

void SweepChart::contextMenuEvent(QContextMenuEvent* event) {
    QMenu menu;
    menu.addAction(tr("Copy as table"), this, &SweepChart::copyText);
    menu.addAction(tr("Copy as picture"), this, &SweepChart::copyPicture);
    menu.exec(event->globalPos());
}

}  // namespace eyrie::ui

#include "moc_sweep_chart.cpp"
