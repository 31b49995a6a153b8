#include "review/pictures/picture_column.h"

#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QTableView>
#include <utility>
#include <vector>

#include "session/project_session.h"
#include "widgets/tables/table_panel.h"
#include "widgets/tables/table_roles.h"
#include "widgets/theme_colours.h"
#include "widgets/wiring.h"

namespace eyrie::ui {

namespace {

constexpr int kAskAfter_ms = 60;  ///< while a list is scrolled
constexpr int kMargin_px = 2;

/// Paints the cells of a column of pictures.
class PictureDelegate : public QStyledItemDelegate {
 public:
    explicit PictureDelegate(PictureColumn& column) : QStyledItemDelegate(&column), column_(column) {}

    void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
        QStyledItemDelegate::paint(painter, option, index);  // selection and ground
        column_.paintCell(*painter, option.rect, index.data(id_role).toInt());
    }
    QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override {
        return {PictureColumn::kShownWidth + 2 * kMargin_px, PictureColumn::kShownHeight + 2 * kMargin_px};
    }

 private:
    PictureColumn& column_;
};

}  // namespace

PictureColumn::PictureColumn(TablePanel& panel, int column, ProjectSession& session, PlaceOf place_of)
    : QObject(&panel),
      panel_(panel),
      table_(panel.table()),
      column_(column),
      session_(session),
      place_of_(std::move(place_of)),
      plain_height_(table_->verticalHeader()->defaultSectionSize()),
      column_due_(0, [this] { followColumn(); }),
      ask_due_(kAskAfter_ms, [this] { ask(); }),
      pictures_([this] { refresh(); }) {
    table_->setItemDelegateForColumn(column_, new PictureDelegate(*this));
    // A column that comes or goes changes the width of another, whether it tells of its own or not.
    whenAny(
        table_->horizontalHeader(), this, [this] { column_due_.start(); }, &QHeaderView::sectionResized);
    whenChanged(session_, this, {{SessionChange::video, [this] {
                                      pictures_.forget();
                                      refresh();
                                  }}});
    followColumn();
}

PictureColumn::~PictureColumn() = default;

bool PictureColumn::readable() const {
    return session_.media() && !session_.videoMissing() && session_.liveSource() == nullptr;
}

bool PictureColumn::shown() const {
    return !table_->isColumnHidden(column_);
}

void PictureColumn::followColumn() {
    if (shown() == was_shown_) return;
    was_shown_ = shown();
    table_->verticalHeader()->setDefaultSectionSize(was_shown_ ? kShownHeight + 2 * kMargin_px : plain_height_);
    if (table_->currentIndex().isValid()) table_->scrollTo(table_->currentIndex());
    if (!was_shown_) pictures_.letGo();
    refresh();
}

void PictureColumn::refresh() {
    if (shown()) table_->viewport()->update();
}

const QImage* PictureColumn::pictureOf(int id) {
    const auto place = readable() ? place_of_(id) : std::nullopt;
    return place ? pictures_.find(*place) : nullptr;
}

void PictureColumn::paintCell(QPainter& painter, const QRect& cell, int id) {
    const auto place = readable() ? place_of_(id) : std::nullopt;
    if (!place) return;
    const QRect room = cell.adjusted(kMargin_px, kMargin_px, -kMargin_px, -kMargin_px);
    QRect frame(QPoint(), QSize(kShownWidth, kShownHeight).scaled(room.size(), Qt::KeepAspectRatio));
    frame.moveCenter(room.center());
    const QImage* picture = pictures_.find(*place);
    if (picture == nullptr) {
        QColor waiting = quietText(panel_.palette());
        waiting.setAlpha(40);
        painter.fillRect(frame, waiting);
        // Asked for by who is painted: so nothing is read that nobody looks at.
        if (!ask_due_.pending()) ask_due_.start();
    } else if (!picture->isNull()) {
        painter.save();
        painter.setRenderHint(QPainter::SmoothPixmapTransform);
        painter.drawImage(frame, *picture);
        painter.restore();
    }
}

void PictureColumn::ask() {
    if (!readable() || !shown() || !table_->isVisible()) return;
    const QAbstractItemModel* rows = table_->model();
    const int first = table_->rowAt(0);
    if (first < 0) return;
    const int below = table_->rowAt(table_->viewport()->height() - 1);
    const int last = below < 0 ? rows->rowCount() - 1 : below;
    std::vector<VehiclePlace> places;
    for (int row = first; row <= last; ++row)
        if (const auto place = place_of_(rows->index(row, column_).data(id_role).toInt())) places.push_back(*place);
    pictures_.want(*session_.media(), places);
}

}  // namespace eyrie::ui

#include "moc_picture_column.cpp"
