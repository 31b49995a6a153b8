#include "review/bookmarks/bookmarks.h"

#include <QAction>
#include <QApplication>
#include <QInputDialog>
#include <algorithm>

#include "review/bookmarks/bookmarks_panel.h"
#include "review/events/event_review.h"
#include "session/project_session.h"
#include "widgets/wiring.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {

constexpr int kAboveEvents = 4;  ///< of marks in one place the bookmark is seen

QColor colourOfMarks(bool dark) {
    return dark ? QColor(0xd5, 0x8c, 0xff) : QColor(0x8a, 0x2b, 0xb5);
}

std::optional<QString> askWithDialog(const QString& note, FrameIndex frame) {
    bool accepted = false;
    const QString text = QInputDialog::getText(QApplication::activeWindow(), QObject::tr("Bookmark"),
                                               QObject::tr("What can be seen in frame %1:").arg(frame),
                                               QLineEdit::Normal, note, &accepted);
    return accepted ? std::optional(text.trimmed()) : std::nullopt;
}

}  // namespace

Bookmarks::Bookmarks(ProjectSession& session, WindowActions& actions, EventReview& review, QObject* parent)
    : QObject(parent),
      session_(session),
      actions_(actions),
      review_(review),
      model_(new BookmarksModel(this)),
      panel_(new BookmarksPanel(model_)),
      ask_(askWithDialog) {
    panel_->setCommands({.go_to = [this](int id) { goTo(-id); },
                         .remove = [this](int id) { review_.removeBookmark(id); },
                         .add = [this] { actions_.bookmark->trigger(); }});
    connect(model_, &BookmarksModel::noteEdited, this, [this](int id, const QString& note) {
        const auto found = review_.bookmarks().find(id);
        if (found != review_.bookmarks().end()) review_.setBookmark(found->second.frame, note);
    });
    bindCommands(this, {
                           {actions.bookmark, [this] { edit(); }},
                           {actions.remove_bookmark, [this] { remove(); }},
                           {actions.next_bookmark, [this] { step(1); }},
                           {actions.previous_bookmark, [this] { step(-1); }},
                       });
    whenChanged(session_, this, {{SessionChange::frame, [this] { enableActions(active_); }}});
    showList();
}

void Bookmarks::showList() {
    model_->setBookmarks(review_.bookmarks());
    panel_->explainNothing(review_.canMark(), actions_.bookmark->shortcut().toString(QKeySequence::NativeText));
}

void Bookmarks::setClock(const ClockOfFrames& clock) {
    model_->setClock(clock);
}

const Bookmark* Bookmarks::at(FrameIndex frame) const {
    for (const auto& [id, bookmark] : review_.bookmarks())
        if (bookmark.frame == frame) return &bookmark;
    return nullptr;
}

std::vector<TimelineMark> Bookmarks::marks(bool dark) const {
    std::vector<TimelineMark> marks;
    for (const auto& [id, bookmark] : review_.bookmarks())
        marks.push_back({-id, bookmark.frame, colourOfMarks(dark), kAboveEvents});
    return marks;
}

QString Bookmarks::markText(int mark_id) const {
    const auto found = review_.bookmarks().find(-mark_id);
    if (found == review_.bookmarks().end()) return {};
    const Bookmark& bookmark = found->second;
    const QString note = QString::fromStdString(bookmark.note);
    const QString person = QString::fromStdString(bookmark.person);
    const QString what = note.isEmpty() ? tr("Bookmark") : tr("Bookmark: %1").arg(note);
    return person.isEmpty() ? what : what + QLatin1Char('\n') + person;
}

void Bookmarks::goTo(int mark_id) {
    const auto found = review_.bookmarks().find(-mark_id);
    if (found == review_.bookmarks().end()) return;
    session_.playback().pause();
    session_.goToFrame(found->second.frame);
}

void Bookmarks::enableActions(bool active) {
    active_ = active;
    showList();
    const bool can = active && review_.canMark();
    const auto& bookmarks = review_.bookmarks();
    const FrameIndex here = session_.currentFrame();
    const auto any = [&](auto&& passes) {
        return active && std::any_of(bookmarks.begin(), bookmarks.end(),
                                     [&](const auto& each) { return passes(each.second.frame); });
    };
    actions_.bookmark->setEnabled(can);
    actions_.remove_bookmark->setEnabled(can && at(here) != nullptr);
    actions_.next_bookmark->setEnabled(any([here](FrameIndex frame) { return frame > here; }));
    actions_.previous_bookmark->setEnabled(any([here](FrameIndex frame) { return frame < here; }));
}

void Bookmarks::edit() {
    session_.playback().pause();
    const FrameIndex frame = session_.currentFrame();
    const Bookmark* before = at(frame);
    const auto note = ask_(before == nullptr ? QString() : QString::fromStdString(before->note), frame);
    // While one writes, another window may have changed them.
    if (note) review_.setBookmark(frame, *note);
}

void Bookmarks::remove() {
    if (const Bookmark* here = at(session_.currentFrame())) review_.removeBookmark(here->id);
}

void Bookmarks::step(int direction) {
    const FrameIndex here = session_.currentFrame();
    std::optional<FrameIndex> best;
    for (const auto& [id, bookmark] : review_.bookmarks()) {
        const FrameIndex frame = bookmark.frame;
        if (direction > 0 ? frame > here && (!best || frame < *best) : frame < here && (!best || frame > *best))
            best = frame;
    }
    if (!best) return;
    session_.playback().pause();
    session_.goToFrame(*best);
}

}  // namespace eyrie::ui

#include "moc_bookmarks.cpp"
