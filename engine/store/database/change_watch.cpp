#include "store/database/change_watch.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <utility>

#include "store/database/database_error.h"

namespace eyrie {

bool ChangeWatch::changed() {
    return guarded(project_.path(), "looking for changes", [&] {
        const int version = project_.database().execAndGet("PRAGMA data_version").getInt();
        return std::exchange(version_, version) != version;
    });
}

}  // namespace eyrie
