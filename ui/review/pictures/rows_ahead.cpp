#include "review/pictures/rows_ahead.h"

#include <QEvent>
#include <QScrollBar>
#include <QTableView>
#include <algorithm>
#include <utility>

#include "session/project_session.h"
#include "widgets/tables/table_panel.h"
#include "widgets/tables/table_roles.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

RowsAhead::RowsAhead(TablePanel& panel, ProjectSession& session, FrameOf frame_of)
    : QObject(&panel),
      table_(panel.table()),
      session_(session),
      frame_of_(std::move(frame_of)),
      expect_due_(kStill_ms, [this] { expect(); }) {
    table_->viewport()->installEventFilter(this);
    const auto follow = [this] { this->follow(); };
    whenAny(table_->verticalScrollBar(), this, follow, &QScrollBar::valueChanged);
    whenAny(table_->selectionModel(), this, follow, &QItemSelectionModel::currentRowChanged,
            &QItemSelectionModel::selectionChanged);
    whenAny(table_->model(), this, follow, &QAbstractItemModel::modelReset, &QAbstractItemModel::layoutChanged,
            &QAbstractItemModel::rowsInserted, &QAbstractItemModel::rowsRemoved);
    whenAny(&session_.playback(), this, follow, &Playback::playingChanged);
    whenChanged(session_, this,
                {{{SessionChange::video, SessionChange::opened, SessionChange::run_preparing,
                   SessionChange::run_started, SessionChange::run_ended},
                  follow}});
}

bool RowsAhead::readable() const {
    return session_.media() && !session_.videoMissing() && session_.liveSource() == nullptr && !session_.running() &&
           !session_.playback().playing() && table_->isVisible();
}

void RowsAhead::follow() {
    if (readable()) {
        expect_due_.start();
        return;
    }
    expect_due_.stop();
    if (std::exchange(expecting_, false)) session_.expectFrames({});
}

std::vector<int> RowsAhead::rowsInOrder() const {
    const int count = table_->model()->rowCount();
    const int first = table_->rowAt(0);
    if (first < 0) return {};
    const int below = table_->rowAt(table_->viewport()->height() - 1);
    const int last = below < 0 ? count - 1 : below;
    const int current = table_->currentIndex().row();
    const bool in_view = current >= first && current <= last;
    const int begin = in_view ? current : first;
    const int end = in_view ? std::min(count - 1, std::max(last, current + kNextRows)) : last;
    std::vector<int> rows;
    const int span = end - first + 1;
    rows.reserve(static_cast<std::size_t>(span));
    for (int row = begin; row <= end; ++row) rows.push_back(row);
    for (int row = begin - 1; row >= first; --row) rows.push_back(row);
    return rows;
}

void RowsAhead::expect() {
    if (!readable()) return;
    std::vector<FrameIndex> frames;
    for (const int row : rowsInOrder())
        if (const auto frame = frame_of_(table_->model()->index(row, 0).data(id_role).toInt()))
            frames.push_back(*frame);
    expecting_ = !frames.empty();
    session_.expectFrames(std::move(frames));
}

bool RowsAhead::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::Show || event->type() == QEvent::Hide || event->type() == QEvent::Resize) follow();
    return QObject::eventFilter(watched, event);
}

}  // namespace eyrie::ui
