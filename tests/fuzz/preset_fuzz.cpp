#include "fuzz/input_file.h"
#include "io/tables/preset_file.h"

/// Bytes as a preset file.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const eyrie::fuzz::MemoryFolder folder;
    static const std::filesystem::path file = folder / "fuzzed.json";
    eyrie::fuzz::writeBytes(file, data, size);
    eyrie::fuzz::expectAnswer([] { eyrie::readPreset(file); });
    return 0;
}
