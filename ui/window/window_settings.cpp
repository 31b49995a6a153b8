#include "window/window_settings.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QFileInfo>
#include <QPointF>
#include <QStandardPaths>
#include <string>

#include "core/scene_name.h"

namespace eyrie::ui {

namespace {
constexpr int kMostRecent = 12;
const QString kRecent = QStringLiteral("recent_projects");
const QString kGeometry = QStringLiteral("window/geometry");

/// Hidden there, a project's own name tells nobody anything.
bool liesInDataFolder(const QString& project) {
    return project.isEmpty() ||
           project.startsWith(QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation) +
                              QStringLiteral("/eyrie/"));
}

QString groupOf(const std::filesystem::path& project) {
    const QByteArray hash =
        QCryptographicHash::hash(QByteArray::fromStdString(project.string()), QCryptographicHash::Sha256);
    return QStringLiteral("project/") + QString::fromLatin1(hash.toHex().left(16)) + QLatin1Char('/');
}
}  // namespace

QString RecentProject::name() const {
    if (const std::string named = video.toStdString(); isScene(named))
        return QCoreApplication::translate("RecentProject", "%1 scene").arg(QString::fromStdString(sceneOf(named)));
    return QFileInfo(liesInDataFolder(project) ? video : project).fileName();
}

QString RecentProject::folder() const {
    if (isScene(video.toStdString())) return {};
    return QFileInfo(liesInDataFolder(project) ? video : project).path();
}

QList<RecentProject> WindowSettings::recent() const {
    QList<RecentProject> projects;
    const QStringList entries = settings_.value(kRecent).toStringList();
    // Pairs: project, video.
    for (qsizetype i = 0; i + 1 < entries.size(); i += 2) projects.append({entries[i], entries[i + 1]});
    return projects;
}

void WindowSettings::addRecent(const RecentProject& project) {
    QList<RecentProject> projects = recent();
    projects.removeIf([&](const RecentProject& known) { return known.project == project.project; });
    projects.prepend(project);
    QStringList entries;
    for (const RecentProject& each : projects.mid(0, kMostRecent)) entries << each.project << each.video;
    settings_.setValue(kRecent, entries);
}

void WindowSettings::clearRecent() {
    settings_.remove(kRecent);
}

QByteArray WindowSettings::geometry() const {
    return settings_.value(kGeometry).toByteArray();
}

void WindowSettings::setGeometry(const QByteArray& geometry) {
    settings_.setValue(kGeometry, geometry);
}

ProjectView WindowSettings::projectView(const std::filesystem::path& project) const {
    const QString group = groupOf(project);
    ProjectView view;
    view.zoom = settings_.value(group + QStringLiteral("zoom"), 0).toDouble();
    view.centre = settings_.value(group + QStringLiteral("centre")).toPointF();
    view.frame = settings_.value(group + QStringLiteral("frame"), 0).toInt();
    return view;
}

void WindowSettings::setProjectView(const std::filesystem::path& project, const ProjectView& view) {
    const QString group = groupOf(project);
    settings_.setValue(group + QStringLiteral("zoom"), view.zoom);
    settings_.setValue(group + QStringLiteral("centre"), view.centre);
    settings_.setValue(group + QStringLiteral("frame"), view.frame);
}

}  // namespace eyrie::ui
