#include "fuzz/input_file.h"
#include "store/labels/packed_labels.h"
#include "store/review/packed_review.h"
#include "store/runs/packed_arrays.h"

/// Bytes as one of the packed columns of a project; the first byte chooses which.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const eyrie::ByteView bytes(reinterpret_cast<const std::byte*>(data + 1), size - 1);
    eyrie::fuzz::expectAnswer([&] {
        switch (data[0] % 7) {
            case 0:
                eyrie::unpackMotionVectors(bytes);
                break;
            case 1:
                eyrie::unpackPoints(bytes);
                break;
            case 2:
                eyrie::unpackIndices(bytes);
                break;
            case 3:
                eyrie::unpackKeyframes(bytes);
                break;
            case 4:
                eyrie::unpackPolygon(bytes);
                break;
            case 5:
                eyrie::unpackReview(bytes);
                break;
            default:
                eyrie::unpackEdit(bytes, {}, false);
        }
    });
    return 0;
}
