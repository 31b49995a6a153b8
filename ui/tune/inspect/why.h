#pragma once

#include <QObject>
#include <QPointF>
#include <memory>
#include <optional>

#include "session/project_session.h"
#include "tune/inspect/explanation_loader.h"

namespace eyrie::ui {

/// "Why?" asked about a place of the frame shown. The place stays asked about when the frame changes, and follows its
/// track; answers come from a background thread. Costs nothing while nobody wants to see them.
class Why : public QObject {
    Q_OBJECT

 public:
    /// The session must outlive it.
    explicit Why(ProjectSession& session, QObject* parent = nullptr);

    /// Whether somebody looks at the answers.
    void want(bool wanted);
    /// Asks about what lies under a point of the frame shown: a track, detection or cluster, else the place itself.
    /// `margin`: px of the image within which something is meant.
    void ask(QPointF image_point, double margin = 0);
    /// Asks about a box, such as one of the ground truth. `about`: what is known of it already, for people.
    void askAbout(const OrientedBox& box, const QString& about = {});
    void clear();

    bool asked() const { return area_.has_value(); }
    const std::optional<OrientedBox>& area() const { return area_; }
    /// The newest answer; null when none was asked for or the run changed. Of another frame while it is on its way.
    const std::shared_ptr<const ExplanationView>& view() const { return view_; }
    bool waiting() const { return waiting_; }
    const QString& problem() const { return problem_; }
    const QString& about() const { return about_; }

 signals:
    /// Another place, another frame, or another answer.
    void changed();

 private:
    void runChanged();
    void frameShown();
    void adopt(const std::shared_ptr<const ExplanationView>& view, const QString& problem);
    void request();

    ProjectSession& session_;
    ExplanationLoader loader_;
    bool wanted_ = false;
    bool waiting_ = false;
    std::optional<OrientedBox> area_;
    std::optional<TrackId> track_;  ///< the area is its box
    std::shared_ptr<const ExplanationView> view_;
    QString problem_;
    QString about_;
};

}  // namespace eyrie::ui
