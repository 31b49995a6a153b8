#pragma once

#include <QString>
#include <array>
#include <optional>

namespace eyrie::ui {

/// What the window is arranged for: looking through what was found, drawing ground truth, tuning the chain.
enum class WorkspaceKind { review, label, tune };
inline constexpr int kWorkspaceCount = 3;

constexpr std::array<WorkspaceKind, kWorkspaceCount> allWorkspaces() {
    return {WorkspaceKind::review, WorkspaceKind::label, WorkspaceKind::tune};
}

/// A word for settings and the command line: "review", "label", "tune".
inline QString wordOf(WorkspaceKind kind) {
    switch (kind) {
        case WorkspaceKind::review:
            break;
        case WorkspaceKind::label:
            return QStringLiteral("label");
        case WorkspaceKind::tune:
            return QStringLiteral("tune");
    }
    return QStringLiteral("review");
}

/// The workspace of a word; none for another word.
inline std::optional<WorkspaceKind> workspaceOf(const QString& word) {
    for (const WorkspaceKind kind : allWorkspaces())
        if (word == wordOf(kind)) return kind;
    return std::nullopt;
}

}  // namespace eyrie::ui
