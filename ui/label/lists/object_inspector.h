#pragma once

#include <QColor>
#include <QWidget>
#include <functional>
#include <optional>
#include <utility>
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
class LabelActions;

/// Another object that may be the same vehicle, as it is listed.
struct JoinOffer {
    int object = 0;
    QString text;  ///< "car 7, 12 frames later, 3.1 px away"
};

/// What is known of the selected object in the frame shown.
struct ObjectDetails {
    int id = 0;
    QString title;   ///< "car 12"
    QString life;    ///< "frames 0 to 120, 3 keyframes; origin: by hand"
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

/// What the inspector does to the object it shows.
struct ObjectEdits {
    std::function<void(const QString& name)> set_class;
    /// An invalid colour: that of its class.
    std::function<void(const QColor& colour)> set_colour;
    std::function<void()> toggle_occluded;
    std::function<void()> toggle_outside;
    std::function<void()> toggle_ignore;
    /// Of the object that was shown while they were written, which may be another one by now.
    std::function<void(int object, const QString& notes)> set_notes;
    std::function<void()> check;
    std::function<void()> question;
    std::function<void(int other)> join;
    /// The user looks at another one that may be the same vehicle.
    std::function<void(int other)> show_candidate;
};

/// The selected object: class, flags, notes, review, and which others may be the same vehicle.
class ObjectInspector : public QWidget {
    Q_OBJECT
 public:
    explicit ObjectInspector(QWidget* parent = nullptr);

    /// Says in its hints by which keys the same is done.
    void nameKeys(const LabelActions& actions);
    /// To be called before anything is shown.
    void setEdits(ObjectEdits edits) { edits_ = std::move(edits); }
    const ObjectEdits& edits() const { return edits_; }
    void setClasses(const QStringList& classes);
    /// Nothing: says how to select one.
    void showObject(const std::optional<ObjectDetails>& details);
    /// Keeps notes that are being written.
    void keepWritten() { keepNotes(shown_); }
    QString title() const;
    QString boxText() const;
    QLineEdit& notes() const { return *notes_; }

 private:
    void chooseColour();
    void keepNotes(int object);
    void showColour(const ObjectDetails& details);

    ObjectEdits edits_;
    int shown_ = 0;  ///< the object whose notes stand there; 0: none
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
