#include "main_window/comparison_window.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QSplitter>
#include <QTabWidget>
#include <QTableWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "view/wipe_split.h"

namespace eyrie::ui {

namespace {

constexpr int kMostRows = 2000;
constexpr double kCloseUp = 4;  ///< screen px per image px at most, when a difference is gone to
constexpr int kRateWindow_ms = 1000;

QTableWidget* table(const QStringList& columns) {
    auto* made = new QTableWidget(0, static_cast<int>(columns.size()));
    made->setHorizontalHeaderLabels(columns);
    made->verticalHeader()->hide();
    made->setSelectionBehavior(QAbstractItemView::SelectRows);
    made->setSelectionMode(QAbstractItemView::SingleSelection);
    made->setEditTriggers(QAbstractItemView::NoEditTriggers);
    made->setAlternatingRowColors(true);
    made->setShowGrid(false);
    made->setWordWrap(false);
    made->horizontalHeader()->setStretchLastSection(true);
    return made;
}

QTableWidgetItem* number(double value, int row) {
    auto* item = new QTableWidgetItem;
    item->setData(Qt::DisplayRole, value);
    item->setData(Qt::UserRole, row);
    item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    return item;
}

QTableWidgetItem* words(const QString& text) {
    return new QTableWidgetItem(text);
}

QString idText(const std::optional<int>& id) {
    return id ? QString::number(*id) : QStringLiteral("–");
}

}  // namespace

ComparisonWindow::ComparisonWindow(ProjectSession& session, OverlaySettings& overlays, QWidget* parent)
    : QWidget(parent, Qt::Window), session_(session) {
    setWindowTitle(tr("Compare runs – Eyrie"));
    setObjectName(QStringLiteral("comparison"));
    resize(1500, 820);
    views_ = new WipeSplit(overlays);
    auto* left = new QWidget;
    auto* column = new QVBoxLayout(left);
    column->setContentsMargins(0, 0, 0, 0);
    column->addWidget(views_, 1);
    column->addWidget(buildTransport());
    auto* splitter = new QSplitter;
    splitter->addWidget(left);
    splitter->addWidget(buildLists());
    splitter->setStretchFactor(0, 1);
    splitter->setSizes({1080, 420});
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(6, 6, 6, 6);
    layout->addWidget(buildHeader());
    layout->addWidget(splitter, 1);

    connect(&loader_, &ComparisonLoader::loaded, this, &ComparisonWindow::showPair);
    connect(&loader_, &ComparisonLoader::compared, this, [this](const std::shared_ptr<const RunComparison>& found) {
        comparison_ = found;
        showComparison();
    });
    connect(&loader_, &ComparisonLoader::failed, this, [this](const QString& message) {
        problem_ = message;
        showComparison();
    });
    connect(&playback_, &Playback::frameDue, this, &ComparisonWindow::goToFrame);
    connect(&playback_, &Playback::playingChanged, this, [this](bool playing) {
        play_->setIcon(QIcon::fromTheme(playing ? QStringLiteral("media-playback-pause")
                                                : QStringLiteral("media-playback-start")));
        shown_ = 0;
        since_.restart();
    });
    connect(&session_, &ProjectSession::runsChanged, this, &ComparisonWindow::fillRuns);
    connect(&session_, &ProjectSession::videoChanged, this, &ComparisonWindow::close);
    frame_ = session_.currentFrame();
    fillRuns();
}

QWidget* ComparisonWindow::buildHeader() {
    auto* header = new QWidget;
    first_ = new QComboBox;
    second_ = new QComboBox;
    first_->setAccessibleName(tr("Run A"));
    second_->setAccessibleName(tr("Run B"));
    auto* swap = new QToolButton;
    swap->setText(tr("⇄"));
    swap->setToolTip(tr("Change A and B round"));
    wipe_ = new QToolButton;
    wipe_->setText(tr("Wipe"));
    wipe_->setCheckable(true);
    wipe_->setToolTip(tr("B over A with a border that can be dragged, instead of side by side (X)"));
    summary_ = new QLabel;
    summary_->setForegroundRole(QPalette::PlaceholderText);
    auto* layout = new QHBoxLayout(header);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(new QLabel(tr("A")));
    layout->addWidget(first_, 1);
    layout->addWidget(swap);
    layout->addWidget(new QLabel(tr("B")));
    layout->addWidget(second_, 1);
    layout->addWidget(wipe_);
    layout->addSpacing(12);
    layout->addWidget(summary_, 2);
    connect(first_, &QComboBox::activated, this, &ComparisonWindow::usePair);
    connect(second_, &QComboBox::activated, this, &ComparisonWindow::usePair);
    connect(swap, &QToolButton::clicked, this,
            [this] { choose(second_->currentData().toInt(), first_->currentData().toInt()); });
    connect(wipe_, &QToolButton::toggled, views_, &WipeSplit::setWipe);
    return header;
}

QWidget* ComparisonWindow::buildTransport() {
    auto* line = new QWidget;
    play_ = new QToolButton;
    play_->setIcon(QIcon::fromTheme(QStringLiteral("media-playback-start")));
    play_->setToolTip(tr("Play both in step (Space)"));
    play_->setAutoRaise(true);
    slider_ = new QSlider(Qt::Horizontal);
    slider_->setFocusPolicy(Qt::NoFocus);
    place_ = new QLabel;
    auto* layout = new QHBoxLayout(line);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(play_);
    layout->addWidget(slider_, 1);
    layout->addWidget(place_);
    connect(play_, &QToolButton::clicked, this, [this] {
        if (playback_.playing())
            playback_.pause();
        else
            playback_.play(frame_);
    });
    connect(slider_, &QSlider::valueChanged, this, [this](int frame) {
        playback_.jumped(frame);
        goToFrame(frame);
    });
    return line;
}

QWidget* ComparisonWindow::buildLists() {
    differences_ = table({tr("Size"), tr("Frames"), tr("What"), tr("A"), tr("B")});
    parameters_ = table({tr("Parameter"), tr("A"), tr("B")});
    detections_ = new QCheckBox(tr("Detections instead of tracks"));
    auto* page = new QWidget;
    auto* layout = new QVBoxLayout(page);
    layout->setContentsMargins(0, 4, 0, 0);
    layout->addWidget(detections_);
    layout->addWidget(differences_, 1);
    tabs_ = new QTabWidget;
    tabs_->addTab(page, tr("Differences"));
    tabs_->addTab(parameters_, tr("Parameters"));
    connect(detections_, &QCheckBox::toggled, this, &ComparisonWindow::showComparison);
    connect(differences_, &QTableWidget::currentCellChanged, this, [this](int row) { goToDifference(row); });
    connect(differences_, &QTableWidget::cellClicked, this, [this](int row) { goToDifference(row); });
    return tabs_;
}

QString ComparisonWindow::runName(int run_id) const {
    for (const RunRecord& run : session_.runs()) {
        if (run.id != run_id) continue;
        const QString name = QString::fromStdString(run.name);
        return name.isEmpty() ? tr("Run %1 · %2").arg(run.id).arg(QString::fromStdString(run.preset))
                              : tr("Run %1 · %2").arg(run.id).arg(name);
    }
    return {};
}

void ComparisonWindow::fillRuns() {
    if (!session_.media()) return;
    const int old_first = first_->currentData().toInt();
    const int old_second = second_->currentData().toInt();
    first_->clear();
    second_->clear();
    for (const RunRecord& run : session_.runs()) {
        if (run.sequence.path != session_.media()->identity || run.frames_done == 0) continue;
        first_->addItem(runName(run.id), run.id);
        second_->addItem(runName(run.id), run.id);
    }
    if (first_->findData(old_first) >= 0 && second_->findData(old_second) >= 0) {
        first_->setCurrentIndex(first_->findData(old_first));
        second_->setCurrentIndex(second_->findData(old_second));
        return;
    }
    if (first_->count() == 0) return;
    const int newest = first_->itemData(first_->count() - 1).toInt();
    const int current = session_.currentRun().value_or(newest);
    const int other = current != newest ? newest : first_->itemData(std::max(0, first_->count() - 2)).toInt();
    choose(current, other);
}

void ComparisonWindow::choose(int first, int second) {
    first_->setCurrentIndex(first_->findData(first));
    second_->setCurrentIndex(second_->findData(second));
    usePair();
}

void ComparisonWindow::usePair() {
    if (!session_.media() || first_->currentIndex() < 0 || second_->currentIndex() < 0) return;
    comparison_.reset();
    problem_.clear();
    playback_.setTimes(session_.timesUs());
    const QSignalBlocker quiet(slider_);
    slider_->setRange(0, session_.lastFrame());
    views_->setNames(tr("A · %1").arg(first_->currentText()), tr("B · %1").arg(second_->currentText()));
    loader_.usePair(
        {*session_.media(), session_.project(), first_->currentData().toInt(), second_->currentData().toInt()});
    loader_.request(frame_);
    showComparison();
}

void ComparisonWindow::goToFrame(FrameIndex frame) {
    frame_ = std::clamp(frame, 0, session_.lastFrame());
    loader_.request(frame_);
}

void ComparisonWindow::showPair(const ViewFrame& first, const ViewFrame& second) {
    views_->first().setFrame(first);
    views_->second().setFrame(second);
    std::optional<PlaceMark> mark;
    if (mark_ && mark_->first == first.index) mark = PlaceMark{mark_->second, {}};
    views_->first().setPlaceMark(mark);
    views_->second().setPlaceMark(mark);
    const QSignalBlocker quiet(slider_);
    slider_->setValue(first.index);
    ++shown_;
    const qint64 passed = since_.isValid() ? since_.elapsed() : 0;
    if (playback_.playing() && passed >= kRateWindow_ms) {
        shown_per_second_ = 1000.0 * shown_ / static_cast<double>(passed);
        shown_ = 0;
        since_.restart();
    }
    QString place = tr("frame %1 / %2").arg(first.index).arg(session_.lastFrame());
    if (playback_.playing() && shown_per_second_ > 0) place += tr(" · %1 frames/s").arg(shown_per_second_, 0, 'f', 0);
    place_->setText(place);
    emit framesShown(first.index);
}

void ComparisonWindow::showComparison() {
    const QSignalBlocker quiet(differences_);
    differences_->setSortingEnabled(false);
    differences_->setRowCount(0);
    parameters_->setRowCount(0);
    if (!problem_.isEmpty()) {
        summary_->setText(problem_);
        return;
    }
    if (!comparison_) {
        summary_->setText(first_->count() < 2 ? tr("There is only one run of this video. Make another one to compare.")
                                              : tr("Comparing …"));
        return;
    }
    const auto& found = detections_->isChecked() ? comparison_->detections : comparison_->tracks;
    const int rows = std::min(kMostRows, static_cast<int>(found.size()));
    differences_->setRowCount(rows);
    for (int i = 0; i < rows; ++i) {
        const ResultDifference& d = found[static_cast<std::size_t>(i)];
        const QString what = d.kind == DifferenceKind::only_first    ? tr("only in A")
                             : d.kind == DifferenceKind::only_second ? tr("only in B")
                             : d.kind == DifferenceKind::box         ? tr("other box")
                                                                     : tr("other id");
        differences_->setItem(i, 0, number(std::round(10 * d.size) / 10, i));
        differences_->setItem(
            i, 1,
            words(d.first_frame == d.last_frame ? QString::number(d.first_frame)
                                                : QStringLiteral("%1–%2").arg(d.first_frame).arg(d.last_frame)));
        differences_->setItem(i, 2, words(what));
        differences_->setItem(i, 3, words(idText(d.first_id)));
        differences_->setItem(i, 4, words(idText(d.second_id)));
    }
    differences_->setSortingEnabled(true);
    differences_->sortByColumn(0, Qt::DescendingOrder);
    differences_->resizeColumnsToContents();
    parameters_->setRowCount(static_cast<int>(comparison_->parameters.size()));
    for (int i = 0; i < parameters_->rowCount(); ++i) {
        const ParameterDifference& d = comparison_->parameters[static_cast<std::size_t>(i)];
        parameters_->setItem(i, 0, words(QString::fromStdString(d.name)));
        parameters_->setItem(i, 1, words(QString::fromStdString(d.first)));
        parameters_->setItem(i, 2, words(QString::fromStdString(d.second)));
    }
    parameters_->resizeColumnsToContents();
    tabs_->setTabText(0, tr("Differences (%1)").arg(found.size()));
    tabs_->setTabText(1, tr("Parameters (%1)").arg(comparison_->parameters.size()));
    const auto count = [&](DifferenceKind kind) {
        return std::count_if(found.begin(), found.end(), [&](const ResultDifference& d) { return d.kind == kind; });
    };
    summary_->setText(tr("%1 only in A, %2 only in B, %3 with another box, %4 changes of id")
                          .arg(count(DifferenceKind::only_first))
                          .arg(count(DifferenceKind::only_second))
                          .arg(count(DifferenceKind::box))
                          .arg(count(DifferenceKind::identity)));
}

void ComparisonWindow::goToDifference(int row) {
    const QTableWidgetItem* item = row >= 0 ? differences_->item(row, 0) : nullptr;
    if (item == nullptr || !comparison_) return;
    const auto& found = detections_->isChecked() ? comparison_->detections : comparison_->tracks;
    const auto index = static_cast<std::size_t>(item->data(Qt::UserRole).toInt());
    if (index >= found.size()) return;
    playback_.pause();
    goToFrame(found[index].worst_frame);
    mark_ = std::pair(found[index].worst_frame, found[index].box);
    const ViewTransform& transform = views_->first().transform();
    const double zoom = std::clamp(transform.zoom(), 1.5, kCloseUp);
    views_->centreOn(QPointF(found[index].box.centre.x, found[index].box.centre.y), zoom);
}

void ComparisonWindow::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
        case Qt::Key_Space:
            play_->click();
            return;
        case Qt::Key_Left:
        case Qt::Key_Right:
            playback_.pause();
            goToFrame(frame_ + (event->key() == Qt::Key_Left ? -1 : 1));
            return;
        case Qt::Key_X:
            wipe_->toggle();
            return;
        case Qt::Key_F:
            views_->first().fit();
            return;
        case Qt::Key_Escape:
            close();
            return;
        default:
            QWidget::keyPressEvent(event);
    }
}

}  // namespace eyrie::ui
