#include "window/docks/report_pages.h"

#include <QAbstractTextDocumentLayout>
#include <QTextBlock>
#include <QTextCursor>
#include <QTextDocument>
#include <algorithm>
#include <cmath>
#include <vector>

namespace eyrie::ui {

namespace {

/// Where a heading of this level stands, and whatever follows it up to the next one.
struct Passage {
    int begin = 0;  ///< positions in the document
    int end = 0;
};

std::vector<Passage> passagesOf(const QTextDocument& document, int level) {
    std::vector<Passage> passages;
    bool within = false;
    for (QTextBlock block = document.begin(); block.isValid(); block = block.next()) {
        const int heading = block.blockFormat().headingLevel();
        if (heading > 0) within = heading == level;
        if (heading == level) passages.push_back({block.position(), block.position()});
        if (within && block.length() > 1) passages.back().end = block.position();
    }
    return passages;
}

}  // namespace

void keepTogether(QTextDocument& document, double page_height) {
    constexpr int kSmallHeading = 3;
    const QAbstractTextDocumentLayout& layout = *document.documentLayout();
    const auto blockAt = [&](int position) { return layout.blockBoundingRect(document.findBlock(position)); };
    for (const Passage& passage : passagesOf(document, kSmallHeading)) {
        double bottom = 0;
        for (QTextBlock block = document.findBlock(passage.begin); block.isValid() && block.position() <= passage.end;
             block = block.next())
            bottom = std::max(bottom, layout.blockBoundingRect(block).bottom());
        const double top = blockAt(passage.begin).top();
        const bool torn = std::floor(top / page_height) != std::floor((bottom - 1) / page_height);
        if (!torn || bottom - top > page_height) continue;
        QTextCursor heading(&document);
        heading.setPosition(passage.begin);
        QTextBlockFormat format;
        format.setPageBreakPolicy(QTextFormat::PageBreak_AlwaysBefore);
        heading.mergeBlockFormat(format);
    }
}

}  // namespace eyrie::ui
