#include "core/box_record.h"

namespace eyrie {

bool isVehicleClass(const std::string& object_class) {
    return object_class == "car" || object_class == "truck" || object_class == "bus" || object_class == "van" ||
           object_class == "vehicle";
}

}  // namespace eyrie
