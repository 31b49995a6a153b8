#pragma once

#include <QImage>
#include <QObject>
#include <functional>
#include <optional>

#include "review/pictures/vehicle_pictures.h"
#include "widgets/delayed_call.h"

class QPainter;
class QRect;
class QTableView;

namespace eyrie::ui {

class ProjectSession;
class TablePanel;

/// A column of a list that shows the vehicle of each row. Pictures are read of the rows in view alone, and while the
/// column is shown, rows are as high as these. There are none where the video is missing or is being recorded.
class PictureColumn : public QObject {
    Q_OBJECT

 public:
    static constexpr int kShownWidth = VehiclePictures::kWidth / 2;  ///< logical px
    static constexpr int kShownHeight = VehiclePictures::kHeight / 2;

    /// Which vehicle the row with an id is about; nothing: none. Asked often, for rows in view.
    using PlaceOf = std::function<std::optional<VehiclePlace>(int id)>;

    /// Belongs to the panel; the session must outlive that. `column` of the panel's model.
    PictureColumn(TablePanel& panel, int column, ProjectSession& session, PlaceOf place_of);
    ~PictureColumn() override;

    /// Rows are about other vehicles than before.
    void refresh();
    /// The picture of a row; null while there is none, a null image where it cannot be read. Valid until the next call.
    const QImage* pictureOf(int id);
    /// What stands in a row's cell.
    void paintCell(QPainter& painter, const QRect& cell, int id);

 private:
    /// Whether there is a video to read.
    bool readable() const;
    bool shown() const;
    void followColumn();
    void ask();

    TablePanel& panel_;
    QTableView* table_;
    int column_;
    ProjectSession& session_;
    PlaceOf place_of_;
    int plain_height_;  ///< of a row without pictures, px
    bool was_shown_ = false;
    DelayedCall column_due_;
    DelayedCall ask_due_;
    VehiclePictures pictures_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
