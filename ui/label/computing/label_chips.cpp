#include "label/computing/label_chips.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "annotation/keyframes/interpolation.h"

namespace eyrie::ui {

namespace {
constexpr double kBorder = 0.4;  ///< of the box' length, on every side
constexpr int kLargestChip_px = 160;
}  // namespace

std::vector<FrameIndex> chipFrames(const LabelledObject& object, int most) {
    std::set<FrameIndex> frames;
    if (static_cast<int>(object.keyframes.size()) <= most / 2)
        for (const Keyframe& keyframe : object.keyframes) frames.insert(keyframe.frame);
    const FrameIndex first = object.keyframes.front().frame;
    const int life = object.last_frame - first;
    const int spread = std::min(life + 1, most - static_cast<int>(frames.size()));
    for (int i = 0; i < spread; ++i)
        frames.insert(first +
                      static_cast<FrameIndex>(std::lround(static_cast<double>(life) * i / std::max(1, spread - 1))));
    return {frames.begin(), frames.end()};
}

LabelChip cutChip(const cv::Mat& gray, const OrientedBox& box) {
    LabelChip chip;
    const double border = std::max(3.0, kBorder * box.length);
    const auto side = [&](double size) {
        return std::clamp(static_cast<int>(std::ceil(size + 2 * border)), 4, kLargestChip_px);
    };
    const cv::Size size(side(box.length), side(box.width));
    chip.box = {box.length, box.width};
    // Image from chip: turned by the heading about the box' centre.
    const double c = std::cos(box.heading);
    const double s = std::sin(box.heading);
    const cv::Point2d middle((size.width - 1) / 2.0, (size.height - 1) / 2.0);
    const cv::Matx23d image_from_chip(c, -s, box.centre.x - c * middle.x + s * middle.y,  //
                                      s, c, box.centre.y - s * middle.x - c * middle.y);
    cv::warpAffine(gray, chip.gray, image_from_chip, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    return chip;
}

LabelChips::LabelChips(ProjectSession& session, LabelSession& labels, QObject* parent)
    : QObject(parent), session_(session), labels_(labels) {}

void LabelChips::request(ObjectId id) {
    cancel();
    const LabelledObject* object = labels_.object(id);
    if (object == nullptr || !session_.media()) return;
    query_.ask([this, object = *object, media = *session_.media(),
                camera = labels_.sharedCamera()](const BackgroundTask& task) {
        std::vector<LabelChip> chips;
        try {
            const auto source = media.open({}, task.stop());
            for (const FrameIndex frame : chipFrames(object, kMostChips)) {
                if (task.stop().stop_requested()) return;
                const LabelledBox box = boxAt(object, frame, *camera);
                if (!box.visible()) continue;
                LabelChip chip = cutChip(source->read(frame, false).gray, box.box);
                chip.frame = frame;
                chip.keyframe = box.source == BoxSource::keyframe;
                chips.push_back(std::move(chip));
            }
        } catch (const std::exception&) {
            // A picture that cannot be read is told by the canvas; what was cut out so far is shown.
        }
        task.tell([this, id = object.id, chips = std::move(chips)] { emit ready(id, chips); });
    });
}

}  // namespace eyrie::ui

#include "moc_label_chips.cpp"
