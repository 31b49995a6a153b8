#include "widgets/parameters/parameter_row.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QLabel>
#include <QTimer>
#include <QToolButton>
#include <algorithm>

#include "widgets/parameters/parameter_editor.h"
#include "widgets/wiring.h"

namespace eyrie::ui {
namespace {

// One width for all kinds of fields, so that they stand in a column.
constexpr int kFieldCharacters = 23;
constexpr int kFlash_ms = 900;

/// "min speed" for "motion.min_speed".
QString shownName(const QString& name) {
    return name.mid(name.indexOf(QLatin1Char('.')) + 1).replace(QLatin1Char('_'), QLatin1Char(' '));
}

bool sameValue(ParameterKind kind, const QString& a, const QString& b) {
    if (kind != ParameterKind::real) return a == b;
    bool a_is_number = false;
    bool b_is_number = false;
    const double number_a = a.toDouble(&a_is_number);
    const double number_b = b.toDouble(&b_is_number);
    return a_is_number && b_is_number ? number_a == number_b : a == b;
}

}  // namespace

ParameterRow::ParameterRow(const Parameter& parameter, QWidget* parent)
    : QWidget(parent),
      parameter_(parameter),
      name_(QString::fromStdString(parameter.name)),
      default_(QString::fromStdString(parameter.value)),
      label_(new QLabel(shownName(name_), this)),
      editor_(makeParameterEditor(parameter, this)),
      reset_(new QToolButton(this)) {
    label_->setBuddy(editor_);
    setFocusProxy(editor_);
    label_->setWordWrap(true);
    editor_->setAccessibleName(name_);
    editor_->focusProxy()->setAccessibleName(name_);
    editor_->focusProxy()->installEventFilter(this);
    reset_->setText(QStringLiteral("↺"));
    reset_->setAutoRaise(true);
    QSizePolicy keeps_its_place = reset_->sizePolicy();
    keeps_its_place.setRetainSizeWhenHidden(true);
    reset_->setSizePolicy(keeps_its_place);
    auto* unit = new QLabel(QString::fromStdString(parameter.text.unit), this);
    unit->setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("px/frame ")));

    editor_->setFixedWidth(fontMetrics().horizontalAdvance(QLatin1Char('0')) * kFieldCharacters);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 1, 0, 1);
    layout->addWidget(label_, 1);
    layout->addWidget(editor_);
    layout->addWidget(unit);
    layout->addWidget(reset_);

    connect(editor_, &ParameterEditor::edited, this, [this](const QString& value) {
        compare();
        emit valueChanged(name_, value);
    });
    bindCommands(this, {{reset_, [this] { resetToDefault(); }}});
    setValues(default_, default_);
}

QString ParameterRow::value() const {
    return editor_->value();
}

void ParameterRow::setValues(const QString& value, const QString& default_value) {
    default_ = default_value;
    editor_->setValue(value);
    setToolTip(helpText());
    reset_->setToolTip(tr("Back to %1").arg(default_));
    reset_->setAccessibleName(tr("Set %1 back to %2").arg(name_, default_));
    compare();
}

void ParameterRow::compare() {
    modified_ = !sameValue(parameter_.kind, editor_->value(), default_);
    QFont font = this->font();
    font.setBold(modified_);
    label_->setFont(font);
    reset_->setVisible(modified_ && !read_only_);
}

void ParameterRow::resetToDefault() {
    if (!modified_ || read_only_) return;
    editor_->setValue(default_);
    compare();
    emit valueChanged(name_, default_);
}

void ParameterRow::setReadOnly(bool read_only) {
    read_only_ = read_only;
    editor_->setReadOnly(read_only);
    compare();
}

bool ParameterRow::matches(const QStringList& words) const {
    const QString text = name_ + QLatin1Char(' ') + shownName(name_) + QLatin1Char(' ') +
                         QString::fromStdString(parameter_.text.help) + QLatin1Char(' ') +
                         QString::fromStdString(parameter_.text.source) + QLatin1Char(' ') +
                         QString::fromStdString(parameter_.text.unit);
    return std::all_of(words.begin(), words.end(),
                       [&](const QString& word) { return text.contains(word, Qt::CaseInsensitive); });
}

QString ParameterRow::helpText() const {
    QString text = QStringLiteral("<b>%1</b><br>%2")
                       .arg(name_.toHtmlEscaped(), QString::fromStdString(parameter_.text.help).toHtmlEscaped());
    text += QStringLiteral("<br>") +
            tr("Default %1; allowed: %2")
                .arg(default_.toHtmlEscaped(), QString::fromStdString(parameter_.expected()).toHtmlEscaped());
    if (!parameter_.text.source.empty()) {
        text += QStringLiteral("<br><i>%1</i>").arg(QString::fromStdString(parameter_.text.source).toHtmlEscaped());
    }
    return text;
}

void ParameterRow::flash() {
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::Highlight);
    label_->setForegroundRole(QPalette::HighlightedText);
    QTimer::singleShot(kFlash_ms, this, [this] {
        setBackgroundRole(QPalette::NoRole);
        setAutoFillBackground(false);
        label_->setForegroundRole(QPalette::NoRole);
    });
}

void ParameterRow::enterEvent(QEnterEvent* event) {
    emit pointedAt();
    QWidget::enterEvent(event);
}

bool ParameterRow::eventFilter(QObject* watched, QEvent* event) {
    if (event->type() == QEvent::FocusIn) emit pointedAt();
    return QWidget::eventFilter(watched, event);
}

}  // namespace eyrie::ui

#include "moc_parameter_row.cpp"
