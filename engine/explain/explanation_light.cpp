#include "explain/explanation_steps.h"

namespace eyrie::explaining {

void tellTrim(Story& story, TrackId track) {
    const auto trim = story.evidence.trims.find(track);
    if (trim == story.evidence.trims.end()) return;
    std::string text = describe(trim->second);
    const auto& shadow = story.evidence.shadow;
    if (trim->second.what == LightOutcome::shadows && shadow)
        text += "; shadows fall " + describe(*shadow, story.scale) + " in this frame";
    story.note("tracks", text, "finishing.trim_shadows");
}

void tellShadowHere(Story& story) {
    const auto& shadow = story.evidence.shadow;
    if (shadow)
        story.note("tracks", "shadows fall " + describe(*shadow, story.scale) + " in this frame",
                   "finishing.drop_shadows");
}

}  // namespace eyrie::explaining
