#pragma once

#include <QColor>
#include <map>
#include <set>
#include <string>

#include "core/labels/annotation.h"

namespace eyrie::ui {

/// The colours in which objects are shown: their own where somebody gave them one, else that of their class. For one
/// list: classes are looked up once.
class ObjectColours {
 public:
    /// The labels must outlive it.
    explicit ObjectColours(const AnnotationSet& set);

    QColor of(const LabelledObject& object);
    QColor ofClass(const std::string& name);
    /// Colours of classes are nobody's own; neither is 0.
    bool isOwn(const LabelledObject& object) const;

 private:
    const AnnotationSet& set_;
    std::set<std::uint32_t> of_classes_;
    std::map<std::string, QColor> known_;
};

}  // namespace eyrie::ui
