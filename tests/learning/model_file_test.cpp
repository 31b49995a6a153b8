#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "learning/classifiers/gentle_adaboost.h"
#include "learning/drawn_windows.h"
#include "learning/models/byte_stream.h"
#include "learning/training/trainer.h"
#include "support/temporary_folder.h"

namespace eyrie::model_file_test {
namespace {

using testing::HasSubstr;

VehicleModel smallModel(DescriptorKind descriptor = DescriptorKind::channel_features,
                        ClassifierKind classifier = ClassifierKind::adaboost) {
    TrainingOptions options;
    options.descriptor = descriptor;
    options.classifier = classifier;
    options.hard_negative_rounds = 0;
    options.mirrored = false;
    options.varied_copies = 0;
    options.misfit_copies = 0;
    options.classifier_options.trees = 12;
    options.classifier_options.weak_classifiers = 5;
    options.classifier_options.weak_features = 4;
    TrainingRecord record;
    record.data = "drawn: a few\nterms: none";
    record.utc_time = "2026-11-21T08:30:00Z";
    record.settings = "training.trees = 12";
    return *trainModel(test::drawnSamples(20, 30, 1), options, record);
}

std::string messageOf(const std::string& bytes) {
    try {
        modelFromBytes(bytes, "m.eyriemodel");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        return error.what();
    }
    return "";
}

/// With a checksum that is right again, as an attacker would do it.
std::string resealed(std::string bytes) {
    bytes.resize(bytes.size() - 8);
    const std::uint64_t sum = checksum(bytes);
    bytes.append(reinterpret_cast<const char*>(&sum), 8);
    return bytes;
}

}  // namespace

TEST(ModelFile, keepsEverythingForEveryDescriptorAndClassifier) {
    const test::TemporaryFolder folder;
    SeededRandom random(9);
    for (const DescriptorKind descriptor : allDescriptors()) {
        for (const ClassifierKind classifier : allClassifiers()) {
            // All classifiers on one descriptor, all descriptors with one classifier.
            if (descriptor != DescriptorKind::moments && classifier != ClassifierKind::adaboost) continue;
            const VehicleModel model = smallModel(descriptor, classifier);
            saveModel(model, folder / "m.eyriemodel");
            const VehicleModel loaded = loadModel(folder / "m.eyriemodel");
            EXPECT_EQ(loaded.descriptor->kind(), descriptor);
            EXPECT_EQ(loaded.classifier->kind(), classifier);
            EXPECT_EQ(loaded.record.data, model.record.data);
            EXPECT_EQ(loaded.record.vehicles, 20);
            EXPECT_EQ(loaded.record.others, 20);
            EXPECT_EQ(loaded.record.seed, 1U);
            EXPECT_EQ(loaded.record.utc_time, model.record.utc_time);
            EXPECT_EQ(loaded.record.settings, model.record.settings);
            for (int i = 0; i < 5; ++i) {
                const cv::Mat window = test::drawnWindow(i % 2 == 0, random);
                EXPECT_NEAR(loaded.decide(window), model.decide(window), 1e-5);
            }
            EXPECT_EQ(modelBytes(loaded), modelBytes(model));
        }
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1) << "nothing is left beside it";
}

TEST(ModelFile, tellsWhatVehiclesTakeOfTheWindow) {
    VehicleModel model = smallModel();
    EXPECT_EQ(modelBytes(model)[8], 1) << "earlier versions read it";
    EXPECT_EQ(modelFromBytes(modelBytes(model), "m").fit, (WindowFit{21.5, 10}));
    model.fit = WindowFit::filled();
    const std::string bytes = modelBytes(model);
    EXPECT_EQ(bytes[8], 2);
    const VehicleModel loaded = modelFromBytes(bytes, "m");
    EXPECT_EQ(loaded.fit, (WindowFit{32, 16}));
    EXPECT_EQ(loaded.record.settings, model.record.settings);
    EXPECT_EQ(modelBytes(loaded), bytes);
    for (const WindowFit outside : {WindowFit{33, 16}, {32, 17}, {0, 16}, {32, 0}, {32, -1}}) {
        model.fit = outside;
        EXPECT_THAT(messageOf(modelBytes(model)), HasSubstr("do not fit")) << outside.length << " × " << outside.width;
    }
}

TEST(ModelFile, cutShortAnywhereIsRefused) {
    const std::string bytes = modelBytes(smallModel());
    for (std::size_t size = 0; size < bytes.size(); size += size < 64 ? 1 : 131) {
        const std::string message = messageOf(bytes.substr(0, size));
        EXPECT_THAT(message, HasSubstr("m.eyriemodel")) << size;
        if (size > 0) {
            EXPECT_THAT(message, HasSubstr("damaged")) << size;
        }
    }
    EXPECT_THAT(messageOf(bytes + "x"), HasSubstr("damaged"));
}

TEST(ModelFile, anyChangedByteIsNoticed) {
    const std::string bytes = modelBytes(smallModel());
    for (std::size_t at = 0; at < bytes.size(); at += 37) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ 0x41);
        EXPECT_NE(messageOf(changed), "") << at;
    }
}

TEST(ModelFile, hostileContentsBehindAValidChecksumNeverCrash) {
    const std::string bytes = modelBytes(smallModel());
    SeededRandom random(3);
    int refused = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        std::string changed = bytes;
        const auto at = static_cast<std::size_t>(12 + random.below(static_cast<int>(bytes.size()) - 20));
        for (std::size_t k = at; k < std::min(at + 4, bytes.size() - 8); ++k) {
            changed[k] = static_cast<char>(random.below(3) == 0 ? 0xff : random.below(256));
        }
        try {
            const VehicleModel model = modelFromBytes(resealed(changed), "m");
            model.decide(test::noiseWindow(1));
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
    // Sizes far beyond the file take no memory.
    std::string huge = bytes;
    huge.replace(12, 8, std::string("\xff\xff\xff\xff\xff\xff\xff\x7f", 8));
    EXPECT_THAT(messageOf(resealed(huge)), HasSubstr("too many"));
}

TEST(ModelFile, hostileTreesOfEveryClassifierNeverCrash) {
    SeededRandom random(5);
    for (const ClassifierKind kind : allClassifiers()) {
        const std::string bytes = modelBytes(smallModel(DescriptorKind::moments, kind));
        for (int trial = 0; trial < 300; ++trial) {
            std::string changed = bytes;
            const std::size_t begin = bytes.size() / 3;
            const auto at = begin + static_cast<std::size_t>(random.below(static_cast<int>(bytes.size() - begin) - 12));
            for (std::size_t k = at; k < at + 4; ++k) changed[k] = static_cast<char>(random.below(256));
            try {
                modelFromBytes(resealed(changed), "m").decide(test::noiseWindow(1));
            } catch (const Error&) {
            }
        }
    }
}

TEST(ModelFile, foreignAndNewerFilesAreSaidToBeSo) {
    EXPECT_THAT(messageOf(""), HasSubstr("not a classifier model"));
    EXPECT_THAT(messageOf("\x89PNG\r\n\x1a\n and so on and on and on"), HasSubstr("not a classifier model"));
    std::string newer = modelBytes(smallModel());
    newer[8] = 3;
    EXPECT_THAT(messageOf(newer), HasSubstr("newer version"));
    EXPECT_THAT(messageOf(resealed(newer)), HasSubstr("newer version"));
}

TEST(ModelFile, missingFilesAndFoldersAreNamed) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(loadModel(folder / "missing.eyriemodel"), Error);
    EXPECT_THROW(loadModel(folder.path()), Error);
    try {
        saveModel(smallModel(), folder / "no" / "such" / "folder.eyriemodel");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
        EXPECT_THAT(error.what(), HasSubstr("folder.eyriemodel"));
    }
}

}  // namespace eyrie::model_file_test
