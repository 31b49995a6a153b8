#pragma once

#include <QString>
#include <cstdint>
#include <vector>

#include "core/labels/annotation.h"

namespace eyrie::ui {

/// The classes every project knows, with usual sizes and colours that are told apart on any ground.
const std::vector<ObjectClass>& builtInClasses();

/// The classes of a project: the built-in ones, changed and added to by its own, then those that only objects name.
std::vector<ObjectClass> classesOf(const AnnotationSet& set);

/// What is known of a class; one that nobody described is grey and has no size.
ObjectClass classNamed(const AnnotationSet& set, const std::string& name);

/// The class's name for people.
QString classText(const std::string& name);

}  // namespace eyrie::ui
