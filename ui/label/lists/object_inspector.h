#pragma once

#include <QColor>
#include <QWidget>
#include <optional>
#include <vector>

#include "core/labels/annotation.h"

class QAction;
class QComboBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QStackedLayout;
class QToolButton;

namespace eyrie::ui {

class EmptyState;

/// Another object that may be the same vehicle, as it is listed.
struct JoinOffer {
    int object = 0;
    QString text;  ///< "car 7, 12 frames later, 3.1 px away"
};

/// What is known of the selected object in the frame shown.
struct ObjectDetails {
    int id = 0;
    QString title;   ///< "car 12"
    QString life;    ///< "frames 0 to 120, 3 keyframes, by hand"
    QString box;     ///< "keyframe · 512.0, 233.5 px · 17.9 × 7.1 px · 45°"
    QString review;  ///< "checked by kim, today 12:40"
    QString object_class;
    QColor colour;            ///< as it is shown
    bool own_colour = false;  ///< and not its class'
    Occlusion occlusion = Occlusion::none;
    bool outside = false;
    bool ignore = false;
    bool lives_here = false;
    bool editable = true;
    QString notes;
    std::vector<JoinOffer> joins;
};

/// The selected object: class, flags, notes, review, and which others may be the same vehicle.
class ObjectInspector : public QWidget {
    Q_OBJECT
 public:
    explicit ObjectInspector(QWidget* parent = nullptr);

    void setClasses(const QStringList& classes);
    /// Nothing: says how to select one.
    void showObject(const std::optional<ObjectDetails>& details);
    QString title() const;
    QString boxText() const;
    QToolButton* colourButton() const { return colour_; }

 signals:
    void classChosen(const QString& name);
    /// An invalid one: that of its class.
    void colourChosen(const QColor& colour);
    void occlusionToggled();
    void outsideToggled();
    void ignoreToggled();
    void notesEdited(const QString& notes);
    void checkedRequested();
    void questionableRequested();
    void joinRequested(int object);
    /// The user looks at a candidate.
    void candidateChosen(int object);

 private:
    void chooseColour();
    void showColour(const ObjectDetails& details);
    QStackedLayout* pages_;
    EmptyState* empty_;
    QLabel* title_;
    QLabel* life_;
    QLabel* box_;
    QLabel* review_;
    QComboBox* class_;
    QToolButton* colour_;
    QAction* class_colour_;
    QColor shown_colour_;
    QToolButton* occluded_;
    QToolButton* outside_;
    QToolButton* ignore_;
    QToolButton* checked_;
    QToolButton* questionable_;
    QLineEdit* notes_;
    QLabel* joins_heading_;
    QListWidget* joins_;
};

}  // namespace eyrie::ui
