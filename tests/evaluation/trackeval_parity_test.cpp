#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "evaluation/evaluate.h"
#include "formats/mot/motchallenge.h"
#include "support/shared_data.h"

namespace eyrie::trackeval_parity_test {
namespace {

/// All figures of a sequence under TrackEval's own names.
std::map<std::string, double> underTrackEvalNames(const Measures& m) {
    const DetectionMeasures& d = m.detection;
    const TrackingMeasures& t = m.tracking.value();
    const IdentityMeasures& i = m.identity.value();
    const HotaMeasures& h = m.hota.value();
    const double tracks = t.truth_tracks;
    return {
        {"CLEAR.CLR_F1", d.f_score},
        {"CLEAR.CLR_FN", d.false_negatives},
        {"CLEAR.CLR_FP", d.false_positives},
        {"CLEAR.CLR_Frames", d.frames},
        {"CLEAR.CLR_Pr", d.precision},
        {"CLEAR.CLR_Re", d.recall},
        {"CLEAR.CLR_TP", d.true_positives},
        {"CLEAR.FP_per_frame", d.false_positives_per_frame},
        {"CLEAR.Frag", t.fragments},
        {"CLEAR.IDSW", t.id_switches},
        {"CLEAR.ML", t.mostly_lost},
        {"CLEAR.MLR", t.mostly_lost / tracks},
        {"CLEAR.MODA", d.n_moda},
        {"CLEAR.MOTA", t.mota},
        {"CLEAR.MOTAL", t.mota_log},
        {"CLEAR.MOTP", t.motp},
        {"CLEAR.MOTP_sum", d.overlap_sum},
        {"CLEAR.MT", t.mostly_tracked},
        {"CLEAR.MTR", t.mostly_tracked / tracks},
        {"CLEAR.PT", t.partially_tracked},
        {"CLEAR.PTR", t.partially_tracked / tracks},
        {"CLEAR.sMOTA", t.mota_soft},
        {"HOTA.AssA", meanOf(h.ass_a)},
        {"HOTA.AssPr", meanOf(h.ass_pr)},
        {"HOTA.AssRe", meanOf(h.ass_re)},
        {"HOTA.DetA", meanOf(h.det_a)},
        {"HOTA.DetPr", meanOf(h.det_pr)},
        {"HOTA.DetRe", meanOf(h.det_re)},
        {"HOTA.HOTA", meanOf(h.hota)},
        {"HOTA.HOTA(0)", h.hota[0]},
        {"HOTA.HOTALocA(0)", h.hota[0] * h.loc_a[0]},
        {"HOTA.HOTA_FN", meanOf(h.false_negatives)},
        {"HOTA.HOTA_FP", meanOf(h.false_positives)},
        {"HOTA.HOTA_TP", meanOf(h.true_positives)},
        {"HOTA.LocA", meanOf(h.loc_a)},
        {"HOTA.LocA(0)", h.loc_a[0]},
        {"HOTA.OWTA", meanOf(h.owta)},
        {"Identity.IDF1", i.idf1},
        {"Identity.IDFN", i.idfn},
        {"Identity.IDFP", i.idfp},
        {"Identity.IDP", i.idp},
        {"Identity.IDR", i.idr},
        {"Identity.IDTP", i.idtp},
    };
}

class TrackEvalParity : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(TrackEvalParity, EveryFigureAgrees) {
    EYRIE_NEED_SHARED_DATA("trackeval_parity");
    const auto [sequence, overlap] = GetParam();
    const auto folder = test::sharedData("trackeval_parity") / sequence;
    EvaluationOptions options;
    options.overlap = std::stod(overlap);
    options.convention = Convention::trackeval;
    options.frame_count = readMotSequence(folder / "seqinfo.ini").frame_count;
    const auto ours = underTrackEvalNames(
        evaluate(plainBoxes(readMotTruth(folder / "gt.txt")), readMotResult(folder / "result.txt"), options));

    const auto name = std::string("expected_iou_") + overlap + ".json";
    const auto theirs = nlohmann::json::parse(std::ifstream(folder / name));
    ASSERT_GT(theirs.size(), 40u);
    for (const auto& [key, value] : theirs.items()) {
        ASSERT_TRUE(ours.contains(key)) << key;
        EXPECT_NEAR(ours.at(key), value.get<double>(), 1e-4) << key;
    }
}

INSTANTIATE_TEST_SUITE_P(Sequences, TrackEvalParity,
                         testing::Combine(testing::Values("clean", "noisy", "harsh"), testing::Values("0.3", "0.5")));

}  // namespace
}  // namespace eyrie::trackeval_parity_test
