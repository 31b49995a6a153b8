#include <algorithm>
#include <fstream>
#include <system_error>

#include "core/error.h"
#include "io/atomic_file.h"
#include "learning/descriptors/channel_features.h"
#include "learning/models/byte_stream.h"
#include "learning/models/vehicle_model.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "EYRIEMDL";
constexpr std::uint32_t kFormat = 2;
constexpr std::uint32_t kFirstWithFit = 2;  // earlier ones know our own samples only
constexpr std::uintmax_t kLargestFile = 1ULL << 30;
constexpr std::size_t kLongestText = 1 << 16;
constexpr std::size_t kHeaderBytes = kMagic.size() + sizeof(std::uint32_t);

void writeRectangles(const ChannelFeatures& features, ByteWriter& out) {
    out.put(static_cast<std::int32_t>(features.dimension()));
    for (const ChannelRectangle& r : features.rectangles()) {
        for (const int value : {r.channel, r.area.x, r.area.y, r.area.width, r.area.height}) {
            out.put(static_cast<std::uint8_t>(value));
        }
    }
}

std::unique_ptr<Descriptor> readRectangles(ByteReader& in) {
    const int count = in.getInt(1, 100000, "the number of channel features");
    std::vector<ChannelRectangle> rectangles;
    for (int i = 0; i < count; ++i) {
        ChannelRectangle r;
        r.channel = in.get<std::uint8_t>();
        r.area.x = in.get<std::uint8_t>();
        r.area.y = in.get<std::uint8_t>();
        r.area.width = in.get<std::uint8_t>();
        r.area.height = in.get<std::uint8_t>();
        if (!isAllowed(r)) in.damaged("a channel feature reaches out of the window");
        rectangles.push_back(r);
    }
    return std::make_unique<ChannelFeatures>(std::move(rectangles));
}

TrainingRecord readRecord(ByteReader& in) {
    TrainingRecord record;
    record.data = in.getText(kLongestText, "the description of the training data");
    record.vehicles = in.get<std::int32_t>();
    record.others = in.get<std::int32_t>();
    record.hard_negative_rounds = in.get<std::int32_t>();
    record.seed = in.get<std::uint64_t>();
    record.utc_time = in.getText(64, "the time");
    record.settings = in.getText(kLongestText, "the settings");
    return record;
}

WindowFit readFit(ByteReader& in) {
    const WindowFit fit{static_cast<double>(in.getFinite()), static_cast<double>(in.getFinite())};
    const bool inside = fit.length >= 1 && fit.length <= kWindowHeight && fit.width >= 1 && fit.width <= kWindowWidth;
    if (!inside) in.damaged("its vehicles do not fit the window");
    return fit;
}

}  // namespace

std::string modelBytes(const VehicleModel& model) {
    ByteWriter out;
    for (const char c : kMagic) out.put(c);
    // Where the first format says all, it stays: earlier versions read it, too.
    const bool ours = model.fit == WindowFit{};
    out.put(ours ? kFirstWithFit - 1 : kFormat);
    const TrainingRecord& record = model.record;
    out.putText(record.data.substr(0, kLongestText));
    out.put(static_cast<std::int32_t>(record.vehicles));
    out.put(static_cast<std::int32_t>(record.others));
    out.put(static_cast<std::int32_t>(record.hard_negative_rounds));
    out.put(record.seed);
    out.putText(record.utc_time.substr(0, 64));
    out.putText(record.settings.substr(0, kLongestText));
    if (!ours) {
        out.put(static_cast<float>(model.fit.length));
        out.put(static_cast<float>(model.fit.width));
    }
    out.put(static_cast<std::int32_t>(model.descriptor->kind()));
    if (const auto* features = dynamic_cast<const ChannelFeatures*>(model.descriptor.get())) {
        writeRectangles(*features, out);
    }
    out.put(static_cast<std::int32_t>(model.descriptor->dimension()));
    out.put(static_cast<std::int32_t>(model.classifier->kind()));
    model.classifier->write(out);
    const std::uint64_t sum = checksum(out.bytes());
    out.put(sum);
    return out.bytes();
}

VehicleModel modelFromBytes(std::string_view bytes, const std::string& name) {
    if (!bytes.starts_with(kMagic.substr(0, std::min(bytes.size(), kMagic.size()))) || bytes.empty()) {
        throw Error(ErrorKind::input, name +
                                          ": is not a classifier model of Eyrie; give a file that eyrie-cli train "
                                          "made");
    }
    ByteReader header(bytes.substr(std::min(bytes.size(), kMagic.size())), name);
    const auto format = header.get<std::uint32_t>();
    if (format > kFormat) {
        throw Error(ErrorKind::input, name + ": this classifier model is from a newer version of Eyrie (format " +
                                          std::to_string(format) + ", known up to " + std::to_string(kFormat) +
                                          "); update Eyrie or train the model again");
    }
    if (format == 0) header.damaged("format 0");
    if (bytes.size() < kHeaderBytes + sizeof(std::uint64_t)) header.damaged("it ends too early");
    const std::size_t end = bytes.size() - sizeof(std::uint64_t);
    if (ByteReader(bytes.substr(end), name).get<std::uint64_t>() != checksum(bytes.substr(0, end))) {
        header.damaged("its checksum does not match: bytes were lost or changed");
    }
    ByteReader in(bytes.substr(kHeaderBytes, end - kHeaderBytes), name);
    VehicleModel model;
    model.record = readRecord(in);
    if (format >= kFirstWithFit) model.fit = readFit(in);
    const int descriptor = in.getInt(0, static_cast<int>(allDescriptors().size()) - 1, "the descriptor");
    const auto kind = static_cast<DescriptorKind>(descriptor);
    model.descriptor = kind == DescriptorKind::channel_features ? readRectangles(in) : makeDescriptor(kind, 0);
    const int dimension = in.get<std::int32_t>();
    if (dimension != model.descriptor->dimension()) in.damaged("the descriptor's length does not match");
    const int classifier = in.getInt(0, static_cast<int>(allClassifiers().size()) - 1, "the classifier");
    model.classifier = readClassifier(static_cast<ClassifierKind>(classifier), dimension, in);
    if (in.left() != 0) in.damaged("there is more than belongs to it");
    return model;
}

void saveModel(const VehicleModel& model, const fs::path& path) {
    writeFileAtomically(path, modelBytes(model));
}

VehicleModel loadModel(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
        throw Error(ErrorKind::input, path.string() + ": no such classifier model");
    }
    const std::uintmax_t size = fs::file_size(path, error);
    if (error || size > kLargestFile) {
        throw Error(ErrorKind::input, path.string() + ": is not a classifier model of Eyrie (too large)");
    }
    std::string bytes(static_cast<std::size_t>(size), '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (!file) throw Error(ErrorKind::input, path.string() + ": the classifier model cannot be read");
    return modelFromBytes(bytes, path.string());
}

}  // namespace eyrie
