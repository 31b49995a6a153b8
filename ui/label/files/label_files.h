#pragma once

#include <QDialog>
#include <filesystem>
#include <optional>

#include "formats/label_formats.h"
#include "label/label_session.h"
#include "session/background/background_query.h"

class QCheckBox;
class QComboBox;
class QDialogButtonBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPlainTextEdit;
class QPushButton;
class QSpinBox;
class QTableWidget;

namespace eyrie::ui {

/// Labels from a file: shows what was found before anything is touched, lets classes be mapped, frames be shifted and
/// lengths be scaled. What is imported is one step to undo.
class LabelImportDialog : public QDialog {
    Q_OBJECT

 public:
    /// `labels` must be open and outlive the dialog.
    explicit LabelImportDialog(LabelSession& labels, QWidget* parent = nullptr);
    ~LabelImportDialog() override;

    /// Asks for a file; false when the user gave up.
    bool choose();
    void setFile(const std::filesystem::path& path);
    /// What was found, for people.
    QString report() const;
    bool readyToImport() const { return report_.has_value(); }
    /// Objects that are labelled already are taken all the same.
    void setAddDoubles(bool add);
    /// Boxes without id that overlap from frame to frame become one object, otherwise each an object of one frame.
    void setLink(bool link);
    /// What came of it, once it was accepted.
    const QString& summary() const { return summary_; }
    void accept() override;

 signals:
    void fileRead();

 private:
    void read();
    void showReport(const LabelReport& report, int doubles);
    ImportOptions options() const;
    void setBusy(bool busy);

    LabelSession& labels_;
    std::filesystem::path path_;
    std::optional<LabelReport> report_;
    QString summary_;
    QComboBox* format_;
    QLineEdit* columns_;
    QSpinBox* shift_;
    QDoubleSpinBox* scale_;
    QDoubleSpinBox* tolerance_;
    QTableWidget* classes_;
    QCheckBox* add_doubles_;
    QCheckBox* link_;
    QPlainTextEdit* text_;
    QDialogButtonBox* buttons_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

/// Labels to a file in any format; afterwards says what the format could not carry.
class LabelExportDialog : public QDialog {
    Q_OBJECT

 public:
    /// `labels` must be open and outlive the dialog.
    explicit LabelExportDialog(LabelSession& labels, QWidget* parent = nullptr);
    ~LabelExportDialog() override;

    void setFormat(const QString& name);
    void setTarget(const std::filesystem::path& path);
    void startExport();
    QString report() const;

 signals:
    void finishedExport(bool fine);

 private:
    void browse();
    void showFormat();
    void showEnd(const QString& text, bool fine);

    LabelSession& labels_;
    QComboBox* format_;
    QLabel* carries_;
    QLineEdit* target_;
    QLineEdit* columns_;
    QCheckBox* clip_;
    QPlainTextEdit* text_;
    QPushButton* export_;
    QString agreed_;         ///< the target that somebody agreed to replace
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
