#include "chain/parameter_stage.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace eyrie::parameter_stage_test {
namespace {

TEST(ParameterStage, EveryDeclaredParameterBelongsToAStage) {
    ChainOptions options;
    ChainStage last = ChainStage::registration;
    for (const Parameter& parameter : listParameters(describeOf(options))) {
        ChainStage stage = last;
        ASSERT_NO_THROW(stage = firstStageOf(parameter.name)) << parameter.name;
        EXPECT_GE(stage, last) << parameter.name << " is declared behind a later stage";
        last = stage;
    }
    EXPECT_EQ(last, ChainStage::finishing);
    EXPECT_EQ(firstStageOf("motion.method"), ChainStage::clustering);  // not where its group begins
    EXPECT_EQ(firstStageOf("difference.gap"), ChainStage::clustering);
    EXPECT_EQ(firstStageOf("motion.min_speed"), ChainStage::motion);
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
    EXPECT_EQ(signatureUpTo(options, ChainStage::stacking), signatureUpTo(changed, ChainStage::stacking));
    EXPECT_NE(signatureUpTo(options, ChainStage::detection), signatureUpTo(changed, ChainStage::detection));
    EXPECT_NE(signatureUpTo(options, ChainStage::finishing), signatureUpTo(changed, ChainStage::finishing));
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

TEST(ParameterStage, SignaturesNameEveryParameterThatCounts) {
    ChainOptions options;
    const std::string middle = signatureOf(options, ChainStage::clustering, ChainStage::removal);
    const std::string beginning = signatureUpTo(options, ChainStage::stacking);
    const std::string prepared = preparationSignature(options), areas = areaSignature(options);
    for (const Parameter& parameter : listParameters(describeOf(options))) {
        const ChainStage stage = parameter.effect.stage;
        const auto isIn = [&](const std::string& signature) {
            return ("\n" + signature).find("\n" + parameter.name + "=" + parameter.value + "\n") != std::string::npos;
        };
        EXPECT_EQ(isIn(middle), stage >= ChainStage::clustering && stage <= ChainStage::removal) << parameter.name;
        EXPECT_EQ(isIn(beginning), stage <= ChainStage::stacking) << parameter.name;
        const bool moves = stage == ChainStage::registration || stage == ChainStage::motion;
        EXPECT_EQ(isIn(areas), moves || stage == ChainStage::detection) << parameter.name;
        EXPECT_EQ(isIn(prepared), moves || (stage == ChainStage::detection && !parameter.effect.decision_only))
            << parameter.name;
    }
}

TEST(ParameterStage, TheFirstDifferenceIsThatOfTheEarliestStage) {
    ChainOptions a;
    ChainOptions b;
    EXPECT_EQ(firstDifference(a, b), ChainStage::none);
    b.tracking.min_overlap = 0.3;
    EXPECT_EQ(firstDifference(a, b), ChainStage::tracking);
    b.outliers.min_vectors = 7;
    EXPECT_EQ(firstDifference(a, b), ChainStage::removal);
    b.detection.gradient.quantile = 0.2;
    EXPECT_EQ(firstDifference(a, b), ChainStage::detection);
    b.stacking.enabled = !b.stacking.enabled;
    EXPECT_EQ(firstDifference(a, b), ChainStage::stacking);
    b.difference.method = MotionMethod::two_frame_difference;
    EXPECT_EQ(firstDifference(a, b), ChainStage::clustering);
    b.motion.min_age = 7;
    EXPECT_EQ(firstDifference(a, b), ChainStage::motion);
    b.registration.corners.corner_spacing_m = 1;
    EXPECT_EQ(firstDifference(a, b), ChainStage::registration);
}

}  // namespace
}  // namespace eyrie::parameter_stage_test
