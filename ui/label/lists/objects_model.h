#pragma once

#include <QColor>
#include <QString>
#include <vector>

#include "core/labels/annotation.h"
#include "core/values/scene_scale.h"
#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// A labelled object as lists show it.
struct ObjectRow {
    int id = 0;
    QString object_class;
    QColor colour;
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;
    int keyframes = 0;
    int computed = 0;         ///< of the keyframes: those that no hand set or confirmed
    double speed_px = 0;      ///< mean, px/frame over the ground
    cv::Point2d place{0, 0};  ///< mean of its keyframes' centres: where the scale is asked for
    ReviewState state = ReviewState::unseen;
    double checked_share = 0;  ///< of its frames
    ObjectOrigin origin = ObjectOrigin::hand;
    QString notes;
};

/// For people: "checked", "34 % checked", "questionable", "new".
QString reviewText(const ObjectRow& row);
/// Where an object and its keyframes come from: "by hand", "by hand, then computed" …
QString originText(ObjectOrigin origin, int keyframes, int computed);
/// "1 keyframe", "5 keyframes, 4 of them computed".
QString keyframesText(int keyframes, int computed);

/// The labelled objects of a video, one row each, ascending id.
class ObjectsModel : public RecordModel<ObjectRow> {
    Q_OBJECT
 public:
    enum Column {
        id_column,
        class_column,
        first_column,
        last_column,
        keyframes_column,
        life_column,
        speed_column,
        state_column,
        origin_column,
        notes_column,
        column_count
    };

    explicit ObjectsModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setObjects(std::vector<ObjectRow> objects, const SceneScale& scale);

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    double secondsOf(const ObjectRow& row) const;
    /// As the column shows it.
    double shownSpeedOf(const ObjectRow& row) const;
    const SceneScale& scale() const { return scale_; }

 private:
    QString textOf(const ObjectRow& row, int column) const;
    /// What a column holds, for its title's tooltip.
    QString helpOf(int column) const;
    QVariant sortValueOf(const ObjectRow& row, int column) const;
    SceneScale scale_;
};

}  // namespace eyrie::ui
