#include "events/review/review_subject.h"

namespace eyrie {

ReviewSubject subjectOf(const Event& event, const StoredTracks& run) {
    ReviewSubject subject;
    subject.kind = event.kind;
    subject.first_frame = event.first_frame;
    subject.last_frame = event.last_frame;
    subject.first_s = run.secondsOf(event.first_frame);
    subject.last_s = run.secondsOf(event.last_frame);
    subject.frame = event.frame;
    subject.place = event.place;
    subject.ground_frame = event.ground_frame;
    subject.ground = event.ground;
    subject.zone = event.zone;
    subject.sense = event.sense;
    return subject;
}

ReviewSubject subjectOf(FrameSpan unsearched, const StoredTracks& run) {
    ReviewSubject subject;
    subject.first_frame = subject.frame = subject.ground_frame = unsearched.first;
    subject.last_frame = unsearched.last;
    subject.first_s = run.secondsOf(unsearched.first);
    subject.last_s = run.secondsOf(unsearched.last);
    return subject;
}

std::vector<FrameSpan> unsearchedStretches(const Footage& footage, const ReviewOptions& options) {
    const double joined = options.join_unsearched_s * footage.scale.frame_rate_hz;
    std::vector<FrameSpan> stretches;
    for (FrameIndex frame = footage.first_frame + 1; frame <= footage.last_frame; ++frame) {
        if (footage.camera.connects(frame - 1, frame)) continue;
        const int between = stretches.empty() ? 0 : frame - stretches.back().last - 1;
        if (!stretches.empty() && (between == 0 || between < joined)) {
            stretches.back().last = frame;
        } else {
            stretches.push_back({frame, frame});
        }
    }
    return stretches;
}

}  // namespace eyrie
