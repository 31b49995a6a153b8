#pragma once

#include <string>
#include <vector>

#include "core/text.h"

namespace eyrie {

/// An HTML page as it grows: tables and paragraphs, one after the other. What is called `safe` is HTML already.
class ReportPage {
 public:
    void heading(const std::string& text) { html_ += "<h2>" + markupEscaped(text) + "</h2>\n"; }
    /// A heading that begins a page where the document is printed.
    void chapter(const std::string& text) { html_ += "<h2 class=\"chapter\">" + markupEscaped(text) + "</h2>\n"; }
    void subheading(const std::string& text) { html_ += "<h3>" + markupEscaped(text) + "</h3>\n"; }
    void paragraph(const std::string& safe) { html_ += "<p>" + safe + "</p>\n"; }
    void figure(const std::string& name, const std::string& words) {
        html_ += "<p><img src=\"" + name + "\"><br><i>" + markupEscaped(words) + "</i></p>\n";
    }
    /// `numbers_from`: columns from there on are aligned right.
    void beginTable(const std::vector<std::string>& headings, std::size_t numbers_from = 1000,
                    const std::string& kind = "plain") {
        html_ += "<table class=\"" + kind + "\" cellspacing=\"0\" cellpadding=\"3\">\n";
        if (headings.empty()) return;
        html_ += "<thead><tr>";
        for (std::size_t i = 0; i < headings.size(); ++i)
            html_ += (i >= numbers_from ? "<th align=\"right\">" : "<th align=\"left\">") + markupEscaped(headings[i]) +
                     "</th>";
        html_ += "</tr></thead>\n";
    }
    /// `safe` fields; `numbers_from`: fields from there on are aligned right.
    void row(const std::vector<std::string>& safe, std::size_t numbers_from = 1000) {
        html_ += "<tr>";
        for (std::size_t i = 0; i < safe.size(); ++i) {
            html_ += i >= numbers_from ? "<td align=\"right\">" : "<td>";
            html_ += safe[i] + "</td>";
        }
        html_ += "</tr>\n";
    }
    void endTable() { html_ += "</table>\n"; }
    std::string take() { return std::move(html_); }

 private:
    std::string html_;
};

}  // namespace eyrie
