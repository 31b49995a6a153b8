#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "io/video/video_writer.h"
#include "support/moving_scene.h"

/// clip_maker FOLDER FRAMES: draws a tiny clip with its truth, as a folder of images, as a picture of each kind and as
/// videos. What the campaign works on; the same bytes on every call.
namespace {

namespace fs = std::filesystem;

eyrie::test::MovingScene tinyScene(int frames) {
    eyrie::test::MovingScene scene;
    scene.size = {160, 120};
    scene.frames = frames;
    scene.camera_per_frame = {0.8, 0.3};
    scene.vehicles = {{{45, 60}, {2.4, 0}, {20, 10}}, {{110, 30}, {0, 2.0}, {18, 9}}};
    return scene;
}

void writeTruth(const eyrie::test::MovingScene& scene, const fs::path& path) {
    std::ofstream truth(path);
    truth << "frame,id,x,y,length,width,heading,class,ignore\n";
    for (int frame = 0; frame < scene.frames; ++frame) {
        for (std::size_t i = 0; i < scene.vehicles.size(); ++i) {
            const auto& vehicle = scene.vehicles[i];
            const cv::Point2d centre = scene.vehicleAt(vehicle, frame);
            truth << frame << ',' << i + 1 << ',' << centre.x << ',' << centre.y << ',' << vehicle.size.width << ','
                  << vehicle.size.height << ',' << (i == 0 ? 0 : 90) << ",car,0\n";
        }
    }
}

void make(const fs::path& folder, int frames) {
    const eyrie::test::MovingScene scene = tinyScene(frames);
    fs::create_directories(folder / "clip");
    eyrie::VideoWriter mp4(folder / "clip.mp4", scene.size);
    eyrie::VideoWriter ts(folder / "clip.ts", scene.size);
    for (int frame = 0; frame < frames; ++frame) {
        const cv::Mat picture = scene.draw(frame);
        cv::imwrite((folder / "clip" / (std::to_string(1000 + frame) + ".pgm")).string(), picture);
        cv::Mat colour;
        cv::cvtColor(picture, colour, cv::COLOR_GRAY2BGR);
        mp4.write(colour);
        ts.write(colour);
    }
    mp4.finish();
    ts.finish();
    for (const char* kind : {"png", "jpg", "tif", "bmp", "pgm"}) {
        const fs::path images = folder / "pictures" / kind;
        fs::create_directories(images);
        for (int frame = 0; frame < 4; ++frame)
            cv::imwrite((images / (std::to_string(frame) + "." + kind)).string(), scene.draw(frame));
    }
    writeTruth(scene, folder / "truth.csv");
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: clip_maker FOLDER FRAMES\n";
        return 2;
    }
    try {
        make(argv[1], std::stoi(argv[2]));
    } catch (const std::exception& error) {
        std::cerr << "clip_maker: " << error.what() << "\n";
        return 3;
    }
    return 0;
}
