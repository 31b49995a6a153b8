#include "review/bookmarks/bookmarks_panel.h"

#include <QKeyEvent>
#include <QMenu>
#include <QTableView>

#include "widgets/empty_state.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

BookmarksPanel::BookmarksPanel(BookmarksModel* model, QWidget* parent)
    : TablePanel(model, QStringLiteral("bookmarks"), parent, BookmarksModel::frame_column) {
    table()->setAccessibleName(tr("Bookmarks"));
    bindCommands(this, {{emptyState()->button(), [this] { commands_.add(); }}});
    explainNothing(false, {});
}

void BookmarksPanel::explainNothing(bool can_add, const QString& keys) {
    if (can_add)
        emptyState()->setTexts(tr("No bookmark yet. %1 marks the frame that is shown, with a note; the mark is shown "
                                  "on the timeline, too.")
                                   .arg(keys),
                               tr("Mark this frame"));
    else
        emptyState()->setTexts(
            tr("Frames that were marked with a note are listed here. They are kept beside the verdicts "
               "on events, so the video needs a run first."));
}

void BookmarksPanel::fillMenu(QMenu& menu, int id) {
    menu.addAction(tr("Go there"), this, [this, id] { commands_.go_to(id); });
    menu.addAction(tr("Change the note"), QKeySequence(Qt::Key_F2), this, &BookmarksPanel::editNote);
    menu.addSeparator();
    menu.addAction(tr("Remove"), QKeySequence(Qt::Key_Delete), this, [this, id] { commands_.remove(id); });
}

void BookmarksPanel::editNote() {
    table()->showColumn(BookmarksModel::note_column);
    table()->edit(proxy().index(table()->currentIndex().row(), BookmarksModel::note_column));
}

bool BookmarksPanel::eventFilter(QObject* watched, QEvent* event) {
    const bool asks = event->type() == QEvent::ShortcutOverride;
    if (watched == table() && (asks || event->type() == QEvent::KeyPress) && currentId() != 0) {
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool removes = key->matches(QKeySequence::Delete);
        if (removes || key->key() == Qt::Key_F2) {
            event->accept();
            if (!asks) removes ? commands_.remove(currentId()) : editNote();
            return true;
        }
    }
    return TablePanel::eventFilter(watched, event);
}

}  // namespace eyrie::ui

#include "moc_bookmarks_panel.cpp"
