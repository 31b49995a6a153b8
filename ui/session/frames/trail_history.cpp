#include "session/frames/trail_history.h"

#include <algorithm>

namespace eyrie::ui {

void TrailHistory::add(TrailStep step) {
    if (!steps_.empty() && step.frame != steps_.back().frame + 1) steps_.clear();
    steps_.push_back(std::move(step));
    while (static_cast<int>(steps_.size()) > std::max(1, length_)) steps_.pop_front();
}

void TrailHistory::add(const FrameResult& result) {
    TrailStep step;
    step.frame = result.motion.frame;
    step.current_from_previous = result.motion.registration.current_from_previous;
    for (const TrackState& state : result.tracks) step.centres.emplace_back(state.id, cv::Point2f(state.box.centre));
    add(std::move(step));
}

std::vector<Trail> TrailHistory::trails() const {
    if (steps_.empty()) return {};
    std::vector<Trail> trails;
    for (const auto& [id, centre] : steps_.back().centres) trails.push_back({id, {centre}});
    cv::Matx33d newest_from_step = cv::Matx33d::eye();
    for (size_t i = steps_.size() - 1; i-- > 0;) {
        newest_from_step = newest_from_step * steps_[i + 1].current_from_previous.matrix;
        size_t at = 0;
        for (const auto& [id, centre] : steps_[i].centres) {
            while (at < trails.size() && trails[at].id < id) ++at;
            if (at == trails.size()) break;
            if (trails[at].id != id) continue;
            const cv::Vec3d p = newest_from_step * cv::Vec3d(centre.x, centre.y, 1);
            if (std::abs(p[2]) < 1e-12) continue;
            trails[at].points.emplace_back(static_cast<float>(p[0] / p[2]), static_cast<float>(p[1] / p[2]));
        }
    }
    std::erase_if(trails, [](const Trail& trail) { return trail.points.size() < 2; });
    for (Trail& trail : trails) std::reverse(trail.points.begin(), trail.points.end());
    return trails;
}

}  // namespace eyrie::ui
