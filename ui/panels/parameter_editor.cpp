#include "panels/parameter_editor.h"

#include <QCheckBox>
#include <QComboBox>
#include <QEvent>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSpinBox>

#include "panels/real_spin_box.h"

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

void fill(ParameterEditor* editor, QWidget* field) {
    auto* layout = new QHBoxLayout(editor);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(field);
    field->setFocusPolicy(Qt::StrongFocus);
    field->installEventFilter(new WheelGuard(editor));
    editor->setFocusProxy(field);
}

class RealEditor : public ParameterEditor {
 public:
    RealEditor(const Parameter& parameter, QWidget* parent)
        : ParameterEditor(parent), field_(new RealSpinBox(parameter.min, parameter.max, this)) {
        fill(this, field_);
        connect(field_, &RealSpinBox::edited, this, &ParameterEditor::edited);
    }
    QString value() const override { return field_->valueText(); }
    void setValue(const QString& value) override { field_->setValueText(value); }
    void setReadOnly(bool read_only) override { field_->setReadOnly(read_only); }

 private:
    RealSpinBox* field_;
};

class IntegerEditor : public ParameterEditor {
 public:
    IntegerEditor(const Parameter& parameter, QWidget* parent) : ParameterEditor(parent), field_(new QSpinBox(this)) {
        field_->setRange(static_cast<int>(parameter.min), static_cast<int>(parameter.max));
        // A number half typed is no value.
        field_->setKeyboardTracking(false);
        fill(this, field_);
        connect(field_, &QSpinBox::valueChanged, this, [this](int value) { emit edited(QString::number(value)); });
    }
    QString value() const override { return QString::number(field_->value()); }
    void setValue(const QString& value) override {
        const QSignalBlocker quiet(field_);
        field_->setValue(value.toInt());
    }
    void setReadOnly(bool read_only) override {
        field_->setReadOnly(read_only);
        field_->setButtonSymbols(read_only ? QAbstractSpinBox::NoButtons : QAbstractSpinBox::UpDownArrows);
    }

 private:
    QSpinBox* field_;
};

class FlagEditor : public ParameterEditor {
 public:
    explicit FlagEditor(QWidget* parent) : ParameterEditor(parent), field_(new QCheckBox(this)) {
        fill(this, field_);
        connect(field_, &QCheckBox::toggled, this, [this] { emit edited(value()); });
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
        connect(field_, &QComboBox::activated, this, [this] {
            if (value() == shown_) return;
            shown_ = value();
            emit edited(shown_);
        });
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
        connect(field_, &QLineEdit::editingFinished, this, [this] {
            if (value() == shown_) return;
            shown_ = value();
            emit edited(shown_);
        });
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
