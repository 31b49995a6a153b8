/// What opens below a chip: the limits of its quality.
#include <QCheckBox>
#include <QFrame>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QScreen>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "review/tracks/filter_chips.h"
#include "review/tracks/kept_likeness.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

/// How many tracks something holds for.
template <class Condition>
int countOfTracks(const DoingsByTrack& doings, const Condition& holds) {
    return static_cast<int>(
        std::count_if(doings.begin(), doings.end(), [&](const auto& each) { return holds(each.second); }));
}

template <class Value>
void put(std::set<Value>& values, const Value& value, bool in) {
    if (in)
        values.insert(value);
    else
        values.erase(value);
}

}  // namespace

QFrame* FilterChips::openLimits(TrackQuality quality) {
    if (popup_ != nullptr) popup_->close();
    popup_ = new QFrame(this, Qt::Popup);
    popup_->setAttribute(Qt::WA_DeleteOnClose);
    popup_->setFrameShape(QFrame::StyledPanel);
    auto* rows = new QVBoxLayout(popup_);
    rows->setContentsMargins(8, 8, 8, 8);
    rows->setSpacing(4);
    switch (quality) {
        case TrackQuality::direction:
            fillDirections(*rows);
            break;
        case TrackQuality::event:
            fillEvents(*rows);
            break;
        case TrackQuality::zone:
            fillZones(*rows);
            break;
        case TrackQuality::time:
            fillTime(*rows);
            break;
        case TrackQuality::state:
            fillStates(*rows);
            break;
        case TrackQuality::like:
            fillLike(*rows);
            break;
        default:
            fillRange(*rows, quality);
    }
    if (needsDoings(quality)) emit doingsWanted();
    const Chip& chip = chips_.at(static_cast<std::size_t>(quality));
    const QWidget* below = chip.whole->isVisible() ? static_cast<QWidget*>(chip.button) : add_;
    popup_->adjustSize();
    QPoint place = below->mapToGlobal(QPoint(0, below->height()));
    const QRect seen = screen()->availableGeometry();
    place.setX(std::clamp(place.x(), seen.left(), std::max(seen.left(), seen.right() - popup_->width())));
    place.setY(std::min(place.y(), std::max(seen.top(), seen.bottom() - popup_->height())));
    popup_->move(place);
    popup_->show();
    if (auto* first = popup_->findChild<QLineEdit*>()) first->setFocus();
    return popup_;
}

QLineEdit* FilterChips::addField(QHBoxLayout& line, const QString& name, const std::optional<double>& value,
                                 const std::function<void(std::optional<double>)>& take) {
    return addText(line, name, value ? QString::number(*value, 'g', 6) : QString(), [take](QString text) {
        bool is_number = false;
        const double number = text.replace(QLatin1Char(','), QLatin1Char('.')).toDouble(&is_number);
        const bool good = text.isEmpty() || (is_number && number >= 0);
        if (good) take(text.isEmpty() ? std::nullopt : std::optional(number));
        return good;
    });
}

QLineEdit* FilterChips::addText(QHBoxLayout& line, const QString& name, const QString& text,
                                const std::function<bool(const QString&)>& take) {
    auto* edit = new QLineEdit;
    edit->setPlaceholderText(tr("any"));
    edit->setAccessibleName(name);
    edit->setFixedWidth(70);
    edit->setText(text);
    onEdited(
        this,
        [edit, take] {
            edit->setStyleSheet(take(edit->text().trimmed()) ? QString() : QStringLiteral("color: #d04040"));
        },
        edit);
    connect(edit, &QLineEdit::returnPressed, popup_, [this] {
        const auto fields = popup_->findChildren<QLineEdit*>();
        const bool bad = std::any_of(fields.begin(), fields.end(),
                                     [](const QLineEdit* field) { return !field->styleSheet().isEmpty(); });
        if (!bad) popup_->close();
    });
    line.addWidget(edit);
    return edit;
}

void FilterChips::fillRange(QVBoxLayout& rows, TrackQuality quality) {
    const TrackRange range = filter_.range(quality);
    auto* line = new QHBoxLayout;
    const auto field = [&](const QString& words, const std::optional<double>& value,
                           std::optional<double> TrackRange::*limit) {
        line->addWidget(new QLabel(words));
        addField(*line, QStringLiteral("%1 %2").arg(nameOf(quality), words), value,
                 [this, limit, quality](std::optional<double> number) {
                     change([&](TrackFilter& filter) { filter.range(quality).*limit = number; });
                 });
    };
    rows.addWidget(new QLabel(QStringLiteral("<b>%1</b>").arg(nameOf(quality))));
    field(tr("from"), range.from, &TrackRange::from);
    field(tr("to"), range.to, &TrackRange::to);
    line->addWidget(new QLabel(unitOf(quality, scale_)));
    rows.addLayout(line);
}

void FilterChips::fillTime(QVBoxLayout& rows) {
    rows.addWidget(new QLabel(QStringLiteral("<b>%1</b>").arg(tr("Tracks that are there at some time"))));
    auto* line = new QHBoxLayout;
    const auto field = [&](const QString& words, std::optional<TimeLimit> TimeRange::*limit) {
        line->addWidget(new QLabel(words));
        const auto& value = filter_.time.*limit;
        addText(*line, QStringLiteral("%1 %2").arg(nameOf(TrackQuality::time), words),
                value ? timeLimitText(*value) : QString(), [this, limit](const QString& text) {
                    const auto moment = timeLimitOf(text);
                    if (!text.isEmpty() && (!moment || (moment->of_day && !clock_known_))) return false;
                    change([&](TrackFilter& filter) { filter.time.*limit = moment; });
                    return true;
                });
    };
    field(tr("from"), &TimeRange::from);
    field(tr("to"), &TimeRange::to);
    rows.addLayout(line);
    auto* note = new QLabel(clock_known_ ? tr("Frames, or times of the day in UTC: 120, 22:08 or 22:08:22")
                                         : tr("Frames: when the video was taken is not known"));
    note->setWordWrap(true);
    rows.addWidget(note);
}

void FilterChips::fillStates(QVBoxLayout& rows) {
    rows.addWidget(new QLabel(QStringLiteral("<b>%1</b>").arg(tr("Tracks of which one of these is true"))));
    for (int i = 0; i < kTrackConditions; ++i) {
        const auto condition = static_cast<TrackCondition>(i);
        auto* box = new QCheckBox(nameOf(condition));
        box->setChecked(filter_.conditions.contains(condition));
        bindCommands(this, {{box, [this, condition](bool on) {
                                 change([&](TrackFilter& filter) { put(filter.conditions, condition, on); });
                             }}});
        rows.addWidget(box);
    }
    auto* note = new QLabel(tr("Now: in the frame shown"));
    rows.addWidget(note);
}

void FilterChips::fillLike(QVBoxLayout& rows) {
    if (!filter_.like) return;
    rows.addWidget(new QLabel(QStringLiteral("<b>%1</b>").arg(tr("Tracks like track %1").arg(filter_.like->track))));
    auto* line = new QHBoxLayout;
    line->addWidget(new QLabel(tr("at least")));
    QLineEdit* least = addField(*line, tr("Least likeness"), filter_.like->least, [this](std::optional<double> number) {
        change([&](TrackFilter& filter) {
            if (filter.like) filter.like->least = number.value_or(0);
        });
    });
    least->setPlaceholderText(QStringLiteral("0"));
    line->addStretch();
    rows.addLayout(line);
    auto* note = new QLabel(tr("From 0 to 1, by what is ticked"));
    note->setWordWrap(true);
    rows.addWidget(note);
    addLikeSwitches(rows);
}

void FilterChips::addLikeSwitches(QVBoxLayout& rows) {
    struct Switch {
        QString text;
        QString tip;
        bool LikenessChoice::*counts;
    };
    const Switch switches[] = {
        {tr("Path"), tr("Where on the ground and in which direction it drove"), &LikenessChoice::path},
        {tr("Speed"), {}, &LikenessChoice::speed},
        {tr("Size"), {}, &LikenessChoice::size},
        {tr("Looks"),
         tr("Colour, brightness and outline in a few pictures of each track. They are read in the background, once for "
            "a run; until then the rest counts"),
         &LikenessChoice::looks}};
    for (const Switch& each : switches) {
        auto* box = new QCheckBox(each.text);
        box->setToolTip(each.tip);
        box->setChecked(filter_.like->counts.*each.counts);
        bindCommands(this, {{box, [this, box, counts = each.counts](bool on) {
                                 change([&](TrackFilter& filter) {
                                     if (!filter.like) return;
                                     LikenessChoice wanted = filter.like->counts;
                                     wanted.*counts = on;
                                     if (wanted.any()) filter.like->counts = wanted;
                                 });
                                 if (!filter_.like) return;
                                 // Something has to count.
                                 box->setChecked(filter_.like->counts.*counts);
                                 keepLikenessChoice(filter_.like->counts);
                             }}});
        rows.addWidget(box);
    }
}

void FilterChips::fillDirections(QVBoxLayout& rows) {
    rows.addWidget(new QLabel(QStringLiteral("<b>%1</b>").arg(nameOf(TrackQuality::direction))));
    auto* rose = new QGridLayout;
    rose->setSpacing(2);
    // Row and column of each eighth, from right over down.
    constexpr std::array<std::pair<int, int>, kEighths> kPlaces{
        {{1, 2}, {2, 2}, {2, 1}, {2, 0}, {1, 0}, {0, 0}, {0, 1}, {0, 2}}};
    for (int eighth = 0; eighth < kEighths; ++eighth) {
        auto* button = new QToolButton;
        button->setText(arrowOf(eighth));
        button->setCheckable(true);
        button->setChecked(filter_.eighths.contains(eighth));
        bindCommands(this, {{button, [this, eighth](bool on) {
                                 change([&](TrackFilter& filter) { put(filter.eighths, eighth, on); });
                             }}});
        const auto [at, column] = kPlaces.at(static_cast<std::size_t>(eighth));
        rose->addWidget(button, at, column);
    }
    rows.addLayout(rose);
    auto* note = new QLabel(tr("Over the ground, as the track's first frame shows it"));
    note->setWordWrap(true);
    rows.addWidget(note);
}

void FilterChips::fillEvents(QVBoxLayout& rows) {
    rows.addWidget(new QLabel(QStringLiteral("<b>%1</b>").arg(tr("Tracks that had one of these"))));
    for (const EventKind kind : allEventKinds()) {
        const int count =
            doings_ ? countOfTracks(*doings_, [&](const TrackDoings& did) { return did.events.contains(kind); }) : 0;
        if (doings_ && count == 0 && !filter_.events.contains(kind)) continue;  // the list would be long
        auto* box = new QCheckBox(QStringLiteral("%1   %2").arg(QLatin1String(eyrie::nameOf(kind))).arg(count));
        box->setChecked(filter_.events.contains(kind));
        bindCommands(
            this,
            {{box, [this, kind](bool on) { change([&](TrackFilter& filter) { put(filter.events, kind, on); }); }}});
        rows.addWidget(box);
    }
}

void FilterChips::fillZones(QVBoxLayout& rows) {
    rows.addWidget(new QLabel(QStringLiteral("<b>%1</b>").arg(tr("Tracks that met one of these"))));
    std::set<std::string> names = filter_.zones;
    if (doings_)
        for (const auto& [track, did] : *doings_) names.insert(did.zones.begin(), did.zones.end());
    if (names.empty()) {
        auto* none =
            new QLabel(tr("No track enters, leaves or crosses a zone. Zones are drawn in the list of events."));
        none->setWordWrap(true);
        none->setFixedWidth(220);
        rows.addWidget(none);
    }
    for (const std::string& name : names) {
        const int count =
            doings_ ? countOfTracks(*doings_, [&](const TrackDoings& did) { return did.zones.contains(name); }) : 0;
        auto* box = new QCheckBox(QStringLiteral("%1   %2").arg(QString::fromStdString(name)).arg(count));
        box->setChecked(filter_.zones.contains(name));
        bindCommands(
            this,
            {{box, [this, name](bool on) { change([&](TrackFilter& filter) { put(filter.zones, name, on); }); }}});
        rows.addWidget(box);
    }
}

}  // namespace eyrie::ui
