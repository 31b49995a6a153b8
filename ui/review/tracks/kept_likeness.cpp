#include "review/tracks/kept_likeness.h"

#include <QSettings>
#include <string>
#include <vector>

#include "core/error.h"

namespace eyrie::ui {

namespace {

const QString kLikeCounts = QStringLiteral("review/like_counts");

}  // namespace

LikenessChoice keptLikenessChoice() {
    std::vector<std::string> names;
    for (const QString& name : QSettings().value(kLikeCounts).toStringList()) names.push_back(name.toStdString());
    if (names.empty()) return {};
    try {
        return LikenessChoice::named(names);
    } catch (const Error&) {
        return {};  // of another version
    }
}

void keepLikenessChoice(const LikenessChoice& counts) {
    QStringList names;
    for (const std::string& name : counts.names()) names << QString::fromStdString(name);
    QSettings().setValue(kLikeCounts, names);
}

}  // namespace eyrie::ui
