#pragma once

#include <QImage>
#include <QWidget>

#include "session/project_session.h"

class QFormLayout;
class QLabel;

namespace eyrie::ui {

class TrackInspector;

/// A cut-out of the video around a box, turned so that its heading points up.
class ChipView : public QWidget {
    Q_OBJECT

 public:
    using QWidget::QWidget;
    /// Nothing to show: a null image.
    void show(const QImage& image, const OrientedBox& box);
    QSize sizeHint() const override { return {200, 150}; }
    QSize minimumSizeHint() const override { return {120, 110}; }

 protected:
    void paintEvent(QPaintEvent* event) override;

 private:
    QImage image_;
    OrientedBox box_;
};

/// The selected track: its picture, its state now and its life. Without a selection: what was found in the frame shown.
class InspectorPanel : public QWidget {
    Q_OBJECT

 public:
    explicit InspectorPanel(ProjectSession& session, QWidget* parent = nullptr);
    TrackInspector& track() { return *track_; }

 private:
    void showFrame(const ViewFrame& frame);
    void showSelection();
    void showChip();
    void showFacts();
    void setRows(const QList<std::pair<QString, QString>>& rows);

    ProjectSession& session_;
    QWidget* facts_;
    QLabel* title_;
    QFormLayout* rows_;
    QList<QLabel*> names_;
    QList<QLabel*> values_;
    QWidget* track_page_;
    ChipView* chip_;
    TrackInspector* track_;
};

}  // namespace eyrie::ui
