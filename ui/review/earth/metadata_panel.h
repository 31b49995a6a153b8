#pragma once

#include "review/earth/metadata_model.h"
#include "widgets/tables/table_panel.h"

class QComboBox;
class QLabel;

namespace eyrie {
class VideoMetadata;
}

namespace eyrie::ui {

class ProjectSession;
class VideoEarth;

/// What the metadata of the video say at the frame shown: a table of the tags, with how complete their stream is above.
/// Shows nothing anew while nobody looks.
class MetadataPanel : public TablePanel {
    Q_OBJECT

 public:
    /// Both must outlive the panel.
    MetadataPanel(ProjectSession& session, VideoEarth& earth, QWidget* parent = nullptr);

    void setLookedAt(bool looked_at);
    MetadataModel& model() { return *model_; }
    QComboBox& streams() { return *streams_; }
    /// What is said above the table.
    QString summary() const;

 protected:
    std::optional<int> mostCharacters(int column) const override;

 private:
    MetadataPanel(ProjectSession& session, VideoEarth& earth, MetadataModel* model, QWidget* parent);
    void showMetadata();
    void showStreams();
    void showSummary();
    void showFrame();
    void explainNothing();
    const VideoMetadata* shownStream() const;

    ProjectSession& session_;
    VideoEarth& earth_;
    MetadataModel* model_;
    QComboBox* streams_;
    QLabel* summary_;
    QLabel* ground_;
    bool looked_at_ = false;
    bool stale_ = true;
};

}  // namespace eyrie::ui
