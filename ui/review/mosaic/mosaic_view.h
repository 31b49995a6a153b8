#pragma once

#include <QLineF>
#include <QPixmap>
#include <QVector>
#include <QWidget>
#include <functional>
#include <memory>
#include <optional>

#include "canvas/overlay_colours.h"
#include "review/mosaic/coverage_tint.h"
#include "review/mosaic/mosaic_maker.h"

class QPainter;

namespace eyrie::ui {

/// Shows one sheet of a mosaic with the ways over it, what the present frame shows, and a place that was asked about.
/// The wheel zooms, dragging pans, a double click fits; arrows, + and −, 0 do the same, Return asks about the middle.
class MosaicView : public QWidget {
    Q_OBJECT

 public:
    /// `ask` is called with the place that a person asks about, on the sheet.
    explicit MosaicView(std::function<void(QPointF on_sheet)> ask, QWidget* parent = nullptr);

    /// Keeps what is looked at while the same sheet of the same run is shown; null: nothing.
    void show(const std::shared_ptr<const MosaicPicture>& mosaic, int sheet);
    int sheet() const { return sheet_; }
    /// The frame that the canvas shows; of another sheet, or of none, it is not drawn.
    void setFrame(FrameIndex frame);
    void setSelectedTrack(std::optional<TrackId> track);
    void setPlace(std::optional<QPointF> on_sheet);
    void setColours(const OverlayColours& colours);
    /// By what the ground is tinted below the ways.
    void setCoverage(CoverageLook look);
    /// Of the sheet shown; null while there is none.
    const SheetCoverage* coverage() const;
    void fit();

    QPointF viewFromSheet(QPointF on_sheet) const;
    QPointF sheetFromView(QPointF in_view) const;
    /// Units of the sheet that a px of the view is wide.
    double unitsPerPx() const;

    QSize sizeHint() const override { return {300, 240}; }
    QSize minimumSizeHint() const override { return {120, 90}; }

 protected:
    bool event(QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

 private:
    const SheetPicture* picture() const;
    void zoomAround(QPointF in_view, double factor);
    void panBy(QPointF way);
    void keepReachable();
    /// What does not change while frames are played is painted anew.
    void changeStill();
    void paintStill(const SheetPicture& shown);
    void paintTint(QPainter& painter, const SheetPicture& shown);
    /// Of one track, or of all.
    QVector<QLineF> waysOf(const SheetPicture& shown, std::optional<TrackId> track) const;

    std::function<void(QPointF)> ask_;
    std::shared_ptr<const MosaicPicture> mosaic_;
    int sheet_ = -1;
    QPixmap still_;  ///< the sheet and all ways, as they lie in the view; null: to be painted
    CoverageLook coverage_look_ = CoverageLook::none;
    QImage tint_;  ///< by coverage_look_; null: to be made
    OverlayColours colours_ = overlayColours(PaletteKind::thesis);
    FrameIndex frame_ = -1;
    std::optional<TrackId> selected_;
    std::optional<QPointF> place_;
    double scale_ = 1;      ///< view px per px of the picture
    QPointF origin_{0, 0};  ///< of the picture in the view
    bool fitted_ = true;
    std::optional<QPointF> drag_from_;
    QPointF pressed_at_;
    bool dragged_ = false;
};

}  // namespace eyrie::ui
