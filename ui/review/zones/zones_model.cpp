#include "review/zones/zones_model.h"

#include <algorithm>

#include "review/zones/zone_colours.h"
#include "widgets/swatch.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

namespace {
constexpr int kSwatch = 12;  ///< px

QString shapeText(const Zone& zone) {
    switch (zone.shape) {
        case ZoneShape::area:
            break;
        case ZoneShape::line:
            return ZonesModel::tr("A line of %1 points").arg(zone.points.size());
        case ZoneShape::arrow:
            return ZonesModel::tr("An arrow of %1 points: near it, its direction is the right one")
                .arg(zone.points.size());
    }
    return ZonesModel::tr("An area with %1 corners").arg(zone.points.size());
}

}  // namespace

void ZonesModel::setZones(const std::map<int, StoredZone>& zones, const std::map<std::string, int>& events) {
    std::vector<ZoneEntry> entries;
    for (const auto& [id, zone] : zones) {
        const auto found = events.find(zone.zone.name);
        entries.push_back({id, zone, found == events.end() ? 0 : found->second});
    }
    const auto is_same = [](const ZoneEntry& a, const ZoneEntry& b) { return a.stored == b.stored; };
    if (!std::equal(records().begin(), records().end(), entries.begin(), entries.end(), is_same)) {
        replaceRecords(std::move(entries));
        return;
    }
    // Events are found while a name is still being written.
    for (int row = 0; row < rowCount(); ++row) {
        const ZoneEntry& entry = entries[static_cast<std::size_t>(row)];
        if (entry.events != recordAt(row)->events) changeRecord(row, entry, events_column);
    }
}

QVariant ZonesModel::data(const QModelIndex& index, int role) const {
    const ZoneEntry* entry = recordAt(index.row());
    if (entry == nullptr) return {};
    const Zone& zone = entry->stored.zone;
    const int column = index.column();
    switch (role) {
        case Qt::DisplayRole:
        case Qt::EditRole:
            if (column == name_column) return QString::fromStdString(zone.name);
            if (column == events_column) return entry->events;
            return zone.anchor == ZoneAnchor::image ? tr("image") : tr("ground");
        case Qt::DecorationRole:
            return column == name_column ? QVariant(swatch(colourOf(entry->stored), kSwatch)) : QVariant();
        case Qt::CheckStateRole:
            return column == name_column ? QVariant(entry->stored.shown ? Qt::Checked : Qt::Unchecked) : QVariant();
        case Qt::TextAlignmentRole:
            return column == events_column ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
        case Qt::ToolTipRole: {
            const QString what = shapeText(zone);
            const QString where = zone.anchor == ZoneAnchor::image
                                      ? tr("fixed to the image")
                                      : tr("fixed to the ground as frame %1 shows it").arg(zone.frame);
            return QStringLiteral("%1, %2").arg(what, where);
        }
        case id_role:
            return entry->id;
        default:
            return {};
    }
}

QVariant ZonesModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || (role != Qt::DisplayRole && role != Qt::ToolTipRole))
        return RecordModel::headerData(section, orientation, role);
    const bool tip = role == Qt::ToolTipRole;
    switch (section) {
        case name_column:
            return tip ? tr("Ticked: drawn over the video. Events are found in all of them")
                       : tr("Zone, line or arrow");
        case events_column:
            return tip ? tr("Vehicles that entered, left or crossed it, or drove against it, in the run shown")
                       : tr("Events");
        default:
            return tip ? tr("Whether it stays on the ground or in the image when the camera moves") : tr("Fixed to");
    }
}

Qt::ItemFlags ZonesModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags flags = RecordModel::flags(index);
    return index.isValid() && index.column() == name_column ? flags | Qt::ItemIsEditable | Qt::ItemIsUserCheckable
                                                            : flags;
}

bool ZonesModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const ZoneEntry* entry = recordAt(index.row());
    if (entry == nullptr || index.column() != name_column) return false;
    if (role == Qt::CheckStateRole) {
        emit shownChanged(entry->id, value.toInt() == Qt::Checked);
        return true;
    }
    const QString name = value.toString().simplified();
    if (role != Qt::EditRole || name == QString::fromStdString(entry->stored.zone.name)) return false;
    emit renamed(entry->id, name);
    return true;
}

}  // namespace eyrie::ui

#include "moc_zones_model.cpp"
