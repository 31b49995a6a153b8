#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <vector>

#include "core/values/frame.h"
#include "widgets/delayed_call.h"

class QTableView;

namespace eyrie::ui {

class ProjectSession;
class TablePanel;

/// Has the frames of a list's rows read beforehand once the list has stood still for a moment: of the selected row and
/// those below it first, then of those above; of rows in view, and of the next few that keys lead to. None while the
/// video plays, a run works or a live source is watched, while the list is hidden, or where the video is missing.
class RowsAhead : public QObject {
 public:
    static constexpr int kStill_ms = 150;
    static constexpr int kNextRows = 3;  ///< after the selected one that are read though they may not be in view

    /// Which frame the row with an id is about; nothing: none.
    using FrameOf = std::function<std::optional<FrameIndex>(int id)>;

    /// Belongs to the panel; the session must outlive that.
    RowsAhead(TablePanel& panel, ProjectSession& session, FrameOf frame_of);

 protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

 private:
    bool readable() const;
    void follow();
    void expect();
    std::vector<int> rowsInOrder() const;

    QTableView* table_;
    ProjectSession& session_;
    FrameOf frame_of_;
    DelayedCall expect_due_;
    bool expecting_ = false;
};

}  // namespace eyrie::ui
