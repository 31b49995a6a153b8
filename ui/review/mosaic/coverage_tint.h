#pragma once

#include <QColor>
#include <QImage>
#include <QRectF>

#include "ground/ground_coverage.h"

namespace eyrie::ui {

/// What of its coverage in time the ground is tinted by.
enum class CoverageLook { none, seen_for, last_seen };

/// From dark (0: short, or long ago) to bright (1), read alike with any colour vision; no colour of tracks.
QColor coverageColour(double share);
/// How long something was seen, between the shortest and the longest of the sheet, as a share: by ratios, so that a
/// glance is told from ten seconds where other ground was watched for an hour.
double seenForShare(const SheetCoverage& coverage, double seconds);
/// The inverse of it.
double secondsAtShare(const SheetCoverage& coverage, double share);
/// A frame between the first and the last of the sheet, as a share.
double lastSeenShare(const SheetCoverage& coverage, FrameIndex frame);
/// The inverse of it.
FrameIndex frameAtShare(const SheetCoverage& coverage, double share);

/// One pixel a cell; nothing covers ground that was never seen.
QImage coverageTint(const SheetCoverage& coverage, CoverageLook look);

}  // namespace eyrie::ui
