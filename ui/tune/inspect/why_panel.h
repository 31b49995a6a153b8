#pragma once

#include <QWidget>

#include "tune/inspect/why.h"

class QLabel;
class QStackedLayout;
class QTextBrowser;

namespace eyrie::ui {

class EmptyState;

/// The answer to "Why?": one sentence with the parameter that decided, and below it each comparison on the way, as the
/// chain made them. Parameters are links.
class WhyPanel : public QWidget {
    Q_OBJECT

 public:
    /// Both must outlive the panel.
    WhyPanel(ProjectSession& session, Why& why, QWidget* parent = nullptr);

    /// Whether the user sees the panel. A dock behind other tabs counts as visible for Qt.
    void setLookedAt(bool looked_at);
    /// What stands there, without marks.
    QString text() const;
    /// What stands there while there is nothing to see; empty while there is.
    QString explanation() const;

 signals:
    void parameterChosen(const QString& name);

 protected:
    void changeEvent(QEvent* event) override;

 private:
    void refresh();
    QString htmlOf(const ExplanationView& view) const;

    ProjectSession& session_;
    Why& why_;
    QLabel* title_;
    QStackedLayout* pages_;
    EmptyState* empty_;
    QTextBrowser* steps_;
    std::shared_ptr<const ExplanationView> shown_;
};

}  // namespace eyrie::ui
