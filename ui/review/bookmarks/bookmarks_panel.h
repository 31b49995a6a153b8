#pragma once

#include <functional>
#include <utility>

#include "review/bookmarks/bookmarks_model.h"
#include "widgets/tables/table_panel.h"

namespace eyrie::ui {

/// What the list of bookmarks leads to.
struct BookmarkListCommands {
    std::function<void(int id)> go_to = [](int) {};
    std::function<void(int id)> remove = [](int) {};
    /// From the empty state: mark the frame that is shown.
    std::function<void()> add = [] {};
};

/// The bookmarks of the video: a double click goes there, notes are changed in place.
class BookmarksPanel : public TablePanel {
    Q_OBJECT
 public:
    /// `model` must outlive the panel.
    explicit BookmarksPanel(BookmarksModel* model, QWidget* parent = nullptr);
    void setCommands(BookmarkListCommands commands) { commands_ = std::move(commands); }
    /// What is said while there are none; `can_add`: whether the frame that is shown can be marked.
    void explainNothing(bool can_add, const QString& keys);

 protected:
    void rowDoubleClicked(int id) override { commands_.go_to(id); }
    void fillMenu(QMenu& menu, int id) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    void editNote();
    BookmarkListCommands commands_;
};

}  // namespace eyrie::ui
