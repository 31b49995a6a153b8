#pragma once

#include <QObject>
#include <QPointer>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "session/background/background_query.h"
#include "session/project/preset_store.h"

namespace eyrie::ui {

/// The presets as the window knows them: a copy in memory of what a PresetStore holds. Files and projects are read and
/// written in the background, one after the other.
class PresetLibrary : public QObject {
    Q_OBJECT

 public:
    struct Preset {
        std::string name;
        PresetStore::Origin origin = PresetStore::Origin::built_in;
        std::string saved_utc;                        ///< project only
        std::shared_ptr<const ChainOptions> options;  ///< null: it cannot be used
        QString problem;                              ///< why not
    };
    /// Told on this object's thread what a wish came to: the preset's name, and what went wrong (empty: nothing).
    using Answer = std::function<void(const QString& name, const QString& problem)>;

    /// `folder` empty: the user's own. Holds the built-in presets at once; the others follow.
    explicit PresetLibrary(const std::filesystem::path& folder = {}, QObject* parent = nullptr);

    /// New presets go into this project; empty: into the user's folder.
    void useProject(const std::filesystem::path& project);
    void refresh();

    /// Built-in ones first, then the project's.
    const std::vector<Preset>& presets() const { return presets_; }
    /// Null when there is none of the name.
    const Preset* find(const std::string& name) const;

    /// Each is done in the background; `answer` comes unless `receiver` has gone meanwhile, after presets() was brought
    /// up to date.
    void save(const std::string& name, const ChainOptions& options, QObject* receiver, Answer answer);
    void rename(const std::string& from, const std::string& to, QObject* receiver, Answer answer);
    void remove(const std::string& name, QObject* receiver, Answer answer);
    void importFile(const std::filesystem::path& file, QObject* receiver, Answer answer);
    void exportFile(const std::string& name, const std::filesystem::path& file, QObject* receiver, Answer answer);

 signals:
    void changed();

 private:
    /// Answers the name of the preset that it leaves.
    using Work = std::function<std::string(PresetStore&)>;
    void post(Work work, QObject* receiver, Answer answer);
    static std::vector<Preset> read(const PresetStore& store);

    std::vector<Preset> presets_;
    PresetStore store_;      ///< in the background only
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
