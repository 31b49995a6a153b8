#pragma once

#include <QStringList>
#include <QWidget>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/parameter.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QScrollArea;
class QToolButton;
class QVBoxLayout;

namespace eyrie::ui {

class CollapsibleSection;
class ParameterRow;

/// What the form leads to.
struct ParameterFormCommands {
    /// Save the current values as a preset.
    std::function<void()> save_preset = [] {};
    std::function<void()> show_presets = [] {};
};

/// The form of all parameters, made from their declarations: a section per group, a row per parameter, with search,
/// help, and the way back to the defaults. It knows values as texts and nothing of the engine's options.
class ParameterForm : public QWidget {
    Q_OBJECT
 public:
    explicit ParameterForm(QWidget* parent = nullptr);
    void setCommands(ParameterFormCommands commands) { commands_ = std::move(commands); }

    /// Shows values; tells nobody. `defaults` are what "modified" and "reset" refer to, e.g. those of the preset; where
    /// it lacks a name, the present value is taken. Rows are made anew only when the declarations differ.
    void setParameters(const std::vector<Parameter>& current, const std::vector<Parameter>& defaults);
    /// All values as shown, in the order of declaration.
    std::vector<std::pair<std::string, std::string>> values() const;
    /// Whether any value differs from its default.
    bool isModified() const { return modifiedCount() > 0; }
    /// How many values differ from their defaults.
    int modifiedCount() const;

    /// Names to choose from and the one the values started from.
    void setPresets(const QStringList& names, const QString& current);
    /// For the parameters of a stored run: everything can be read and copied, nothing changed.
    void setReadOnly(bool read_only);
    void setFilterText(const QString& text);
    void setModifiedOnly(bool modified_only);
    /// Brings a parameter into sight, whatever is searched for, and sets the keyboard to its field; false when there is
    /// none of the name.
    bool reveal(const QString& name);
    /// Every value that differs back to its default, each told by valueChanged().
    void resetAll();

 signals:
    /// The mouse or the keyboard came to a parameter.
    void pointedAt(const QString& name);
    /// A person changed one value.
    void valueChanged(const QString& name, const QString& value);
    void presetChosen(const QString& name);

 private:
    struct Group {
        QString title;
        CollapsibleSection* section = nullptr;
        std::vector<ParameterRow*> rows;
    };

    bool hasRowsFor(const std::vector<Parameter>& parameters) const;
    void makeRows(const std::vector<Parameter>& parameters);
    void onRowChanged(const QString& name, const QString& value);
    void refresh();
    QWidget* makePresetLine();
    QWidget* makeSearchLine();

    ParameterFormCommands commands_;
    std::vector<Parameter> declarations_;
    std::vector<Group> groups_;
    std::vector<ParameterRow*> rows_;
    bool read_only_ = false;
    QComboBox* presets_;
    QToolButton* save_preset_;
    QLineEdit* search_;
    QToolButton* modified_only_;
    QToolButton* reset_all_;
    QScrollArea* scroll_;
    QWidget* rows_area_;
    QVBoxLayout* rows_layout_;
    QLabel* nothing_;
    QLabel* help_;
};

}  // namespace eyrie::ui
