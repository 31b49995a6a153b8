#include "window/docks/report_printing.h"

#include <fstream>
#include <iterator>

#include "core/error.h"
#include "io/output_files.h"
#include "report/packed_report.h"
#include "window/docks/report_writer.h"

namespace eyrie::ui {

void printPackedReport(const std::filesystem::path& packed, const std::filesystem::path& pdf) {
    filesToReplace({{pdf, FileKind::pdf}}, {});
    std::ifstream file(packed, std::ios::binary);
    if (!file) throw Error(ErrorKind::input, packed.string() + ": cannot be read");
    writePdfReport(pdf, unpackReport({std::istreambuf_iterator<char>(file), {}}));
}

}  // namespace eyrie::ui
