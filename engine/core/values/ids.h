#pragma once

#include <cstdint>

/// Names for the numbers that identify things. All are assigned once and never reused within a run.
namespace eyrie {

/// Number of a frame in its video, from 0.
using FrameIndex = int;
/// Identity of a tracked corner, kept by its motion vector. Grows with time.
using CornerId = std::int64_t;
/// Identity of an object track within a run, from 1.
using TrackId = int;

}  // namespace eyrie
