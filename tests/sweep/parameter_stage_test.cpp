#include "sweep/plan/parameter_stage.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace eyrie {
namespace {

TEST(ParameterStage, EveryDeclaredParameterBelongsToAStage) {
    ChainOptions options;
    SweepStage last = SweepStage::registration;
    for (const Parameter& parameter : listParameters(describeOf(options))) {
        SweepStage stage = last;
        ASSERT_NO_THROW(stage = firstStageOf(parameter.name)) << parameter.name;
        EXPECT_GE(stage, last) << parameter.name << " is declared behind a later stage";
        last = stage;
    }
    EXPECT_EQ(last, SweepStage::finishing);
    EXPECT_EQ(firstStageOf("motion.method"), SweepStage::clustering);
    EXPECT_EQ(firstStageOf("motion.min_speed"), SweepStage::motion);
}

TEST(ParameterStage, NamesThatBelongToNoStageAreDefects) {
    EXPECT_THROW(firstStageOf("magic.wand"), Error);
    EXPECT_THROW(firstStageOf("motion"), Error);
    EXPECT_THROW(firstStageOf(""), Error);
}

TEST(ParameterStage, SignaturesChangeFromTheFirstStageOn) {
    ChainOptions options;
    ChainOptions changed;
    changed.detection.gradient.quantile = 0.2;
    EXPECT_EQ(signatureUpTo(options, SweepStage::stacking), signatureUpTo(changed, SweepStage::stacking));
    EXPECT_NE(signatureUpTo(options, SweepStage::detection), signatureUpTo(changed, SweepStage::detection));
    EXPECT_NE(signatureUpTo(options, SweepStage::finishing), signatureUpTo(changed, SweepStage::finishing));
    EXPECT_EQ(preparationSignature(options), preparationSignature(changed));
    EXPECT_NE(areaSignature(options), areaSignature(changed));
    changed = {};
    changed.clustering.along_m = 9;
    EXPECT_EQ(areaSignature(options), areaSignature(changed));
    changed = {};
    changed.detection.extend_along = 3;
    EXPECT_NE(preparationSignature(options), preparationSignature(changed));
    changed = {};
    changed.motion.max_speed_m_s = 20;
    EXPECT_NE(areaSignature(options), areaSignature(changed));
    EXPECT_NE(preparationSignature(options), preparationSignature(changed));
}

}  // namespace
}  // namespace eyrie
