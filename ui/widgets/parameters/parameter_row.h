#pragma once

#include <QWidget>

#include "core/parameter.h"

class QLabel;
class QToolButton;

namespace eyrie::ui {

class ParameterEditor;

/// One parameter in the form: its name, its field, its unit, and a button back to the default once it differs.
class ParameterRow : public QWidget {
    Q_OBJECT
 public:
    ParameterRow(const Parameter& parameter, QWidget* parent);

    const QString& name() const { return name_; }
    QString value() const;
    /// Shows a value and what it is compared with; tells nobody.
    void setValues(const QString& value, const QString& default_value);
    bool isModified() const { return modified_; }
    void resetToDefault();
    void setReadOnly(bool read_only);
    /// Whether every word is in the name, help, source or unit.
    bool matches(const QStringList& words) const;
    /// Shows for a moment which row is meant.
    void flash();
    /// Range, default, help and source, as rich text.
    QString helpText() const;

 signals:
    void valueChanged(const QString& name, const QString& value);
    /// The pointer or the keyboard came to this row.
    void pointedAt();

 protected:
    void enterEvent(QEnterEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void compare();
    Parameter parameter_;
    QString name_;
    QString default_;
    bool modified_ = false;
    bool read_only_ = false;
    QLabel* label_;
    ParameterEditor* editor_;
    QToolButton* reset_;
};

}  // namespace eyrie::ui
