#pragma once

#include <QPointF>
#include <optional>
#include <vector>

#include "core/values/frame_result.h"

/// Which motion cluster is meant by what the user points at. Indices are those of FrameResult::clusters.
namespace eyrie::ui {

/// The cluster of the smallest detection under a point; else the smallest cluster, else the smallest ROI there.
/// `margin`: px around boxes that still count.
std::optional<int> clusterAt(const FrameResult& result, QPointF image_point, double margin = 0);

/// The cluster that a track's box rests on: that of the kept detection it overlaps most, else the cluster it overlaps
/// most; nothing while the track coasts alone.
std::optional<int> clusterOfTrack(const FrameResult& result, TrackId track);

/// The corners whose motion vectors make a cluster, ascending.
std::vector<CornerId> cornersOf(const FrameResult& result, int cluster);

/// The cluster that holds most of these corners (ascending) in another frame; nothing when none holds any.
std::optional<int> clusterWith(const FrameResult& result, const std::vector<CornerId>& corners);

}  // namespace eyrie::ui
