#include "review/earth/start_time_dialog.h"

#include <QDateTimeEdit>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <utility>

#include "core/utc_time.h"
#include "widgets/display_text.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

QString knownText(const KnownStart& known) {
    if (known.origin.isEmpty())
        return StartTimeDialog::tr("Nobody knows when the video was taken: times count from its beginning.");
    if (!known.utc_us) return StartTimeDialog::tr("Clock times are told by %1.").arg(known.origin);
    QString moment = QString::fromStdString(utcTextToMilliseconds(*known.utc_us)).remove(QLatin1Char('Z'));
    moment.replace(QLatin1Char('T'), QLatin1Char(' '));
    return StartTimeDialog::tr("Now: %1 UTC, by %2.").arg(moment, known.origin);
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
    auto* note = new QLabel(tr("It is kept in the project and counts before what the video tells itself."), this);
    note->setWordWrap(true);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel, this);
    not_known_ = buttons->addButton(tr("Not known"), QDialogButtonBox::ResetRole);
    not_known_->setToolTip(tr("Forget what was said here; what the video tells itself counts again"));
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
