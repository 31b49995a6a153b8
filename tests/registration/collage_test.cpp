#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "registration/registrar.h"
#include "support/shared_data.h"
#include "support/textured_ground.h"

namespace eyrie::collage_test {
namespace {

std::vector<cv::Matx33d> firstFromFrame(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    std::getline(stream, line);
    std::vector<cv::Matx33d> result;
    while (std::getline(stream, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        int frame = 0;
        cv::Matx33d m;
        numbers >> frame;
        for (double& value : m.val) numbers >> value;
        result.push_back(m);
    }
    return result;
}

/// Mean frame-to-frame grid error over the first frames of a collage, px.
double meanError(const std::string& name, double gsd, int frames) {
    const auto truth = firstFromFrame(test::sharedData(name) / "homography.csv");
    SceneScale scale;
    scale.gsd_m_per_px = gsd;
    scale.gsd_known = true;
    Registrar registrar({}, scale);
    double sum = 0;
    for (int i = 0; i < frames; ++i) {
        char file[16];
        std::snprintf(file, sizeof file, "%06d.png", i);
        const cv::Mat gray = cv::imread((test::sharedData(name) / "frames" / file).string(), cv::IMREAD_GRAYSCALE);
        const RegisteredFrame result = registrar.next(test::frameOf(i, gray));
        if (i == 0) continue;
        EXPECT_EQ(result.registration.state, RegistrationState::registered) << name << " frame " << i;
        const cv::Matx33d expected = truth[std::size_t(i)].inv() * truth[std::size_t(i) - 1];
        sum += test::gridError(result.registration.current_from_previous.matrix, expected, gray.size());
    }
    return sum / (frames - 1);
}

}  // namespace

TEST(Collage, dayIsRegisteredToAHundredthOfAPixel) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    EXPECT_LT(meanError("collage_day", 0.20, 80), 0.02);
}

TEST(Collage, smallIsRegisteredToTwoHundredths) {
    EYRIE_NEED_SHARED_DATA("collage_small");
    EXPECT_LT(meanError("collage_small", 0.28, 80), 0.03);
}

}  // namespace eyrie::collage_test
