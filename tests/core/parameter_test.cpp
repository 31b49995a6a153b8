#include "core/parameter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <type_traits>

#include "support/error_message.h"

namespace eyrie::parameter_test {
namespace {

using test::messageOf;

enum class Method { clusters, gradient };

struct ExampleOptions {
    double quantile = 0.12;
    int height = 25;
    bool enabled = true;
    Method method = Method::gradient;
    std::string model;

    void describe(ParameterVisitor& visitor) {
        const ParameterDeclarer declare(visitor, ChainStage::detection);
        declare.real("example.quantile", quantile, 0, 1, {"", "Share of pixels kept.", ""});
        declare.integer("example.height", height, 1, 500, {"layers", "Stack height.", ""});
        declare.flag("example.enabled", enabled, {"", "On or off.", ""});
        declare.choosesModel().choice("example.method", method, {"clusters", "gradient"}, {"", "Which.", ""});
        declare.decisionOnly().words("example.model", model, {"", "A file.", ""});
    }
};

template <class Visitor>
concept DeclaresByItself = requires(Visitor& visitor, double& value) {
    visitor.real("example.quantile", value, 0.0, 1.0, ParameterText{});
}
|| requires(Visitor& visitor, double& value) {
    visitor.real("example.quantile", ParameterEffect{ChainStage::motion}, value, 0.0, 1.0, ParameterText{});
};
// A parameter without a stage does not compile: a visitor takes none, and a declarer needs a stage.
static_assert(!DeclaresByItself<ParameterVisitor>);
static_assert(DeclaresByItself<const ParameterDeclarer>);
static_assert(!std::is_constructible_v<ParameterDeclarer, ParameterVisitor&>);
static_assert(std::is_constructible_v<ParameterDeclarer, ParameterVisitor&, ChainStage>);

}  // namespace

TEST(Parameter, listsValuesThatReadBackIdentically) {
    ExampleOptions options;
    options.quantile = 0.1 + 0.2;
    ExampleOptions copy;
    for (const auto& p : listParameters(describeOf(options))) setParameter(describeOf(copy), p.name, p.value);
    EXPECT_EQ(copy.quantile, options.quantile);
    EXPECT_EQ(copy.method, Method::gradient);
}

TEST(Parameter, carriesTheStageItWasDeclaredFor) {
    ExampleOptions options;
    for (const Parameter& parameter : listParameters(describeOf(options))) {
        EXPECT_EQ(parameter.effect.stage, ChainStage::detection) << parameter.name;
        EXPECT_EQ(parameter.effect.decision_only, parameter.name == "example.model") << parameter.name;
        EXPECT_EQ(parameter.effect.chooses_model, parameter.name == "example.method") << parameter.name;
    }
}

TEST(Parameter, takesAnyTextWhereOneIsWanted) {
    ExampleOptions options;
    for (const char* path : {"models/a b.model", "true", "12", ""}) {
        setParameter(describeOf(options), "example.model", path);
        EXPECT_EQ(options.model, path);
        EXPECT_EQ(listParameters(describeOf(options)).back().value, path);
    }
    EXPECT_EQ(listParameters(describeOf(options)).back().expected(), "a text");
}

TEST(Parameter, refusesWithNameValueAndRange) {
    ExampleOptions options;
    EXPECT_EQ(messageOf([&] { setParameter(describeOf(options), "example.height", "0"); }),
              "example.height = 0, expected 1..500 layers");
    EXPECT_EQ(messageOf([&] { setParameter(describeOf(options), "example.method", "magic"); }),
              "example.method = magic, expected one of: clusters, gradient");
    for (const char* bad : {"nan", "inf", "-1", "", "0.5x", "1e999"}) {
        EXPECT_THROW(setParameter(describeOf(options), "example.quantile", bad), Error) << bad;
    }
    EXPECT_DOUBLE_EQ(options.quantile, 0.12);
}

TEST(Parameter, takesBothLimitsAndNothingBeyond) {
    ExampleOptions options;
    const auto set = [&](const char* name, const char* value) { setParameter(describeOf(options), name, value); };
    for (const char* good : {"0", "1", "0.5"}) EXPECT_NO_THROW(set("example.quantile", good)) << good;
    for (const char* bad : {"-0.001", "1.001"}) EXPECT_THROW(set("example.quantile", bad), Error) << bad;
    for (const char* good : {"1", "500"}) EXPECT_NO_THROW(set("example.height", good)) << good;
    for (const char* bad : {"501", "2.5", "3x", ""}) EXPECT_THROW(set("example.height", bad), Error) << bad;
    EXPECT_EQ(options.quantile, 0.5);
    EXPECT_EQ(options.height, 500);
}

TEST(Parameter, takesTheWordsOfSwitchesAndChoices) {
    ExampleOptions options;
    const auto set = [&](const char* name, const char* value) { setParameter(describeOf(options), name, value); };
    for (const char* no : {"false", "off", "no", "0"}) {
        options.enabled = true;
        set("example.enabled", no);
        EXPECT_FALSE(options.enabled) << no;
    }
    for (const char* yes : {"true", "on", "yes", "1"}) {
        options.enabled = false;
        set("example.enabled", yes);
        EXPECT_TRUE(options.enabled) << yes;
    }
    EXPECT_THROW(set("example.enabled", "maybe"), Error);
    EXPECT_TRUE(options.enabled) << "as it was";
    set("example.method", "clusters");
    EXPECT_EQ(options.method, Method::clusters);
    set("example.method", "gradient");
    EXPECT_EQ(options.method, Method::gradient);
}

TEST(Parameter, isListedWithItsKindAndLimits) {
    ExampleOptions options;
    const auto listed = listParameters(describeOf(options));
    ASSERT_EQ(listed.size(), 5U);
    const auto limits = [&](std::size_t i) { return std::pair(listed[i].min, listed[i].max); };
    EXPECT_EQ(listed[0].kind, ParameterKind::real);
    EXPECT_EQ(limits(0), std::pair(0.0, 1.0));
    EXPECT_EQ(listed[1].kind, ParameterKind::integer);
    EXPECT_EQ(limits(1), std::pair(1.0, 500.0));
    EXPECT_EQ(listed[2].kind, ParameterKind::flag);
    EXPECT_EQ(limits(2), std::pair(0.0, 1.0));
    EXPECT_EQ(listed[3].kind, ParameterKind::choice);
    EXPECT_EQ(limits(3), std::pair(0.0, 1.0)) << "two words, by their numbers";
    EXPECT_EQ(listed[4].kind, ParameterKind::words);
    EXPECT_EQ(limits(4), std::pair(0.0, 0.0));
}

TEST(Parameter, anUnknownNameSuggestsTheNearest) {
    ExampleOptions options;
    EXPECT_THAT(messageOf([&] { setParameter(describeOf(options), "example.hight", "3"); }),
                testing::HasSubstr("\"example.height\""));
    EXPECT_THAT(messageOf([&] { setParameter(describeOf(options), "example.methxx", "3"); }),
                testing::HasSubstr("\"example.method\""));
    EXPECT_THAT(messageOf([&] { setParameter(describeOf(options), "example.xxxxxx", "3"); }),
                testing::HasSubstr("\"example.height\""))
        << "the first of three that are as near";
}

}  // namespace eyrie::parameter_test
