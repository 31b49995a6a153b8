#include "cli/reports/pdf_report.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "cli/child_program.h"
#include "core/error.h"
#include "core/text.h"
#include "io/atomic_file.h"
#include "report/packed_report.h"

namespace eyrie::cli {
namespace {

constexpr auto kLookAtPrinter = std::chrono::milliseconds(20);

/// The program of the window; this one knows nothing of pages and fonts.
std::filesystem::path printerProgram() {
    std::error_code unknown;
    return std::filesystem::read_symlink("/proc/self/exe", unknown).replace_filename("eyrie");
}

/// Bytes that a child reads as a file, and that leave nothing behind.
class HandedBytes {
 public:
    explicit HandedBytes(const std::string& bytes) : file_(memfd_create("report", 0)) {
        std::size_t written = 0;
        while (file_ >= 0 && written < bytes.size()) {
            const ssize_t some = ::write(file_, bytes.data() + written, bytes.size() - written);
            if (some < 0 && errno == EINTR) continue;
            if (some <= 0) break;
            written += static_cast<std::size_t>(some);
        }
        if (file_ < 0 || written < bytes.size()) {
            if (file_ >= 0) ::close(file_);
            throw Error(ErrorKind::output, "there is no memory to hand the report over; close other programs");
        }
    }
    ~HandedBytes() { ::close(file_); }
    HandedBytes(const HandedBytes&) = delete;
    HandedBytes& operator=(const HandedBytes&) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(file_); }

 private:
    int file_;
};

/// Takes away what a printer that was ended, or died, had written so far beside its target.
class NoPartsLeft {
 public:
    explicit NoPartsLeft(std::filesystem::path target) : target_(std::move(target)) {}
    ~NoPartsLeft() { removeAbandonedParts(target_); }
    NoPartsLeft(const NoPartsLeft&) = delete;
    NoPartsLeft& operator=(const NoPartsLeft&) = delete;

 private:
    std::filesystem::path target_;
};

}  // namespace

void checkReportCanBeWritten(const std::filesystem::path& out) {
    if (kindOfReport(out) != FileKind::pdf || ::access(printerProgram().c_str(), X_OK) == 0) return;
    throw Error(ErrorKind::output, displayText(out) + ": PDF is written by the program eyrie, which is not at " +
                                       displayText(printerProgram()) +
                                       "; build it or install it there, or choose a name that ends in .html");
}

bool writeReport(const std::filesystem::path& out, const ReportFile& report, const std::stop_token& stop) {
    if (kindOfReport(out) != FileKind::pdf) {
        writeHtmlReport(out, report);
        return true;
    }
    const HandedBytes packed(packReport(report));
    const std::filesystem::path target = throughLinks(std::filesystem::absolute(out));
    const NoPartsLeft tidy(target);  // before the printer: it has ended by then
    ChildProgram printer({"--print-report", packed.path(), target.string(), "-platform", "offscreen"},
                         printerProgram());
    std::optional<ChildEnd> end;
    while (!(end = printer.ended())) {
        if (stop.stop_requested()) return false;
        std::this_thread::sleep_for(kLookAtPrinter);
    }
    if (end->exit_code == 0 && end->signal == 0) return true;
    // Qt may have warned of something before.
    throw Error(ErrorKind::output, displayText(out) + ": the program eyrie did not write the PDF: " + end->lastWords());
}

}  // namespace eyrie::cli
