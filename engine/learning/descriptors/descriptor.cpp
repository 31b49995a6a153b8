#include "learning/descriptors/descriptor.h"

#include <opencv2/core/utility.hpp>

#include "core/error.h"
#include "learning/descriptors/channel_features.h"
#include "learning/descriptors/dct_descriptor.h"
#include "learning/descriptors/hog_descriptor.h"
#include "learning/descriptors/moments_descriptor.h"
#include "learning/descriptors/multi_lbp_descriptor.h"
#include "learning/models/window.h"

namespace eyrie {

const std::vector<DescriptorKind>& allDescriptors() {
    static const std::vector<DescriptorKind> kinds{DescriptorKind::moments, DescriptorKind::dct, DescriptorKind::hog,
                                                   DescriptorKind::channel_features, DescriptorKind::multi_lbp};
    return kinds;
}

const char* nameOf(DescriptorKind kind) {
    switch (kind) {
        case DescriptorKind::moments:
            return "moments";
        case DescriptorKind::dct:
            return "dct";
        case DescriptorKind::hog:
            return "hog";
        case DescriptorKind::channel_features:
            return "chnftrs";
        case DescriptorKind::multi_lbp:
            return "multi_lbp";
    }
    throw Error(ErrorKind::internal, "unknown descriptor");
}

const char* titleOf(DescriptorKind kind) {
    switch (kind) {
        case DescriptorKind::moments:
            return "moments";
        case DescriptorKind::dct:
            return "DCT";
        case DescriptorKind::hog:
            return "HOG";
        case DescriptorKind::channel_features:
            return "channel features";
        case DescriptorKind::multi_lbp:
            return "Multi-LBP";
    }
    throw Error(ErrorKind::internal, "unknown descriptor");
}

DescriptorKind descriptorFromName(const std::string& name) {
    std::string known;
    for (const DescriptorKind kind : allDescriptors()) {
        if (name == nameOf(kind)) return kind;
        known += (known.empty() ? "" : ", ") + std::string(nameOf(kind));
    }
    throw Error(ErrorKind::parameter, "unknown descriptor \"" + name + "\"; known are " + known);
}

std::unique_ptr<Descriptor> makeDescriptor(DescriptorKind kind, std::uint64_t seed) {
    switch (kind) {
        case DescriptorKind::moments:
            return std::make_unique<MomentsDescriptor>();
        case DescriptorKind::dct:
            return std::make_unique<DctDescriptor>();
        case DescriptorKind::hog:
            return std::make_unique<HogDescriptor>();
        case DescriptorKind::channel_features:
            return std::make_unique<ChannelFeatures>(randomRectangles(seed));
        case DescriptorKind::multi_lbp:
            return std::make_unique<MultiLbpDescriptor>();
    }
    throw Error(ErrorKind::internal, "unknown descriptor");
}

void requireWindow(const cv::Mat& window) {
    if (window.type() != CV_8UC1 || window.size() != cv::Size(kWindowWidth, kWindowHeight)) {
        throw Error(ErrorKind::internal, "a window must be grey, 16 wide and 32 high");
    }
}

cv::Mat1f describeWindows(const Descriptor& descriptor, const std::vector<cv::Mat>& windows) {
    cv::Mat1f features(static_cast<int>(windows.size()), descriptor.dimension());
    cv::parallel_for_(cv::Range(0, features.rows), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            descriptor.compute(windows[static_cast<std::size_t>(i)],
                               {features[i], static_cast<std::size_t>(features.cols)});
        }
    });
    return features;
}

}  // namespace eyrie
