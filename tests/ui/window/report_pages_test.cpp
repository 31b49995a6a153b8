#include "window/docks/report_pages.h"

#include <QAbstractTextDocumentLayout>
#include <QImage>
#include <QTest>
#include <QTextBlock>
#include <QTextDocument>
#include <QUrl>
#include <algorithm>
#include <cmath>

#include "ui/support/ui_test.h"

namespace eyrie::ui::report_pages_test {

namespace {

constexpr double kWidth = 700;

/// Events as reports tell them: a heading, a still beside facts, and a row of sketches; on one endless page.
void tellEvents(QTextDocument& document, int count, int still_height) {
    QImage picture(4, 4, QImage::Format_RGB32);
    picture.fill(Qt::gray);
    document.addResource(QTextDocument::ImageResource, QUrl(QStringLiteral("p")), picture);
    QString html = QStringLiteral("<h2>Events</h2><p>Boxes are those of the machine.</p>");
    for (int i = 0; i < count; ++i)
        html += QStringLiteral(
                    "<h3>%1. stops</h3><table><tr><td><img src=\"p\" width=\"300\" height=\"%2\"></td>"
                    "<td><table><tr><td>From</td><td>0:12</td></tr></table></td></tr></table>"
                    "<table><tr><td><img src=\"p\" width=\"90\" height=\"120\"></td>"
                    "<td><img src=\"p\" width=\"90\" height=\"100\"></td></tr></table>")
                    .arg(i)
                    .arg(still_height);
    document.setHtml(html + QStringLiteral("<h2>The ground</h2><p>From above.</p>"));
    document.setDocumentMargin(0);
    document.setTextWidth(kWidth);
}

/// Highest and lowest edge of each event.
using Edges = std::vector<std::pair<double, double>>;

Edges edgesOf(const QTextDocument& document) {
    Edges edges;
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        const QRectF place = document.documentLayout()->blockBoundingRect(block);
        const int heading = block.blockFormat().headingLevel();
        if (heading == 2 && !edges.empty()) break;
        if (heading == 3) edges.emplace_back(place.top(), place.bottom());
        if (!edges.empty() && block.length() > 1) edges.back().second = std::max(edges.back().second, place.bottom());
    }
    return edges;
}

int pageOf(double y, double page) {
    return static_cast<int>(std::floor(y / page));
}

/// How many events lie on more than one page.
std::ptrdiff_t tornIn(const QTextDocument& document, double page) {
    const Edges edges = edgesOf(document);
    return std::count_if(edges.begin(), edges.end(), [page](const auto& edge) {
        return pageOf(edge.first, page) != pageOf(edge.second - 1, page);
    });
}

}  // namespace

/// Pages of a report.
class ReportPagesTest : public QObject {
    Q_OBJECT

 private slots:
    // Fonts differ, and the heights of texts with them: pages are as high as these events want them.
    void anEventIsOnOnePage() {
        QTextDocument document;
        tellEvents(document, 7, 250);
        const Edges endless = edgesOf(document);
        QCOMPARE(endless.size(), std::size_t(7));
        const double page = (endless[2].first + endless[2].second) / 2;  // ends amid the third event
        const double gap = endless[2].first - endless[1].second;
        document.setPageSize(QSizeF(kWidth, page));
        QVERIFY2(tornIn(document, page) > 0, "otherwise this shows nothing");
        keepTogether(document, page);
        QCOMPARE(tornIn(document, page), std::ptrdiff_t(0));
        // As many as fit share a page: whichever begins the next one had no room.
        const Edges edges = edgesOf(document);
        QCOMPARE(edges.size(), std::size_t(7));
        QCOMPARE(pageOf(edges[1].first, page), 0);
        QCOMPARE(pageOf(edges[2].first, page), 1);
        for (std::size_t i = 1; i < edges.size(); ++i) {
            const int before = pageOf(edges[i - 1].second - 1, page);
            if (pageOf(edges[i].first, page) == before) continue;
            const double room = (before + 1) * page - edges[i - 1].second;
            const double wanted = gap + endless[i].second - endless[i].first;
            QVERIFY2(room < wanted + 1, qPrintable(QStringLiteral("event %1 had room").arg(i)));
        }
    }

    void whatIsHigherThanAPageStaysWhereItIs() {
        QTextDocument document;
        tellEvents(document, 3, 950);
        const Edges endless = edgesOf(document);
        const double page = 0.95 * (endless[1].second - endless[1].first);
        document.setPageSize(QSizeF(kWidth, page));
        const Edges before = edgesOf(document);
        QVERIFY2(tornIn(document, page) > 0, "otherwise this shows nothing");
        keepTogether(document, page);
        QVERIFY(edgesOf(document) == before);
    }
};

}  // namespace eyrie::ui::report_pages_test

EYRIE_UI_TEST(QApplication, report_pages_test, ReportPagesTest)
#include "report_pages_test.moc"
