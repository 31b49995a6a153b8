#pragma once

#include <QImage>
#include <QObject>
#include <QRectF>
#include <functional>
#include <memory>
#include <vector>

#include "ground/ground_coverage.h"
#include "ground/place_history.h"
#include "session/background/background_query.h"
#include "session/project/media.h"

namespace eyrie::ui {

struct RunGround;

/// One sheet of ground as it can be shown.
struct SheetPicture {
    QImage image;
    QRectF area;  ///< of the sheet, in its unit
    double px_per_unit = 1;
    std::shared_ptr<const std::vector<SheetPath>> paths;  ///< never null in what is shown

    QPointF imageFromSheet(QPointF on_sheet) const { return (on_sheet - area.topLeft()) * px_per_unit; }
    QPointF sheetFromImage(QPointF in_image) const { return in_image / px_per_unit + area.topLeft(); }
};

/// The ground that a run saw, as far as it is laid out. Made in the background, then never changed.
struct MosaicPicture {
    std::shared_ptr<const RunGround> ground;
    std::shared_ptr<const GroundSheets> sheets;
    std::vector<SheetPicture> pictures;                          ///< by sheet
    std::shared_ptr<const std::vector<SheetCoverage>> coverage;  ///< by sheet, of the whole run from the beginning on
    double share = 0;                                            ///< of the work that is done, 0 … 1
};

/// Lays the pictures of a run out on the ground, in the background and in bounded memory; shows what it has now and
/// then.
class MosaicMaker : public QObject {
    Q_OBJECT

 public:
    /// `fail` is told why nothing can be made.
    explicit MosaicMaker(std::function<void(const QString& message)> fail, QObject* parent = nullptr)
        : QObject(parent), fail_(std::move(fail)) {}

    /// Answers with changed(), several times. What was asked for before is given up.
    void make(const std::shared_ptr<const RunGround>& ground, const Media& media);
    void clear();
    /// Null until there is something to be seen.
    const std::shared_ptr<const MosaicPicture>& mosaic() const { return mosaic_; }

 signals:
    void changed();

 private:
    std::function<void(const QString& message)> fail_;
    std::shared_ptr<const MosaicPicture> mosaic_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
