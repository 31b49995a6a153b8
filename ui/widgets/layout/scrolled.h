#pragma once

#include <QFrame>
#include <QScrollArea>

namespace eyrie::ui {

/// The content of a dock that is large: where there is less room than it needs, it is scrolled, so that it does not
/// push the window over the edges of a small screen. Takes the content over.
inline QScrollArea* scrolled(QWidget* content) {
    class Area : public QScrollArea {
     public:
        QSize minimumSizeHint() const override { return {200, 160}; }
    };
    auto* area = new Area;
    area->setFrameShape(QFrame::NoFrame);
    area->setWidgetResizable(true);
    area->setWidget(content);
    return area;
}

}  // namespace eyrie::ui
