#include "tune/compare/comparison_window.h"

#include <QCheckBox>
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

#include "canvas/layers/stages/detection_layer.h"
#include "canvas/layers/track_layer.h"
#include "canvas/overlay_settings.h"
#include "canvas/wipe_split.h"
#include "tune/compare/comparison_header.h"
#include "widgets/tables/table_look.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr int kMostRows = 2000;
constexpr double kCloseUp = 4;  ///< screen px per image px at most, when a difference is gone to
constexpr int kRateWindow_ms = 1000;
constexpr int kEditsSettle_ms = 250;  ///< after the last change of a parameter

QTableWidgetItem* number(double value, int row) {
    auto* item = new QTableWidgetItem;
    item->setData(Qt::DisplayRole, value);
    item->setData(Qt::UserRole, row);
    item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    return item;
}

QTableWidgetItem* words(const QString& text) {
    auto* item = new QTableWidgetItem(text);
    item->setToolTip(text);
    return item;
}

QString idText(const std::optional<int>& id) {
    return id ? QString::number(*id) : QStringLiteral("–");
}

}  // namespace

ComparisonWindow::ComparisonWindow(ProjectSession& session, PresetLibrary& presets, OverlaySettings& overlays,
                                   QWidget* parent)
    : QWidget(parent, Qt::Window),
      session_(session),
      overlays_(overlays),
      drawn_(new OverlaySettings(this)),
      loader_(answers()),
      edited_(kEditsSettle_ms, [this] { parametersEdited(); }) {
    setWindowTitle(tr("A and B – Eyrie"));
    setObjectName(QStringLiteral("comparison"));
    resize(1500, 820);
    views_ = new WipeSplit(*drawn_);
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
    header_ = new ComparisonHeader(session_, presets);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(6, 6, 6, 6);
    layout->addWidget(header_);
    layout->addWidget(splitter, 1);

    connect(header_, &ComparisonHeader::pairChosen, this, &ComparisonWindow::usePair);
    const auto compareOthers = [this](bool) {
        followOverlays();
        showComparison();
    };
    bindSwitches(this, {{&header_->wipe(), [this](bool on) { views_->setWipe(on); }}, {detections_, compareOthers}});
    whenAny(&overlays_, this, &ComparisonWindow::followOverlays, &OverlaySettings::changed);
    connect(&playback_, &Playback::frameDue, this, &ComparisonWindow::playOn);
    connect(&playback_, &Playback::playingChanged, this, [this](bool playing) {
        play_->setIcon(QIcon::fromTheme(playing ? QStringLiteral("media-playback-pause")
                                                : QStringLiteral("media-playback-start")));
        shown_ = 0;
        since_.restart();
    });
    whenChanged(session_, this, {{SessionChange::video, [this] { close(); }}});
    followOverlays();
    frame_ = session_.currentFrame();
    usePair();
}

ComparisonAnswers ComparisonWindow::answers() {
    return {
        .show_comparison =
            [this](const std::shared_ptr<const SideComparison>& found) {
                comparison_ = found;
                header_->showProgress(0, 0);
                showComparison();
                if (pair_ && pair_->computes()) loader_.request(frame_);  // tracks were finished
            },
        .show = [this](const ViewFrame& first, const ViewFrame& second) { showPair(first, second); },
        .show_progress =
            [this](int done, int total) {
                header_->showProgress(done, total);
                const bool lacks = !views_->first().frame().result || !views_->second().frame().result;
                if (lacks && !playback_.playing()) loader_.request(frame_);
            },
        .fail =
            [this](const QString& message) {
                problem_ = message;
                header_->showProgress(0, 0);
                showComparison();
            },
    };
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
    bindCommands(this, {{play_, [this] {
                             if (playback_.playing())
                                 playback_.pause();
                             else
                                 playback_.play(frame_);
                         }}});
    const auto jump = [this] {
        playback_.jumped(slider_->value());
        goToFrame(slider_->value());
    };
    onEdited(this, jump, slider_);
    return line;
}

QWidget* ComparisonWindow::buildLists() {
    differences_ = tableToRead({tr("Size"), tr("Frames"), tr("What"), tr("A"), tr("B")});
    parameters_ = tableToRead({tr("Parameter"), tr("A"), tr("B")});
    detections_ = new QCheckBox(tr("Detections instead of tracks"));
    auto* page = new QWidget;
    auto* layout = new QVBoxLayout(page);
    layout->setContentsMargins(0, 4, 0, 0);
    layout->addWidget(detections_);
    layout->addWidget(differences_, 1);
    tabs_ = new QTabWidget;
    tabs_->addTab(page, tr("Differences"));
    tabs_->addTab(parameters_, tr("Parameters"));
    connect(differences_, &QTableWidget::currentCellChanged, this, &ComparisonWindow::goToDifference);
    connect(differences_, &QTableWidget::cellClicked, this, &ComparisonWindow::goToDifference);
    return tabs_;
}

void ComparisonWindow::choose(int first, int second) {
    header_->choose(ComparisonHeader::runSide(first), ComparisonHeader::runSide(second));
}

void ComparisonWindow::usePair() {
    edited_.stop();
    comparison_.reset();
    problem_.clear();
    pair_ = header_->pair();
    if (!pair_) {
        showComparison();
        return;
    }
    playback_.setTimes(session_.timesUs());
    playback_.setLooping(pair_->computes());  // as playOn() does within the frames that are computed
    {
        const QSignalBlocker quiet(slider_);
        slider_->setRange(pair_->computes() ? pair_->range.first : 0,
                          pair_->computes() ? pair_->range.last : session_.lastFrame());
    }
    views_->setNames(tr("A · %1").arg(header_->firstName()), tr("B · %1").arg(header_->secondName()));
    loader_.usePair(*pair_);
    header_->showProgress(0, pair_->computes() ? 1 : 0);
    goToFrame(frame_);
    showComparison();
}

void ComparisonWindow::parametersEdited() {
    if (!pair_ || !header_->comparesForm()) return;
    const auto now = header_->pair();
    const auto changed = [](const ComparisonSide& a, const ComparisonSide& b) {
        return a.options && b.options && !differencesBetween(*a.options, *b.options).empty();
    };
    if (now && (changed(now->first, pair_->first) || changed(now->second, pair_->second))) usePair();
}

bool ComparisonWindow::event(QEvent* event) {
    if (event->type() == QEvent::WindowActivate) parametersEdited();
    return QWidget::event(event);
}

void ComparisonWindow::followOverlays() {
    OverlayProfile profile = overlays_.profile();
    profile.set(detections_->isChecked() ? DetectionLayer::kKind : TrackLayer::kKind, true);
    drawn_->setProfile(profile);
    drawn_->setPalette(overlays_.palette());
    drawn_->setMinScore(overlays_.style().min_score);
    drawn_->setHidden(overlays_.hidden());
}

void ComparisonWindow::playOn(FrameIndex frame) {
    const bool at_end = frame > slider_->maximum() || frame < slider_->minimum();
    if (at_end && playback_.playing()) {  // only computed frames are played, again and again
        frame = playback_.speed() > 0 ? slider_->minimum() : slider_->maximum();
        playback_.jumped(frame);
    }
    goToFrame(frame);
}

void ComparisonWindow::goToFrame(FrameIndex frame) {
    frame_ = std::clamp(frame, slider_->minimum(), slider_->maximum());
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
    tabs_->setTabText(0, tr("Differences"));
    tabs_->setTabText(1, tr("Parameters"));
    if (!problem_.isEmpty()) {
        header_->setSummary(problem_);
        return;
    }
    if (!comparison_) {
        header_->setSummary(!pair_              ? tr("There is no run of this video yet. Make one to compare with.")
                            : pair_->computes() ? tr("Computing…")
                                                : tr("Comparing…"));
        return;
    }
    const auto& found = detections_->isChecked() ? comparison_->detections : comparison_->tracks;
    const int rows = std::min(kMostRows, static_cast<int>(found.size()));
    differences_->setRowCount(rows);
    for (int i = 0; i < rows; ++i) {
        const ResultDifference& d = found[static_cast<std::size_t>(i)];
        const QString what = d.kind == DifferenceKind::only_first    ? tr("only in A")
                             : d.kind == DifferenceKind::only_second ? tr("only in B")
                             : d.kind == DifferenceKind::box         ? tr("different box")
                                                                     : tr("different id");
        differences_->setItem(i, 0, number(std::round(10 * d.size) / 10, i));
        differences_->setItem(
            i, 1,
            words(d.first_frame == d.last_frame ? QString::number(d.first_frame)
                                                : QStringLiteral("%1–%2").arg(d.first_frame).arg(d.last_frame)));
        differences_->item(i, 1)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
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
    header_->setSummary(tr("%1 only in A, %2 only in B, %3 different boxes, %4 different ids%5")
                            .arg(count(DifferenceKind::only_first))
                            .arg(count(DifferenceKind::only_second))
                            .arg(count(DifferenceKind::box))
                            .arg(count(DifferenceKind::identity))
                            .arg(comparison_->exact ? QString() : tr("; tracks begin shortly before these frames")));
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
            header_->wipe().toggle();
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

#include "moc_comparison_window.cpp"
