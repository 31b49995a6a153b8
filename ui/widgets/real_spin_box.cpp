#include "widgets/real_spin_box.h"

#include <QKeyEvent>
#include <QLineEdit>
#include <QLocale>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace eyrie::ui {
namespace {

/// The number a text stands for, written with a point or a comma.
std::optional<double> numberOf(QString text) {
    bool is_number = false;
    const double value = text.trimmed().replace(QLatin1Char(','), QLatin1Char('.')).toDouble(&is_number);
    if (!is_number || !std::isfinite(value)) return std::nullopt;
    return value;
}

/// One in the second significant digit.
double stepAt(double value, double min, double max) {
    double size = std::abs(value);
    if (size == 0) size = std::min(max - min, 10.0) / 10;
    return size > 0 && std::isfinite(size) ? std::pow(10.0, std::floor(std::log10(size)) - 1) : 0.1;
}

}  // namespace

QString exactText(double value) {
    char buffer[64];
    const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
    return error == std::errc() ? QString::fromLatin1(buffer, end - buffer) : QString::number(value);
}

RealSpinBox::RealSpinBox(double min, double max, QWidget* parent) : QAbstractSpinBox(parent), min_(min), max_(max) {
    setFocusPolicy(Qt::StrongFocus);
}

void RealSpinBox::setValueText(const QString& text) {
    value_text_ = text;
    lineEdit()->setText(text);
    lineEdit()->setCursorPosition(0);
}

void RealSpinBox::take(double value) {
    const QString text = exactText(std::clamp(value, min_, max_));
    if (text == value_text_) return;
    setValueText(text);
    emit edited(text);
}

void RealSpinBox::commit() {
    const QString typed = lineEdit()->text();
    if (typed == value_text_) return;
    const auto number = numberOf(typed);
    const auto before = numberOf(value_text_);
    // What is no number, or the same number in other words, changes nothing.
    if (number && number != before) take(*number);
    if (lineEdit()->text() != value_text_) setValueText(value_text_);
}

void RealSpinBox::stepBy(int steps) {
    if (isReadOnly() || steps == 0) return;
    commit();
    const double value = numberOf(value_text_).value_or(min_);
    const double step = stepAt(value, min_, max_);
    // Through text, so that 0.1 + 0.2 becomes 0.3.
    const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
    const QString text = QString::number(value + steps * step, 'f', std::min(decimals, 15));
    take(text.toDouble());
    selectAll();
}

QAbstractSpinBox::StepEnabled RealSpinBox::stepEnabled() const {
    if (isReadOnly()) return StepNone;
    const double value = numberOf(value_text_).value_or(min_);
    StepEnabled enabled = StepNone;
    if (value < max_) enabled |= StepUpEnabled;
    if (value > min_) enabled |= StepDownEnabled;
    return enabled;
}

QValidator::State RealSpinBox::validate(QString& input, int&) const {
    const bool could_be = std::all_of(input.begin(), input.end(), [](QChar c) {
        return (c >= QLatin1Char('0') && c <= QLatin1Char('9')) || QStringLiteral("+-.,eE ").contains(c);
    });
    if (!could_be) return QValidator::Invalid;
    const auto number = numberOf(input);
    return number && *number >= min_ && *number <= max_ ? QValidator::Acceptable : QValidator::Intermediate;
}

QSize RealSpinBox::sizeHint() const {
    QSize hint = QAbstractSpinBox::sizeHint();
    hint.setWidth(fontMetrics().horizontalAdvance(QStringLiteral("0")) * 14);
    return hint;
}

void RealSpinBox::keyPressEvent(QKeyEvent* event) {
    if (event->key() == Qt::Key_Return || event->key() == Qt::Key_Enter) {
        commit();
        selectAll();
        return;
    }
    if (event->key() == Qt::Key_Escape && lineEdit()->text() != value_text_) {
        setValueText(value_text_);
        return;
    }
    QAbstractSpinBox::keyPressEvent(event);
}

void RealSpinBox::focusOutEvent(QFocusEvent* event) {
    commit();
    QAbstractSpinBox::focusOutEvent(event);
}

}  // namespace eyrie::ui

#include "moc_real_spin_box.cpp"
