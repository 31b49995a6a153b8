#include "cli/batch/batch_rows.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"

namespace eyrie::cli {

const char* nameOf(BatchState state) {
    switch (state) {
        case BatchState::waiting:
            return "waiting";
        case BatchState::working:
            return "working";
        case BatchState::done:
            return "done";
        case BatchState::done_before:
            return "done before";
        case BatchState::stopped:
            return "stopped";
        case BatchState::failed:
            return "failed";
    }
    return "";
}

void writeBatchSummary(const std::filesystem::path& path, const std::vector<BatchRow>& rows) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::fixed << std::setprecision(1) << "file,project,state,frames,unregistered,tracks,seconds,message\n";
    for (const BatchRow& row : rows) {
        text << csvField(row.input.path.string()) << ',' << csvField(row.project.string()) << ',' << nameOf(row.state)
             << ',' << row.frames << ',' << row.unregistered << ',' << row.tracks << ',' << row.seconds << ','
             << csvField(row.message) << '\n';
    }
    writeFileAtomically(path, text.str());
}

void addToBatchLog(const std::filesystem::path& path, const BatchRow& row) {
    nlohmann::ordered_json entry{{"time", nowUtc()},
                                 {"file", row.input.path.string()},
                                 {"project", row.project.string()},
                                 {"event", nameOf(row.state)}};
    if (row.state != BatchState::working) {
        entry.update({{"frames", row.frames},
                      {"unregistered", row.unregistered},
                      {"tracks", row.tracks},
                      {"seconds", row.seconds},
                      {"message", row.message}});
    }
    // Names of files need not be UTF-8; the log is.
    const std::string line = entry.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    // At once, so that lines of several batches do not mix.
    const bool written = file >= 0 && write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
    const int reason = errno;
    if (file >= 0) close(file);
    if (!written) throw Error(ErrorKind::output, path.string() + ": cannot be written: " + std::strerror(reason));
}

}  // namespace eyrie::cli
