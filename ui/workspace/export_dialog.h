#pragma once

#include <QDialog>
#include <QList>
#include <QString>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/output_files.h"
#include "session/background/background_query.h"

class QCheckBox;
class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;

namespace eyrie::ui {

/// A format in which something can be written.
struct ExportOffer {
    QString name;               ///< as the command line calls it
    QString title;              ///< for people
    QString ending;             ///< of files, "csv"; empty: a folder, or any
    QString holds;              ///< what it carries, and what it does not; may be empty
    bool asks_columns = false;  ///< a table whose columns a person names
    bool clips = false;         ///< boxes can be clipped to the image
};

/// What a person chose to have written.
struct ExportWish {
    std::string format;
    std::filesystem::path path;
    std::string columns;
    bool clip = false;
};

/// Tells how far the writing is, 0 … 1. May be called on any thread.
using ExportProgress = std::function<void(double)>;

/// Writes, and answers what to tell; nothing when it was stopped, which may also be thrown. Throws what has a message.
using ExportWork = std::function<std::optional<QString>(const ExportProgress&, const std::stop_token&)>;

/// Something that can be written to files.
struct ExportSource {
    QString title;                            ///< "Export labels"
    QString name;                             ///< suggested for the file, without its ending
    QList<ExportOffer> offers;                ///< at least one; of a single one nothing is asked
    std::vector<std::filesystem::path> read;  ///< what it is made from, and is not overwritten
    /// The files that will be written.
    std::function<std::vector<OutputFile>(const ExportWish&)> files;
    /// Called on the window's thread when somebody begins: what is to be done in the background.
    std::function<ExportWork(const ExportWish&)> begin;
};

/// Asks in which format and where to write something, writes it in the background, and tells what was written or lost.
/// Nothing is replaced without consent. Closing it stops the writing.
class ExportDialog : public QDialog {
    Q_OBJECT

 public:
    explicit ExportDialog(ExportSource source, QWidget* parent = nullptr);
    ~ExportDialog() override;

    /// Puts a row of choices of its own above the target.
    void addRow(const QString& label, QWidget* row);
    void setFormat(const QString& name);
    void setTarget(const std::filesystem::path& path);
    /// Also stops what is being written.
    void startExport();
    /// What was told last.
    QString report() const;

 signals:
    void finishedExport(bool fine);

 private:
    const ExportOffer& offer() const;
    void browse();
    void showFormat();
    void showWorking(bool working);
    void showEnd(const QString& text, bool fine);

    ExportSource source_;
    QFormLayout* form_;
    QComboBox* format_;
    QLabel* holds_;
    QLineEdit* target_;
    QLineEdit* columns_;
    QCheckBox* clip_;
    QPlainTextEdit* text_;
    QPushButton* export_;
    QString agreed_;  ///< the target that somebody agreed to replace
    std::optional<std::stop_source> writing_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
