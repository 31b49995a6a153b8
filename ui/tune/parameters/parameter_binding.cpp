#include "tune/parameters/parameter_binding.h"

#include <QInputDialog>

#include "core/error.h"
#include "rerun/replay.h"
#include "tune/parameters/preset_dialog.h"
#include "widgets/message_bar.h"
#include "widgets/parameters/parameter_form.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

ParameterBinding::ParameterBinding(ProjectSession& session, ParameterForm& form, MessageBar& messages, QObject* parent)
    : QObject(parent), session_(session), form_(form), messages_(messages), defaults_(session.settings().options) {
    connect(&form_, &ParameterForm::valueChanged, this, [this](const QString& name, const QString& value) {
        try {
            setParameter(describeOf(session_.settings().options), name.toStdString(), value.toStdString());
        } catch (const Error& error) {
            tellProblem(QString::fromUtf8(error.what()));
            show();
        }
    });
    connect(&form_, &ParameterForm::presetChosen, this, &ParameterBinding::choosePreset);
    form_.setCommands({.save_preset = [this] { savePreset(); }, .show_presets = [this] { comparePresets(); }});
    whenChanged(session_, this, {{SessionChange::project, [this] { presets_.useProject(session_.project()); }}});
    connect(&presets_, &PresetLibrary::changed, this, [this] {
        const PresetLibrary::Preset* awaited = presets_.find(defaults_awaited_);
        if (awaited != nullptr && awaited->options) {
            defaults_ = *awaited->options;
            defaults_awaited_.clear();
        }
        show();
    });
    show();
}

void ParameterBinding::tellProblem(const QString& text) {
    messages_.showMessage(MessageKind::error, text);
}

void ParameterBinding::tell(const QString& text) {
    messages_.showMessage(MessageKind::info, text);
}

void ParameterBinding::comparePresets() {
    PresetDialog dialog(presets_, session_.settings().options, form_.window());
    connect(&dialog, &PresetDialog::useRequested, this, &ParameterBinding::usePreset);
    dialog.exec();
    show();
}

void ParameterBinding::usePreset(const QString& name) {
    emit form_.presetChosen(name);  // as if it were chosen there, so that the preview follows, too
}

void ParameterBinding::show() {
    form_.setParameters(listParameters(describeOf(session_.settings().options)), listParameters(describeOf(defaults_)));
    QStringList names;
    for (const auto& preset : presets_.presets()) names << QString::fromStdString(preset.name);
    form_.setPresets(names, QString::fromStdString(session_.settings().preset));
}

void ParameterBinding::choosePreset(const QString& name) {
    const PresetLibrary::Preset* preset = presets_.find(name.toStdString());
    if (preset != nullptr && preset->options) {
        defaults_ = *preset->options;
        defaults_awaited_.clear();
        session_.settings().options = defaults_;
        session_.settings().preset = preset->name;
    } else {
        tellProblem(preset != nullptr ? preset->problem : tr("There is no preset “%1”.").arg(name));
    }
    show();
}

void ParameterBinding::savePreset() {
    bool accepted = false;
    const QString name = QInputDialog::getText(&form_, tr("Save preset"), tr("Name of the preset:"), QLineEdit::Normal,
                                               tr("my preset"), &accepted);
    if (!accepted) return;
    const ChainOptions options = session_.settings().options;
    presets_.save(name.toStdString(), options, this, [this, options](const QString& saved, const QString& what_failed) {
        if (!what_failed.isEmpty()) {
            tellProblem(what_failed);
            return;
        }
        session_.settings().preset = saved.toStdString();
        defaults_ = options;
        defaults_awaited_.clear();
        tell(tr("Saved the preset “%1”.").arg(saved));
        show();
    });
}

void ParameterBinding::setValue(const std::string& name, const std::string& value) {
    setParameter(describeOf(session_.settings().options), name, value);
    show();
}

void ParameterBinding::setValues(const std::vector<std::pair<std::string, std::string>>& values) {
    try {
        setParameters(describeOf(session_.settings().options), values);
        tell(tr("The next run uses the parameters of this point."));
    } catch (const Error& error) {
        tellProblem(QString::fromUtf8(error.what()));
    }
    show();
}

void ParameterBinding::saveAsPreset(const ChainOptions& options) {
    session_.settings().options = options;
    savePreset();
}

void ParameterBinding::adoptRunParameters() {
    if (!session_.runData()) return;
    // Parameters that this version does not know any more would make the run's values unusable as a whole; they are
    // named, the others taken.
    std::vector<std::string> names;
    session_.settings().options = storedOptions(session_.runData()->parameters, &names);
    const std::string preset = session_.runData()->record.preset;
    session_.settings().preset = preset;
    const PresetLibrary::Preset* known = presets_.find(preset);
    const bool usable = known != nullptr && known->options;
    defaults_ =
        usable ? *known->options : builtInPreset("default");  // where it is gone: what differs from the defaults
    defaults_awaited_ = usable ? std::string() : preset;
    QStringList unknown;
    for (const std::string& name : names) unknown << QString::fromStdString(name);
    if (!unknown.isEmpty())
        tellProblem(tr("These parameters of the run are not known to this version and were left at their defaults: %1")
                        .arg(unknown.join(QStringLiteral(", "))));
    show();
}

}  // namespace eyrie::ui

#include "moc_parameter_binding.cpp"
