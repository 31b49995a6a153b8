#pragma once

#include <string>
#include <vector>

namespace eyrie {

/// What a column of a user's own table means.
enum class Column {
    frame,
    image,
    id,
    class_name,
    class_number,
    left,
    top,
    right,
    bottom,
    centre_x,
    centre_y,
    width,   ///< along the heading where there is one, otherwise to the right
    height,  ///< across
    heading,
    score,
    ignore,
    occluded,
    count,
    unused
};

/// A table described by the names of its columns, as DarkLabel does it: "frame,id,cname,x1,y1,x2,y2", or with a group
/// in brackets that a line repeats `n` times (without `n`: up to its end): "frame,n,[id,x,y,w,h]". The first separator
/// in it (comma, semicolon, tab or blank) is the table's.
struct ColumnTemplate {
    std::vector<Column> once;
    std::vector<Column> repeated;  ///< empty: one box a line
    char separator = ',';

    bool has(Column column) const;
};

/// Names: frame fn · image iname · id · class cname label · classid · x1 x left · y1 y top · x2 right · y2 bottom · cx
/// · cy · w · h · heading (degrees clockwise) · score conf · ignore difficult · occluded (0 to 2) · n · _ (passed
/// over). Throws Error(parameter) naming what is wrong, among it a frame or an edge that nothing tells.
ColumnTemplate parseColumns(const std::string& text);

}  // namespace eyrie
