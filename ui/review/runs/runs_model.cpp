#include "review/runs/runs_model.h"

#include <QCoreApplication>
#include <QFileInfo>

#include "review/runs/run_text.h"
#include "widgets/display_text.h"
#include "widgets/tables/table_roles.h"

namespace eyrie::ui {
namespace {

int plannedFrames(const RunRecord& run) {
    return run.last_frame >= run.first_frame ? run.last_frame - run.first_frame + 1 : 0;
}

double secondsOfVideo(const RunRecord& run) {
    return run.scale.frame_rate_hz > 0 ? run.frames_done / run.scale.frame_rate_hz : 0;
}

/// Short, for a column: "0.080", "≈ 0.091", "unknown".
QString gsdText(const RunRecord& run) {
    const QString value = numberText(run.scale.gsd_m_per_px, 3);
    switch (run.scale_basis.origin) {
        case ScaleOrigin::given:
        case ScaleOrigin::metadata:
            return value;
        case ScaleOrigin::estimated:
            return QStringLiteral("≈ ") + value;
        case ScaleOrigin::assumed:
            break;
    }
    return QCoreApplication::translate("RunsModel", "unknown");
}

QString fileName(const RunRecord& run) {
    return QFileInfo(QString::fromStdString(run.sequence.path)).fileName();
}

}  // namespace

QString shownName(const RunRecord& run) {
    return run.name.empty() ? QCoreApplication::translate("RunsModel", "Run %1").arg(run.id)
                            : QString::fromStdString(run.name);
}

void RunsModel::updateRun(const RunRecord& run) {
    const int row = rowOf(run.id);
    if (row >= 0) {
        changeRecord(row, run);
    } else {
        std::vector<RunRecord> all = records();
        all.push_back(run);
        replaceRecords(std::move(all));
    }
}

void RunsModel::setLiveRun(int run_id) {
    if (run_id == live_run_) return;
    live_run_ = run_id;
    if (rowCount() > 0) emit dataChanged(index(0, state_column), index(rowCount() - 1, state_column));
}

QVariant RunsModel::data(const QModelIndex& index, int role) const {
    const RunRecord* run = recordAt(index.row());
    if (run == nullptr || !index.isValid()) return {};
    switch (role) {
        case Qt::DisplayRole:
            return textOf(*run, index.column());
        case Qt::EditRole:
            return index.column() == name_column ? QString::fromStdString(run->name) : textOf(*run, index.column());
        case Qt::ToolTipRole:
            return toolTipOf(*run);
        case Qt::TextAlignmentRole:
            return index.column() == frames_column || index.column() == length_column || index.column() == gsd_column
                       ? QVariant(Qt::AlignRight | Qt::AlignVCenter)
                       : QVariant();
        case sort_role:
            return sortValueOf(*run, index.column());
        case id_role:
            return run->id;
        default:
            return {};
    }
}

QString RunsModel::textOf(const RunRecord& run, int column) const {
    switch (column) {
        case name_column:
            return shownName(run);
        case started_column:
            return localTimeText(run.started_utc);
        case state_column:
            return stateText(run);
        case frames_column:
            return run.frames_done == plannedFrames(run)
                       ? QString::number(run.frames_done)
                       : QStringLiteral("%1/%2").arg(run.frames_done).arg(plannedFrames(run));
        case length_column:
            return durationText(secondsOfVideo(run));
        case preset_column:
            return QString::fromStdString(run.preset);
        case gsd_column:
            return gsdText(run);
        case video_column:
            return fileName(run);
        default:
            return {};
    }
}

QVariant RunsModel::sortValueOf(const RunRecord& run, int column) const {
    switch (column) {
        case started_column:
            return QString::fromStdString(run.started_utc);
        case frames_column:
            return run.frames_done;
        case length_column:
            return secondsOfVideo(run);
        case gsd_column:
            return run.scale.gsd_known ? run.scale.gsd_m_per_px : -1.0;
        default:
            return textOf(run, column);
    }
}

QString RunsModel::stateText(const RunRecord& run) const {
    switch (run.state) {
        case RunState::finished:
            return tr("finished");
        case RunState::failed:
            return tr("failed");
        case RunState::running:
            if (run.live || run.id == live_run_) return tr("running");
            break;
        case RunState::stopped:
            break;
    }
    return tr("stopped");
}

QString RunsModel::toolTipOf(const RunRecord& run) const {
    QStringList lines{shownName(run), QString::fromStdString(run.sequence.path),
                      tr("frames %1 to %2, %3 processed").arg(run.first_frame).arg(run.last_frame).arg(run.frames_done),
                      (run.rate_assumed ? tr("%1 frames/s (assumed), Eyrie %2") : tr("%1 frames/s, Eyrie %2"))
                          .arg(numberText(run.scale.frame_rate_hz, 2), QString::fromStdString(run.engine_version))};
    lines << tr("Scale: %1").arg(scaleText(run));
    if (const QString light = lightText(run); !light.isEmpty()) lines << tr("Light: %1").arg(light);
    if (run.live && run.id != live_run_) lines << tr("Written by %1").arg(QString::fromStdString(run.writer));
    if (!run.message.empty()) lines << QString::fromStdString(run.message);
    for (QString& line : lines) line = line.toHtmlEscaped();
    return QStringLiteral("<p>%1</p>").arg(lines.join(QStringLiteral("<br>")));  // only rich text breaks long lines
}

QString RunsModel::helpOf(int column) const {
    switch (column) {
        case frames_column:
            return tr("Frames processed; of how many, if the run ended early");
        case length_column:
            return tr("Length of the processed part of the video");
        case gsd_column:
            return tr(
                "Ground sampling distance in metres per pixel; ≈: estimated from the traffic. Point at a run to see "
                "where it comes from");
        default:
            return {};
    }
}

QVariant RunsModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation == Qt::Horizontal && role == Qt::ToolTipRole) return helpOf(section);
    if (orientation != Qt::Horizontal || role != Qt::DisplayRole) {
        return RecordModel::headerData(section, orientation, role);
    }
    switch (section) {
        case name_column:
            return tr("Run");
        case started_column:
            return tr("Started");
        case state_column:
            return tr("State");
        case frames_column:
            return tr("Frames");
        case length_column:
            return tr("Video time");
        case preset_column:
            return tr("Preset");
        case gsd_column:
            return tr("GSD (m/px)");
        case video_column:
            return tr("Video");
        default:
            return {};
    }
}

Qt::ItemFlags RunsModel::flags(const QModelIndex& index) const {
    const Qt::ItemFlags basic = RecordModel::flags(index);
    return index.isValid() && index.column() == name_column ? basic | Qt::ItemIsEditable : basic;
}

bool RunsModel::setData(const QModelIndex& index, const QVariant& value, int role) {
    const RunRecord* run = recordAt(index.row());
    if (role != Qt::EditRole || index.column() != name_column || run == nullptr) return false;
    RunRecord renamed = *run;
    renamed.name = value.toString().trimmed().toStdString();
    if (renamed.name == run->name) return false;
    const int id = renamed.id;
    const QString name = QString::fromStdString(renamed.name);
    changeRecord(index.row(), std::move(renamed));
    emit renameRequested(id, name);
    return true;
}

}  // namespace eyrie::ui

#include "moc_runs_model.cpp"
