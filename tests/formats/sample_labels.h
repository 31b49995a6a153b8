#pragma once

#include <fstream>
#include <sstream>

#include "core/geometry/angle.h"
#include "formats/label_formats.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace eyrie::test {

inline std::string textOf(const std::filesystem::path& path) {
    std::stringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

inline std::filesystem::path writeText(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::filesystem::remove(path);  // file systems flush a file that is cut and written anew, which takes milliseconds
    std::ofstream(path, std::ios::binary) << text;
    return path;
}

/// Three objects over twelve frames: a car that turns, a van with a gap, a truck that is hidden and ignored for a
/// while. Positions are whole or broken, sizes are those of the thesis.
inline LabelFile sampleLabels(bool turned = true) {
    LabelFile labels;
    labels.image_size = cv::Size(320, 240);
    labels.frame_count = 14;
    labels.frame_rate_hz = 25;
    for (int frame = 0; frame < 12; ++frame) {
        LabelBox car;
        car.frame = frame;
        car.id = 3;
        car.object_class = "car";
        car.box = {
            {40.25 + 3.5 * frame, 60.125 + frame}, 20.5, 9.25, turned ? radiansFromDegrees(350 + 4.0 * frame) : 0};
        car.box.heading = wrapPi(car.box.heading);
        labels.boxes[frame].push_back(car);
        if (frame < 4 || frame > 7) {
            LabelBox van = car;
            van.id = 7;
            van.object_class = "van";
            van.box = {{200.0 - 2 * frame, 100}, 24, 11, turned ? kPi : 0};
            van.occlusion = frame > 9 ? Occlusion::fully : Occlusion::none;
            labels.boxes[frame].push_back(van);
        }
        LabelBox truck = car;
        truck.id = 12;
        truck.object_class = "truck";
        truck.box = {{150, 180}, 30, 12, turned ? radiansFromDegrees(217.5) : 0};
        truck.ignore = frame >= 6;
        truck.occlusion = frame == 5 ? Occlusion::partly : Occlusion::none;
        labels.boxes[frame].push_back(truck);
    }
    return labels;
}

}  // namespace eyrie::test
