#include "label/object_colours.h"

#include "label/label_classes.h"

namespace eyrie::ui {

namespace {
QColor colourFrom(std::uint32_t rgb) {
    return QColor::fromRgb(static_cast<QRgb>(rgb | 0xff000000U));
}
}  // namespace

ObjectColours::ObjectColours(const AnnotationSet& set) : set_(set) {
    for (const ObjectClass& entry : builtInClasses()) of_classes_.insert(entry.colour);
    for (const ObjectClass& entry : classesOf(set)) of_classes_.insert(entry.colour);
}

bool ObjectColours::isOwn(const LabelledObject& object) const {
    return object.colour != 0 && !of_classes_.contains(object.colour);
}

QColor ObjectColours::of(const LabelledObject& object) {
    return isOwn(object) ? colourFrom(object.colour) : ofClass(object.object_class);
}

QColor ObjectColours::ofClass(const std::string& name) {
    const auto known = known_.find(name);
    if (known != known_.end()) return known->second;
    return known_[name] = colourFrom(classNamed(set_, name).colour);
}

}  // namespace eyrie::ui
