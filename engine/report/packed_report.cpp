#include "report/packed_report.h"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.h"

namespace eyrie {
namespace {

using Packed = nlohmann::json;

Packed bytesAsValue(const std::string& bytes) {
    return Packed::binary(std::vector<std::uint8_t>(bytes.begin(), bytes.end()));
}

std::string bytesOfValue(const Packed& value) {
    const auto& bytes = value.get_binary();
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string packReport(const ReportFile& report) {
    Packed pictures = Packed::object();
    for (const auto& [name, picture] : report.pictures)
        pictures[name] = {{"kind", static_cast<int>(picture.kind)},
                          {"width_mm", picture.width_mm},
                          {"bytes", bytesAsValue(picture.bytes)}};
    const std::vector<std::uint8_t> packed =
        Packed::to_cbor({{"html", bytesAsValue(report.html)}, {"pictures", std::move(pictures)}});
    return {packed.begin(), packed.end()};
}

ReportFile unpackReport(const std::string& bytes) {
    try {
        const Packed packed = Packed::from_cbor(bytes);
        ReportFile report;
        report.html = bytesOfValue(packed.at("html"));
        for (const auto& [name, picture] : packed.at("pictures").items()) {
            const int kind = picture.at("kind").get<int>();
            if (kind < 0 || kind > static_cast<int>(ReportPicture::Kind::jpeg))
                throw Error(ErrorKind::input, "the report has a picture of an unknown kind");
            report.add(name, static_cast<ReportPicture::Kind>(kind), bytesOfValue(picture.at("bytes")),
                       picture.at("width_mm").get<double>());
        }
        return report;
    } catch (const nlohmann::json::exception&) {
        throw Error(ErrorKind::input, "what should be printed is no report that eyrie-cli handed over");
    }
}

}  // namespace eyrie
