#include "evaluation/evaluate.h"

#include <algorithm>

namespace eyrie {
namespace {

/// Which way a measure improves; `higher` for those that only describe, such as the number of objects.
enum class Better { higher, lower };

/// Gathers measures; those of an absent group have no value.
class List {
 public:
    void begin(const char* group) { group_ = group; }
    void count(const char* key, const char* label, const char* help, std::optional<double> value,
               Better better = Better::higher) {
        real(key, label, help, value, 0, better);
    }
    void real(const char* key, const char* label, const char* help, std::optional<double> value, int decimals = 4,
              Better better = Better::higher) {
        measures_.push_back({group_, key, label, help, value, decimals, better == Better::higher});
    }
    std::vector<NamedMeasure> take() { return std::move(measures_); }

 private:
    std::string group_;
    std::vector<NamedMeasure> measures_;
};

template <class Group, class Value>
std::optional<double> of(const std::optional<Group>& group, Value Group::*member) {
    if (!group) return std::nullopt;
    return static_cast<double>((*group).*member);
}

std::optional<double> meanIfKnown(const std::optional<HotaMeasures>& hota, HotaCurve HotaMeasures::*curve) {
    if (!hota) return std::nullopt;
    return meanOf((*hota).*curve);
}

void listDetection(List& list, const DetectionMeasures& d) {
    list.begin("detection");
    list.count("ground_truth", "objects", "boxes of the ground truth that count", d.ground_truth);
    list.count("tp", "TP", "true positives", d.true_positives);
    list.count("fp", "FP", "false positives", d.false_positives, Better::lower);
    list.count("fn", "FN", "false negatives", d.false_negatives, Better::lower);
    list.count("ignored_results", "ignored results", "results that are not counted", d.ignored_results);
    list.real("precision", "precision", "TP / (TP + FP)", d.precision);
    list.real("recall", "recall", "TP / (TP + FN)", d.recall);
    list.real("f_score", "f-score", "harmonic mean of precision and recall", d.f_score);
    list.real("n_moda", "N-MODA", "1 - (FN + FP) / objects", d.n_moda);
    list.real("n_modp", "N-MODP", "mean overlap of the true positives", d.n_modp);
    list.real("fp_per_frame", "FP per frame", "FP / frames", d.false_positives_per_frame, 3, Better::lower);
}

void listTracking(List& list, const Measures& m) {
    const auto& t = m.tracking;
    list.begin("tracking");
    list.real("mota", "MOTA", "1 - (FN + FP + ID switches) / objects", of(t, &TrackingMeasures::mota));
    list.real("motp", "MOTP", "mean overlap of the matched pairs", of(t, &TrackingMeasures::motp));
    list.count("id_switches", "ID switches", "times an object's id changes", of(t, &TrackingMeasures::id_switches),
               Better::lower);
    const bool thesis = m.convention == Convention::thesis;
    list.count("mostly_tracked", "MT", thesis ? "tracked for 80 % or more" : "tracked for more than 80 %",
               of(t, &TrackingMeasures::mostly_tracked));
    list.count("partially_tracked", "PT", "neither mostly tracked nor mostly lost",
               of(t, &TrackingMeasures::partially_tracked));
    list.count("mostly_lost", "MLT", "tracked for less than 20 %", of(t, &TrackingMeasures::mostly_lost),
               Better::lower);
    list.count("fragments", thesis ? "FM" : "Frag",
               thesis ? "changes from tracked to not tracked" : "tracked runs - 1 per object",
               of(t, &TrackingMeasures::fragments), Better::lower);
    list.real("initialisation_frames", "TID, frames", "mean frames of an object until it is first found",
              of(t, &TrackingMeasures::initialisation_frames), 1, Better::lower);
    list.count("gt_tracks", "ground truth tracks", "tracks of the ground truth",
               of(t, &TrackingMeasures::truth_tracks));
    list.count("result_tracks", "result tracks", "tracks of the result", of(t, &TrackingMeasures::result_tracks));
    list.begin("identity");
    list.real("idf1", "IDF1", "boxes under the right identity", of(m.identity, &IdentityMeasures::idf1));
    list.count("idtp", "IDTP", "identity true positives", of(m.identity, &IdentityMeasures::idtp));
    list.count("idfp", "IDFP", "identity false positives", of(m.identity, &IdentityMeasures::idfp), Better::lower);
    list.count("idfn", "IDFN", "identity false negatives", of(m.identity, &IdentityMeasures::idfn), Better::lower);
    list.real("hota", "HOTA", "mean over overlaps 0.05 to 0.95", meanIfKnown(m.hota, &HotaMeasures::hota));
    list.real("det_a", "DetA", "detection part of HOTA", meanIfKnown(m.hota, &HotaMeasures::det_a));
    list.real("ass_a", "AssA", "association part of HOTA", meanIfKnown(m.hota, &HotaMeasures::ass_a));
    list.real("loc_a", "LocA", "localisation part of HOTA", meanIfKnown(m.hota, &HotaMeasures::loc_a));
}

void listBoxErrors(List& list, const BoxErrors& e) {
    const auto known = [&](double value) { return e.pairs > 0 ? std::optional<double>(value) : std::nullopt; };
    const auto heading = [&](double value) { return e.has_headings ? known(value) : std::nullopt; };
    list.begin("boxes");
    list.real("centre_error_px", "centre error, px", "mean distance of the centres", known(e.centre_px), 2,
              Better::lower);
    list.real("length_error_px", "length error, px", "mean absolute", known(e.length_px), 2, Better::lower);
    list.real("length_bias_px", "length bias, px", "mean of result - ground truth", known(e.length_bias_px), 2,
              Better::lower);
    list.real("width_error_px", "width error, px", "mean absolute", known(e.width_px), 2, Better::lower);
    list.real("width_bias_px", "width bias, px", "mean of result - ground truth", known(e.width_bias_px), 2,
              Better::lower);
    list.real("heading_error_deg", "heading error, deg", "mean absolute, front and rear distinguished",
              heading(e.heading_degrees), 2, Better::lower);
    list.real("axis_error_deg", "axis error, deg", "mean absolute, modulo 180", heading(e.heading_axis_degrees), 2,
              Better::lower);
}

}  // namespace

std::vector<NamedMeasure> listMeasures(const Measures& measures) {
    List list;
    listDetection(list, measures.detection);
    listTracking(list, measures);
    listBoxErrors(list, measures.boxes);
    return list.take();
}

std::vector<std::string> remarksOn(const Measures& measures) {
    std::vector<std::string> remarks;
    if (measures.shared_frames == 0) {
        remarks.push_back(
            "ground truth and result have no frame in common; check that both belong to the same video and "
            "count frames alike (Eyrie from 0, MOTChallenge from 1)");
    }
    const DetectionMeasures& detection = measures.detection;
    const int fewer = std::min(detection.ground_truth, detection.true_positives + detection.false_positives);
    if (measures.shared_frames > 0 && fewer >= 50 && detection.true_positives * 50 < fewer) {
        remarks.push_back(
            "hardly any result lies on an object of the ground truth; check that both belong to the same video");
    }
    if (measures.results_not_counted > 0) {
        remarks.push_back(std::to_string(measures.results_not_counted) +
                          " result boxes lie in frames without ground truth and were not counted");
    }
    if (measures.repeated_ids > 0) {
        remarks.push_back(std::to_string(measures.repeated_ids) +
                          " boxes share their id with another box of the same frame; tracking measures take the first");
    }
    if (measures.detection.ground_truth == 0) remarks.push_back("no object of the ground truth counts");
    if (!measures.tracking) remarks.push_back("some boxes have no id, so there are no tracking measures");
    return remarks;
}

}  // namespace eyrie
