#include "widgets/parameters/parameter_editor.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSlider>
#include <QSpinBox>
#include <algorithm>
#include <cmath>

#include "widgets/real_spin_box.h"
#include "widgets/wiring.h"

namespace eyrie::ui {
namespace {

/// Lets the wheel scroll the form instead of changing a value that the pointer happens to pass.
class WheelGuard : public QObject {
 public:
    using QObject::QObject;

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        const auto* widget = qobject_cast<QWidget*>(watched);
        if (event->type() != QEvent::Wheel || widget == nullptr || widget->hasFocus()) return false;
        event->ignore();
        return true;
    }
};

void fill(ParameterEditor* editor, QWidget* field, QWidget* slider = nullptr) {
    auto* layout = new QHBoxLayout(editor);
    layout->setContentsMargins(0, 0, 0, 0);
    if (slider != nullptr) {
        slider->installEventFilter(new WheelGuard(editor));
        slider->setFocusPolicy(Qt::ClickFocus);
        layout->addWidget(slider, 2);
        field->setMinimumWidth(slider->minimumWidth());  // else whole and real numbers would not stand in a column
    }
    layout->addWidget(field, 3);
    field->setFocusPolicy(Qt::StrongFocus);
    field->installEventFilter(new WheelGuard(editor));
    editor->setFocusProxy(field);
}

/// A slider over the part of a number's range in which it is tuned: around the value it was made with.
class TuningSlider : public QSlider {
 public:
    TuningSlider(const Parameter& parameter, bool whole, QWidget* parent)
        : QSlider(Qt::Horizontal, parent), whole_(whole) {
        const double value = QString::fromStdString(parameter.value).toDouble();
        const double reach = value != 0 ? kReach * std::abs(value) : (parameter.max - parameter.min) / 10;
        lowest_ = std::max(parameter.min, value < 0 ? value - reach : std::min(0.0, value));
        highest_ = std::min(parameter.max, std::max(value, lowest_) + reach);
        if (parameter.max - parameter.min <= 1) {  // shares
            lowest_ = parameter.min;
            highest_ = parameter.max;
        }
        setRange(0, whole ? std::clamp(static_cast<int>(highest_ - lowest_), 1, kSteps) : kSteps);
        setMinimumWidth(40);
    }
    /// Moves the handle; tells nobody.
    void show(double value) {
        const QSignalBlocker quiet(this);
        const double share = highest_ > lowest_ ? (value - lowest_) / (highest_ - lowest_) : 0;
        setValue(static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * maximum())));
    }
    QString text() const {
        const double value = lowest_ + (highest_ - lowest_) * QSlider::value() / maximum();
        if (whole_) return QString::number(std::lround(value));
        // As many digits as a step of the handle changes.
        const double step = (highest_ - lowest_) / maximum();
        const double unit = std::pow(10.0, std::floor(std::log10(step)));
        return QString::number(std::clamp(std::round(value / unit) * unit, lowest_, highest_), 'g', 6);
    }

 private:
    static constexpr double kReach = 3;
    static constexpr int kSteps = 200;
    bool whole_;
    double lowest_ = 0;
    double highest_ = 1;
};

class RealEditor : public ParameterEditor {
 public:
    RealEditor(const Parameter& parameter, QWidget* parent)
        : ParameterEditor(parent),
          field_(new RealSpinBox(parameter.min, parameter.max, this)),
          slider_(new TuningSlider(parameter, false, this)) {
        fill(this, field_, slider_);
        connect(field_, &RealSpinBox::edited, this, [this](const QString& value) {
            slider_->show(value.toDouble());
            emit edited(value);
        });
        onEdited(this, &RealEditor::takeSlider, slider_);
    }
    QString value() const override { return field_->valueText(); }
    void setValue(const QString& value) override {
        field_->setValueText(value);
        slider_->show(value.toDouble());
    }
    void setReadOnly(bool read_only) override {
        field_->setReadOnly(read_only);
        slider_->setEnabled(!read_only);
    }

 private:
    void takeSlider() {
        field_->setValueText(slider_->text());
        emit edited(field_->valueText());
    }

    RealSpinBox* field_;
    TuningSlider* slider_;
};

class IntegerEditor : public ParameterEditor {
 public:
    IntegerEditor(const Parameter& parameter, QWidget* parent)
        : ParameterEditor(parent), field_(new QSpinBox(this)), slider_(new TuningSlider(parameter, true, this)) {
        field_->setRange(static_cast<int>(parameter.min), static_cast<int>(parameter.max));
        // A number half typed is no value.
        field_->setKeyboardTracking(false);
        fill(this, field_, slider_);
        onEdited(this, &IntegerEditor::takeField, field_);
        onEdited(
            this, [this] { field_->setValue(slider_->text().toInt()); }, slider_);
    }
    QString value() const override { return QString::number(field_->value()); }
    void setValue(const QString& value) override {
        const QSignalBlocker quiet(field_);
        field_->setValue(value.toInt());
        slider_->show(value.toInt());
    }
    void setReadOnly(bool read_only) override {
        field_->setReadOnly(read_only);
        slider_->setEnabled(!read_only);
        field_->setButtonSymbols(read_only ? QAbstractSpinBox::NoButtons : QAbstractSpinBox::UpDownArrows);
    }

 private:
    void takeField() {
        slider_->show(field_->value());
        emit edited(value());
    }

    QSpinBox* field_;
    TuningSlider* slider_;
};

class FlagEditor : public ParameterEditor {
 public:
    explicit FlagEditor(QWidget* parent) : ParameterEditor(parent), field_(new QCheckBox(this)) {
        fill(this, field_);
        onEdited(
            this, [this] { emit edited(value()); }, field_);
    }
    QString value() const override { return field_->isChecked() ? QStringLiteral("true") : QStringLiteral("false"); }
    void setValue(const QString& value) override {
        const QSignalBlocker quiet(field_);
        field_->setChecked(value == QStringLiteral("true"));
    }
    void setReadOnly(bool read_only) override { field_->setEnabled(!read_only); }

 private:
    QCheckBox* field_;
};

class ChoiceEditor : public ParameterEditor {
 public:
    ChoiceEditor(const Parameter& parameter, QWidget* parent) : ParameterEditor(parent), field_(new QComboBox(this)) {
        for (const std::string& choice : parameter.choices) field_->addItem(QString::fromStdString(choice));
        fill(this, field_);
        bindCommands(this, {{field_, [this] {
                                 if (value() == shown_) return;
                                 shown_ = value();
                                 emit edited(shown_);
                             }}});
    }
    QString value() const override { return field_->currentText(); }
    void setValue(const QString& value) override {
        field_->setCurrentIndex(field_->findText(value));
        shown_ = value;
    }
    void setReadOnly(bool read_only) override { field_->setEnabled(!read_only); }

 private:
    QComboBox* field_;
    QString shown_;
};

class WordsEditor : public ParameterEditor {
 public:
    explicit WordsEditor(QWidget* parent) : ParameterEditor(parent), field_(new QLineEdit(this)) {
        fill(this, field_);
        const auto take = [this] {
            if (value() == shown_) return;
            shown_ = value();
            emit edited(shown_);
        };
        onFinished(this, take, field_);
    }
    QString value() const override { return field_->text(); }
    void setValue(const QString& value) override {
        field_->setText(value);
        shown_ = value;
    }
    void setReadOnly(bool read_only) override { field_->setReadOnly(read_only); }

 private:
    QLineEdit* field_;
    QString shown_;
};

}  // namespace

ParameterEditor* makeParameterEditor(const Parameter& parameter, QWidget* parent) {
    switch (parameter.kind) {
        case ParameterKind::integer:
            return new IntegerEditor(parameter, parent);
        case ParameterKind::flag:
            return new FlagEditor(parent);
        case ParameterKind::choice:
            return new ChoiceEditor(parameter, parent);
        case ParameterKind::words:
            return new WordsEditor(parent);
        case ParameterKind::real:
            break;
    }
    return new RealEditor(parameter, parent);
}

}  // namespace eyrie::ui

#include "moc_parameter_editor.cpp"
