#include "review/earth/metadata_model.h"

#include <QApplication>
#include <QFont>
#include <QPalette>
#include <cmath>

#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

QVariant MetadataModel::data(const QModelIndex& index, int role) const {
    const MetadataRow* row = recordAt(index.row());
    if (row == nullptr) return {};
    const int column = index.column();
    switch (role) {
        case Qt::DisplayRole:
            switch (column) {
                case tag_column:
                    return row->is_tag && row->has_number ? QVariant(row->id) : QVariant(QString());
                case name_column:
                    return row->name;
                case value_column:
                    return row->value.isEmpty() ? QStringLiteral("–") : row->value;
                default:
                    return row->is_tag ? tr("%1 %").arg(std::floor(100 * row->sets)) : QString();
            }
        case Qt::ToolTipRole:
            return row->tip.isEmpty() ? QVariant() : QVariant(row->tip);
        case Qt::TextAlignmentRole:
            return column == tag_column ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
        case Qt::ForegroundRole:
            return row->value.isEmpty() ? QVariant(QApplication::palette().brush(QPalette::Disabled, QPalette::Text))
                                        : QVariant();
        case Qt::FontRole: {
            if (row->is_tag) return {};
            QFont font;
            font.setItalic(true);
            return font;
        }
        case sort_role:
            if (column == tag_column) return row->id;
            return column == sets_column ? QVariant(row->sets) : data(index, Qt::DisplayRole);
        case id_role:
            return row->id;
        default:
            return {};
    }
}

QVariant MetadataModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || (role != Qt::DisplayRole && role != Qt::ToolTipRole))
        return RecordModel::headerData(section, orientation, role);
    const bool tip = role == Qt::ToolTipRole;
    switch (section) {
        case tag_column:
            return tip ? tr("Number of the tag in MISB ST 0601; what was worked out from several has none") : tr("Tag");
        case name_column:
            return tip ? QString() : tr("Name");
        case value_column:
            return tip ? tr("At the frame shown; a dash where no set near it holds it") : tr("Value");
        default:
            return tip ? tr("Share of all sets of the stream that hold the tag") : tr("In sets");
    }
}

}  // namespace eyrie::ui

#include "moc_metadata_model.cpp"
