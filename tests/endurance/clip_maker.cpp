#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <opencv2/imgcodecs.hpp>

#include "io/video/video_writer.h"
#include "support/moving_scene.h"

/// clip_maker FOLDER FRAMES: draws a tiny clip with its truth, as a folder of images, as a picture of each kind and as
/// videos, also of a corner of its first frames, for fuzzing. What the campaign works on; the same bytes on every call.
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

/// Small, and of a codec whose decoder is made quickly: under the sanitizers that of H.264 takes ten times as long.
void writeCorner(const eyrie::test::MovingScene& scene, const fs::path& path, const std::string& codec) {
    constexpr int kFrames = 8;
    const cv::Rect corner(0, 0, 64, 48);
    eyrie::VideoWriterOptions options;
    options.codec = codec;
    options.key_frame_distance = 4;
    options.b_frames = 2;  // shown in another order than they lie in the file
    eyrie::VideoWriter video(path, corner.size(), options);
    for (int frame = 0; frame < kFrames; ++frame) {
        cv::Mat colour;
        cv::cvtColor(scene.draw(frame)(corner), colour, cv::COLOR_GRAY2BGR);
        video.write(colour);
    }
    video.finish();
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
    writeCorner(scene, folder / "corner.mp4", "mpeg4");
    writeCorner(scene, folder / "corner.ts", "mpeg2video");
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
