#include "widgets/chip_grid.h"

#include <QKeyEvent>
#include <QLocale>
#include <QPainter>
#include <QScrollBar>
#include <algorithm>
#include <cmath>

#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {

constexpr double kGap = 8;                ///< between cards and around them, logical px
constexpr double kChipGap = 4;            ///< between the chips of one card
constexpr double kNarrowestChip = 76;     ///< even if all titles are short
constexpr double kWidestTitle = 124;      ///< longer ones are cut
constexpr double kSmallestPicture = 130;  ///< longer side of a fitted picture
constexpr double kTallestShare = 0.45;    ///< of the view's height, if they have to be scrolled
constexpr int kFitSteps = 12;             ///< of halving
constexpr double kSmallestZoom = 0.1;
constexpr double kLargestZoom = 32;
constexpr double kStep = 1.25;

/// What a key does to the pictures; with a modifier it belongs to the window.
enum class ChipGridKey { none, nearer, farther, fit };

ChipGridKey chipGridKey(const QKeyEvent& key) {
    if (key.modifiers() & ~(Qt::KeypadModifier | Qt::ShiftModifier)) return ChipGridKey::none;
    switch (key.key()) {
        case Qt::Key_Plus:
            return ChipGridKey::nearer;
        case Qt::Key_Minus:
            return ChipGridKey::farther;
        case Qt::Key_0:
            return ChipGridKey::fit;
        default:
            return ChipGridKey::none;
    }
}

QSizeF sizeOf(const Chip& chip) {
    if (!chip.image.isNull()) return chip.image.size();
    return {static_cast<double>(chip.values.cols), static_cast<double>(chip.values.rows)};
}

}  // namespace

ChipGrid::ChipGrid(QWidget* parent) : QAbstractScrollArea(parent) {
    viewport()->setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    setToolTip(tr("Ctrl and the wheel zoom all pictures, 0 fits them"));
}

void ChipGrid::setCards(std::vector<ChipCard> cards) {
    cards_ = std::move(cards);
    layoutCards();
}

void ChipGrid::setMarkedCard(int id) {
    marked_ = id;
    viewport()->update();
}

void ChipGrid::fit() {
    fitted_ = true;
    layoutCards();
}

void ChipGrid::zoomBy(double factor) {
    setZoom(zoom_ * factor);
}

void ChipGrid::setZoom(double zoom) {
    fitted_ = false;
    zoom_ = std::clamp(zoom, kSmallestZoom, kLargestZoom);
    layoutCards();
}

double ChipGrid::textWidth(const QString& text) const {
    return fontMetrics().horizontalAdvance(text) + 2;
}

double ChipGrid::titleHeight() const {
    return fontMetrics().height() * 2 + 2;
}

double ChipGrid::headingHeight() const {
    return fontMetrics().height() + 4;
}

/// Places the cards in rows and returns the height of all; the widest chip may be wider than the view.
double ChipGrid::arrange(double zoom, std::vector<Placed>* placed) const {
    const double width = viewport()->width();
    double x = kGap;
    double y = kGap;
    double row_height = 0;
    for (const ChipCard& card : cards_) {
        const double heading = card.heading.isEmpty() ? 0 : headingHeight();
        double card_width = 0;
        double card_height = 0;
        std::vector<QRectF> pictures;
        for (const Chip& chip : card.chips) {
            const QSizeF picture = sizeOf(chip) * zoom;
            if (card_width > 0) card_width += kChipGap;
            pictures.emplace_back(QPointF(card_width, heading + titleHeight()), picture);
            card_width += std::max(picture.width(), title_width_);
            card_height = std::max(card_height, heading + titleHeight() + picture.height());
        }
        if (x > kGap && x + card_width + kGap > width) {
            x = kGap;
            y += row_height + kGap;
            row_height = 0;
        }
        if (placed != nullptr) {
            for (QRectF& picture : pictures) picture.translate(x, y);
            placed->push_back({QRectF(x, y, card_width, card_height), std::move(pictures)});
        }
        x += card_width + kGap;
        row_height = std::max(row_height, card_height);
    }
    return cards_.empty() ? 0 : y + row_height + kGap;
}

double ChipGrid::fittingZoom() const {
    double widest = 0;
    double tallest = 0;
    std::size_t most_chips = 1;
    for (const ChipCard& card : cards_) {
        most_chips = std::max(most_chips, card.chips.size());
        for (const Chip& chip : card.chips) {
            widest = std::max(widest, sizeOf(chip).width());
            tallest = std::max(tallest, sizeOf(chip).height());
        }
    }
    if (widest <= 0 || tallest <= 0) return 1;
    // The largest zoom at which all can be seen at once, unless the pictures would become too small to see anything.
    const auto side_by_side = static_cast<double>(most_chips);
    const double of_width = (viewport()->width() - 2 * kGap - (side_by_side - 1) * kChipGap) / side_by_side / widest;
    double large = std::min(of_width, viewport()->height() / tallest);
    double small = std::min(large, kSmallestPicture / std::max(widest, tallest));
    for (int i = 0; i < kFitSteps; ++i) {
        const double middle = (small + large) / 2;
        (arrange(middle, nullptr) <= viewport()->height() ? small : large) = middle;
    }
    if (arrange(small, nullptr) > viewport()->height()) {
        // They have to be scrolled anyway: the columns there are fill the width.
        const double card = side_by_side * std::max(title_width_, small * widest) + (side_by_side - 1) * kChipGap;
        const double columns = std::max(1.0, std::floor((viewport()->width() - kGap) / (card + kGap)));
        const double wider = (viewport()->width() - kGap) / columns - kGap - 1;
        const double filling = (wider - (side_by_side - 1) * kChipGap) / side_by_side / widest;
        small = std::max(small, std::min(filling, kTallestShare * viewport()->height() / tallest));
    }
    return std::clamp(small, kSmallestZoom, kLargestZoom);
}

void ChipGrid::layoutCards() {
    title_width_ = kNarrowestChip;
    for (const ChipCard& card : cards_)
        for (const Chip& chip : card.chips)
            title_width_ = std::max({title_width_, textWidth(chip.title), textWidth(chip.note)});
    // Two in a row rather than whole titles, where it is narrow.
    const double half = std::max(kNarrowestChip, (viewport()->width() - 3 * kGap) / 2);
    title_width_ = std::min({title_width_, kWidestTitle, half});
    if (fitted_) zoom_ = fittingZoom();
    placed_.clear();
    const double height = arrange(zoom_, &placed_);
    double right = 0;
    for (const Placed& placed : placed_) right = std::max(right, placed.card.right() + kGap);
    const QSize view = viewport()->size();
    verticalScrollBar()->setPageStep(view.height());
    verticalScrollBar()->setSingleStep(fontMetrics().height() * 2);
    verticalScrollBar()->setRange(0, std::max(0, static_cast<int>(std::ceil(height)) - view.height()));
    horizontalScrollBar()->setPageStep(view.width());
    horizontalScrollBar()->setRange(0, std::max(0, static_cast<int>(std::ceil(right - kGap)) - view.width()));
    viewport()->update();
    emit zoomChanged(zoom_);
}

QRectF ChipGrid::pictureRect(int card, int chip) const {
    const Placed& placed = placed_.at(static_cast<std::size_t>(card));
    return placed.pictures.at(static_cast<std::size_t>(chip))
        .translated(-horizontalScrollBar()->value(), -verticalScrollBar()->value());
}

QString ChipGrid::valueText(const Chip& chip, QPoint pixel) {
    const cv::Mat& values = chip.values;
    if (pixel.x() < 0 || pixel.y() < 0 || pixel.x() >= values.cols || pixel.y() >= values.rows) return {};
    const QString unit = chip.unit.isEmpty() ? QString() : QLatin1Char(' ') + chip.unit;
    switch (values.type()) {
        case CV_8UC1:
            return QString::number(values.at<uchar>(pixel.y(), pixel.x())) + unit;
        case CV_32FC1:
            return QLocale().toString(static_cast<double>(values.at<float>(pixel.y(), pixel.x())), 'f', 2) + unit;
        default:
            return {};
    }
}

// ---- painting -------------------------------------------------------------------------------------------------------

void ChipGrid::paintEvent(QPaintEvent*) {
    QPainter painter(viewport());
    painter.fillRect(viewport()->rect(), palette().color(QPalette::Window));
    painter.translate(-horizontalScrollBar()->value(), -verticalScrollBar()->value());
    const QRectF visible =
        QRectF(viewport()->rect()).translated(horizontalScrollBar()->value(), verticalScrollBar()->value());
    for (std::size_t i = 0; i < placed_.size(); ++i)
        if (placed_[i].card.intersects(visible)) paintCard(painter, cards_[i], placed_[i]);
}

void ChipGrid::paintCard(QPainter& painter, const ChipCard& card, const Placed& placed) const {
    if (!card.heading.isEmpty()) {
        QRectF line(placed.card.topLeft(), QSizeF(placed.card.width(), headingHeight()));
        if (card.colour.isValid()) {
            const double side = fontMetrics().height() * 0.62;
            painter.setRenderHint(QPainter::Antialiasing);
            painter.setPen(QColor(0, 0, 0, 150));
            painter.setBrush(card.colour);
            painter.drawRoundedRect(QRectF(line.left() + 0.5, line.center().y() - side / 2, side, side), 2, 2);
            painter.setBrush(Qt::NoBrush);
            line.setLeft(line.left() + side + 5);
        }
        QFont bold = font();
        bold.setBold(true);
        painter.setFont(bold);
        painter.setPen(palette().color(QPalette::WindowText));
        painter.drawText(line, Qt::AlignVCenter | Qt::AlignLeft,
                         QFontMetricsF(bold).elidedText(card.heading, Qt::ElideRight, line.width()));
        painter.setFont(font());
    }
    for (std::size_t i = 0; i < card.chips.size(); ++i) paintChip(painter, card.chips[i], placed.pictures[i]);
    if (marked_ >= 0 && card.id == marked_) {
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(QPen(palette().color(QPalette::Highlight), 2));
        painter.drawRoundedRect(placed.card.adjusted(-4, -3, 4, 4), 4, 4);
    }
}

void ChipGrid::paintChip(QPainter& painter, const Chip& chip, const QRectF& picture) const {
    const double width = std::max(picture.width(), title_width_);
    const double line = fontMetrics().height();
    const QRectF title(picture.left(), picture.top() - titleHeight(), width, line);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(title, Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(chip.title, Qt::ElideRight, static_cast<int>(width)));
    // The value under the cursor takes the place of the note, so that nothing moves.
    QString below = chip.note;
    bool is_value = false;
    if (cursor_ && !chip.histogram) {
        const QPoint pixel(static_cast<int>(std::floor(cursor_->x())), static_cast<int>(std::floor(cursor_->y())));
        const QString value = valueText(chip, pixel);
        is_value = !value.isEmpty();
        if (is_value) below = value;
    }
    painter.setPen(is_value ? palette().color(QPalette::WindowText) : quietText(palette()));
    painter.drawText(title.translated(0, line), Qt::AlignLeft | Qt::AlignVCenter,
                     fontMetrics().elidedText(below, Qt::ElideRight, static_cast<int>(width)));
    if (chip.histogram) {
        paintHistogram(painter, *chip.histogram, picture);
        return;
    }
    painter.setRenderHint(QPainter::SmoothPixmapTransform, zoom_ < 1);
    painter.drawImage(picture, chip.image);
    painter.setRenderHint(QPainter::Antialiasing);
    for (const QRectF& box : chip.boxes) {
        const QRectF shown(picture.topLeft() + (box.topLeft() + QPointF(0.5, 0.5)) * zoom_, box.size() * zoom_);
        painter.setPen(QPen(QColor(12, 12, 14), 3.2));
        painter.drawRect(shown);
        painter.setPen(QPen(chip.box_colour, 1.6));
        painter.drawRect(shown);
    }
    if (!cursor_ || !QRectF(QPointF(0, 0), sizeOf(chip)).contains(*cursor_)) return;
    const QPointF at = picture.topLeft() + *cursor_ * zoom_;
    painter.setRenderHint(QPainter::Antialiasing, false);
    for (const auto& [colour, shift] : {std::pair(QColor(0, 0, 0), 1.0), std::pair(QColor(255, 230, 0), 0.0)}) {
        painter.setPen(colour);
        painter.drawLine(QPointF(at.x() - 6, at.y() + shift), QPointF(at.x() + 6, at.y() + shift));
        painter.drawLine(QPointF(at.x() + shift, at.y() - 6), QPointF(at.x() + shift, at.y() + 6));
    }
}

void ChipGrid::paintHistogram(QPainter& painter, const ChipHistogram& histogram, const QRectF& picture) const {
    const double axis = fontMetrics().height() + 2;
    const QRectF plot = picture.adjusted(0, 0, 0, -axis);
    painter.fillRect(plot, palette().color(QPalette::Base));
    if (histogram.counts.empty() || histogram.largest <= 0 || plot.height() < 8) return;
    // Logarithmic heights: nearly all pixels have hardly any gradient.
    const int most = *std::max_element(histogram.counts.begin(), histogram.counts.end());
    const double top = std::log1p(std::max(1, most));
    const auto bins = static_cast<double>(histogram.counts.size());
    const auto xOf = [&](double value) { return plot.left() + plot.width() * value / histogram.largest; };
    painter.setRenderHint(QPainter::Antialiasing, false);
    for (std::size_t i = 0; i < histogram.counts.size(); ++i) {
        const double from = histogram.largest * static_cast<double>(i) / bins;
        const double height = std::log1p(histogram.counts[i]) / top * (plot.height() - 2);
        const bool above = histogram.threshold && from >= *histogram.threshold;
        painter.fillRect(QRectF(xOf(from), plot.bottom() - height, plot.width() / bins + 0.5, height),
                         above ? QColor(230, 120, 30) : quietText(palette()));
    }
    painter.setPen(quietText(palette()));
    painter.drawLine(plot.bottomLeft(), plot.bottomRight());
    const QRectF labels(plot.left(), plot.bottom() + 1, plot.width(), axis);
    painter.drawText(labels, Qt::AlignLeft, QStringLiteral("0"));
    painter.drawText(labels, Qt::AlignRight, QLocale().toString(histogram.largest, 'f', 0));
    if (!histogram.threshold) return;
    const double x = xOf(*histogram.threshold);
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1, Qt::DashLine));
    painter.drawLine(QPointF(x, plot.top()), QPointF(x, plot.bottom()));
}

// ---- input ----------------------------------------------------------------------------------------------------------

void ChipGrid::hover(QPointF position) {
    const QPointF content = position + QPointF(horizontalScrollBar()->value(), verticalScrollBar()->value());
    std::optional<QPointF> cursor;
    for (std::size_t i = 0; i < placed_.size(); ++i)
        for (std::size_t j = 0; j < placed_[i].pictures.size(); ++j)
            if (!cards_[i].chips[j].histogram && placed_[i].pictures[j].contains(content))
                cursor = (content - placed_[i].pictures[j].topLeft()) / zoom_;
    if (cursor == cursor_) return;
    cursor_ = cursor;
    viewport()->update();
}

void ChipGrid::mouseMoveEvent(QMouseEvent* event) {
    hover(event->position());
}

void ChipGrid::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton) return;
    const QPointF content = event->position() + QPointF(horizontalScrollBar()->value(), verticalScrollBar()->value());
    for (std::size_t i = 0; i < placed_.size(); ++i)
        if (placed_[i].card.contains(content) && cards_[i].id >= 0) emit cardClicked(cards_[i].id);
}

void ChipGrid::wheelEvent(QWheelEvent* event) {
    if (event->modifiers().testFlag(Qt::ControlModifier)) {
        zoomBy(std::pow(kStep, event->angleDelta().y() / 120.0));
        event->accept();
    } else {
        QAbstractScrollArea::wheelEvent(event);
    }
    hover(event->position());
}

void ChipGrid::keyPressEvent(QKeyEvent* event) {
    switch (chipGridKey(*event)) {
        case ChipGridKey::nearer:
            return zoomBy(kStep);
        case ChipGridKey::farther:
            return zoomBy(1 / kStep);
        case ChipGridKey::fit:
            return fit();
        case ChipGridKey::none:
            QAbstractScrollArea::keyPressEvent(event);
    }
}

bool ChipGrid::event(QEvent* event) {
    if (event->type() == QEvent::ShortcutOverride) {
        // The window's own + and − zoom the video; while the pictures have the focus they are meant.
        if (chipGridKey(*static_cast<QKeyEvent*>(event)) != ChipGridKey::none) {
            event->accept();
            return true;
        }
    }
    return QAbstractScrollArea::event(event);
}

bool ChipGrid::viewportEvent(QEvent* event) {
    if (event->type() == QEvent::Leave && cursor_) {
        cursor_.reset();
        viewport()->update();
    }
    return QAbstractScrollArea::viewportEvent(event);
}

void ChipGrid::resizeEvent(QResizeEvent*) {
    layoutCards();
}

void ChipGrid::changeEvent(QEvent* event) {
    if (event->type() == QEvent::FontChange || event->type() == QEvent::PaletteChange) layoutCards();
    QAbstractScrollArea::changeEvent(event);
}

}  // namespace eyrie::ui

#include "moc_chip_grid.cpp"
