#include "review/tracks/filter_chips.h"

#include <QHBoxLayout>
#include <QInputDialog>
#include <QJsonDocument>
#include <QJsonObject>
#include <QMenu>
#include <QSettings>
#include <QToolButton>

#include "review/tracks/kept_likeness.h"
#include "widgets/layout/flow_layout.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

const QString kKeptFilters = QStringLiteral("review/track_filters");

std::array<TrackQuality, kTrackQualities> allQualities() {
    std::array<TrackQuality, kTrackQualities> all{};
    for (int i = 0; i < kTrackQualities; ++i) all[static_cast<std::size_t>(i)] = static_cast<TrackQuality>(i);
    return all;
}

}  // namespace

FilterChips::FilterChips(QWidget* parent) : QWidget(parent), add_(new QToolButton(this)) {
    auto* row = new FlowLayout(this);
    add_->setText(tr("+ Filter"));
    add_->setToolTip(tr(
        "Narrow the list: speed (mean, lowest, highest), life, length, score, direction, events, zones, time, state"));
    add_->setPopupMode(QToolButton::InstantPopup);
    auto* menu = new QMenu(add_);
    connect(menu, &QMenu::aboutToShow, this, [this, menu] {
        menu->clear();
        fillAddMenu(*menu);
    });
    add_->setMenu(menu);
    row->addWidget(add_);
    for (const TrackQuality quality : allQualities()) makeChip(quality);
    // As high as its rows.
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Preferred);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    refresh();
}

void FilterChips::makeChip(TrackQuality quality) {
    Chip& chip = chips_.at(static_cast<std::size_t>(quality));
    chip.whole = new QWidget(this);
    auto* parts = new QHBoxLayout(chip.whole);
    parts->setContentsMargins(0, 0, 0, 0);
    parts->setSpacing(0);
    chip.button = new QToolButton(chip.whole);
    chip.button->setToolTip(tr("Change the limits"));
    auto* remove = new QToolButton(chip.whole);
    remove->setText(QStringLiteral("×"));
    remove->setToolTip(tr("Remove this filter"));
    remove->setAccessibleName(tr("Remove the filter %1").arg(nameOf(quality)));
    parts->addWidget(chip.button);
    parts->addWidget(remove);
    bindCommands(this, {{chip.button, [this, quality] { openLimits(quality); }},
                        {remove, [this, quality] { change([&](TrackFilter& filter) { filter.clear(quality); }); }}});
    layout()->addWidget(chip.whole);
}

void FilterChips::setFilter(const TrackFilter& filter) {
    change([&](TrackFilter& mine) { mine = filter; });
}

void FilterChips::setLike(std::optional<TrackId> track) {
    change([&](TrackFilter& filter) {
        if (!track)
            filter.like.reset();
        else if (!filter.like || filter.like->track != *track)
            filter.like = LikeLimit{.track = *track, .counts = keptLikenessChoice()};
    });
}

void FilterChips::setLikeWaiting(const QString& why) {
    if (why == like_waits_) return;
    like_waits_ = why;
    refresh();
}

void FilterChips::change(const std::function<void(TrackFilter&)>& what) {
    const TrackFilter before = filter_;
    what(filter_);
    if (filter_ == before) return;
    refresh();
    emit edited();
}

void FilterChips::setScale(const SceneScale& scale) {
    scale_ = scale;
    refresh();
}

void FilterChips::setDoings(std::shared_ptr<const DoingsByTrack> doings) {
    doings_ = std::move(doings);
}

void FilterChips::refresh() {
    for (const TrackQuality quality : allQualities()) {
        const Chip& chip = chips_.at(static_cast<std::size_t>(quality));
        QString text = chipText(filter_, quality, scale_);
        if (quality == TrackQuality::like && !like_waits_.isEmpty()) text += QStringLiteral(": ") + like_waits_;
        chip.button->setText(text);
        chip.whole->setVisible(filter_.has(quality));
    }
    updateGeometry();
}

void FilterChips::fillAddMenu(QMenu& menu) {
    for (const TrackQuality quality : allQualities()) {
        if (quality == TrackQuality::like) continue;  // begins with a track, not here
        QAction* action =
            menu.addAction(tr("%1…").arg(nameOf(quality)), this, [this, quality] { openLimits(quality); });
        action->setEnabled(!filter_.has(quality));
    }
    menu.addSeparator();
    const QStringList names = keptNames();
    for (const QString& name : names) menu.addAction(name, this, [this, name] { useKept(name); });
    menu.addAction(tr("Save this filter as…"), this, [this] { askForName(); })->setEnabled(!filter_.json().isEmpty());
    if (!names.isEmpty()) {
        QMenu* forget = menu.addMenu(tr("Delete"));
        for (const QString& name : names) forget->addAction(name, this, [this, name] { forgetKept(name); });
    }
    menu.addAction(tr("Remove all"), this, [this] { clear(); })->setEnabled(filter_.any());
}

// ---- kept filters ---------------------------------------------------------------------------------------------------

QStringList FilterChips::keptNames() const {
    return QSettings().value(kKeptFilters).toMap().keys();
}

void FilterChips::keepAs(const QString& name) {
    QVariantMap kept = QSettings().value(kKeptFilters).toMap();
    kept[name] = QString::fromUtf8(QJsonDocument(filter_.json()).toJson(QJsonDocument::Compact));
    QSettings().setValue(kKeptFilters, kept);
}

void FilterChips::useKept(const QString& name) {
    const QString text = QSettings().value(kKeptFilters).toMap().value(name).toString();
    setFilter(TrackFilter::fromJson(QJsonDocument::fromJson(text.toUtf8()).object()));
    for (const TrackQuality quality : allQualities())
        if (needsDoings(quality) && filter_.has(quality)) return emit doingsWanted();
}

void FilterChips::forgetKept(const QString& name) {
    QVariantMap kept = QSettings().value(kKeptFilters).toMap();
    kept.remove(name);
    QSettings().setValue(kKeptFilters, kept);
}

void FilterChips::askForName() {
    const QString name = QInputDialog::getText(this, tr("Save this filter"), tr("Name")).simplified();
    if (!name.isEmpty()) keepAs(name);
}

}  // namespace eyrie::ui

#include "moc_filter_chips.cpp"
