// Not a test: how much work labelling is, for reports. A robot labels a clip with known truth through the window, by
// mouse and keys, until every box overlaps the truth by as much as asked for.
//   ninja labelling_effort && bin/labelling_effort CLIP TRUTH.csv GSD RATE OVERLAP [upright]
#include <QApplication>
#include <cstdio>

#include "ui/label/labelling_robot.h"

namespace eyrie::ui {
namespace {

using test::Robot;
using test::Truth;
using test::Work;

void print(const char* what, std::size_t vehicles, const Work& work, double keyframes, double worst) {
    const double n = static_cast<double>(std::max<std::size_t>(1, vehicles));
    std::printf(
        "%-16s %3zu vehicles: %4d clicks, %4d keys (%.1f and %.1f each), %.2f keyframes each, least overlap %.2f\n",
        what, vehicles, work.clicks, work.keys, work.clicks / n, work.keys / n, keyframes / n, worst);
}

void fromNothing(Robot& robot, const std::map<int, Truth>& truth, std::size_t vehicles) {
    // The longest lives: the most work.
    std::vector<const Truth*> longest;
    for (const auto& [id, known] : truth) longest.push_back(&known);
    std::sort(longest.begin(), longest.end(),
              [](const Truth* a, const Truth* b) { return a->counted.size() > b->counted.size(); });
    longest.resize(std::min(vehicles, longest.size()));
    robot.work = {};
    double keyframes = 0;
    double worst = 1;
    for (const Truth* known : longest) {
        const ObjectId id = robot.drawFromNothing(*known);
        if (id == 0) continue;
        keyframes += static_cast<double>(robot.keyframes(id));
        worst = std::min(worst, robot.worst(id, *known));
    }
    print("from nothing", longest.size(), robot.work, keyframes, worst);
}

void fromProposals(Robot& robot, const std::map<int, Truth>& truth) {
    robot.work = {};
    robot.takeOver();
    std::map<int, std::vector<std::pair<int, ObjectId>>> shown;  // by vehicle: frames, object
    std::vector<ObjectId> removed;
    std::vector<ObjectId> all;
    for (const auto& [id, object] : robot.labels().annotations().objects) all.push_back(id);
    const std::size_t taken = all.size();
    for (const ObjectId id : all) {
        bool of_any = false;
        const auto [vehicle, frames] = robot.vehicleOf(id, truth, of_any);
        if (vehicle != 0) {
            shown[vehicle].push_back({frames, id});
        } else {
            removed.push_back(id);
        }
    }
    double keyframes = 0;
    double worst = 1;
    int joined = 0;
    int untouched = 0;
    int drawn = 0;
    for (const auto& [vehicle, known] : truth) {
        const Work before = robot.work;
        auto& objects = shown[vehicle];
        std::sort(objects.rbegin(), objects.rend());
        ObjectId id = objects.empty() ? 0 : objects.front().second;
        for (std::size_t i = 1; i < objects.size(); ++i) {
            const auto& present = robot.labels().annotations().objects;
            const LabelledObject& a = present.at(id);
            const LabelledObject& b = present.at(objects[i].second);
            if (firstFrameOf(a) > b.last_frame || firstFrameOf(b) > a.last_frame) {
                robot.joinObjects(id, objects[i].second);
                ++joined;
            } else {
                removed.push_back(objects[i].second);
            }
        }
        if (id == 0) {
            id = robot.drawFromNothing(known);
            ++drawn;
        } else {
            id = robot.correctProposal(id, known);
        }
        const int actions = robot.work.clicks + robot.work.keys - before.clicks - before.keys;
        constexpr int kMany = 15;
        if (actions >= kMany)
            std::printf("  vehicle %d took %d clicks and keys: %zu frames, %zu tracks, %zu keyframes\n", vehicle,
                        actions, known.counted.size(), objects.size(), robot.keyframes(id));
        untouched += robot.work.clicks == before.clicks && robot.work.keys == before.keys ? 1 : 0;
        if (id == 0) continue;
        keyframes += static_cast<double>(robot.keyframes(id));
        worst = std::min(worst, robot.worst(id, known));
    }
    robot.removeObjects(removed);
    print("from proposals", truth.size(), robot.work, keyframes, worst);
    std::printf(
        "  %zu taken over by two keys, %zu removed, %d joined, %d vehicles drawn from nothing, %d never touched\n",
        taken, removed.size(), joined, drawn, untouched);
}

}  // namespace
}  // namespace eyrie::ui

int main(int argc, char** argv) {
    using namespace eyrie::ui;
    if (argc < 6) return 2;
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    const auto truth = test::readTruth(argv[2]);
    const bool upright = argc > 6 && std::string(argv[6]) == "upright";
    for (int way = 0; way < 3; ++way) {
        Robot robot(argv[1], std::stod(argv[3]), std::stod(argv[4]), std::stod(argv[5]), upright);
        if (!robot.open()) return 1;
        if (way == 2)
            fromProposals(robot, truth);
        else
            fromNothing(robot, truth, way == 0 ? 3 : truth.size());
    }
}
