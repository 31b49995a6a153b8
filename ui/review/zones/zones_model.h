#pragma once

#include <map>
#include <vector>

#include "core/review/zone.h"
#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// A row: a zone with what came of it.
struct ZoneEntry {
    int id = 0;
    StoredZone stored;
    int events = 0;  ///< in the run shown
};

/// The zones, lines and arrows of a video. Changes nothing itself: what a person writes or ticks is told.
class ZonesModel : public RecordModel<ZoneEntry> {
    Q_OBJECT

 public:
    enum Column { name_column, events_column, anchor_column, column_count };

    explicit ZonesModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setZones(const std::map<int, StoredZone>& zones, const std::map<std::string, int>& events);

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
    void renamed(int id, const QString& name);
    void shownChanged(int id, bool shown);
};

}  // namespace eyrie::ui
