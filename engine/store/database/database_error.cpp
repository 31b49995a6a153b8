#include "store/database/database_error.h"

#include <sqlite3.h>

namespace eyrie {
namespace {

bool isFailureToRead(int extended_code) {
    switch (extended_code) {
        case SQLITE_IOERR_READ:
        case SQLITE_IOERR_SHORT_READ:
        case SQLITE_IOERR_CORRUPTFS:
        case SQLITE_IOERR_DATA:
            return true;
        default:
            return false;
    }
}

}  // namespace

Error damagedProject(const std::filesystem::path& path, const std::string& what) {
    return Error(ErrorKind::project,
                 "the project " + path.string() + " is damaged (" + what +
                     "); restore an earlier state, or save what can be read with eyrie-cli check --repair");
}

Error databaseError(const std::filesystem::path& path, const std::string& doing, const SQLite::Exception& exception) {
    const std::string file = path.string();
    const std::string why = doing + ": " + exception.what();
    switch (exception.getErrorCode()) {
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            return Error(ErrorKind::project, "the project " + file + " is in use by another program (" + why +
                                                 "); close that program or wait until it is done");
        case SQLITE_FULL:
            return Error(ErrorKind::output, "the disk is full while writing " + file + " (" + why +
                                                "); free some space and run again; what was stored before is kept");
        case SQLITE_READONLY:
        case SQLITE_PERM:
        case SQLITE_AUTH:
            return Error(ErrorKind::output,
                         "the project " + file + " cannot be written (" + why + "); check the file's permissions");
        case SQLITE_CANTOPEN:
            return Error(ErrorKind::project, "the project " + file + " cannot be opened (" + why +
                                                 "); check that file and folder may be read and written");
        case SQLITE_IOERR:
            if (!isFailureToRead(exception.getExtendedErrorCode())) {
                return Error(ErrorKind::output, "the disk refuses to write " + file + " (" + why +
                                                    "); check the disk, its free space and quota");
            }
            break;
        case SQLITE_NOMEM:
            return Error(ErrorKind::project,
                         "not enough memory for the project " + file + " (" + why + "); close other programs");
        case SQLITE_CONSTRAINT:
            if (exception.getExtendedErrorCode() == SQLITE_CONSTRAINT_FOREIGNKEY) {
                return Error(ErrorKind::project, "the run was removed from the project " + file +
                                                     " while it was being written (" + why + "); run it again");
            }
            return Error(ErrorKind::internal, "contradictory data for the project " + file + " (" + why + ")");
        case SQLITE_MISUSE:
        case SQLITE_RANGE:
            return Error(ErrorKind::internal, "misused project " + file + " (" + why + ")");
        default:
            break;
    }
    return damagedProject(path, why);
}

}  // namespace eyrie
