#include "formats/label_formats.h"
#include "formats/tables/column_template.h"
#include "fuzz/input_file.h"
#include "io/tables/box_csv.h"
#include "io/tables/homography_csv.h"
#include "io/video/parts/part_list.h"

/// tables_fuzz --table=boxes|homographies|parts|template: bytes as one of our own tables, or as the columns of a user's
/// table (the first line) and that table (the rest).
namespace {

struct Reader {
    eyrie::fuzz::MemoryFolder folder;
    std::filesystem::path file = folder / "fuzzed.csv";
    std::string table = "boxes";

    static Reader& only() {
        static Reader reader;
        return reader;
    }
};

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    Reader::only().table = eyrie::fuzz::option(*argc, *argv, "table", "boxes");
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Reader& reader = Reader::only();
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    eyrie::fuzz::expectAnswer([&] {
        if (reader.table == "template") {
            const std::size_t end = std::min(text.find('\n'), size);
            eyrie::ImportOptions options;
            options.columns = text.substr(0, end);
            eyrie::parseColumns(options.columns);
            if (end == size) return;
            eyrie::fuzz::writeBytes(reader.file, data + end + 1, size - end - 1);
            eyrie::readLabels(reader.file, "columns", options);
            return;
        }
        eyrie::fuzz::writeBytes(reader.file, data, size);
        if (reader.table == "boxes")
            eyrie::readBoxCsv(reader.file);
        else if (reader.table == "parts")
            eyrie::readPartList(reader.file);
        else
            eyrie::readHomographyCsv(reader.file);
    });
    return 0;
}
