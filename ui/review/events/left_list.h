#pragma once

#include <QDialog>
#include <QStringList>
#include <functional>
#include <vector>

#include "core/values/ids.h"

class QTreeWidget;

namespace eyrie::ui {

struct ClockOfFrames;
class EventReview;

/// What a person said or did that the run shown has no place for, in words.
struct LeftRow {
    FrameIndex frame = 0;  ///< to look at
    bool correction = false;
    QString time = {};
    QString what = {};     ///< "Stops", "Track rejected"
    QString verdict = {};  ///< empty for corrections
    QString note = {};
    QString person = {};
    QString reason = {};  ///< "no such event near"
};
/// In the order of the video.
std::vector<LeftRow> leftRows(const EventReview& review, const ClockOfFrames& clock);
/// Those of corrections, each in a line: "Track rejected at frame 12 by Anna: no such track near".
QStringList leftCorrections(const std::vector<LeftRow>& rows);

/// A list of them beside the window; a double click or Return goes to the frame.
class LeftList : public QDialog {
    Q_OBJECT

 public:
    LeftList(std::function<void(FrameIndex frame)> go_to, QWidget* parent);

    void setRows(const std::vector<LeftRow>& rows);
    QTreeWidget& list() { return *list_; }

 private:
    QTreeWidget* list_;
};

}  // namespace eyrie::ui
