#pragma once

#include <QComboBox>

namespace eyrie::ui {

class EvaluationSession;

/// What runs are compared with: the labels of the project or a file. There is one choice for all that measures, so
/// every such field shows and changes that of the evaluation.
class TruthChoice : public QComboBox {
    Q_OBJECT

 public:
    /// The evaluation must outlive the field.
    explicit TruthChoice(EvaluationSession& evaluation, QWidget* parent = nullptr);

    /// Takes this file as the ground truth.
    void useFile(const QString& path);

 protected:
    /// Scrolling over the field must not change what is measured.
    void wheelEvent(QWheelEvent* event) override;

 private:
    void showChosen();
    void choose(int entry);

    EvaluationSession& evaluation_;
};

}  // namespace eyrie::ui
