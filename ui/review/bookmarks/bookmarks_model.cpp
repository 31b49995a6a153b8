#include "review/bookmarks/bookmarks_model.h"

#include <algorithm>
#include <utility>

#include "core/time/time_text.h"
#include "widgets/display_text.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui {

void BookmarksModel::setBookmarks(const std::map<int, Bookmark>& bookmarks) {
    std::vector<Bookmark> rows;
    for (const auto& [id, bookmark] : bookmarks) rows.push_back(bookmark);
    std::stable_sort(rows.begin(), rows.end(), [](const Bookmark& a, const Bookmark& b) { return a.frame < b.frame; });
    // Other lists change while a note is being written.
    if (rows != records()) replaceRecords(std::move(rows));
}

void BookmarksModel::setClock(ClockOfFrames clock) {
    clock_ = std::move(clock);
    tellClockChanged(*this, time_column, time_column);
}

QString BookmarksModel::tipOf(const Bookmark& bookmark) const {
    const QString tip =
        tr("Double-click goes to frame %1; F2 changes the note, Delete removes the bookmark.").arg(bookmark.frame);
    const QString moment = clock_.text(bookmark.frame);
    return moment.isEmpty() ? tip : moment + QLatin1Char('\n') + tip;
}

QVariant BookmarksModel::data(const QModelIndex& index, int role) const {
    const Bookmark* bookmark = recordAt(index.row());
    if (bookmark == nullptr) return {};
    const int column = index.column();
    const bool number = column == frame_column || column == time_column;
    switch (role) {
        case Qt::DisplayRole:
        case Qt::EditRole:
            switch (column) {
                case frame_column:
                    return QString::number(bookmark->frame);
                case time_column:
                    return clock_.timeOr(bookmark->frame, QString::fromStdString(videoClockText(bookmark->seconds)));
                case note_column:
                    return QString::fromStdString(bookmark->note);
                case person_column:
                    return QString::fromStdString(bookmark->person);
                default:
                    return localTimeText(bookmark->when_utc);
            }
        case Qt::ToolTipRole:
            return tipOf(*bookmark);
        case Qt::TextAlignmentRole:
            return number ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
        case sort_role:
            if (number) return bookmark->frame;
            return column == made_column ? QString::fromStdString(bookmark->when_utc) : data(index, Qt::DisplayRole);
        case id_role:
            return bookmark->id;
        default:
            return {};
    }
}

QVariant BookmarksModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
        return RecordModel::headerData(section, orientation, role);
    switch (section) {
        case frame_column:
            return tr("Frame");
        case time_column:
            return clock_.known() ? tr("Time (UTC)") : tr("Time");
        case note_column:
            return tr("Note");
        case person_column:
            return tr("Who");
        default:
            return tr("When");
    }
}

Qt::ItemFlags BookmarksModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags flags = RecordModel::flags(index);
    return index.isValid() && index.column() == note_column ? flags | Qt::ItemIsEditable : flags;
}

bool BookmarksModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const Bookmark* bookmark = recordAt(index.row());
    if (bookmark == nullptr || index.column() != note_column || role != Qt::EditRole) return false;
    const QString note = value.toString().trimmed();
    if (note == QString::fromStdString(bookmark->note)) return false;
    emit noteEdited(bookmark->id, note);
    return true;
}

}  // namespace eyrie::ui

#include "moc_bookmarks_model.cpp"
