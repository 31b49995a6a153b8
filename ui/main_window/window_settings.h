#pragma once

#include <QByteArray>
#include <QPointF>
#include <QSettings>
#include <QStringList>
#include <filesystem>

namespace eyrie::ui {

/// How the window looked when a project was last open.
struct ProjectView {
    QByteArray layout;
    double zoom = 0;  ///< 0: fitted
    QPointF centre;
    int frame = 0;
};

/// What the window remembers between sessions: recent files, geometry, and a view per project.
class WindowSettings {
 public:
    QStringList recent() const;
    /// Puts a path first.
    void addRecent(const QString& path);
    void clearRecent();

    QByteArray geometry() const;
    void setGeometry(const QByteArray& geometry);
    QByteArray layout() const;
    void setLayout(const QByteArray& layout);

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
