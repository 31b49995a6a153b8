#include "session/project/project_location.h"

#include <QCoreApplication>
#include <QCryptographicHash>
#include <QRegularExpression>
#include <QStandardPaths>
#include <QString>
#include <algorithm>

#include "core/project_name.h"
#include "session/project/media.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

namespace {
bool isThere(const fs::path& path) {
    std::error_code unreachable;
    return fs::exists(path, unreachable);
}
}  // namespace

fs::path projectInDataFolder(const std::string& media_name, const std::string& media_identity) {
    const fs::path data = QStandardPaths::writableLocation(QStandardPaths::GenericDataLocation).toStdString();
    const QByteArray hash =
        QCryptographicHash::hash(QByteArray::fromStdString(media_identity), QCryptographicHash::Sha256).toHex().left(8);
    QString name = QString::fromStdString(fs::path(media_name).stem().string());
    // Nothing in the name may upset a file system or a shell.
    name.replace(QRegularExpression(QStringLiteral("[^\\w.-]+"), QRegularExpression::UseUnicodePropertiesOption),
                 QStringLiteral("_"));
    name = name.left(60);
    if (name.isEmpty()) name = QStringLiteral("video");
    return data / "eyrie" / "projects" / (name.toStdString() + "-" + hash.toStdString() + kProjectEnding);
}

std::vector<fs::path> projectPlaces(const std::string& media_name, const std::string& media_identity) {
    std::vector<fs::path> places;
    if (!isScene(media_identity)) {
        const fs::path video(media_identity);
        // A folder "flight.2" is not a file "flight" of kind "2".
        std::error_code unreachable;
        const fs::path stem = fs::is_directory(video, unreachable) ? video.filename() : video.stem();
        places.push_back(video.parent_path() / (stem.string() + kProjectEnding));
    }
    places.push_back(projectInDataFolder(media_name, media_identity));
    std::stable_partition(places.begin(), places.end(), isThere);
    return places;
}

bool isSameVideo(const SequenceRecord& known, const VideoInfo& video) {
    return known.size == video.size && known.frame_count == video.frame_count;
}

QString whyAnotherVideo(const std::string& identity, const VideoInfo& video, const SequenceRecord& known) {
    return QCoreApplication::translate(
               "eyrie::ui::ProjectSession",
               "%1 is another video: it has %2 frames of %3 × %4; that of the project has %5 of "
               "%6 × %7. Locate the video that the runs were made with.")
        .arg(QString::fromStdString(identity))
        .arg(video.frame_count)
        .arg(video.size.width)
        .arg(video.size.height)
        .arg(known.frame_count)
        .arg(known.size.width)
        .arg(known.size.height);
}

std::optional<fs::path> movedBeside(const fs::path& project, const SequenceRecord& known) {
    if (isScene(known.path)) return std::nullopt;
    const fs::path candidate = fs::absolute(project).parent_path() / fs::path(known.path).filename();
    return candidate != known.path && isThere(candidate) ? std::optional(candidate) : std::nullopt;
}

const SequenceRecord* formerPlaceOf(const VideoInfo& video, const std::string& identity,
                                    const std::vector<SequenceRecord>& known) {
    const SequenceRecord* moved = nullptr;
    for (const SequenceRecord& sequence : known) {
        if (sequence.path == identity) return nullptr;
        const bool same_name = fs::path(sequence.path).filename() == fs::path(identity).filename();
        if (same_name && isSameVideo(sequence, video) && !isThere(sequence.path)) moved = &sequence;
    }
    return moved;
}

}  // namespace eyrie::ui
