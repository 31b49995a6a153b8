#include "formats/label_stream.h"

namespace eyrie {

VisitFrames framesOf(const LabelBoxes& boxes) {
    return [&boxes](const FrameVisitor& visitor) {
        for (const auto& [frame, records] : boxes) {
            if (!records.empty()) visitor(frame, records);
        }
    };
}

VisitBoxes plainBoxes(const VisitFrames& frames) {
    return [frames](const BoxVisitor& visitor) {
        frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
            for (const LabelBox& record : records) visitor(frame, record);
        });
    };
}

LabelFile collected(const LabelStream& labels) {
    LabelFile file = labels.about;
    labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
        file.boxes.emplace_hint(file.boxes.end(), frame, records);
    });
    return file;
}

}  // namespace eyrie
