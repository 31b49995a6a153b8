#pragma once

#include <QWidget>

#include "core/parameter.h"

namespace eyrie::ui {

/// The field of one parameter. Values are texts, as setParameter() reads them.
class ParameterEditor : public QWidget {
    Q_OBJECT
 public:
    using QWidget::QWidget;
    virtual QString value() const = 0;
    /// Shows a value; tells nobody.
    virtual void setValue(const QString& value) = 0;
    virtual void setReadOnly(bool read_only) = 0;

 signals:
    /// A person changed the value; it is one that setParameter() accepts.
    void edited(const QString& value);
};

/// The fitting field: a number with steps, a check box, a list of choices, or a line of text.
ParameterEditor* makeParameterEditor(const Parameter& parameter, QWidget* parent);

}  // namespace eyrie::ui
