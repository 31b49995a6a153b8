#include "learning/training/labelled_frames.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace eyrie {

namespace {
constexpr int kOthersPerVehicle = 4;
}  // namespace

TrainingBox trainingBoxOf(const BoxRecord& record, bool hidden) {
    return {record.box, isVehicleClass(record.object_class) && !record.ignore && !hidden && record.box.area() > 0};
}

std::vector<LabelledImage> labelledImagesOf(const TrainingBoxes& boxes, const std::string& name, int frame_count,
                                            int step, const std::function<cv::Mat(FrameIndex)>& gray,
                                            const std::stop_token& stop, const std::function<void(double)>& progress) {
    std::vector<LabelledImage> images;
    double position = 0;
    FrameIndex next = 0;
    for (const auto& [frame, labelled] : boxes) {
        if (stop.stop_requested()) break;
        ++position;
        if (frame < next || frame >= frame_count) continue;
        next = frame + step;
        LabelledImage image;
        image.gray = gray(frame);
        image.source = image.group = name;
        for (const TrainingBox& one : labelled) (one.clear ? image.vehicles : image.unclear).push_back(one.box);
        images.push_back(std::move(image));
        if (progress) progress(position / static_cast<double>(boxes.size()));
    }
    return images;
}

OrientedBox typicalVehicle() {
    return {{0, 0}, 21.5, 10, 0};
}

SampleSet samplesFromImages(const std::vector<LabelledImage>& images, std::uint64_t seed,
                            const SampleCutting& cutting) {
    SampleSet samples;
    for (std::size_t i = 0; i < images.size(); ++i) {
        const int others = kOthersPerVehicle * std::max<int>(1, static_cast<int>(images[i].vehicles.size()));
        SampleSet cut = samplesFromImage(images[i], others, typicalVehicle(), seed + i, cutting);
        std::move(cut.begin(), cut.end(), std::back_inserter(samples));
    }
    return samples;
}

}  // namespace eyrie
