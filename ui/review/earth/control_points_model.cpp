#include "review/earth/control_points_model.h"

#include <QColor>

#include "core/geometry/place_text.h"
#include "widgets/display_text.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

QVariant ControlPointsModel::data(const QModelIndex& index, int role) const {
    const ControlPointRow* row = recordAt(index.row());
    if (row == nullptr) return {};
    const int column = index.column();
    switch (role) {
        case Qt::DisplayRole:
        case Qt::EditRole:
            switch (column) {
                case number_column:
                    return row->id;
                case frame_column:
                    return row->point.frame;
                case place_column:
                    return QString::fromStdString(placeText(row->point.place));
                default:
                    return row->off_m ? tr("%1 m").arg(numberText(*row->off_m, 1)) : QStringLiteral("–");
            }
        case Qt::ToolTipRole: {
            const QString where =
                tr("In frame %1 at %2, %3 px. A double-click goes there; F2 changes latitude and longitude, Delete "
                   "removes the point.")
                    .arg(row->point.frame)
                    .arg(numberText(row->point.px.x, 1), numberText(row->point.px.y, 1));
            return row->suspect ? tr("It contradicts the other points.") + QLatin1Char('\n') + where : where;
        }
        case Qt::ForegroundRole:
            return row->suspect ? QVariant(QColor(0xe0, 0x40, 0x38)) : QVariant();
        case Qt::TextAlignmentRole:
            return column == place_column ? QVariant() : QVariant(Qt::AlignRight | Qt::AlignVCenter);
        case id_role:
            return row->id;
        default:
            return {};
    }
}

QVariant ControlPointsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || (role != Qt::DisplayRole && role != Qt::ToolTipRole))
        return RecordModel::headerData(section, orientation, role);
    const bool tip = role == Qt::ToolTipRole;
    switch (section) {
        case number_column:
            return tip ? tr("As shown beside the cross in the picture") : tr("No.");
        case frame_column:
            return tip ? tr("Where it was set") : tr("Frame");
        case place_column:
            return tip ? tr("Degrees, as maps give them (WGS 84)") : tr("Latitude, longitude");
        default:
            return tip ? tr("How far its place is from where all points together put it; four points always fit")
                       : tr("Off");
    }
}

Qt::ItemFlags ControlPointsModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags flags = RecordModel::flags(index);
    return index.isValid() && index.column() == place_column ? flags | Qt::ItemIsEditable : flags;
}

bool ControlPointsModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const ControlPointRow* row = recordAt(index.row());
    if (row == nullptr || index.column() != place_column || role != Qt::EditRole) return false;
    const QString text = value.toString().trimmed();
    if (text == data(index, Qt::EditRole).toString()) return false;
    emit placeEdited(row->id, text);
    return true;
}

}  // namespace eyrie::ui

#include "moc_control_points_model.cpp"
