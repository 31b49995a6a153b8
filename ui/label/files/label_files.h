#pragma once

#include <QDialog>
#include <filesystem>
#include <optional>
#include <stop_token>

#include "formats/label_formats.h"
#include "label/label_session.h"
#include "session/background/background_query.h"

class QCheckBox;
class QComboBox;
class QDialogButtonBox;
class QDoubleSpinBox;
class QLineEdit;
class QPlainTextEdit;
class QSpinBox;
class QTableWidget;

namespace eyrie::ui {

/// Labels from a file: shows what was found before anything is touched, lets classes be mapped, frames be shifted and
/// lengths be scaled. What is imported is one step to undo.
class LabelImportDialog : public QDialog {
    Q_OBJECT

 public:
    /// `labels` must be open and outlive the dialog. When they are closed, so is the dialog, and nothing is imported.
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
    void chooseFolder();
    void giveUp();
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
    std::stop_source importing_;
    BackgroundQuery query_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
