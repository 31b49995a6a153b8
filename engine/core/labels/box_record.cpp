#include "core/labels/box_record.h"

#include <algorithm>
#include <cmath>

namespace eyrie {

bool isVehicleClass(const std::string& object_class) {
    return object_class == "car" || object_class == "truck" || object_class == "bus" || object_class == "van" ||
           object_class == "vehicle";
}

std::string originText(const BoxRecord& record) {
    return record.origin ? nameOf(*record.origin) : "";
}

bool allUpright(const BoxesByFrame& boxes) {
    constexpr double kTurned = 1e-6;
    return std::all_of(boxes.begin(), boxes.end(), [](const auto& entry) {
        return std::all_of(entry.second.begin(), entry.second.end(), [](const BoxRecord& record) {
            return std::abs(std::sin(2 * record.box.heading)) <= kTurned;
        });
    });
}

}  // namespace eyrie
