#include "learning/sample_set.h"

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

#include "learning/seeded_random.h"

namespace eyrie {

int countOf(const SampleSet& samples, bool vehicle) {
    return static_cast<int>(std::count_if(samples.begin(), samples.end(),
                                          [vehicle](const Sample& sample) { return sample.vehicle == vehicle; }));
}

std::pair<SampleSet, SampleSet> splitByGroup(const SampleSet& samples, double share, std::uint64_t seed) {
    std::map<std::pair<std::string, std::string>, int> sizes;
    for (const Sample& sample : samples) ++sizes[{sample.source, sample.group}];
    std::vector<std::pair<std::string, std::string>> groups;
    for (const auto& [group, size] : sizes) groups.push_back(group);
    SeededRandom(seed).shuffle(groups);
    std::map<std::pair<std::string, std::string>, bool> second;
    const double wanted = share * static_cast<double>(samples.size());
    double taken = 0;
    for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
        const int size = sizes[groups[i]];
        // Taking a group must bring the share nearer.
        if (taken + size / 2.0 > wanted) continue;
        second[groups[i]] = true;
        taken += size;
    }
    std::pair<SampleSet, SampleSet> result;
    for (const Sample& sample : samples) {
        (second[{sample.source, sample.group}] ? result.second : result.first).push_back(sample);
    }
    return result;
}

cv::Mat mirroredAcross(const cv::Mat& window) {
    cv::Mat result;
    cv::flip(window, result, 1);
    return result;
}

cv::Mat mirroredAlong(const cv::Mat& window) {
    cv::Mat result;
    cv::flip(window, result, 0);
    return result;
}

}  // namespace eyrie
