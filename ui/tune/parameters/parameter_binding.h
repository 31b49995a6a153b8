#pragma once

#include <QObject>

#include "session/project/preset_library.h"
#include "session/project_session.h"

namespace eyrie::ui {

class MessageBar;
class ParameterForm;

/// Joins the form of parameters with the settings of the next run and with the presets.
class ParameterBinding : public QObject {
    Q_OBJECT

 public:
    /// All must outlive the binding. What goes wrong is told by `messages`.
    ParameterBinding(ProjectSession& session, ParameterForm& form, MessageBar& messages, QObject* parent);

    /// Takes over the parameters of the current run, which were read with it.
    void adoptRunParameters();
    /// Sets one parameter of the next run; its name and value must be right.
    void setValue(const std::string& name, const std::string& value);
    /// Sets several parameters of the next run, those of a point of a sweep.
    void setValues(const std::vector<std::pair<std::string, std::string>>& values);
    PresetLibrary& presets() { return presets_; }
    /// Asks for a name and keeps these parameters as a preset.
    void saveAsPreset(const ChainOptions& options);

 private:
    void show();
    void choosePreset(const QString& name);
    void usePreset(const QString& name);
    void savePreset();
    void comparePresets();
    void tellProblem(const QString& text);
    void tell(const QString& text);

    ProjectSession& session_;
    ParameterForm& form_;
    MessageBar& messages_;
    PresetLibrary presets_;
    ChainOptions defaults_;         ///< the values of the preset chosen last
    std::string defaults_awaited_;  ///< a preset that was not read yet when it was wanted
};

}  // namespace eyrie::ui
