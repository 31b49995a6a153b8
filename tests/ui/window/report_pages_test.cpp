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

constexpr double kPage = 1000;

/// Events as reports tell them: a heading, a still beside facts, and a row of sketches.
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
    document.setPageSize(QSizeF(700, kPage));
}

/// Highest and lowest edge of each event.
std::vector<std::pair<double, double>> edgesOf(const QTextDocument& document) {
    std::vector<std::pair<double, double>> edges;
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        const QRectF place = document.documentLayout()->blockBoundingRect(block);
        const int heading = block.blockFormat().headingLevel();
        if (heading == 2 && !edges.empty()) break;
        if (heading == 3) edges.emplace_back(place.top(), place.bottom());
        if (!edges.empty() && block.length() > 1) edges.back().second = std::max(edges.back().second, place.bottom());
    }
    return edges;
}

int pageOf(double y) {
    return static_cast<int>(std::floor(y / kPage));
}

}  // namespace

/// Pages of a report.
class ReportPagesTest : public QObject {
    Q_OBJECT

 private slots:
    void anEventIsOnOnePage() {
        QTextDocument document;
        tellEvents(document, 7, 250);
        const auto torn = [&] {
            const auto edges = edgesOf(document);
            return std::count_if(edges.begin(), edges.end(),
                                 [](const auto& edge) { return pageOf(edge.first) != pageOf(edge.second - 1); });
        };
        QVERIFY2(torn() > 0, "otherwise this shows nothing");
        keepTogether(document, kPage);
        QCOMPARE(torn(), 0);
        // As many as fit share a page.
        const auto edges = edgesOf(document);
        QCOMPARE(edges.size(), std::size_t(7));
        QCOMPARE(pageOf(edges.back().first), 3);
    }

    void whatIsHigherThanAPageStaysWhereItIs() {
        QTextDocument document;
        tellEvents(document, 3, 950);
        const int pages = document.pageCount();
        keepTogether(document, kPage);
        QCOMPARE(document.pageCount(), pages);
    }
};

}  // namespace eyrie::ui::report_pages_test

EYRIE_UI_TEST(QApplication, report_pages_test, ReportPagesTest)
#include "report_pages_test.moc"
