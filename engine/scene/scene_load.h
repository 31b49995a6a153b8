#pragma once

#include "scene/scene_description.h"

namespace eyrie {

/// What a preset wants to hold of the truth that counts (is not marked ignore), as in Teutsch table 7.1; 0: whatever
/// comes. What trees and buildings hide is not looked at.
struct LoadTarget {
    int vehicle_tracks = 0;
    int vehicle_boxes = 0;
    int other_tracks = 0;
    int other_boxes = 0;
    int most_objects = 0;
};

/// Takes objects out until no more than the wanted number of tracks is left, choosing those that bring the number of
/// boxes nearest to the wanted one and relieve crowded frames first; drops objects that never come into the picture;
/// numbers the rest anew from 1.
void thinOut(SceneDescription& scene, const LoadTarget& target);

}  // namespace eyrie
