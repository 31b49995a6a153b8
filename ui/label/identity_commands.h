#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <set>

#include "label/editor/label_editor.h"
#include "label/label_parts.h"

class QAction;

namespace eyrie::ui {

/// The commands that say which object is which: join, fuse, split, swap, renumber, and what is cut off. What one would
/// do is shown first; the same key once more does it.
class IdentityCommands : public QObject {
    Q_OBJECT

 public:
    IdentityCommands(const LabelParts& parts, QObject* parent);

    /// The edit that is shown and waits for its key; null when there is none, or when it no longer fits the labels.
    const AnnotationEdit* shownEdit() const;
    /// Gives up what is shown; answers whether there was anything.
    bool takeBack();

 signals:
    /// Another edit is shown, or none.
    void shownEditChanged();

 private:
    /// What was shown and waits for its key.
    struct Planned {
        const QAction* action = nullptr;
        std::set<ObjectId> selection;
        std::optional<LabelEditor::Plan> plan;
    };
    void offer(QAction* action, const std::function<std::optional<LabelEditor::Plan>()>& make);
    void join();
    void fuse();
    void swap();
    /// Lets the user choose among candidates, the nearest first; pointing at one shows it.
    std::optional<ObjectId> chosenOf(const std::vector<std::pair<ObjectId, QString>>& candidates);
    std::optional<ObjectId> otherSelected() const;

    LabelParts parts_;
    Planned planned_;
};

}  // namespace eyrie::ui
