#pragma once

#include <QString>
#include <functional>
#include <vector>

class QWidget;

namespace eyrie::ui {

/// One way to answer a question.
struct Answer {
    QString text;  ///< of the button: a verb
    std::function<void()> then;
};

/// Asks in a box over `window` and returns at once; the first answer is the default one, "Cancel" (or Escape) does
/// nothing. A second question while one is open is not asked: the open one comes to the front.
void ask(QWidget& window, const QString& question, const QString& details, const std::vector<Answer>& answers);

}  // namespace eyrie::ui
