#pragma once

#include <QDialog>
#include <cstdint>
#include <functional>
#include <optional>

class QDateTimeEdit;
class QPushButton;

namespace eyrie::ui {

/// What is known of when a video began; µs since 1970-01-01.
struct KnownStart {
    std::optional<std::int64_t> utc_us;  ///< by whatever tells it
    bool given = false;                  ///< a person said so
    QString origin;                      ///< what it rests on, for people; empty: nobody knows it
};

/// Asks when the first frame of the video was taken, and tells what is known of that.
class StartTimeDialog : public QDialog {
    Q_OBJECT

 public:
    /// `answer` hears once what the person says; nothing: she does not know, or not any more.
    StartTimeDialog(const KnownStart& known, std::function<void(std::optional<std::int64_t> utc_us)> answer,
                    QWidget* parent);

    QDateTimeEdit& field() { return *field_; }
    /// Takes back what a person said; there is nothing to take back where nobody did.
    QPushButton& notKnown() { return *not_known_; }

 private:
    void answer(std::optional<std::int64_t> utc_us);

    std::function<void(std::optional<std::int64_t>)> answer_;
    QDateTimeEdit* field_;
    QPushButton* not_known_;
};

}  // namespace eyrie::ui
