#include "report/packed_report.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace eyrie::packed_report_test {
namespace {

TEST(PackedReport, IsUnpackedAsItWas) {
    ReportFile report;
    report.html = "<p>µ “quotes” <img src=\"a\"></p>";
    report.add("a", ReportPicture::Kind::svg, "<svg/>", 160);
    report.add("b", ReportPicture::Kind::jpeg, std::string("\xff\xd8\0\x80", 4), 42.5);
    const ReportFile again = unpackReport(packReport(report));
    EXPECT_EQ(again.html, report.html);
    ASSERT_EQ(again.pictures.size(), 2U);
    for (const auto& [name, picture] : report.pictures) {
        EXPECT_EQ(again.pictures.at(name).kind, picture.kind);
        EXPECT_EQ(again.pictures.at(name).bytes, picture.bytes);
        EXPECT_EQ(again.pictures.at(name).width_mm, picture.width_mm);
    }
}

TEST(PackedReport, OtherBytesAreRefused) {
    const std::string whole = packReport({"<p></p>", {}});
    for (const std::string& bytes : {std::string(), std::string("no report"), whole.substr(0, whole.size() / 2),
                                     std::string("\xa1\x64html\x01", 7)})
        EXPECT_THROW(unpackReport(bytes), Error);
}

TEST(ReportNames, ThatEndSoArePdf) {
    EXPECT_EQ(kindOfReport("a/r.pdf"), FileKind::pdf);
    EXPECT_EQ(kindOfReport("R.PDF"), FileKind::pdf);
    EXPECT_EQ(kindOfReport("r.html"), FileKind::html);
    EXPECT_EQ(kindOfReport("pdf"), FileKind::html);
}

}  // namespace
}  // namespace eyrie::packed_report_test
