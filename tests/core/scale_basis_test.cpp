#include "core/values/scale_basis.h"

#include <gtest/gtest.h>

namespace eyrie::scale_basis_test {

TEST(ScaleBasis, isWordedWithHowSureItIs) {
    EXPECT_EQ(describe(0.08, {ScaleOrigin::given}), "0.08 m/px, as given");
    EXPECT_EQ(describe(0.033512, {ScaleOrigin::metadata}), "0.03351 m/px, from the video's metadata");
    EXPECT_EQ(describe(0.2104, {ScaleOrigin::estimated, 1.198, 14}),
              "0.21 m/px, estimated from 14 vehicles, right to within a factor of 1.2");
    EXPECT_EQ(describe({ScaleOrigin::estimated, 1.5, 1}), "estimated from 1 vehicle, right to within a factor of 1.5");
    EXPECT_EQ(describe(0.25, {ScaleOrigin::assumed}), "0.25 m/px, assumed, may be far off");
}

TEST(ScaleBasis, ofAnEstimateWithoutFiguresClaimsNone) {
    EXPECT_EQ(describe(0.091, {ScaleOrigin::estimated}), "0.091 m/px, estimated from the traffic");
}

TEST(ScaleBasis, ofAScaleAloneIsWhatItMustBe) {
    SceneScale scale;
    EXPECT_EQ(basisOf(scale).origin, ScaleOrigin::assumed);
    scale.gsd_m_per_px = 0.091;
    EXPECT_EQ(basisOf(scale).origin, ScaleOrigin::estimated);
    scale.gsd_known = true;
    EXPECT_EQ(basisOf(scale).origin, ScaleOrigin::given);
    scale.gsd_m_per_px = 0.25;
    EXPECT_EQ(basisOf(scale).origin, ScaleOrigin::given) << "somebody gave the value that is assumed elsewhere";
}

TEST(ScaleBasis, neverContradictsWhetherTheScaleIsKnown) {
    const ScaleBasis metadata{ScaleOrigin::metadata};
    const ScaleBasis estimate{ScaleOrigin::estimated, 1.3, 5};
    EXPECT_EQ(agreeing(metadata, {0.2, 25, true}), metadata);
    EXPECT_EQ(agreeing(estimate, {0.25, 25, false}), estimate);
    EXPECT_EQ(agreeing(estimate, {0.2, 25, true}), ScaleBasis{ScaleOrigin::given});
    EXPECT_EQ(agreeing(metadata, {0.2, 25, false}), ScaleBasis{ScaleOrigin::estimated});
}

}  // namespace eyrie::scale_basis_test
