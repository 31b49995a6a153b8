#include "formats/tables/column_template.h"

#include <algorithm>
#include <map>

#include "core/error.h"
#include "formats/format_functions.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

const std::map<std::string, Column, std::less<>>& columnNames() {
    static const std::map<std::string, Column, std::less<>> names{{"frame", Column::frame},
                                                                  {"fn", Column::frame},
                                                                  {"image", Column::image},
                                                                  {"iname", Column::image},
                                                                  {"id", Column::id},
                                                                  {"class", Column::class_name},
                                                                  {"cname", Column::class_name},
                                                                  {"label", Column::class_name},
                                                                  {"classid", Column::class_number},
                                                                  {"x1", Column::left},
                                                                  {"x", Column::left},
                                                                  {"left", Column::left},
                                                                  {"y1", Column::top},
                                                                  {"y", Column::top},
                                                                  {"top", Column::top},
                                                                  {"x2", Column::right},
                                                                  {"right", Column::right},
                                                                  {"y2", Column::bottom},
                                                                  {"bottom", Column::bottom},
                                                                  {"cx", Column::centre_x},
                                                                  {"cy", Column::centre_y},
                                                                  {"w", Column::width},
                                                                  {"h", Column::height},
                                                                  {"heading", Column::heading},
                                                                  {"score", Column::score},
                                                                  {"conf", Column::score},
                                                                  {"ignore", Column::ignore},
                                                                  {"difficult", Column::ignore},
                                                                  {"occluded", Column::occluded},
                                                                  {"n", Column::count},
                                                                  {"_", Column::unused}};
    return names;
}

[[noreturn]] void refuse(const std::string& text, const std::string& reason) {
    throw Error(ErrorKind::parameter, "columns \"" + text + "\": " + reason +
                                          "; write them as in frame,id,cname,x1,y1,x2,y2 or frame,n,[id,x,y,w,h]");
}

void checkAxis(const std::string& text, const ColumnTemplate& columns, Column low, Column high, Column centre,
               Column size, const char* axis) {
    const int known = columns.has(low) + columns.has(high) + columns.has(centre) + columns.has(size);
    if (known < 2) refuse(text, std::string("two columns must give the ") + axis + " extent of a box");
    if (known > 2)
        refuse(text, std::string("more than two columns give the ") + axis + " extent of a box; skip columns with _");
}

}  // namespace

bool ColumnTemplate::has(Column column) const {
    return std::find(once.begin(), once.end(), column) != once.end() ||
           std::find(repeated.begin(), repeated.end(), column) != repeated.end();
}

ColumnTemplate parseColumns(const std::string& text) {
    ColumnTemplate columns;
    const std::size_t first = text.find_first_of(",;\t ");
    if (first == std::string::npos) refuse(text, "there is no separator");
    columns.separator = text[first];
    if (columns.separator == ' ' && text.find_first_of(",;\t") != std::string::npos) {
        columns.separator = text[text.find_first_of(",;\t")];
    }
    bool in_group = false, group_over = false;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(columns.separator, begin), text.size());
        std::string_view name = trimmed(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
        if (name.empty() && columns.separator == ' ') continue;
        if (group_over) refuse(text, "nothing may follow the brackets");
        if (name.starts_with('[')) {
            if (in_group) refuse(text, "brackets do not nest");
            in_group = true;
            name = trimmed(name.substr(1));
        }
        const bool closes = name.ends_with(']');
        if (closes) {
            if (!in_group) refuse(text, "a bracket closes that never opened");
            name = trimmed(name.substr(0, name.size() - 1));
            group_over = true;
        }
        const auto known = columnNames().find(name);
        if (known == columnNames().end()) refuse(text, inQuotes(name) + " names no column");
        if (known->second != Column::unused && columns.has(known->second)) {
            refuse(text, inQuotes(name) + " is given twice");
        }
        (in_group ? columns.repeated : columns.once).push_back(known->second);
    }
    if (in_group && !group_over) refuse(text, "a bracket is opened and never closed");
    const auto grouped = [&](Column column) {
        return std::find(columns.repeated.begin(), columns.repeated.end(), column) != columns.repeated.end();
    };
    if (columns.has(Column::count) && (columns.repeated.empty() || grouped(Column::count))) {
        refuse(text, "n needs a group in brackets behind it");
    }
    if (grouped(Column::frame) || grouped(Column::image)) refuse(text, "a line belongs to one frame");
    if (!columns.has(Column::frame) && !columns.has(Column::image)) refuse(text, "neither frame nor image is given");
    if (columns.has(Column::class_name) && columns.has(Column::class_number)) refuse(text, "the class is given twice");
    checkAxis(text, columns, Column::left, Column::right, Column::centre_x, Column::width, "horizontal");
    checkAxis(text, columns, Column::top, Column::bottom, Column::centre_y, Column::height, "vertical");
    return columns;
}

}  // namespace eyrie
