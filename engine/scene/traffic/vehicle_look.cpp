#include <algorithm>
#include <array>

#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

/// Body colours of cars, blue-green-red, as often as on the street: half of them white, grey or black.
cv::Vec3f carColour(Random& random) {
    struct Choice {
        double share;
        cv::Vec3f colour;
    };
    static const std::array<Choice, 12> choices{{{0.20, {212, 214, 214}},
                                                 {0.16, {158, 160, 160}},
                                                 {0.15, {30, 29, 29}},
                                                 {0.13, {76, 74, 73}},
                                                 {0.08, {105, 103, 100}},
                                                 {0.08, {110, 62, 36}},
                                                 {0.06, {34, 34, 128}},
                                                 {0.04, {58, 40, 30}},
                                                 {0.03, {44, 62, 36}},
                                                 {0.03, {98, 122, 138}},
                                                 {0.02, {40, 158, 196}},
                                                 {0.02, {150, 120, 70}}}};
    double rest = random.uniform();
    for (const Choice& choice : choices) {
        rest -= choice.share;
        if (rest < 0) return choice.colour * static_cast<float>(random.uniform(0.88, 1.1));
    }
    return choices.front().colour;
}

}  // namespace

ObjectKind randomVehicleKind(Random& random) {
    const double draw = random.uniform();
    if (draw < 0.76) return ObjectKind::car;
    if (draw < 0.89) return ObjectKind::van;
    return draw < 0.97 ? ObjectKind::truck : ObjectKind::bus;
}

ObjectLook randomLook(ObjectKind kind, Random& random) {
    ObjectLook look;
    look.kind = kind;
    look.seed = random.bits();
    look.colour = carColour(random);
    switch (kind) {
        case ObjectKind::car:
            look.length = std::clamp(4.45 + 0.32 * random.normal(), 3.6, 5.1);
            look.width = 1.35 + 0.1 * look.length + random.uniform(-0.04, 0.04);
            look.height = random.chance(0.3) ? random.uniform(1.6, 1.75) : random.uniform(1.42, 1.52);
            break;
        case ObjectKind::van:
            look.length = random.uniform(4.9, 6.4);
            look.width = random.uniform(1.92, 2.1);
            look.height = random.uniform(1.95, 2.6);
            if (random.chance(0.6)) look.colour = cv::Vec3f(208, 210, 210);
            break;
        case ObjectKind::truck:
            look.length = random.chance(0.3) ? random.uniform(13.5, 16.0) : random.uniform(7.0, 9.8);
            look.width = random.uniform(2.4, 2.55);
            look.height = random.uniform(3.2, 3.9);
            break;
        case ObjectKind::bus:
            look.length = random.uniform(11.5, 12.4);
            look.width = 2.55;
            look.height = random.uniform(3.0, 3.3);
            look.colour = random.chance(0.5) ? cv::Vec3f(60, 170, 205) : cv::Vec3f(190, 190, 188);
            break;
        case ObjectKind::motorcycle:
            look.length = random.uniform(1.95, 2.25);
            look.width = random.uniform(0.75, 0.9);
            look.height = 1.68;
            break;
        case ObjectKind::bicycle:
            look.length = random.uniform(1.65, 1.85);
            look.width = random.uniform(0.55, 0.65);
            look.height = 1.68;
            break;
        case ObjectKind::person:
            look.length = random.uniform(0.42, 0.6);
            look.width = random.uniform(0.5, 0.65);
            look.height = random.uniform(1.55, 1.85);
            break;
    }
    return look;
}

}  // namespace eyrie
