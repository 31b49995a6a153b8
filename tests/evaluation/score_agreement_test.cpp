#include <gtest/gtest.h>

#include <map>
#include <string>

#include "evaluation/evaluate.h"
#include "evaluation_boxes.h"

/// The independent scorer that acceptance uses was run once over the scene below; its figures stand here. The scene is
/// drawn with whole numbers, so that any language makes the same one.
namespace eyrie::score_agreement_test {
namespace {

/// Numbers in [0, bound) from a linear congruence.
class Draw {
 public:
    int operator()(int bound) {
        state_ = (state_ * 1103515245u + 12345u) % 2147483648u;
        return static_cast<int>(state_ / 65536u) % bound;
    }

 private:
    std::uint64_t state_ = 2026;
};

struct Scene {
    BoxesByFrame truth;
    BoxesByFrame result;
};

/// Twelve vehicles that turn and cross over 40 frames, some ignored, some of another class; a result that misses,
/// strays, swaps ids and invents.
Scene drawScene() {
    Draw draw;
    Scene scene;
    for (int frame = 0; frame < 40; ++frame) {
        if (frame == 17) continue;  // a frame without ground truth
        for (int k = 0; k < 12; ++k) {
            BoxRecord object;
            object.frame = frame;
            object.id = k;
            object.box = {{20.0 + 9 * k + 2 * frame, 60.0 + 5 * (k % 4) + (k % 2 == 0 ? frame : -frame)},
                          18.0 + k % 3,
                          8.0 + k % 2,
                          radiansFromDegrees((k * 31 + frame * 3) % 360)};
            object.object_class = k == 5 ? "motorcycle" : "car";
            object.ignore = k == 7 || (k == 3 && frame > 20 && frame < 27);
            scene.truth[frame].push_back(object);
            if (draw(10) == 0) continue;
            BoxRecord found = object;
            found.id = draw(25) == 0 ? draw(12) + 200 : k + (frame > 22 ? 100 : 50);
            found.box.centre.x += (draw(13) - 6) / 2.0;
            found.box.centre.y += (draw(13) - 6) / 2.0;
            found.box.length += draw(9) - 3;
            found.box.width += draw(5) - 1;
            found.box.heading = radiansFromDegrees((k * 31 + frame * 3 + draw(41) + 340) % 360);
            scene.result[frame].push_back(found);
        }
        const double x = draw(160);
        const double y = draw(120);
        BoxRecord invented = test::car(frame, 300 + frame / 4, x, y);
        scene.result[frame].push_back(invented);
    }
    return scene;
}

using Figures = std::map<std::string, double>;

void expectAgreement(const EvaluationOptions& options, const std::map<double, Figures>& expected) {
    const Scene scene = drawScene();
    for (const auto& [overlap, figures] : expected) {
        EvaluationOptions at = options;
        at.overlap = overlap;
        Figures ours;
        for (const NamedMeasure& measure : listMeasures(evaluate(scene.truth, scene.result, at))) {
            if (measure.value) ours[measure.key] = *measure.value;
        }
        for (const auto& [key, value] : figures) {
            EXPECT_NEAR(ours.at(key), value, 5.001e-5) << key << " at T_ov " << overlap;
        }
    }
}

TEST(ScoreAgreement, OrientedBoxes) {
    EvaluationOptions options;
    expectAgreement(options, {
                                 {0.1,
                                  {{"ground_truth", 423},
                                   {"tp", 383},
                                   {"fp", 39},
                                   {"fn", 40},
                                   {"precision", 0.9076},
                                   {"recall", 0.9054},
                                   {"f_score", 0.9065},
                                   {"n_moda", 0.8132},
                                   {"n_modp", 0.5652},
                                   {"mota", 0.7234},
                                   {"motp", 0.5652},
                                   {"id_switches", 38},
                                   {"mostly_tracked", 11},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 0},
                                   {"fragments", 33},
                                   {"gt_tracks", 11}}},
                                 {0.2,
                                  {{"ground_truth", 423},
                                   {"tp", 383},
                                   {"fp", 39},
                                   {"fn", 40},
                                   {"precision", 0.9076},
                                   {"recall", 0.9054},
                                   {"f_score", 0.9065},
                                   {"n_moda", 0.8132},
                                   {"n_modp", 0.5652},
                                   {"mota", 0.7234},
                                   {"motp", 0.5652},
                                   {"id_switches", 38},
                                   {"mostly_tracked", 11},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 0},
                                   {"fragments", 33},
                                   {"gt_tracks", 11}}},
                                 {0.3,
                                  {{"ground_truth", 423},
                                   {"tp", 381},
                                   {"fp", 40},
                                   {"fn", 42},
                                   {"precision", 0.905},
                                   {"recall", 0.9007},
                                   {"f_score", 0.9028},
                                   {"n_moda", 0.8061},
                                   {"n_modp", 0.5676},
                                   {"mota", 0.721},
                                   {"motp", 0.5676},
                                   {"id_switches", 36},
                                   {"mostly_tracked", 11},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 0},
                                   {"fragments", 35},
                                   {"gt_tracks", 11}}},
                             });
}

TEST(ScoreAgreement, VehiclesOnly) {
    EvaluationOptions options;
    options.vehicles_only = true;
    expectAgreement(options, {
                                 {0.1,
                                  {{"ground_truth", 384},
                                   {"tp", 347},
                                   {"fp", 39},
                                   {"fn", 37},
                                   {"precision", 0.899},
                                   {"recall", 0.9036},
                                   {"f_score", 0.9013},
                                   {"n_moda", 0.8021},
                                   {"n_modp", 0.566},
                                   {"mota", 0.7135},
                                   {"motp", 0.566},
                                   {"id_switches", 34},
                                   {"mostly_tracked", 10},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 0},
                                   {"fragments", 30},
                                   {"gt_tracks", 10}}},
                                 {0.2,
                                  {{"ground_truth", 384},
                                   {"tp", 347},
                                   {"fp", 39},
                                   {"fn", 37},
                                   {"precision", 0.899},
                                   {"recall", 0.9036},
                                   {"f_score", 0.9013},
                                   {"n_moda", 0.8021},
                                   {"n_modp", 0.566},
                                   {"mota", 0.7135},
                                   {"motp", 0.566},
                                   {"id_switches", 34},
                                   {"mostly_tracked", 10},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 0},
                                   {"fragments", 30},
                                   {"gt_tracks", 10}}},
                                 {0.3,
                                  {{"ground_truth", 384},
                                   {"tp", 345},
                                   {"fp", 40},
                                   {"fn", 39},
                                   {"precision", 0.8961},
                                   {"recall", 0.8984},
                                   {"f_score", 0.8973},
                                   {"n_moda", 0.7943},
                                   {"n_modp", 0.5686},
                                   {"mota", 0.7109},
                                   {"motp", 0.5686},
                                   {"id_switches", 32},
                                   {"mostly_tracked", 10},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 0},
                                   {"fragments", 32},
                                   {"gt_tracks", 10}}},
                             });
}

TEST(ScoreAgreement, UprightAwayFromTheBorder) {
    EvaluationOptions options;
    options.upright = true;
    options.border = 3;
    options.image_size = {160, 120};
    expectAgreement(options, {
                                 {0.1,
                                  {{"ground_truth", 423},
                                   {"tp", 308},
                                   {"fp", 27},
                                   {"fn", 115},
                                   {"precision", 0.9194},
                                   {"recall", 0.7281},
                                   {"f_score", 0.8127},
                                   {"n_moda", 0.6643},
                                   {"n_modp", 0.6327},
                                   {"mota", 0.5816},
                                   {"motp", 0.6327},
                                   {"id_switches", 35},
                                   {"mostly_tracked", 6},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 5},
                                   {"fragments", 33},
                                   {"gt_tracks", 11}}},
                                 {0.2,
                                  {{"ground_truth", 423},
                                   {"tp", 307},
                                   {"fp", 28},
                                   {"fn", 116},
                                   {"precision", 0.9164},
                                   {"recall", 0.7258},
                                   {"f_score", 0.81},
                                   {"n_moda", 0.6596},
                                   {"n_modp", 0.6406},
                                   {"mota", 0.5792},
                                   {"motp", 0.6406},
                                   {"id_switches", 34},
                                   {"mostly_tracked", 6},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 5},
                                   {"fragments", 34},
                                   {"gt_tracks", 11}}},
                                 {0.3,
                                  {{"ground_truth", 423},
                                   {"tp", 306},
                                   {"fp", 28},
                                   {"fn", 117},
                                   {"precision", 0.9162},
                                   {"recall", 0.7234},
                                   {"f_score", 0.8085},
                                   {"n_moda", 0.6572},
                                   {"n_modp", 0.6438},
                                   {"mota", 0.5816},
                                   {"motp", 0.6438},
                                   {"id_switches", 32},
                                   {"mostly_tracked", 6},
                                   {"mostly_lost", 0},
                                   {"partially_tracked", 5},
                                   {"fragments", 35},
                                   {"gt_tracks", 11}}},
                             });
}

}  // namespace
}  // namespace eyrie::score_agreement_test
