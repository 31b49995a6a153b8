#include <cstdint>

#include "io/atomic_file.h"
#include "report/evaluation_report.h"

namespace eyrie {
namespace {

std::string base64(const std::string& bytes) {
    static constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

void replaceSource(std::string& html, const std::string& name, const std::string& source) {
    const std::string wanted = "src=\"" + name + "\"";
    for (std::size_t at = html.find(wanted); at != std::string::npos; at = html.find(wanted, at + source.size()))
        html.replace(at, wanted.size(), "src=\"" + source + "\"");
}

}  // namespace

std::string selfContained(const EvaluationReportFile& report) {
    std::string html = report.html;
    for (const auto& [name, svg] : report.figures)
        replaceSource(html, name, "data:image/svg+xml;base64," + base64(svg));
    for (const auto& [name, png] : report.chips) replaceSource(html, name, "data:image/png;base64," + base64(png));
    return html;
}

void writeHtmlReport(const std::filesystem::path& path, const EvaluationReportFile& report) {
    writeFileAtomically(path, selfContained(report));
}

}  // namespace eyrie
