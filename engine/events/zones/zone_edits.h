#pragma once

#include <functional>
#include <vector>

#include "core/review/review_edit.h"
#include "events/review/judging.h"

/// Steps that change the zones of a project, to be handed to ReviewStore::apply(), which refuses those with a fault or
/// with the name of another. All are pure.
namespace eyrie {

/// One step for all of them. Zones that are there just so already are left out, so that a file read twice adds nothing.
ReviewEdit addZones(const ReviewSet& set, const std::vector<Zone>& zones, const Judge& judge, const NewId& new_id);

/// Changes one zone. Under another name it keeps what was said about its events. Nothing where nothing changes.
ReviewEdit changeZone(const ReviewSet& set, int id, const std::function<void(StoredZone&)>& change, const Judge& judge);

/// One step for all of these; ids that are not there are passed over.
ReviewEdit removeZones(const ReviewSet& set, const std::vector<int>& ids);

/// "zone 1" ("line 1", "arrow 1"), or the next that no zone of the project has.
std::string newZoneName(const ReviewSet& set, ZoneShape shape);

}  // namespace eyrie
