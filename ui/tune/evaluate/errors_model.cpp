#include "tune/evaluate/errors_model.h"

#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

void ErrorsModel::setErrors(std::vector<ErrorRow> rows) {
    replaceRecords(std::move(rows));
}

void ErrorsModel::setChip(int id, const QImage& chip) {
    chips_[id] = chip;
    const int row = rowOf(id);
    if (row >= 0) emit dataChanged(index(row, chip_column), index(row, chip_column), {Qt::DecorationRole});
}

void ErrorsModel::clearChips() {
    chips_.clear();
    if (rowCount() > 0)
        emit dataChanged(index(0, chip_column), index(rowCount() - 1, chip_column), {Qt::DecorationRole});
}

QVariant ErrorsModel::data(const QModelIndex& index, int role) const {
    const ErrorRow* row = recordAt(index.row());
    if (row == nullptr || !index.isValid()) return {};
    switch (role) {
        case Qt::DisplayRole:
            return textOf(*row, index.column());
        case Qt::DecorationRole: {
            if (index.column() != chip_column) return {};
            const auto chip = chips_.find(row->id);
            return chip == chips_.end() ? QVariant() : QVariant(chip->second);
        }
        case Qt::SizeHintRole:
            return index.column() == chip_column ? QVariant(QSize(64, 40)) : QVariant();
        case Qt::ToolTipRole:
            return tr("<b>%1</b>: %2. %3%4")
                .arg(row->kind, row->cause, row->explanation,
                     row->detail.isEmpty() ? QString() : QStringLiteral("<br>%1").arg(row->detail.toHtmlEscaped()));
        case Qt::TextAlignmentRole:
            return index.column() == frame_column || index.column() == count_column ||
                           index.column() == object_column || index.column() == track_column
                       ? QVariant(Qt::AlignRight | Qt::AlignVCenter)
                       : QVariant(Qt::AlignLeft | Qt::AlignVCenter);
        case sort_role:
            return sortValueOf(*row, index.column());
        case id_role:
            return row->id;
        default:
            return {};
    }
}

QString ErrorsModel::textOf(const ErrorRow& row, int column) const {
    switch (column) {
        case kind_column:
            return row.kind;
        case frame_column:
            return row.first_frame == row.last_frame ? QString::number(row.first_frame)
                                                     : QStringLiteral("%1–%2").arg(row.first_frame).arg(row.last_frame);
        case count_column:
            return QString::number(row.count);
        case object_column:
            return row.objects;
        case track_column:
            return row.tracks;
        case cause_column:
            return row.cause;
        case detail_column:
            return row.detail;
        default:
            return {};
    }
}

QVariant ErrorsModel::sortValueOf(const ErrorRow& row, int column) const {
    switch (column) {
        case chip_column:
        case frame_column:
            return row.first_frame;
        case kind_column:
            return row.kind_order;
        case count_column:
            return row.count;
        case object_column:
            return row.object_order;
        default:
            return textOf(row, column);
    }
}

QString ErrorsModel::helpOf(int column) const {
    switch (column) {
        case chip_column:
            return tr("The place of the error in the video");
        case frame_column:
            return tr("First and last frame of the error");
        case count_column:
            return tr("Boxes or events that the error counts");
        case object_column:
            return tr("Objects of the ground truth");
        case track_column:
            return tr("Tracks of the run");
        case cause_column:
            return tr("Last stage that still had the object: the probable cause, not a proven one");
        default:
            return {};
    }
}

QVariant ErrorsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation == Qt::Horizontal && role == Qt::ToolTipRole) return helpOf(section);
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return RecordModel::headerData(section, orientation, role);
    switch (section) {
        case chip_column:
            return tr("Chip");
        case kind_column:
            return tr("Kind");
        case frame_column:
            return tr("Frames");
        case count_column:
            return tr("Count");
        case object_column:
            return tr("Object");
        case track_column:
            return tr("Track");
        case cause_column:
            return tr("Cause");
        case detail_column:
            return tr("Detail");
        default:
            return {};
    }
}

}  // namespace eyrie::ui

#include "moc_errors_model.cpp"
