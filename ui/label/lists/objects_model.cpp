#include "label/lists/objects_model.h"

#include "widgets/display_text.h"
#include "widgets/swatch.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

QString reviewText(const ObjectRow& row) {
    if (row.state == ReviewState::questionable) return ObjectsModel::tr("questionable");
    if (row.state == ReviewState::checked) return ObjectsModel::tr("checked");
    if (row.checked_share > 0) return ObjectsModel::tr("%1 % checked").arg(qRound(100 * row.checked_share));
    return ObjectsModel::tr("new");
}

QString keyframesText(int keyframes, int computed) {
    const QString text =
        keyframes == 1 ? ObjectsModel::tr("1 keyframe") : ObjectsModel::tr("%1 keyframes").arg(keyframes);
    if (computed == 0) return text;
    return computed == keyframes ? ObjectsModel::tr("%1, computed").arg(text)
                                 : ObjectsModel::tr("%1, %2 of them computed").arg(text).arg(computed);
}

QString originText(ObjectOrigin origin, int keyframes, int computed) {
    switch (origin) {
        case ObjectOrigin::hand:
            if (computed == 0) return ObjectsModel::tr("by hand");
            return computed == keyframes ? ObjectsModel::tr("computed") : ObjectsModel::tr("by hand, then computed");
        case ObjectOrigin::proposal_accepted:
            return ObjectsModel::tr("proposal");
        case ObjectOrigin::proposal_corrected:
            return ObjectsModel::tr("corrected");
        case ObjectOrigin::imported:
            return ObjectsModel::tr("imported");
    }
    return {};
}

void ObjectsModel::setObjects(std::vector<ObjectRow> objects, const SceneScale& scale) {
    const bool other_units = scale.gsd_known != scale_.gsd_known;
    scale_ = scale;
    replaceRecords(std::move(objects));
    if (other_units) emit headerDataChanged(Qt::Horizontal, 0, column_count - 1);
}

double ObjectsModel::secondsOf(const ObjectRow& row) const {
    return scale_.frame_rate_hz > 0 ? (row.last_frame - row.first_frame + 1) / scale_.frame_rate_hz : 0;
}

double ObjectsModel::shownSpeedOf(const ObjectRow& row) const {
    return shownSpeed(row.speed_px, scale_.zoomed(scale_.zoom.meanOf(row.first_frame, row.last_frame)).at(row.place));
}

QVariant ObjectsModel::data(const QModelIndex& index, int role) const {
    const ObjectRow* row = recordAt(index.row());
    if (row == nullptr || !index.isValid()) return {};
    switch (role) {
        case Qt::DisplayRole:
            return textOf(*row, index.column());
        case Qt::DecorationRole:
            return index.column() == class_column ? QVariant(swatch(row->colour, 12)) : QVariant();
        case Qt::ToolTipRole:
            return tr("%1 %2: frames %3 to %4, %5. Origin: %6. Click to go to it.")
                .arg(row->object_class)
                .arg(row->id)
                .arg(row->first_frame)
                .arg(row->last_frame)
                .arg(keyframesText(row->keyframes, row->computed),
                     originText(row->origin, row->keyframes, row->computed));
        case Qt::TextAlignmentRole: {
            const int column = index.column();
            const bool words = column == class_column || column >= state_column;
            return words ? QVariant() : QVariant(Qt::AlignRight | Qt::AlignVCenter);
        }
        case sort_role:
            return sortValueOf(*row, index.column());
        case id_role:
            return row->id;
        default:
            return {};
    }
}

QString ObjectsModel::textOf(const ObjectRow& row, int column) const {
    switch (column) {
        case id_column:
            return QString::number(row.id);
        case class_column:
            return row.object_class;
        case first_column:
            return QString::number(row.first_frame);
        case last_column:
            return QString::number(row.last_frame);
        case keyframes_column:
            return QString::number(row.keyframes);
        case life_column:
            return numberText(secondsOf(row), 1);
        case speed_column:
            return numberText(shownSpeedOf(row), scale_.gsd_known ? 1 : 2);
        case state_column:
            return reviewText(row);
        case origin_column:
            return originText(row.origin, row.keyframes, row.computed);
        case notes_column:
            return row.notes;
        default:
            return {};
    }
}

QVariant ObjectsModel::sortValueOf(const ObjectRow& row, int column) const {
    switch (column) {
        case id_column:
            return row.id;
        case first_column:
            return row.first_frame;
        case last_column:
            return row.last_frame;
        case keyframes_column:
            return row.keyframes;
        case life_column:
            return row.last_frame - row.first_frame;
        case speed_column:
            return shownSpeedOf(row);
        case state_column:
            return row.state == ReviewState::questionable ? -1.0
                   : row.state == ReviewState::checked    ? 2.0
                                                          : row.checked_share;
        default:
            return textOf(row, column);
    }
}

QString ObjectsModel::helpOf(int column) const {
    switch (column) {
        case id_column:
            return tr("Number of the object");
        case first_column:
            return tr("First frame");
        case last_column:
            return tr("Last frame");
        case keyframes_column:
            return tr("Number of keyframes, set by hand or computed");
        case life_column:
            return tr("From first to last frame, in seconds");
        case speed_column:
            return tr("Mean speed over the ground, in %1").arg(speedUnit(scale_));
        case state_column:
            return tr("Review: new (not checked), partly or fully checked, or questionable");
        case origin_column:
            return tr(
                "Drawn by hand, drawn by hand and then tracked (computed), accepted from a run, corrected since then, "
                "or "
                "imported");
        default:
            return {};
    }
}

QVariant ObjectsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation == Qt::Horizontal && role == Qt::ToolTipRole) return helpOf(section);
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return RecordModel::headerData(section, orientation, role);
    switch (section) {
        case id_column:
            return tr("Id");
        case class_column:
            return tr("Class");
        case first_column:
            return tr("First");
        case last_column:
            return tr("Last");
        case keyframes_column:
            return tr("Keys");
        case life_column:
            return tr("Life (s)");
        case speed_column:
            return tr("Speed (%1)").arg(speedUnit(scale_));
        case state_column:
            return tr("State");
        case origin_column:
            return tr("Origin");
        case notes_column:
            return tr("Notes");
        default:
            return {};
    }
}

}  // namespace eyrie::ui

#include "moc_objects_model.cpp"
