#include "review/events/event_thresholds.h"

#include <QSettings>
#include <QVBoxLayout>
#include <algorithm>
#include <exception>
#include <utility>

#include "review/events/event_text.h"
#include "widgets/layout/collapsible_section.h"
#include "widgets/parameters/parameter_row.h"

namespace eyrie::ui {

namespace {

const QString kThresholdsSetting = QStringLiteral("review/thresholds");

/// Kinds whose thresholds belong together, and how the names of these begin.
struct ThresholdGroup {
    std::vector<EventKind> kinds;
    std::vector<std::string> names;
};

std::vector<ThresholdGroup> thresholdGroups() {
    return {
        {{EventKind::lost, EventKind::appears, EventKind::leaves}, {"border_", "edge_"}},
        {{EventKind::stops, EventKind::starts, EventKind::stands},
         {"standing_speed", "moving_speed", "min_standing", "min_way", "stands"}},
        {{EventKind::turns_back}, {"turn_back_"}},
        {{EventKind::against_flow, EventKind::leaves_flow}, {"flow_", "arrow_", "against_", "off_flow"}},
        {{EventKind::over_speed, EventKind::under_speed}, {"over", "under"}},
        {{EventKind::convoy}, {"convoy_"}},
        {{EventKind::meeting}, {"meeting_"}},
        {{EventKind::loiters}, {"loiter_"}},
        {{EventKind::enters, EventKind::exits, EventKind::crosses}, {"zone_"}},
    };
}

bool holdsThreshold(const ThresholdGroup& group, const std::string& name) {
    const std::string bare = name.substr(name.find('.') + 1);
    return std::any_of(group.names.begin(), group.names.end(),
                       [&](const std::string& begin) { return bare.starts_with(begin); });
}

}  // namespace

EventThresholds::EventThresholds(QWidget* parent) : QScrollArea(parent) {
    setWidgetResizable(true);
    setFrameShape(QFrame::NoFrame);
    setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    restoreValues();
    makeGroups();
    setCounts({});
}

void EventThresholds::makeGroups() {
    auto* area = new QWidget;
    auto* layout = new QVBoxLayout(area);
    layout->setContentsMargins(0, 0, 0, 0);
    EventOptions plain;
    const std::vector<Parameter> defaults = listParameters(describeOf(plain));
    const std::vector<Parameter> current = listParameters(describeOf(options_));
    std::vector<bool> taken(defaults.size(), false);
    const auto add = [&](Group group, const auto& is_in_it) {
        group.section = new CollapsibleSection(group.title, area);
        for (std::size_t i = 0; i < defaults.size(); ++i) {
            if (taken[i] || !is_in_it(defaults[i].name)) continue;
            taken[i] = true;
            auto* row = new ParameterRow(defaults[i], group.section);
            row->setValues(QString::fromStdString(current[i].value), QString::fromStdString(defaults[i].value));
            connect(row, &ParameterRow::valueChanged, this, &EventThresholds::setValue);
            group.section->addRow(row);
            rows_.push_back(row);
        }
        layout->addWidget(group.section);
        groups_.push_back(std::move(group));
    };
    for (const ThresholdGroup& each : thresholdGroups()) {
        Group group;
        for (const EventKind kind : each.kinds) group.kinds.push_back(static_cast<int>(kind));
        add(std::move(group), [&](const std::string& name) { return holdsThreshold(each, name); });
    }
    add({tr("All kinds"), {}, nullptr}, [](const std::string&) { return true; });
    layout->addStretch(1);
    setWidget(area);
}

void EventThresholds::setCounts(const EventKindsButton::Counts& counts) {
    for (Group& group : groups_) {
        if (group.kinds.empty()) continue;
        QStringList parts;
        for (const int kind : group.kinds)
            parts << QStringLiteral("%1 %2").arg(listedKindText(kind)).arg(counts.at(static_cast<std::size_t>(kind)));
        group.section->setTitle(parts.join(QStringLiteral(", ")));
    }
}

void EventThresholds::setKindsShown(const EventKindsButton& kinds) {
    for (const Group& group : groups_)
        group.section->setVisible(group.kinds.empty() || std::any_of(group.kinds.begin(), group.kinds.end(),
                                                                     [&](int kind) { return kinds.shows(kind); }));
}

void EventThresholds::setValue(const QString& name, const QString& value) {
    EventOptions changed = options_;
    try {
        setParameter(describeOf(changed), name.toStdString(), value.toStdString());
    } catch (const std::exception&) {
        return;  // editors let no such value through
    }
    options_ = changed;
    EventOptions plain;
    const std::vector<Parameter> defaults = listParameters(describeOf(plain));
    for (ParameterRow* row : rows_) {
        if (row->name() != name || row->value() == value) continue;
        const auto parameter = std::find_if(defaults.begin(), defaults.end(),
                                            [&](const Parameter& each) { return each.name == name.toStdString(); });
        row->setValues(value, QString::fromStdString(parameter->value));
    }
    keepValues();
    emit edited();
}

void EventThresholds::resetAll() {
    for (ParameterRow* row : rows_) row->resetToDefault();
}

void EventThresholds::restoreValues() {
    const QVariantMap kept = QSettings().value(kThresholdsSetting).toMap();
    for (auto value = kept.begin(); value != kept.end(); ++value) {
        try {
            setParameter(describeOf(options_), value.key().toStdString(), value.value().toString().toStdString());
        } catch (const std::exception&) {
            continue;  // of another version
        }
    }
}

void EventThresholds::keepValues() const {
    EventOptions plain;
    EventOptions mine = options_;
    const std::vector<Parameter> defaults = listParameters(describeOf(plain));
    const std::vector<Parameter> current = listParameters(describeOf(mine));
    QVariantMap changed;
    for (std::size_t i = 0; i < defaults.size(); ++i)
        if (defaults[i].value != current[i].value)
            changed[QString::fromStdString(current[i].name)] = QString::fromStdString(current[i].value);
    QSettings().setValue(kThresholdsSetting, changed);
}

}  // namespace eyrie::ui

#include "moc_event_thresholds.cpp"
