#pragma once

class QTextDocument;

namespace eyrie::ui {

/// What stands below a small heading (h3), its pictures and facts, begins a new page where it would be torn apart
/// between two; what is higher than a page stays where it is. For a document that is laid out in pages of this height,
/// in its own unit.
void keepTogether(QTextDocument& document, double page_height);

}  // namespace eyrie::ui
