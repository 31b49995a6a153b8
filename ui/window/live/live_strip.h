#pragma once

#include <QFrame>

#include "session/project_session.h"
#include "widgets/repeated_call.h"

class QLabel;
class QToolButton;

namespace eyrie::ui {

/// Above the picture while a live source is watched: whether it comes, what was given up to keep pace, what is
/// recorded, its address; and Stop.
class LiveStrip : public QFrame {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit LiveStrip(ProjectSession& session, QWidget* parent = nullptr);

    /// All that it says, in its order.
    QString text() const;

 protected:
    void changeEvent(QEvent* event) override;

 private:
    void follow();
    void refresh();

    ProjectSession& session_;
    QLabel* dot_;
    QLabel* state_;
    QLabel* load_;
    QLabel* recording_;
    QLabel* address_;
    QToolButton* stop_;
    RepeatedCall again_;
};

}  // namespace eyrie::ui
