#include "evaluation/comparison/published_figures.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr const char* kGradients = "table 7.3";
constexpr const char* kRescaling = "table 7.5";
constexpr const char* kDetectors = "table 7.6";
constexpr const char* kLiterature = "table 7.7";
constexpr const char* kStacking = "table 7.8";
constexpr const char* kTracking = "table 7.9";
constexpr const char* kRunway = "table 7.10";

struct Counts {
    int true_positives, false_positives, false_negatives;
};
struct Shares {
    double precision, recall, f_score;
};
struct Lives {
    int mostly_tracked, partially_tracked, mostly_lost, fragments;
};

/// What other authors publish of their own method.
PublishedFigures paper(const char* method, const char* source, double precision, double recall, double f_score) {
    PublishedFigures row;
    row.method = method;
    row.source = source;
    row.precision = precision;
    row.recall = recall;
    row.f_score = f_score;
    return row;
}

/// A row of the tables of detection.
PublishedFigures boxes(const char* method, const char* source, Counts counts, Shares shares,
                       std::optional<double> n_moda = {}, std::optional<double> n_modp = {}) {
    PublishedFigures row = paper(method, source, shares.precision, shares.recall, shares.f_score);
    row.true_positives = counts.true_positives;
    row.false_positives = counts.false_positives;
    row.false_negatives = counts.false_negatives;
    row.n_moda = n_moda;
    row.n_modp = n_modp;
    return row;
}

/// A row of the tables of tracking.
PublishedFigures tracks(const char* method, const char* source, Counts counts, Shares shares, double mota, double motp,
                        Lives lives) {
    PublishedFigures row = boxes(method, source, counts, shares);
    row.mota = mota;
    row.motp = motp;
    row.mostly_tracked = lives.mostly_tracked;
    row.partially_tracked = lives.partially_tracked;
    row.mostly_lost = lives.mostly_lost;
    row.fragments = lives.fragments;
    return row;
}

/// As printed, with what contradicts itself there (docs/thesis.md, misprints).
const std::map<std::string, std::vector<PublishedFigures>>& allPublished() {
    static const std::map<std::string, std::vector<PublishedFigures>> all{
        {"seq1",
         {
             boxes("gradient_lbp", kGradients, {4322, 223, 409}, {.953, .914, .932}, .866, .621),
             boxes("gradient_simple", kGradients, {4349, 282, 382}, {.939, .919, .929}, .859, .606),
             boxes("gradient_canny", kGradients, {4322, 242, 409}, {.947, .914, .930}, .862, .594),
             boxes("gradient_morphological", kGradients, {4332, 252, 421}, {.945, .916, .930}, .862, .598),
             boxes("sliding_window_joint_11, hog + svm", kRescaling, {4486, 889, 245}, {.835, .948, .888}),
             boxes("sliding_window_length_11, hog + svm", kRescaling, {4473, 780, 258}, {.852, .945, .896}),
             boxes("sliding_window_length_3, hog + svm", kRescaling, {4125, 190, 606}, {.956, .872, .912}),
             boxes("sliding_window_joint_11", kRescaling, {4501, 357, 230}, {.972, .951, .939}),
             boxes("sliding_window_length_11", kRescaling, {4487, 283, 244}, {.941, .948, .945}),
             boxes("sliding_window_length_3", kRescaling, {4463, 83, 268}, {.982, .943, .962}),
             boxes("clusters", kDetectors, {4070, 807, 661}, {.835, .860, .847}, .689, .481),
             boxes("gradient", kDetectors, {4322, 223, 409}, {.952, .913, .931}, .866, .621),
             boxes("relative_connectivity", kDetectors, {4267, 453, 464}, {.904, .902, .903}, .806, .585),
             boxes("sliding_window", kDetectors, {4463, 83, 268}, {.982, .943, .962}, .925, .696),
             boxes("tophat_otsu", kLiterature, {4253, 286, 478}, {.937, .899, .918}, .838, .530),
             boxes("mser", kLiterature, {3395, 113, 1336}, {.968, .718, .824}, .693, .482),
             boxes("canny_harris", kLiterature, {4141, 136, 590}, {.968, .875, .919}, .846, .526),
             boxes("gradient", kStacking, {4322, 223, 409}, {.952, .913, .931}, .866, .621),
             boxes("gradient + stacking", kStacking, {4389, 214, 342}, {.954, .928, .940}, .882, .632),
             boxes("sliding_window", kStacking, {4463, 83, 268}, {.982, .943, .962}, .925, .696),
             boxes("sliding_window + stacking", kStacking, {4461, 67, 270}, {.985, .943, .964}, .928, .694),
             tracks("clusters + tracking", kTracking, {4427, 1040, 304}, {.810, .936, .868}, .688, .541,
                    {33, 4, 3, 49}),
             boxes("gradient + stacking", kTracking, {4389, 214, 342}, {.954, .928, .940}),
             tracks("gradient + stacking + tracking", kTracking, {4588, 238, 143}, {.951, .970, .960}, .916, .642,
                    {36, 2, 2, 42}),
             boxes("sliding_window + stacking", kTracking, {4461, 67, 270}, {.985, .943, .964}),
             tracks("sliding_window + stacking + tracking", kTracking, {4582, 72, 149}, {.985, .969, .976}, .950, .715,
                    {36, 4, 0, 41}),
         }},
        {"seq2",
         {
             boxes("gradient_lbp", kGradients, {1265, 190, 108}, {.869, .921, .895}, .783, .573),
             boxes("gradient_simple", kGradients, {1259, 197, 114}, {.865, .917, .890}, .773, .552),
             boxes("gradient_canny", kGradients, {1252, 178, 121}, {.876, .912, .893}, .781, .544),
             boxes("gradient_morphological", kGradients, {1248, 188, 125}, {.869, .909, .889}, .772, .540),
             boxes("clusters", kDetectors, {1289, 579, 84}, {.690, .939, .795}, .517, .514),
             boxes("gradient", kDetectors, {1265, 190, 108}, {.869, .921, .894}, .782, .573),
             boxes("relative_connectivity", kDetectors, {1216, 414, 157}, {.746, .886, .810}, .584, .545),
             boxes("sliding_window", kDetectors, {1181, 47, 192}, {.961, .860, .908}, .825, .593),
             boxes("tophat_otsu", kLiterature, {1276, 334, 97}, {.793, .929, .856}, .686, .590),
             boxes("mser", kLiterature, {1200, 142, 173}, {.894, .874, .884}, .770, .473),
             boxes("canny_harris", kLiterature, {1207, 157, 166}, {.885, .879, .882}, .765, .499),
             boxes("gradient", kStacking, {1265, 190, 108}, {.869, .921, .894}, .782, .573),
             boxes("gradient + stacking", kStacking, {1274, 170, 99}, {.882, .928, .905}, .804, .575),
             boxes("sliding_window", kStacking, {1181, 47, 192}, {.961, .860, .908}, .825, .593),
             boxes("sliding_window + stacking", kStacking, {1196, 43, 177}, {.965, .871, .916}, .839, .593),
             tracks("clusters + tracking", kTracking, {1281, 900, 92}, {.587, .933, .721}, .240, .513, {15, 3, 0, 31}),
             boxes("gradient + stacking", kTracking, {1274, 170, 99}, {.882, .928, .905}),
             tracks("gradient + stacking + tracking", kTracking, {1263, 184, 110}, {.873, .920, .896}, .774, .570,
                    {12, 6, 0, 52}),
             boxes("sliding_window + stacking", kTracking, {1196, 43, 177}, {.965, .871, .916}),
             tracks("sliding_window + stacking + tracking", kTracking, {1258, 81, 115}, {.939, .916, .928}, .845, .624,
                    {13, 4, 1, 28}),
         }},
        {"egtest01",
         {
             boxes("gradient_lbp", kGradients, {6811, 126, 55}, {.982, .992, .987}, .974, .515),
             boxes("gradient_simple", kGradients, {6807, 139, 59}, {.980, .991, .986}, .971, .493),
             boxes("gradient_canny", kGradients, {6804, 112, 62}, {.983, .991, .987}, .974, .483),
             boxes("gradient_morphological", kGradients, {6802, 118, 64}, {.983, .991, .987}, .973, .491),
             boxes("clusters", kDetectors, {6844, 487, 22}, {.934, .997, .964}, .925, .448),
             boxes("gradient", kDetectors, {6812, 128, 54}, {.982, .992, .987}, .973, .549),
             boxes("relative_connectivity", kDetectors, {6142, 1836, 724}, {.770, .895, .828}, .627, .493),
             boxes("sliding_window", kDetectors, {6726, 73, 140}, {.989, .980, .984}, .968, .526),
             boxes("tophat_otsu", kLiterature, {6782, 1231, 84}, {.846, .988, .912}, .808, .489),
             boxes("mser", kLiterature, {6703, 195, 163}, {.972, .976, .974}, .947, .497),
             boxes("canny_harris", kLiterature, {6785, 100, 81}, {.985, .988, .987}, .973, .527),
             paper("Siam et al. 2012a", "their paper, in table 7.7", .996, .961, .978),
             paper("Shen et al. 2013b", "their paper, in table 7.7", .735, .725, .730),
             boxes("gradient", kStacking, {6812, 128, 54}, {.982, .992, .987}, .973, .527),
             boxes("gradient + stacking", kStacking, {6807, 108, 59}, {.984, .991, .988}, .976, .544),
             boxes("sliding_window", kStacking, {6726, 73, 140}, {.989, .980, .984}, .968, .526),
             boxes("sliding_window + stacking", kStacking, {6677, 69, 189}, {.990, .972, .981}, .962, .518),
             tracks("clusters + tracking", kRunway, {6866, 320, 0}, {.955, 1.000, .977}, .951, .446, {4, 2, 0, 9}),
             tracks("gradient + stacking + tracking", kRunway, {6813, 73, 53}, {.989, .992, .991}, .981, .536,
                    {4, 2, 0, 13}),
             tracks("sliding_window + tracking", kRunway, {6821, 87, 45}, {.987, .993, .990}, .980, .508,
                    {4, 2, 0, 13}),
             paper("Siam et al. 2012b", "their paper, in table 7.10", .991, .971, .980),
             paper("Shen et al. 2013a", "their paper, in table 7.10", .770, .790, .780),
         }},
    };
    return all;
}

std::string cell(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string cell(std::optional<int> count, std::size_t width) {
    return cell(count ? std::to_string(*count) : "-", width);
}

std::string cell(std::optional<double> share, std::size_t width) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f", share.value_or(0));
    return cell(share ? std::string(text) : "-", width);
}

}  // namespace

const std::vector<std::string>& publishedSequences() {
    static const std::vector<std::string> names{"seq1", "seq2", "egtest01"};
    return names;
}

const std::vector<PublishedFigures>& publishedFigures(const std::string& sequence) {
    const auto found = allPublished().find(sequence);
    if (found == allPublished().end()) {
        throw Error(ErrorKind::parameter,
                    "no figures are published for \"" + sequence + "\", only for seq1, seq2 and egtest01");
    }
    return found->second;
}

std::string publishedText(const std::string& sequence) {
    const std::string title = "Published, T_ov 0.1";
    std::size_t widest = title.size();
    for (const PublishedFigures& row : publishedFigures(sequence)) widest = std::max(widest, row.method.size());
    const auto left = [&](const std::string& name) { return name + std::string(widest - name.size(), ' '); };
    std::string text = left(title) +
                       "     TP     FP     FN precision  recall f-score  N-MODA  N-MODP    MOTA    MOTP   MT   PT  MLT"
                       "   FM  source\n";
    for (const PublishedFigures& row : publishedFigures(sequence)) {
        text += left(row.method);
        for (const auto& count : {row.true_positives, row.false_positives, row.false_negatives}) text += cell(count, 7);
        text += cell(std::optional(row.precision), 10);
        for (const auto& share :
             {std::optional(row.recall), std::optional(row.f_score), row.n_moda, row.n_modp, row.mota, row.motp})
            text += cell(share, 8);
        for (const auto& count : {row.mostly_tracked, row.partially_tracked, row.mostly_lost, row.fragments})
            text += cell(count, 5);
        text += "  " + row.source + "\n";
    }
    return text;
}

}  // namespace eyrie
