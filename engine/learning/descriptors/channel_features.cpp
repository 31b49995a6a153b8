#include "learning/descriptors/channel_features.h"

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/models/window.h"

namespace eyrie {
namespace {

constexpr int kInnerWidth = kWindowWidth - 2;
constexpr int kInnerHeight = kWindowHeight - 2;
constexpr int kSmallestSide = 2;

}  // namespace

std::vector<ChannelRectangle> randomRectangles(std::uint64_t seed, int count) {
    SeededRandom random(seed);
    std::vector<ChannelRectangle> rectangles;
    while (static_cast<int>(rectangles.size()) < count) {
        ChannelRectangle r;
        r.channel = random.below(IntegralChannels::kChannels);
        r.area.width = kSmallestSide + random.below(kInnerWidth - kSmallestSide + 1);
        r.area.height = kSmallestSide + random.below(kInnerHeight - kSmallestSide + 1);
        r.area.x = 1 + random.below(kInnerWidth - r.area.width + 1);
        r.area.y = 1 + random.below(kInnerHeight - r.area.height + 1);
        if (std::find(rectangles.begin(), rectangles.end(), r) == rectangles.end()) rectangles.push_back(r);
    }
    return rectangles;
}

bool isAllowed(const ChannelRectangle& r) {
    return r.channel >= 0 && r.channel < IntegralChannels::kChannels && r.area.x >= 1 && r.area.y >= 1 &&
           r.area.width >= 1 && r.area.height >= 1 && r.area.width <= kInnerWidth && r.area.height <= kInnerHeight &&
           r.area.x + r.area.width <= 1 + kInnerWidth && r.area.y + r.area.height <= 1 + kInnerHeight;
}

ChannelFeatures::ChannelFeatures(std::vector<ChannelRectangle> rectangles) : rectangles_(std::move(rectangles)) {
    if (!std::all_of(rectangles_.begin(), rectangles_.end(), isAllowed)) {
        throw Error(ErrorKind::internal, "a channel feature reaches out of the window");
    }
}

void ChannelFeatures::compute(const cv::Mat& window, std::span<float> values) const {
    requireWindow(window);
    const IntegralChannels channels(window);
    for (std::size_t i = 0; i < rectangles_.size(); ++i) {
        values[i] = channels.sum(rectangles_[i].channel, rectangles_[i].area);
    }
}

}  // namespace eyrie
