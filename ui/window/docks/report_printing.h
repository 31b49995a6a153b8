#pragma once

#include <filesystem>

namespace eyrie::ui {

/// Writes the report that eyrie-cli packed into a file (report/packed_report.h) as PDF, in place of nothing but another
/// PDF. Needs an application without a window. Throws Error(input | output).
void printPackedReport(const std::filesystem::path& packed, const std::filesystem::path& pdf);

}  // namespace eyrie::ui
