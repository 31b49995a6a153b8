#include <fstream>
#include <iostream>

#include "formats/sample_labels.h"
#include "io/tables/preset_file.h"
#include "support/klv_writer.h"

/// fuzz_seeds FOLDER: good files to begin with, written by our own writers: a folder for each target and format.
namespace {

namespace fs = std::filesystem;
using eyrie::ExportOptions;

constexpr const char* kColumns = "frame,n,[id,cname,x1,y1,w,h,heading,score,ignore,occluded]";

/// Every file that the export wrote becomes a seed.
void seedsOfFormat(const std::string& format, const fs::path& target) {
    ExportOptions options;
    if (format == "columns") options.columns = kColumns;
    for (const bool turned : {true, false}) {
        const eyrie::test::TemporaryFolder folder;
        const eyrie::LabelFile labels = eyrie::test::sampleLabels(turned);
        const bool per_image = format == "dota" || format == "yolo-obb";
        eyrie::writeLabels(labels, folder / (per_image ? "images" : "labels_gt.txt"), format, options);
        fs::create_directories(target);
        int number = 0;
        for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
            if (!entry.is_regular_file() || ++number > 4) continue;
            fs::copy_file(entry.path(), target / ((turned ? "turned-" : "upright-") + std::to_string(number)),
                          fs::copy_options::overwrite_existing);
        }
    }
}

void write(const fs::path& path, const std::string& text) {
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

void seedsOfTables(const fs::path& folder) {
    write(folder / "boxes" / "truth",
          "frame,id,x,y,length,width,heading,class,ignore\n0,1,40.5,30,20,9,350.25,car,0\n1,i18,41,30,20,9,0,,1\n");
    write(
        folder / "boxes" / "result",
        "frame,id,x,y,length,width,heading,class,score,vx,vy,origin\n0,,4,3,2,1,0,\"a \"\"b\"\"\",0.5,1,-1,detected\n");
    write(folder / "homographies" / "two",
          "frame,h00,h01,h02,h10,h11,h12,h20,h21,h22\n0,1,0,0.5,0,1,0,0,0,1\n1,1,0,0.5,0,1,0,0,0,1\n");
    write(folder / "parts" / "two",
          "file,start_utc,frames,bytes,digest\nrec_1.ts,2026-11-21T08:00:00Z,50,1234,\n/x/rec_2.ts,,50,," +
              std::string(64, 'a') + "\n");
    write(folder / "template" / "flat", "frame,id,cname,x1,y1,x2,y2\n0,1,car,10,20,30,40\n");
    write(folder / "template" / "repeated", std::string(kColumns) + "\n0,1,1,car,3,4,20,10,90,0.5,0,1\n");
    eyrie::Preset preset;
    preset.name = "seed";
    preset.values = {{"motion.min_speed", "1.5"}, {"stacking.enabled", "true"}, {"detection.method", "mser"}};
    fs::create_directories(folder / "preset");
    eyrie::writePreset(folder / "preset" / "three", preset);
}

/// The first byte says how the target cuts the rest into packets.
void seedsOfMetadata(const fs::path& folder) {
    const auto writeKlv = [&](const char* name, const eyrie::test::KlvBytes& klv) {
        write(folder / name, "\x7F" + std::string(klv.begin(), klv.end()));
    };
    eyrie::test::LocalSetWriter local;
    local.time(1'600'000'000'000'000).item(3, {'s', 'e', 'e', 'd'}).range(5, 90, 0, 360).range(22, 300, 0, 10000);
    for (int corner = 0; corner < 4; ++corner) {
        local.angle(82 + 2 * corner, corner < 2 ? 50.002 : 50, 90);
        local.angle(83 + 2 * corner, corner % 3 == 0 ? 8 : 8.003, 180);
    }
    writeKlv("local", local.bytes());
    eyrie::test::KlvBytes two = local.item(96, {0x00, 0xD9, 0x2A}).bytes();
    eyrie::test::append(two, local.bytes());
    writeKlv("two", two);
    writeKlv("universal", eyrie::test::UniversalSetWriter()
                              .item("0702010101050000", eyrie::test::bigEndian(1'600'000'000'000'000, 8))
                              .real("0701020103020000", 50)
                              .real("0701020103040000", 8)
                              .single("0420020101080000", 0.8F)
                              .bytes());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "usage: fuzz_seeds FOLDER\n";
        return 2;
    }
    const fs::path folder = argv[1];
    for (const eyrie::LabelFormatInfo& format : eyrie::labelFormats()) {
        if (format.name == "trackeval" || !format.writes || !format.reads) continue;  // a tree is MOTChallenge inside
        seedsOfFormat(format.name, folder / format.name);
        std::cout << format.name << "\n";
    }
    seedsOfTables(folder);
    seedsOfMetadata(folder / "metadata");
    return 0;
}
