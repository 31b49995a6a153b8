#include "peer/three_frame_boxes.h"

#include <opencv2/imgproc.hpp>

#include "motion/differences/difference_image.h"

namespace eyrie {

std::vector<OrientedBox> ThreeFrameBoxes::boxesOf(const cv::Mat& moving) const {
    const int side = cvRound(options_.joining / 2) * 2 + 1;
    cv::Mat joined, labels, facts, centres;
    cv::morphologyEx(moving, joined, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side}));
    const int count = cv::connectedComponentsWithStats(joined, labels, facts, centres, 8, CV_32S);
    std::vector<OrientedBox> boxes;
    for (int i = 1; i < count; ++i) {
        if (facts.at<int>(i, cv::CC_STAT_AREA) < options_.min_area) continue;
        const int width = facts.at<int>(i, cv::CC_STAT_WIDTH);
        const int height = facts.at<int>(i, cv::CC_STAT_HEIGHT);
        const cv::Point2d centre(facts.at<int>(i, cv::CC_STAT_LEFT) + (width - 1) / 2.0,
                                 facts.at<int>(i, cv::CC_STAT_TOP) + (height - 1) / 2.0);
        boxes.push_back({centre, static_cast<double>(width), static_cast<double>(height), 0});
    }
    return boxes;
}

std::optional<BoxesOfPicture> ThreeFrameBoxes::next(const Frame& frame, const Registration& registration) {
    if (!frames_.add(frame, registration) || frames_.count() < 2 * options_.gap) return std::nullopt;
    const DifferenceImage difference = threeFrameDifference(frames_.newest(), frames_.past(options_.gap),
                                                            frames_.past(2 * options_.gap), options_.blur);
    const Homography middle_from_newest = frames_.pathTo(options_.gap);
    BoxesOfPicture answer;
    answer.frame = middle_from_newest.to_frame;
    for (const OrientedBox& box : boxesOf(difference.values > options_.threshold)) {
        const double scale = middle_from_newest.scaleAt(box.centre);
        answer.boxes.push_back({middle_from_newest.apply(box.centre), box.length * scale, box.width * scale, 0});
    }
    return answer;
}

}  // namespace eyrie
