#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/values/scale_basis.h"
#include "metadata/ground_view.h"

namespace eyrie {

/// The scale of a whole video by its metadata.
struct MetadataScale {
    double gsd_m_per_px = 0;  ///< > 0: median over the frames that were asked about, both axes
    GroundSource source = GroundSource::none;
    int frames_asked = 0;
    int frames_known = 0;
    std::string why_not;  ///< where the metadata give no scale that can be used: the reason, for people

    bool usable() const { return gsd_m_per_px > 0; }
};

/// Looks at some frames of [first, last]. Usable when at least half of them have a scale, from 0.005 to 5 m/px, nine in
/// ten of them within a factor of two: one figure is to stand for all frames.
MetadataScale scaleByMetadata(const MetadataTimeline& timeline, const FrameSource& source, FrameIndex first,
                              FrameIndex last);

/// The same from a file; a file without metadata, or with none that can be read, has none. Never throws: the video is
/// to be worked on all the same.
MetadataScale scaleByMetadata(const FrameSource& source, FrameIndex first, FrameIndex last,
                              const std::stop_token& stop = {});

/// A scale that is known before any picture is looked at.
struct StatedScale {
    double gsd_m_per_px = 0;                  ///< 0: none but what the source itself knows
    ScaleOrigin origin = ScaleOrigin::given;  ///< where there is one, of this or of the source
    MetadataScale by_metadata = {};           ///< what the metadata say; empty where they were not asked
};

/// The scale that a run over frames first … last (last < 0: to the end) is to work with: what a person gave (m/px, > 0)
/// and where that came from, else the source's own, for which nothing is stated here, else that of the metadata.
StatedScale statedScale(const FrameSource& source, FrameIndex first, FrameIndex last, double given_m_per_px,
                        ScaleOrigin given_origin, const std::stop_token& stop);

}  // namespace eyrie
