#include "chain/chain_options.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "core/error.h"

namespace eyrie {

TEST(ChainOptions, everyParameterIsNamedOnceAndExplained) {
    ChainOptions options;
    std::set<std::string> names;
    for (const auto& parameter : listParameters(describeOf(options))) {
        EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name << " is declared twice";
        EXPECT_NE(parameter.name.find('.'), std::string::npos) << parameter.name;
        EXPECT_GE(parameter.text.help.size(), 15U) << parameter.name;
    }
}

TEST(ChainOptions, defaultsAndPresetsLieInsideTheirRanges) {
    for (const auto& preset : builtInPresets()) {
        ChainOptions options = builtInPreset(preset);
        ChainOptions copy;
        for (const auto& [name, value] : parameterValues(options)) {
            EXPECT_NO_THROW(setParameter(describeOf(copy), name, value)) << preset << ": " << name;
        }
        EXPECT_EQ(parameterValues(copy), parameterValues(options)) << "saving and loading is the identity";
    }
}

TEST(ChainOptions, theThesisPresetHoldsItsOptima) {
    ChainOptions options = builtInPreset("thesis");
    std::map<std::string, std::string> values;
    for (const auto& [name, value] : parameterValues(options)) values[name] = value;
    EXPECT_EQ(values.at("gradient.quantile"), "0.12");
    EXPECT_EQ(values.at("tracking.min_overlap"), "0.5");
    EXPECT_EQ(values.at("motion.min_age"), "5");
    EXPECT_THROW(builtInPreset("best"), Error);
}

}  // namespace eyrie
