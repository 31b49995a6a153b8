#include "formats/label_formats.h"
#include "fuzz/input_file.h"

/// labels_fuzz --format=NAME: bytes as a file of labels of that format, or of the one that they look like ("auto").
namespace {

/// What every call of the target shares.
struct Reader {
    eyrie::fuzz::MemoryFolder folder;
    std::string format = "auto";
    eyrie::ImportOptions options;
    std::filesystem::path file;

    static Reader& only() {
        static Reader reader;
        return reader;
    }
};

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    Reader& reader = Reader::only();
    reader.format = eyrie::fuzz::option(*argc, *argv, "format", "auto");
    reader.options.image_size = cv::Size(320, 240);
    if (reader.format == "columns")
        reader.options.columns = "frame,n,[id,cname,x1,y1,w,h,heading,score,ignore,occluded]";
    reader.file = reader.folder / (reader.format == "uavdt" ? "fuzzed_gt_whole.txt" : "fuzzed.txt");
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Reader& reader = Reader::only();
    eyrie::fuzz::writeBytes(reader.file, data, size);
    eyrie::fuzz::expectAnswer([&] {
        const eyrie::LabelFile labels = eyrie::readLabels(reader.file, reader.format, reader.options);
        eyrie::reportOn(labels);
        eyrie::annotationsOf(labels);
    });
    return 0;
}
