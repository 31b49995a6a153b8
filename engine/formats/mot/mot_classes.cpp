#include "formats/mot/mot_classes.h"

#include "core/labels/track_class.h"

namespace eyrie {
namespace {

constexpr int kPerson = 1;
constexpr int kPersonOnVehicle = 2;
constexpr int kCar = 3;
constexpr int kBicycle = 4;
constexpr int kMotorbike = 5;
constexpr int kOtherVehicle = 6;
constexpr int kStaticPerson = 7;
constexpr int kDistractor = 8;

}  // namespace

std::string classFromMot(int number) {
    if (number < kPerson) return {};
    switch (number) {
        case kPerson:
        case kPersonOnVehicle:
        case kStaticPerson:
            return "person";
        case kCar:
            return "car";
        case kBicycle:
            return "bicycle";
        case kMotorbike:
            return "motorcycle";
        case kOtherVehicle:
            return "vehicle";
        default:
            return "other";
    }
}

MotClass motFromClass(const std::string& object_class) {
    if (object_class.empty()) return {-1, true};
    if (object_class == "person") return {kPerson, true};
    if (object_class == "car") return {kCar, true};
    if (object_class == "bicycle") return {kBicycle, true};
    if (object_class == "motorcycle") return {kMotorbike, true};
    if (object_class == "vehicle") return {kOtherVehicle, true};
    if (isVehicleClass(object_class)) return {kOtherVehicle, false};
    if (trackClassOf(object_class) == TrackClass::two_wheeler) return {kMotorbike, false};
    return {kDistractor, object_class == "other"};
}

}  // namespace eyrie
