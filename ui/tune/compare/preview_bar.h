#pragma once

#include <QFrame>
#include <functional>

#include "tune/compare/live_preview.h"

class QPushButton;
class QSpinBox;

namespace eyrie::ui {

class ElidedLabel;

/// What can be done with a preview.
struct PreviewCommands {
    std::function<void()> run;
    std::function<void()> discard;
};

/// Says that the picture is a preview, of what, and what can be done with it. Hidden while it is none.
class PreviewBar : public QFrame {
    Q_OBJECT

 public:
    /// `preview` must outlive the bar.
    PreviewBar(LivePreview& preview, PreviewCommands commands, QWidget* parent = nullptr);
    const PreviewCommands& commands() const { return commands_; }

    QString text() const;

 private:
    void refresh();

    LivePreview& preview_;
    PreviewCommands commands_;
    ElidedLabel* text_;
    QSpinBox* range_;
    QPushButton* run_;
    QPushButton* discard_;
};

}  // namespace eyrie::ui
