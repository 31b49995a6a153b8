#include "evaluation/measures/identity_measures.h"

#include <algorithm>

#include "evaluation/hungarian.h"

namespace eyrie {

IdentityMeasures identityMeasures(const EvaluationInput& input, const std::vector<FrameMatch>& matches,
                                  const EvaluationOptions& options) {
    Eigen::MatrixXd together = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(input.truth_ids.size()),
                                                     static_cast<Eigen::Index>(input.result_ids.size()));
    int objects = 0;
    int results = 0;
    for (std::size_t f = 0; f < input.frames.size(); ++f) {
        const EvaluationFrame& frame = input.frames[f];
        const std::vector<int>& ignored = matches[f].ignored_results;
        objects += static_cast<int>(frame.truth.size());
        for (std::size_t j = 0; j < frame.results.size(); ++j) {
            if (std::binary_search(ignored.begin(), ignored.end(), frame.results[j])) continue;
            ++results;
            for (std::size_t i = 0; i < frame.truth.size(); ++i) {
                const double shared = frame.overlap(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
                if (shared >= options.overlap) together(frame.truth_tracks[i], frame.result_tracks[j]) += 1;
            }
        }
    }
    double agreeing = 0;
    const std::vector<int> partner = assignMaximum(together);
    for (std::size_t i = 0; i < partner.size(); ++i) {
        if (partner[i] >= 0) agreeing += together(static_cast<Eigen::Index>(i), partner[i]);
    }
    IdentityMeasures m;
    m.idtp = static_cast<int>(agreeing);
    m.idfn = objects - m.idtp;
    m.idfp = results - m.idtp;
    m.idp = m.idtp / std::max(1.0, static_cast<double>(results));
    m.idr = m.idtp / std::max(1.0, static_cast<double>(objects));
    m.idf1 = m.idtp / std::max(1.0, (objects + results) / 2.0);
    return m;
}

}  // namespace eyrie
