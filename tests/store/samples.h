#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/values/frame_result.h"
#include "store/runs/run_store.h"

/// Made-up results for the tests of the store.
namespace eyrie::test {

/// How much there is in a made-up frame.
struct SampleSize {
    int stationary_corners = 60;
    int motion_vectors = 40;
    int clusters = 6;
    int detections = 7;
    int tracks = 5;
    cv::Size image{768, 576};
};

/// A frame in which every field differs from its default; the same for the same frame, whoever asks.
FrameResult sampleFrame(FrameIndex frame, const SampleSize& size = {});

/// A run over "/videos/street.mp4", frames 0 … 99.
RunRecord sampleRun();

/// A track of id 1 that moves 3 px right and 4 px down per frame in frames 4 … 6, confirmed in the last; and a
/// tentative track 2 in frame 5.
std::vector<FrameResult> twoTracks();

/// The times without that of storing, which the writer measures itself.
StageTimes ofTheChain(StageTimes times);

/// Checks that two results are the same to the bit but for the time of storing, and stationary corners to 1/32 px.
void expectSame(const FrameResult& read, const FrameResult& written);

/// A project with one finished run of `frames` frames; answers the run's id.
int writeSampleProject(const std::filesystem::path& path, int frames, const SampleSize& size = {});

/// A project as schema 11 wrote it, with runs whose scale is known (1), assumed (2), estimated (3), and known as much
/// as is assumed elsewhere (4).
void writeRunsOfSchemaEleven(const std::filesystem::path& path);

/// What its runs tell about their scales once it was brought up to date.
void expectOriginsOfSchemaEleven(ProjectFile& project);

/// Reads everything the project holds, throwing Error where it cannot be read.
void readEverything(const std::filesystem::path& path);

}  // namespace eyrie::test
