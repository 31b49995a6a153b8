#include "widgets/charts/sweep_chart_data.h"

#include <cmath>
#include <map>

namespace eyrie::ui {

namespace {

QString numberText(double value) {
    return std::isfinite(value) ? QString::number(value, 'g', 10) : QString();
}

QString mapText(const SweepChartData& data) {
    QStringList lines{data.y_label + QLatin1Char('\\') + data.x_label + QLatin1Char('\t') +
                      data.columns.join(QLatin1Char('\t'))};
    for (qsizetype r = 0; r < data.rows.size(); ++r) {
        QStringList fields{data.rows[r]};
        for (qsizetype c = 0; c < data.columns.size(); ++c)
            fields << numberText(data.cells[static_cast<std::size_t>(r * data.columns.size() + c)]);
        lines << fields.join(QLatin1Char('\t'));
    }
    return lines.join(QLatin1Char('\n'));
}

}  // namespace

QString SweepChartData::text() const {
    if (isMap()) return mapText(*this);
    // Curves over the same axis stand side by side; those that trade one measure for another have an x of their own.
    QStringList heading{x_label};
    std::map<double, std::vector<double>> lines;
    for (std::size_t s = 0; s < series.size(); ++s) {
        heading << series[s].name;
        for (std::size_t i = 0; i < series[s].x.size(); ++i) {
            auto& values = lines[series[s].x[i]];
            values.resize(series.size(), std::nan(""));
            values[s] = series[s].y[i];
        }
    }
    QStringList text{heading.join(QLatin1Char('\t'))};
    for (const auto& [x, values] : lines) {
        const auto word = static_cast<qsizetype>(x);
        QStringList fields{!x_words.isEmpty() && word < x_words.size() ? x_words[word] : numberText(x)};
        for (const double value : values) fields << numberText(value);
        text << fields.join(QLatin1Char('\t'));
    }
    return text.join(QLatin1Char('\n'));
}

}  // namespace eyrie::ui
