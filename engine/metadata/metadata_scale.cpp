#include "metadata/metadata_scale.h"

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr int kFramesAsked = 50;
constexpr double kFinest = 0.005;  ///< m/px at which a chain for small vehicles is of any use
constexpr double kCoarsest = 5;    ///< m/px
constexpr double kSpread = 2;

}  // namespace

MetadataScale scaleByMetadata(const MetadataTimeline& timeline, const FrameSource& source, FrameIndex first,
                              FrameIndex last) {
    MetadataScale scale;
    std::vector<double> known;
    std::map<GroundSource, int> sources;
    const int frames = last - first + 1;
    scale.frames_asked = std::clamp(frames, 0, kFramesAsked);
    for (int i = 0; i < scale.frames_asked; ++i) {
        const auto step = static_cast<std::int64_t>(i) * frames / scale.frames_asked;
        const std::int64_t time = source.timeOf(first + static_cast<FrameIndex>(step));
        const GroundView view = groundViewOf(timeline.at(time), source.info().size);
        if (!view.gsd()) continue;
        known.push_back(*view.gsd());
        ++sources[view.scale_source];
    }
    scale.frames_known = static_cast<int>(known.size());
    if (known.empty()) {
        scale.why_not = "they give no scale";
        return scale;
    }
    std::sort(known.begin(), known.end());
    const double median = known[known.size() / 2];
    const double low = known[known.size() / 20], high = known[known.size() - 1 - known.size() / 20];
    if (scale.frames_known * 2 < scale.frames_asked) {
        scale.why_not = "only " + std::to_string(scale.frames_known) + " of " + std::to_string(scale.frames_asked) +
                        " frames looked at have a scale";
    } else if (median < kFinest || median > kCoarsest) {
        scale.why_not = fixedText(median, 4) + " m/px is implausible";
    } else if (high > kSpread * low) {
        scale.why_not = "the scale changes from " + fixedText(low, 4) + " to " + fixedText(high, 4) + " m/px";
    } else {
        scale.gsd_m_per_px = median;
        scale.source = std::max_element(sources.begin(), sources.end(), [](const auto& a, const auto& b) {
                           return a.second < b.second;
                       })->first;
    }
    return scale;
}

MetadataScale scaleByMetadata(const FrameSource& source, FrameIndex first, FrameIndex last,
                              const std::stop_token& stop) {
    MetadataScale none;
    const std::vector<PictureStamp> pictures = source.pictureStamps();
    if (pictures.empty()) return none;
    try {
        const MetadataRecording recording = readMetadata(source.info(), {}, stop);
        const int chosen = recording.mostUseful();
        if (chosen < 0) return none;
        const MetadataTimeline timeline(recording.streams[static_cast<std::size_t>(chosen)], pictures,
                                        timelineOptionsOf(source.info()));
        return scaleByMetadata(timeline, source, first, last);
    } catch (const Error& error) {
        none.why_not = error.what();
        return none;
    }
}

StatedScale statedScale(const FrameSource& source, FrameIndex first, FrameIndex last, double given_m_per_px,
                        ScaleOrigin given_origin, const std::stop_token& stop) {
    if (given_m_per_px > 0) return {given_m_per_px, given_origin, {}};
    if (source.info().gsd_m_per_px > 0) return {};
    const FrameIndex end = source.info().frame_count - 1;
    MetadataScale found = scaleByMetadata(source, first, last < 0 ? end : std::min(last, end), stop);
    return {found.gsd_m_per_px, ScaleOrigin::metadata, std::move(found)};
}

}  // namespace eyrie
