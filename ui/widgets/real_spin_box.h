#pragma once

#include <QAbstractSpinBox>

namespace eyrie::ui {

/// A field for a real number that keeps the text it was given until somebody edits it: showing a value never rounds it.
/// Numbers are written as in presets and on the command line, with a point; a typed comma is taken as one.
class RealSpinBox : public QAbstractSpinBox {
    Q_OBJECT
 public:
    RealSpinBox(double min, double max, QWidget* parent = nullptr);

    /// The text given, or after an edit the shortest that reads back identically.
    const QString& valueText() const { return value_text_; }
    /// Shows a value; tells nobody.
    void setValueText(const QString& text);

    void stepBy(int steps) override;
    QValidator::State validate(QString& input, int& position) const override;
    QSize sizeHint() const override;

 signals:
    /// A person changed the value; it lies in the range.
    void edited(const QString& value_text);

 protected:
    StepEnabled stepEnabled() const override;
    void keyPressEvent(QKeyEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;

 private:
    void commit();
    void take(double value);
    double min_;
    double max_;
    QString value_text_;
};

/// The shortest text that reads back as exactly this number.
QString exactText(double value);

}  // namespace eyrie::ui
