#pragma once

#include <QObject>
#include <cstdint>
#include <optional>

#include "session/background/background_query.h"

namespace eyrie::ui {

class MessageBar;
class ProjectSession;
class VideoEarth;
class WindowActions;

/// What it works on. All must outlive it.
struct StartTimeParts {
    ProjectSession& session;
    WindowActions& actions;
    MessageBar& messages;
    VideoEarth& earth;
};

/// The command that asks a person when the video began, and keeps it in the project.
class StartTime : public QObject {
    Q_OBJECT

 public:
    explicit StartTime(const StartTimeParts& parts, QObject* parent = nullptr);
    ~StartTime() override;

 private:
    void ask();
    void store(std::optional<std::int64_t> utc_us);
    void enableActions();

    StartTimeParts parts_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
