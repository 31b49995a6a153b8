#include "review/earth/start_time_dialog.h"

#include <QDateTimeEdit>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <utility>

#include "widgets/display_text.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

QString knownText(const KnownStart& known) {
    if (known.origin.isEmpty())
        return StartTimeDialog::tr("It is not known when the video was taken; times count from its beginning.");
    if (!known.utc_us) return StartTimeDialog::tr("Clock times come from %1.").arg(known.origin);
    return StartTimeDialog::tr("Now: %1, by %2.").arg(utcMomentText(*known.utc_us), known.origin);
}

}  // namespace

StartTimeDialog::StartTimeDialog(const KnownStart& known,
                                 std::function<void(std::optional<std::int64_t> utc_us)> answer, QWidget* parent)
    : QDialog(parent), answer_(std::move(answer)) {
    setObjectName(QStringLiteral("start_time"));
    setWindowTitle(tr("Start time of the video"));
    auto* told = new QLabel(knownText(known), this);
    told->setWordWrap(true);
    told->setTextFormat(Qt::PlainText);
    field_ = new QDateTimeEdit(this);
    field_->setTimeSpec(Qt::UTC);
    field_->setDisplayFormat(QStringLiteral("yyyy-MM-dd HH:mm:ss.zzz"));
    field_->setCalendarPopup(true);
    field_->setAccessibleName(tr("When the first frame was taken, UTC"));
    field_->setDateTime(known.utc_us ? QDateTime::fromMSecsSinceEpoch(*known.utc_us / 1000, Qt::UTC)
                                     : QDateTime(QDateTime::currentDateTimeUtc().date(), QTime(0, 0), Qt::UTC));
    auto* form = new QFormLayout;
    form->addRow(tr("First frame, UTC:"), field_);
    auto* note =
        new QLabel(tr("It is kept in the project and takes precedence over what the video itself says."), this);
    note->setWordWrap(true);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    not_known_ = buttons->addButton(tr("Not known"), QDialogButtonBox::ResetRole);
    not_known_->setToolTip(tr("Forget the time entered here and use what the video says"));
    not_known_->setEnabled(known.given);
    auto* rows = new QVBoxLayout(this);
    rows->addWidget(told);
    rows->addLayout(form);
    rows->addWidget(note);
    rows->addWidget(buttons);
    bindCommands(this, {{buttons->button(QDialogButtonBox::Ok),
                         [this] { this->answer(field_->dateTime().toMSecsSinceEpoch() * 1000); }},
                        {not_known_, [this] { this->answer(std::nullopt); }},
                        {buttons->button(QDialogButtonBox::Cancel), [this] { reject(); }}});
    field_->setFocus();
}

void StartTimeDialog::answer(std::optional<std::int64_t> utc_us) {
    accept();
    answer_(utc_us);
}

}  // namespace eyrie::ui

#include "moc_start_time_dialog.cpp"
