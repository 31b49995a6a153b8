// The list of formats: a new one is its own file, its declaration and its row here.
#include "formats/format_functions.h"

namespace eyrie {

LabelFormat nativeFormat();
LabelFormat nativeResultFormat();
LabelFormat motFormat();
LabelFormat motCvatFormat();
LabelFormat motResultFormat();
LabelFormat trackEvalFormat();
LabelFormat cvatFormat();
LabelFormat cocoFormat();
LabelFormat kwcocoFormat();
LabelFormat dotaFormat();
LabelFormat yoloObbFormat();
LabelFormat visDroneFormat();
LabelFormat uavdtFormat();
LabelFormat kw18Format();
LabelFormat viratFormat();
LabelFormat viameFormat();
LabelFormat vividFormat();
LabelFormat columnsFormat();
LabelFormat tracksCsvFormat();
LabelFormat geoJsonFormat();
LabelFormat kmlFormat();
LabelFormat stanag4676Format();

namespace {

/// The order is that of sniffing: a format comes before those that would take its files, and after those whose files it
/// would take.
constexpr LabelFormat (*kFormats[])() = {
    nativeFormat,    nativeResultFormat, cvatFormat,    kwcocoFormat,     cocoFormat,      trackEvalFormat,
    uavdtFormat,     visDroneFormat,     motCvatFormat, motFormat,        motResultFormat, viameFormat,
    vividFormat,     kw18Format,         viratFormat,   yoloObbFormat,    dotaFormat,      columnsFormat,
    tracksCsvFormat, geoJsonFormat,      kmlFormat,     stanag4676Format,
};

}  // namespace

const std::vector<LabelFormat>& formatTable() {
    static const std::vector<LabelFormat> table = [] {
        std::vector<LabelFormat> formats;
        for (const auto format : kFormats) formats.push_back(format());
        return formats;
    }();
    return table;
}

}  // namespace eyrie
