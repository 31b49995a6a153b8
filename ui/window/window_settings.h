#pragma once

#include <QByteArray>
#include <QPointF>
#include <QSettings>
#include <QStringList>
#include <filesystem>

namespace eyrie::ui {

/// How the window looked when a project was last open.
struct ProjectView {
    double zoom = 0;  ///< 0: fitted
    QPointF centre;
    int frame = 0;
};

/// A project that was opened lately.
struct RecentProject {
    QString project;  ///< its file; empty: only the video is known
    QString video;    ///< what was shown of it: a path or "scene:demo"; may be empty

    /// For lists: the name of the project, or of the video where the project lies hidden in the data folder.
    QString name() const;
    /// The folder in which that lies; empty for built-in scenes.
    QString folder() const;
};

/// What the window remembers between sessions: recent files, geometry, and a view per project.
class WindowSettings {
 public:
    /// The newest first.
    QList<RecentProject> recent() const;
    /// Puts a project first.
    void addRecent(const RecentProject& project);
    void clearRecent();

    QByteArray geometry() const;
    void setGeometry(const QByteArray& geometry);

    /// Nothing is remembered: an empty view.
    ProjectView projectView(const std::filesystem::path& project) const;
    void setProjectView(const std::filesystem::path& project, const ProjectView& view);

    /// Other things, by name.
    QVariant value(const QString& key, const QVariant& otherwise) const { return settings_.value(key, otherwise); }
    void setValue(const QString& key, const QVariant& value) { settings_.setValue(key, value); }

 private:
    QSettings settings_;  ///< the program's own: organisation and name are set by main()
};

}  // namespace eyrie::ui
