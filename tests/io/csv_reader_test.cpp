#include "io/tables/csv_reader.h"

#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "support/temporary_folder.h"

namespace eyrie::csv_reader_test {
namespace {

class CsvFiles : public testing::Test {
 protected:
    CsvReader reading(const std::string& bytes, const std::vector<std::string>& required = {}) const {
        std::ofstream(folder_ / "table.csv", std::ios::binary) << bytes;
        return {folder_ / "table.csv", required};
    }
    /// What is said of the file; `ask` asks for more of the first row.
    template <class Ask>
    std::string refusalOf(const std::string& bytes, const Ask& ask) const {
        try {
            CsvReader reader = reading(bytes, {"a", "b"});
            while (reader.next()) ask(reader);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            const std::string text = error.what();
            const std::string path = (folder_ / "table.csv").string();
            EXPECT_EQ(text.rfind(path, 0), 0U) << text;
            return text.substr(path.size());
        }
        return "";
    }
    std::string refusalOf(const std::string& bytes) const {
        return refusalOf(bytes, [](const CsvReader&) {});
    }
    test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(CsvFiles, FieldsAreFoundByTheNamesOfTheirColumns) {
    CsvReader reader = reading(
        "\xEF\xBB\xBF"
        "a, b ,c\r\n\r\n1,\"two, \"\"2\"\"\",3.5\r\n,,\n",
        {"a", "b"});
    EXPECT_TRUE(reader.has("b"));
    EXPECT_FALSE(reader.has("d"));
    ASSERT_TRUE(reader.next());
    EXPECT_EQ(reader.whole("a"), 1);
    EXPECT_EQ(reader.text("b"), "two, \"2\"");
    EXPECT_EQ(reader.real("c"), 3.5);
    EXPECT_EQ(reader.text("d"), "");
    EXPECT_EQ(reader.real("d", 9.5), 9.5);
    EXPECT_EQ(reader.whole("a", 9), 1) << "where something stands that counts";
    EXPECT_EQ(reader.real("c", 9), 3.5);
    ASSERT_TRUE(reader.next());
    EXPECT_EQ(reader.text("a"), "");
    EXPECT_EQ(reader.whole("a", 9), 9);
    EXPECT_FALSE(reader.next());
    EXPECT_FALSE(reader.next());
}

TEST_F(CsvFiles, QuotedFieldsMayBeAnywhereAndEmpty) {
    CsvReader reader = reading("a,b,c\n\"x\",\"\",\"\"\"\"\n\"y\",,z");
    ASSERT_TRUE(reader.next());
    EXPECT_EQ(reader.text("a"), "x");
    EXPECT_EQ(reader.text("b"), "");
    EXPECT_EQ(reader.text("c"), "\"");
    ASSERT_TRUE(reader.next()) << "without an end of the line";
    EXPECT_EQ(reader.text("a"), "y");
    EXPECT_EQ(reader.text("c"), "z");
}

TEST_F(CsvFiles, WhatIsWrongIsToldWithItsLine) {
    EXPECT_EQ(refusalOf(""), ": the file is empty, expected a line of column names");
    EXPECT_EQ(refusalOf("\n \n"), ": the file is empty, expected a line of column names");
    EXPECT_EQ(refusalOf("a,c\n"), ":1: column b is missing; the first line must name at least a,b");
    EXPECT_EQ(refusalOf("\na,b,a\n"), ":2: column a is there twice");
    EXPECT_EQ(refusalOf("a,b,,\n1,2,3,4\n"), "") << "columns without a name are nobody's";
    EXPECT_EQ(refusalOf("a,b\n1,2\n1,2,3\n"), ":3: the line has 3 fields, the header 2");
    EXPECT_EQ(refusalOf("a,b\n1\n"), ":2: the line has 1 fields, the header 2");
    EXPECT_EQ(refusalOf("a,b\n\"1,2\n"), ":2: a quote is not closed on this line");
    EXPECT_EQ(refusalOf("a,b\n\"1\"x,2\n"), ":2: text follows a closing quote, expected a comma");
    EXPECT_EQ(refusalOf(std::string("a,b\n1,\0\n", 8)),
              ":2: the line holds bytes that are not text; is this a CSV file?");
    EXPECT_EQ(refusalOf("a,b\n1.5,2\n", [](const CsvReader& reader) { reader.whole("a"); }),
              ":2: column a = 1.5, expected a whole number");
    EXPECT_EQ(refusalOf("a,b\n,2\n", [](const CsvReader& reader) { reader.real("a"); }),
              ":2: column a is empty, expected a number");
    EXPECT_EQ(refusalOf("a,b\nx,2\n", [](const CsvReader& reader) { reader.real("a", 1); }),
              ":2: column a = x, expected a number");
    EXPECT_EQ(refusalOf("a,b\n1,2\n", [](const CsvReader& reader) { reader.whole("d"); }),
              ":2: column d is empty, expected a whole number");
}

TEST(CsvField, IsQuotedWhereItMust) {
    EXPECT_EQ(csvField("plain"), "plain");
    EXPECT_EQ(csvField("two words"), "two words");
    EXPECT_EQ(csvField("a,b"), "\"a,b\"");
    EXPECT_EQ(csvField("a\"b"), "\"a\"\"b\"");
    EXPECT_EQ(csvField("a\nb\rc"), "\"a b c\"");
    EXPECT_EQ(csvField(" a"), "\" a\"");
    EXPECT_EQ(csvField("a "), "\"a \"");
    EXPECT_EQ(csvField(""), "");
}

TEST(CsvField, NothingThatASpreadsheetWouldRunIsWrittenAsItIs) {
    for (const char* text : {"=1+1", "+a", "-a", "@a", "\ta", "\ra", "'=1", "''-a"}) {
        EXPECT_EQ(formulaGuarded(text), "'" + std::string(text)) << text;
        EXPECT_EQ(withoutFormulaGuard(formulaGuarded(text)), text);
    }
    for (const char* text : {"-5", "+1.5", "1+1", "a=b", "'a", "'", "", "a'"}) {
        EXPECT_EQ(formulaGuarded(text), text);
        EXPECT_EQ(withoutFormulaGuard(text), text);
    }
    EXPECT_EQ(csvField("=a,b"), "\"'=a,b\"");
}

}  // namespace eyrie::csv_reader_test
