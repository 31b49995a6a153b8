#pragma once

#include <QAbstractScrollArea>
#include <QColor>
#include <QImage>
#include <QRectF>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace eyrie::ui {

/// How often values occur, with the value that separates them.
struct ChipHistogram {
    std::vector<int> counts;  ///< equally wide bins from 0 to `largest`
    double largest = 0;
    std::optional<double> threshold;
};

/// One small picture with its title.
struct Chip {
    QString title;
    QString note;    ///< under the title, such as the range of values
    cv::Mat values;  ///< what the cursor reads: CV_8UC1, CV_8UC3 or CV_32FC1; the size that boxes refer to
    QImage image;    ///< the values as they are shown, pixel by pixel
    QColor box_colour{255, 90, 60};
    std::vector<QRectF> boxes;               ///< drawn over it; edges, pixel 0 covers −0.5 … 0.5
    QString unit;                            ///< of the values
    std::optional<ChipHistogram> histogram;  ///< shown in place of the image
};

/// Pictures that belong together, side by side under one heading.
struct ChipCard {
    QString heading;  ///< may be empty
    QColor colour;    ///< mark before the heading; invalid: none
    int id = -1;      ///< what clicking the card reports
    std::vector<Chip> chips;
};

/// Pictures of one small area, all at one zoom, as many in a row as fit. The cursor stands in all of them at once, and
/// each tells its value there. Ctrl and the wheel, + and − zoom, 0 fits.
class ChipGrid : public QAbstractScrollArea {
    Q_OBJECT

 public:
    explicit ChipGrid(QWidget* parent = nullptr);

    /// A zoom that the user chose stays.
    void setCards(std::vector<ChipCard> cards);
    const std::vector<ChipCard>& cards() const { return cards_; }
    /// Outlines one card; −1: none.
    void setMarkedCard(int id);

    /// Screen pixels (logical) per pixel of the pictures.
    double zoom() const { return zoom_; }
    bool fitted() const { return fitted_; }
    void fit();
    void zoomBy(double factor);

    /// The picture of a chip in the coordinates of viewport().
    QRectF pictureRect(int card, int chip) const;
    /// The value of a chip at a pixel, for people: "34.2", "127 grey"; empty outside.
    static QString valueText(const Chip& chip, QPoint pixel);

    QSize sizeHint() const override { return {320, 420}; }
    QSize minimumSizeHint() const override { return {140, 120}; }

 signals:
    void cardClicked(int id);
    void zoomChanged(double zoom);

 protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override;
    bool viewportEvent(QEvent* event) override;
    void changeEvent(QEvent* event) override;

 private:
    struct Placed {
        QRectF card;                   ///< content coordinates
        std::vector<QRectF> pictures;  ///< of its chips
    };
    void layoutCards();
    double arrange(double zoom, std::vector<Placed>* placed) const;
    double fittingZoom() const;
    void setZoom(double zoom);
    void paintCard(QPainter& painter, const ChipCard& card, const Placed& placed) const;
    void paintChip(QPainter& painter, const Chip& chip, const QRectF& picture) const;
    void paintHistogram(QPainter& painter, const ChipHistogram& histogram, const QRectF& picture) const;
    void hover(QPointF position);
    double textWidth(const QString& text) const;
    double titleHeight() const;
    double headingHeight() const;

    std::vector<ChipCard> cards_;
    std::vector<Placed> placed_;
    int marked_ = -1;
    double title_width_ = 0;  ///< room that every chip has for its title
    double zoom_ = 1;
    bool fitted_ = true;
    std::optional<QPointF> cursor_;  ///< pixel coordinates of the pictures
};

}  // namespace eyrie::ui
