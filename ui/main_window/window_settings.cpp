#include "main_window/window_settings.h"

#include <QCryptographicHash>
#include <QPointF>

namespace eyrie::ui {

namespace {
constexpr int kMostRecent = 12;
const QString kRecent = QStringLiteral("recent");
const QString kGeometry = QStringLiteral("window/geometry");
const QString kLayout = QStringLiteral("window/layout");

QString groupOf(const std::filesystem::path& project) {
    const QByteArray hash =
        QCryptographicHash::hash(QByteArray::fromStdString(project.string()), QCryptographicHash::Sha256);
    return QStringLiteral("project/") + QString::fromLatin1(hash.toHex().left(16)) + QLatin1Char('/');
}
}  // namespace

QStringList WindowSettings::recent() const {
    return settings_.value(kRecent).toStringList();
}

void WindowSettings::addRecent(const QString& path) {
    QStringList paths = recent();
    paths.removeAll(path);
    paths.prepend(path);
    settings_.setValue(kRecent, paths.mid(0, kMostRecent));
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

QByteArray WindowSettings::layout() const {
    return settings_.value(kLayout).toByteArray();
}

void WindowSettings::setLayout(const QByteArray& layout) {
    settings_.setValue(kLayout, layout);
}

ProjectView WindowSettings::projectView(const std::filesystem::path& project) const {
    const QString group = groupOf(project);
    ProjectView view;
    view.layout = settings_.value(group + QStringLiteral("layout")).toByteArray();
    view.zoom = settings_.value(group + QStringLiteral("zoom"), 0).toDouble();
    view.centre = settings_.value(group + QStringLiteral("centre")).toPointF();
    view.frame = settings_.value(group + QStringLiteral("frame"), 0).toInt();
    return view;
}

void WindowSettings::setProjectView(const std::filesystem::path& project, const ProjectView& view) {
    const QString group = groupOf(project);
    settings_.setValue(group + QStringLiteral("layout"), view.layout);
    settings_.setValue(group + QStringLiteral("zoom"), view.zoom);
    settings_.setValue(group + QStringLiteral("centre"), view.centre);
    settings_.setValue(group + QStringLiteral("frame"), view.frame);
}

}  // namespace eyrie::ui
