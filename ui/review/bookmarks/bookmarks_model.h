#pragma once

#include <map>

#include "core/review/verdict.h"
#include "widgets/clock_of_frames.h"
#include "widgets/tables/record_model.h"

namespace eyrie::ui {

/// The bookmarks of a video, one row each, in the order of the video. Changes nothing itself: what a person writes is
/// told.
class BookmarksModel : public RecordModel<Bookmark> {
    Q_OBJECT

 public:
    enum Column { frame_column, time_column, note_column, person_column, made_column, column_count };

    explicit BookmarksModel(QObject* parent = nullptr) : RecordModel(parent) {}

    void setBookmarks(const std::map<int, Bookmark>& bookmarks);
    /// Times of the day instead of those of the video, where they are known. To be given again when they are others.
    void setClock(ClockOfFrames clock);

    int columnCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : column_count; }
    QVariant data(const QModelIndex& index, int role) const override;
    QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
    Qt::ItemFlags flags(const QModelIndex& index) const override;
    bool setData(const QModelIndex& index, const QVariant& value, int role) override;

 signals:
    void noteEdited(int id, const QString& note);

 private:
    QString tipOf(const Bookmark& bookmark) const;

    ClockOfFrames clock_;
};

}  // namespace eyrie::ui
