#include "window/question.h"

#include <QMessageBox>
#include <QPushButton>

#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {
const QString kName = QStringLiteral("question");
}

void ask(QWidget& window, const QString& question, const QString& details, const std::vector<Answer>& answers) {
    if (auto* open = window.findChild<QMessageBox*>(kName)) {
        open->raise();
        open->activateWindow();
        return;
    }
    auto* box = new QMessageBox(QMessageBox::Question, QMessageBox::tr("Eyrie"), question, {}, &window);
    box->setObjectName(kName);
    box->setInformativeText(details);
    box->setAttribute(Qt::WA_DeleteOnClose);
    for (const Answer& answer : answers) {
        QPushButton* button = box->addButton(answer.text, QMessageBox::AcceptRole);
        if (&answer == &answers.front()) box->setDefaultButton(button);
        bindCommands(&window, {{button, [box, then = answer.then] {
                                    box->setObjectName(QString());  // it is answered: what follows may ask the next
                                    then();
                                }}});
    }
    box->addButton(QMessageBox::Cancel);
    QObject::connect(box, &QDialog::finished, box, [box] { box->setObjectName(QString()); });
    box->open();
}

}  // namespace eyrie::ui
