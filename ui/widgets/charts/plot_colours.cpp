#include "widgets/charts/plot_colours.h"

#include <qcustomplot.h>

#include <QWidget>

#include "widgets/theme_colours.h"

namespace eyrie::ui {

void applyTheme(QCustomPlot& plot, const QWidget& widget, const std::vector<QCPAxis*>& further) {
    const QPalette palette = widget.palette();
    const QColor text = palette.color(QPalette::WindowText);
    const QColor quiet = quietText(palette);
    const QColor ground = palette.color(QPalette::Base);
    plot.setBackground(palette.color(QPalette::Window));
    plot.axisRect()->setBackground(ground);
    std::vector<QCPAxis*> axes{plot.xAxis, plot.yAxis};
    axes.insert(axes.end(), further.begin(), further.end());
    for (QCPAxis* axis : axes) {
        axis->setLabelColor(text);
        axis->setTickLabelColor(text);
        axis->setLabelFont(widget.font());
        axis->setTickLabelFont(widget.font());
        axis->setBasePen(QPen(quiet));
        axis->setTickPen(QPen(quiet));
        axis->setSubTickPen(QPen(quiet));
        axis->grid()->setPen(QPen(blend(ground, text, 0.15)));
        axis->grid()->setZeroLinePen(Qt::NoPen);
    }
    plot.legend->setFont(widget.font());
    plot.legend->setTextColor(text);
    plot.legend->setBorderPen(Qt::NoPen);
}

}  // namespace eyrie::ui
