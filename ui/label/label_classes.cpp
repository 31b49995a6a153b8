#include "label/label_classes.h"

#include <QCoreApplication>
#include <algorithm>
#include <set>

#include "core/values/scene_scale.h"

namespace eyrie::ui {

namespace {

template <class Classes>
auto find(Classes& classes, const std::string& name) {
    return std::find_if(classes.begin(), classes.end(), [&](const ObjectClass& entry) { return entry.name == name; });
}

void merge(std::vector<ObjectClass>& classes, const std::vector<ObjectClass>& own) {
    for (const ObjectClass& entry : own) {
        const auto known = find(classes, entry.name);
        if (known == classes.end()) {
            classes.push_back(entry);
            continue;
        }
        known->vehicle = entry.vehicle;
        if (entry.colour != 0) known->colour = entry.colour;
        if (entry.length_m > 0) known->length_m = entry.length_m;
        if (entry.width_m > 0) known->width_m = entry.width_m;
    }
}

}  // namespace

const std::vector<ObjectClass>& builtInClasses() {
    static const std::vector<ObjectClass> classes = {
        {"car", true, 0x4cc9ff, kCarLength_m, 1.85}, {"truck", true, 0xffb020, 9.0, 2.5},
        {"bus", true, 0xff6f91, 12.0, 2.55},         {"van", true, 0x9be15d, 5.6, 2.1},
        {"motorcycle", false, 0xd59bff, 2.2, 0.8},   {"bicycle", false, 0xf4e04d, 1.8, 0.6},
        {"person", false, 0xff8a5c, 0.6, 0.6},       {"other", false, 0xc8ccd4, 0, 0}};
    return classes;
}

std::vector<ObjectClass> classesOf(const AnnotationSet& set) {
    std::vector<ObjectClass> classes = builtInClasses();
    merge(classes, set.classes);
    std::set<std::string> named;
    for (const auto& [id, object] : set.objects) named.insert(object.object_class);
    for (const std::string& name : named)
        if (find(classes, name) == classes.end()) classes.push_back({name, true, 0xc8ccd4, 0, 0});
    return classes;
}

ObjectClass classNamed(const AnnotationSet& set, const std::string& name) {
    ObjectClass result{name, true, 0xc8ccd4, 0, 0};
    const auto built_in = find(builtInClasses(), name);
    if (built_in != builtInClasses().end()) result = *built_in;
    std::vector<ObjectClass> merged{result};
    const auto own = find(set.classes, name);
    if (own != set.classes.end()) merge(merged, {*own});
    return merged.front();
}

QString classText(const std::string& name) {
    return name.empty() ? QCoreApplication::translate("eyrie::ui", "no class") : QString::fromStdString(name);
}

}  // namespace eyrie::ui
