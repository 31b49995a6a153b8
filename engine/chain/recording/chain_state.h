#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>

#include "chain/chain.h"
#include "core/state_archive.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// A frame whose motion is known while the second half of the chain has not seen it yet.
struct WaitingMotion {
    FrameMotion motion;
    StageTimes times{};

    template <class Archive>
    void transfer(Archive& archive);
};

/// What tells one content of the classifier's file from another; 0 where no classifier takes part. Throws Error(input)
/// when the file cannot be read.
std::uint64_t classifierChecksum(const DetectionOptions& options);

/// The chain in the middle of a run. The first half may be ahead of the second by the frames that wait.
struct ChainProgress {
    ChainProgress(const ChainOptions& options, const SceneScale& scale)
        : classifier(classifierChecksum(options.detection)), motion_half(options, scale), track_half(options, scale) {}

    FrameIndex last_done = -1;  ///< the last frame that both halves have seen
    std::uint64_t classifier;   ///< checksum of the one the run was begun with
    MotionHalf motion_half;
    std::deque<WaitingMotion> waiting;
    TrackHalf track_half;
};

/// The parts of a state as bytes; each half is written by the thread that owns it.
struct ChainStateParts {
    FrameIndex last_done = 0;
    std::uint64_t classifier = 0;  ///< classifierChecksum()
    std::string motion_half;
    std::string waiting;
    std::string track_half;
};

/// What a stage, or a container of such, remembers.
template <class Stage>
std::string stateBytes(Stage& stage) {
    StateWriter writer;
    writer(stage);
    return writer.bytes();
}

/// All of it, with the engine's version, the parameters and a checksum.
std::string packedState(ChainStateParts parts, const ChainOptions& options, const SceneScale& scale);

/// The chain as it was. `source` gives the pictures it needs. Nothing for bytes that no writer wrote, or of another
/// engine or other parameters. Throws Error(input) when a picture or the classifier cannot be read or differs from what
/// it was.
std::unique_ptr<ChainProgress> unpackedState(std::string_view bytes, const ChainOptions& options,
                                             const SceneScale& scale, FrameSource& source);

}  // namespace eyrie
