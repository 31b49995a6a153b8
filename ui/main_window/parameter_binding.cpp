#include "main_window/parameter_binding.h"

#include <QInputDialog>

#include "chain/replay.h"
#include "core/error.h"
#include "main_window/preset_dialog.h"
#include "panels/parameter_form.h"

namespace eyrie::ui {

ParameterBinding::ParameterBinding(ProjectSession& session, ParameterForm& form, QObject* parent)
    : QObject(parent), session_(session), form_(form), defaults_(session.settings().options) {
    connect(&form_, &ParameterForm::valueChanged, this, [this](const QString& name, const QString& value) {
        try {
            setParameter(describeOf(session_.settings().options), name.toStdString(), value.toStdString());
        } catch (const Error& error) {
            emit problem(QString::fromUtf8(error.what()));
            show();
        }
    });
    connect(&form_, &ParameterForm::presetChosen, this, &ParameterBinding::choosePreset);
    connect(&form_, &ParameterForm::savePresetRequested, this, &ParameterBinding::savePreset);
    connect(&form_, &ParameterForm::presetsRequested, this, [this] {
        PresetDialog dialog(presets_, session_.settings().options, form_.window());
        connect(&dialog, &PresetDialog::useRequested, this, &ParameterBinding::usePreset);
        dialog.exec();
        show();
    });
    connect(&session_, &ProjectSession::projectChanged, this, [this] {
        presets_.useProject(session_.project());
        show();
    });
    show();
}

void ParameterBinding::usePreset(const QString& name) {
    emit form_.presetChosen(name);  // as if it were chosen there, so that the preview follows, too
}

void ParameterBinding::show() {
    form_.setParameters(listParameters(describeOf(session_.settings().options)), listParameters(describeOf(defaults_)));
    QStringList names;
    for (const std::string& name : presets_.names()) names << QString::fromStdString(name);
    form_.setPresets(names, QString::fromStdString(session_.settings().preset));
}

void ParameterBinding::choosePreset(const QString& name) {
    try {
        defaults_ = presets_.load(name.toStdString());
        session_.settings().options = defaults_;
        session_.settings().preset = name.toStdString();
    } catch (const Error& error) {
        emit problem(QString::fromUtf8(error.what()));
    }
    show();
}

void ParameterBinding::savePreset() {
    bool accepted = false;
    const QString name = QInputDialog::getText(&form_, tr("Save preset"), tr("Name of the preset:"), QLineEdit::Normal,
                                               tr("my preset"), &accepted);
    if (!accepted) return;
    try {
        presets_.save(name.toStdString(), session_.settings().options);
        session_.settings().preset = name.toStdString();
        defaults_ = session_.settings().options;
        emit notice(tr("Saved the preset “%1”.").arg(name));
    } catch (const Error& error) {
        emit problem(QString::fromUtf8(error.what()));
    }
    show();
}

void ParameterBinding::setValue(const std::string& name, const std::string& value) {
    setParameter(describeOf(session_.settings().options), name, value);
    show();
}

void ParameterBinding::setValues(const std::vector<std::pair<std::string, std::string>>& values) {
    try {
        setParameters(describeOf(session_.settings().options), values);
        emit notice(tr("The next run uses the parameters of this point."));
    } catch (const Error& error) {
        emit problem(QString::fromUtf8(error.what()));
    }
    show();
}

void ParameterBinding::saveAsPreset(const ChainOptions& options) {
    session_.settings().options = options;
    savePreset();
}

void ParameterBinding::adoptRunParameters() {
    if (!session_.runData()) return;
    try {
        // Parameters that this version does not know any more would make the run's values unusable as a whole; they are
        // named, the others taken.
        std::vector<std::string> names;
        session_.settings().options = storedOptions(session_.runData()->parameters, &names);
        QStringList unknown;
        for (const std::string& name : names) unknown << QString::fromStdString(name);
        const std::string preset = session_.runData()->record.preset;
        session_.settings().preset = preset;
        defaults_ = presets_.load(preset);
        if (!unknown.isEmpty())
            emit problem(
                tr("These parameters of the run are not known to this version and were left at their defaults: %1")
                    .arg(unknown.join(QStringLiteral(", "))));
    } catch (const Error&) {
        defaults_ = builtInPreset("default");  // its preset is gone: show what differs from the defaults
    }
    show();
}

}  // namespace eyrie::ui
