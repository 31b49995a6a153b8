#include "imaging/upright_patch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace eyrie {
namespace {

int sideOf(double length) {
    if (!(length > 1)) return 1;
    return static_cast<int>(std::ceil(std::min(length, static_cast<double>(kLargestPatchSide)) - 1e-9));
}

bool lies(cv::Point2d p, cv::Size image) {
    return p.x >= -0.5 && p.y >= -0.5 && p.x <= image.width - 0.5 && p.y <= image.height - 0.5;
}

}  // namespace

cv::Size patchSize(const OrientedBox& area) {
    return {sideOf(area.width), sideOf(area.length)};
}

cv::Matx23d imageFromPatch(const OrientedBox& area, cv::Size size) {
    const cv::Point2d ahead = area.direction();
    const cv::Point2d right(-ahead.y, ahead.x);
    const cv::Point2d origin = area.centre + ahead * ((size.height - 1) / 2.0) - right * ((size.width - 1) / 2.0);
    return {right.x, -ahead.x, origin.x, right.y, -ahead.y, origin.y};
}

UprightPatch cutUpright(const cv::Mat& gray, const OrientedBox& area) {
    CV_Assert(gray.type() == CV_8UC1 && !gray.empty());
    UprightPatch patch;
    const cv::Size size = patchSize(area);
    const bool finite = std::isfinite(area.centre.x) && std::isfinite(area.centre.y) && std::isfinite(area.heading);
    const double far = 4.0 * (gray.cols + gray.rows + kLargestPatchSide);
    if (!finite || std::abs(area.centre.x) > far || std::abs(area.centre.y) > far) {
        // Nothing of it can be in the image, and fixed point arithmetic in the warp would overflow.
        patch.image_from_patch = finite ? imageFromPatch(area, size) : cv::Matx23d(1, 0, 0, 0, 1, 0);
        patch.image = cv::Mat::zeros(size, CV_8UC1);
        patch.inside = cv::Mat::zeros(size, CV_8UC1);
        return patch;
    }
    patch.image_from_patch = imageFromPatch(area, size);
    patch.inside = insideMask(patch.image_from_patch, size, gray.size());
    cv::warpAffine(gray, patch.image, patch.image_from_patch, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    return patch;
}

cv::Mat insideMask(const cv::Matx23d& image_from_patch, cv::Size patch, cv::Size image) {
    const cv::Point2d right(patch.width - 1, 0);
    const cv::Point2d down(0, patch.height - 1);
    bool all = true;
    for (const cv::Point2d corner : {cv::Point2d(0, 0), right, down, right + down}) {
        all = all && lies(toImage(image_from_patch, corner), image);
    }
    cv::Mat inside(patch, CV_8UC1, cv::Scalar(all ? 255 : 0));
    if (all) return inside;
    for (int y = 0; y < patch.height; ++y) {
        uchar* row = inside.ptr<uchar>(y);
        for (int x = 0; x < patch.width; ++x) {
            row[x] = lies(toImage(image_from_patch, {double(x), double(y)}), image) ? 255 : 0;
        }
    }
    return inside;
}

cv::Point2d toImage(const cv::Matx23d& m, cv::Point2d p) {
    return {m(0, 0) * p.x + m(0, 1) * p.y + m(0, 2), m(1, 0) * p.x + m(1, 1) * p.y + m(1, 2)};
}

cv::Point2d toPatch(const cv::Matx23d& m, cv::Point2d p) {
    const double x = p.x - m(0, 2);
    const double y = p.y - m(1, 2);
    return {m(0, 0) * x + m(1, 0) * y, m(0, 1) * x + m(1, 1) * y};
}

OrientedBox boxInImage(const cv::Matx23d& image_from_patch, const cv::Rect2d& in_patch) {
    OrientedBox box;
    box.centre = toImage(image_from_patch, {in_patch.x + in_patch.width / 2, in_patch.y + in_patch.height / 2});
    box.length = in_patch.height;
    box.width = in_patch.width;
    box.heading = std::atan2(-image_from_patch(1, 1), -image_from_patch(0, 1));
    return box;
}

}  // namespace eyrie
