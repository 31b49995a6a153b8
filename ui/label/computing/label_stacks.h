#pragma once

#include <QObject>
#include <memory>

#include "annotation/pictures/object_stack.h"
#include "label/label_session.h"
#include "widgets/delayed_call.h"

namespace eyrie::ui {

/// Makes the image stack of the selected object for the frame shown, in the background, a moment after they were asked
/// for. Of several wishes the newest wins; pictures read are kept for the next ones.
class LabelStacks : public QObject {
    Q_OBJECT

 public:
    /// Both must outlive it.
    LabelStacks(ProjectSession& session, LabelSession& labels, QObject* parent = nullptr);
    ~LabelStacks() override;

    /// Answers with ready(), unless the object is not to be seen in the frame or lives too shortly.
    void request(ObjectId object, FrameIndex frame);
    void cancel();

 signals:
    void ready(ObjectId object, const ObjectStack& stack);

 private:
    class Pictures;
    void begin();

    ProjectSession& session_;
    LabelSession& labels_;
    ObjectId object_ = 0;
    FrameIndex frame_ = 0;
    DelayedCall due_;
    std::shared_ptr<Pictures> pictures_;  ///< in the background only
    BackgroundQuery query_;               ///< last: stops before the rest goes
};

}  // namespace eyrie::ui
