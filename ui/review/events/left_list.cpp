#include "review/events/left_list.h"

#include <QLabel>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "core/time/time_text.h"
#include "correction/corrected_run.h"
#include "review/events/event_review.h"
#include "review/events/event_text.h"
#include "widgets/clock_of_frames.h"

namespace eyrie::ui {

std::vector<LeftRow> leftRows(const EventReview& review, const ClockOfFrames& clock) {
    std::vector<LeftRow> rows;
    const auto add = [&](LeftRow row, double seconds, const std::string& person, const char* reason) {
        row.time = clock.timeOr(row.frame, QString::fromStdString(videoClockText(seconds)));
        row.person = QString::fromStdString(person);
        row.reason = QString::fromUtf8(reason);
        rows.push_back(std::move(row));
    };
    for (const auto& [verdict, fault] : review.left())
        add({.frame = verdict->subject.frame,
             .what = eventKindText(verdict->subject),
             .verdict = judgementText(verdict->judgement),
             .note = QString::fromStdString(verdict->note)},
            verdict->subject.first_s, verdict->person, nameOf(fault));
    if (const auto& tracks = review.tracks())
        for (const auto& [id, state] : tracks->corrections.states) {
            const auto made = review.corrections().find(id);
            if (!isLeft(state) || made == review.corrections().end()) continue;
            const TrackCorrection& correction = made->second;
            add({.frame = correction.frame,
                 .correction = true,
                 .what = LeftList::tr("Track %1").arg(QString::fromUtf8(nameOf(correction.kind)))},
                tracks->secondsOf(correction.frame), correction.person, nameOf(state));
        }
    std::stable_sort(rows.begin(), rows.end(), [](const LeftRow& a, const LeftRow& b) { return a.frame < b.frame; });
    return rows;
}

QStringList leftCorrections(const std::vector<LeftRow>& rows) {
    QStringList lines;
    for (const LeftRow& row : rows)
        if (row.correction)
            lines << LeftList::tr("%1 at frame %2 by %3: %4")
                         .arg(row.what, QString::number(row.frame), row.person, row.reason);
    return lines;
}

LeftList::LeftList(std::function<void(FrameIndex frame)> go_to, QWidget* parent)
    : QDialog(parent), list_(new QTreeWidget(this)) {
    setObjectName(QStringLiteral("not_carried_over"));
    setWindowTitle(tr("Not carried over to this run"));
    resize(680, 300);
    auto* note = new QLabel(tr("All of it is kept, and counts again in runs, and with limits, that it fits."), this);
    note->setWordWrap(true);
    list_->setHeaderLabels({tr("Time"), tr("What"), tr("Verdict"), tr("Note"), tr("By"), tr("Reason")});
    list_->setRootIsDecorated(false);
    list_->setAlternatingRowColors(true);
    list_->setAccessibleName(windowTitle());
    auto* rows = new QVBoxLayout(this);
    rows->addWidget(note);
    rows->addWidget(list_);
    connect(list_, &QTreeWidget::itemActivated, this,
            [go_to = std::move(go_to)](const QTreeWidgetItem* item) { go_to(item->data(0, Qt::UserRole).toInt()); });
}

void LeftList::setRows(const std::vector<LeftRow>& rows) {
    list_->clear();
    for (const LeftRow& row : rows) {
        auto* item = new QTreeWidgetItem(list_, {row.time, row.what, row.verdict, row.note, row.person, row.reason});
        item->setData(0, Qt::UserRole, row.frame);
        item->setToolTip(0, tr("Double-click goes to frame %1.").arg(row.frame));
    }
    for (int column = 0; column < list_->columnCount(); ++column) list_->resizeColumnToContents(column);
}

}  // namespace eyrie::ui

#include "moc_left_list.cpp"
