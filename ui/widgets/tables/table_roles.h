#pragma once

#include <Qt>

namespace eyrie::ui {

/// Roles that every table of ours answers besides Qt's own.
enum TableRole {
    sort_role = Qt::UserRole,  ///< what to sort by: a number wherever the text shows one
    id_role                    ///< the run's or track's number, in every column
};

}  // namespace eyrie::ui
