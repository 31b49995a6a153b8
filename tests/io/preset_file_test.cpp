#include "io/tables/preset_file.h"

#include <gmock/gmock.h>

#include "io/numbered_video.h"
#include "support/temporary_folder.h"

namespace eyrie::preset_file_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class PresetFile : public testing::Test {
 protected:
    Preset read(const std::string& text) {
        test::writeBytes(folder_ / "p.json", text);
        return readPreset(folder_ / "p.json");
    }
    std::string refusal(const std::string& text) {
        return test::messageOf(ErrorKind::input, [&] { read(text); });
    }
    test::TemporaryFolder folder_;
};

TEST_F(PresetFile, NumbersTruthValuesAndTextBecomeText) {
    const Preset preset = read(R"({"eyrie_preset": 1, "name": "mine", "note": [1, {"a": 2}], "parameters": {
        "b.speed": 1.0, "a.count": 7, "a.small": 1e-7, "a.flag": true, "a.off": false, "a.method": "canny"}})");
    EXPECT_EQ(preset.name, "mine");
    EXPECT_THAT(preset.values, ElementsAre(Pair("b.speed", "1"), Pair("a.count", "7"), Pair("a.small", "1e-07"),
                                           Pair("a.flag", "true"), Pair("a.off", "false"), Pair("a.method", "canny")));
}

TEST_F(PresetFile, SurvivesTheRoundTrip) {
    const Preset preset{"a \"quoted\" name",
                        {{"z.real", "0.1"},
                         {"b.whole", "12"},
                         {"a.tiny", "1e-07"},
                         {"a.flag", "true"},
                         {"m.choice", "007"},
                         {"m.text", "none"},
                         {"m.odd", "0.10"},
                         {"m.huge", "1e999"},
                         {"m.neg", "-3"},
                         {"m.empty", ""}}};
    writePreset(folder_ / "p.json", preset);
    const Preset back = readPreset(folder_ / "p.json");
    EXPECT_EQ(back.name, preset.name);
    EXPECT_EQ(back.values, preset.values);
    EXPECT_THAT(test::bytesOf(folder_ / "p.json"),
                AllOf(HasSubstr("\"z.real\": 0.1,"), HasSubstr("\"a.flag\": true"), HasSubstr("\"eyrie_preset\": 1")));
}

TEST_F(PresetFile, MalformedTextIsRefusedWithItsPlace) {
    EXPECT_THAT(refusal(""), HasSubstr("p.json"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1,\n \"name\" \"x\"}"),
                AllOf(HasSubstr("p.json: line 2, column 11"), HasSubstr("JSON")));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"parameters\": {\"a\": nan}}"), HasSubstr("line 1, column 42"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"parameters\": {\"a\": 1}"), HasSubstr("JSON"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"parameters\": {\"a\": 1e999}}"), HasSubstr("out of range"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"parameters\": {\"a\": 1, \"a\": 2}}"),
                HasSubstr("\"a\" is there twice"));
    EXPECT_THAT(refusal("\xff\xfe\x00"), HasSubstr("JSON"));
}

TEST_F(PresetFile, WhatIsNoPresetIsRefused) {
    EXPECT_THAT(refusal("[]"), HasSubstr("not a preset"));
    EXPECT_THAT(refusal("{\"name\": \"x\"}"), HasSubstr("not a preset"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 2, \"parameters\": {}}"), HasSubstr("newer"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": \"1\", \"parameters\": {}}"), HasSubstr("eyrie_preset = \"1\""));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 0, \"parameters\": {}}"), HasSubstr("eyrie_preset = 0"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1}"), HasSubstr("\"parameters\""));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"parameters\": [1]}"), HasSubstr("\"parameters\""));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"name\": 3, \"parameters\": {}}"), HasSubstr("name = 3"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"parameters\": {\"a.b\": [1]}}"), HasSubstr("a.b = [1]"));
    EXPECT_THAT(refusal("{\"eyrie_preset\": 1, \"parameters\": {\"a.b\": null}}"), HasSubstr("a.b = null"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { readPreset(folder_ / "none.json"); }), HasSubstr("none.json"));
}

TEST_F(PresetFile, FoldersThatCannotBeWritten) {
    test::messageOf(ErrorKind::output, [&] { writePreset(folder_ / "none" / "p.json", {}); });
}

}  // namespace
}  // namespace eyrie::preset_file_test
