#include <cstdint>

#include "core/text.h"
#include "io/atomic_file.h"
#include "report/report_file.h"

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

std::string reportPage(const std::string& title, const std::string& body) {
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + markupEscaped(title) +
           "</title>\n<style>body{font-family:sans-serif;font-size:14px;max-width:900px;margin:24px auto;padding:0 "
           "12px;"
           "color:#222;background:#fff}h1{font-size:22px}h2{font-size:17px;margin-top:28px}h3{font-size:15px;"
           "margin:22px 0 4px}table{border-collapse:collapse;margin:6px 0}th{border-bottom:2px solid "
           "#888;font-size:13px}"
           "td{border-bottom:1px solid #ddd;font-size:13px;vertical-align:middle}img{max-width:100%}"
           "table.event td{border:0;vertical-align:top;padding:0 12px 4px 0}table.event table td{border-bottom:1px "
           "solid "
           "#ddd;padding:2px 8px 2px 0}table.event{break-inside:avoid}h3{break-after:avoid}"
           "@media print{h2.chapter{break-before:page}thead{display:table-header-group}}</style></head>\n"
           "<body><h1>" +
           markupEscaped(title) + "</h1>\n" + body + "</body></html>\n";
}

std::string selfContained(const ReportFile& report) {
    std::string html = report.html;
    for (const auto& [name, picture] : report.pictures) {
        const char* type = picture.kind == ReportPicture::Kind::svg   ? "svg+xml"
                           : picture.kind == ReportPicture::Kind::png ? "png"
                                                                      : "jpeg";
        replaceSource(html, name, std::string("data:image/") + type + ";base64," + base64(picture.bytes));
    }
    return html;
}

FileKind kindOfReport(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    for (char& letter : ending)
        letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    return ending == ".pdf" ? FileKind::pdf : FileKind::html;
}

void writeHtmlReport(const std::filesystem::path& path, const ReportFile& report) {
    writeFileAtomically(path, selfContained(report));
}

}  // namespace eyrie
