// Not a test: pictures of the label workspace with few and many objects, light and dark, small and large, to be looked
// at.
//   ninja label_pictures && bin/label_pictures CLIP TRUTH.csv GSD RATE FOLDER
#include <QApplication>
#include <cstdio>
#include <map>

#include "annotation/edits/identity_edits.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "io/tables/box_csv.h"
#include "ui/label/labelling.h"
#include "window/theme.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {
namespace {

class Photographer : public test::Labelling {
 public:
    Photographer(std::filesystem::path clip, double gsd, double rate) : clip_(std::move(clip)), gsd_(gsd), rate_(rate) {
        begin();
    }
    ~Photographer() { end(); }

    bool open() {
        StartOptions options;
        options.input = clip_;
        options.gsd_m_per_px = gsd_;
        options.frame_rate_hz = rate_;
        window_ = clipWindow(options);
        return window_ != nullptr;
    }
    LabelSession& labels() { return window_->labelling().labels(); }

    /// The vehicles of the truth, beside one another as often as it takes.
    void label(const std::filesystem::path& truth, int objects) {
        std::map<int, std::vector<FrameBox>> tracks;
        for (const auto& [frame, records] : readBoxCsv(truth))
            for (const BoxRecord& record : records)
                if (record.id && record.box.area() < 20'000) tracks[*record.id].push_back({frame, record.box});
        const char* classes[] = {"car", "car", "van", "truck", "bus"};
        AnnotationEdit edit;
        edit.name = "Label";
        for (int copy = 0; static_cast<int>(edit.objects.size()) < objects; ++copy) {
            for (const auto& [id, boxes] : tracks) {
                if (boxes.size() < 40 || static_cast<int>(edit.objects.size()) >= objects) continue;
                LabelledObject object;
                object.id = labels().newObjectId();
                object.object_class = classes[object.id % 5];
                object.keyframes = reduceToKeyframes(boxes, labels().camera());
                for (Keyframe& keyframe : object.keyframes)
                    keyframe.box.centre += cv::Point2d(17.0 * (copy % 5), 13.0 * copy);
                object.last_frame = boxes.back().frame;
                // One object of its own colour, and one of a run with a single box set by hand.
                if (edit.objects.size() == 1) object.colour = 0xff4fd8;
                if (edit.objects.size() == 2)
                    for (std::size_t i = 1; i < object.keyframes.size(); ++i) object.keyframes[i].computed = true;
                edit.objects.push_back({std::nullopt, std::move(object)});
            }
        }
        labels().apply(edit);
        ReviewMark mark;
        mark.object = edit.objects.front().after->id;
        mark.last_frame = 60;
        mark.person = "somebody";
        mark.when_utc = "2026-01-01T00:00:00Z";
        labels().apply(reviewEdit("Checked", labels().annotations(), {mark}));
        labels().select(edit.objects[2].after->id);
    }

    void shoot(const std::filesystem::path& file, QSize size, double zoom) {
        window_->resize(size);
        QTest::qWait(150);
        window_->labelling().editor().goTo(*labels().selected(), 40);
        waitFor([&] { return window_->canvas().frame().index == 40; });
        window_->canvas().fit();
        const LabelMark* mark = nullptr;
        for (const LabelMark& candidate : window_->labelling().tool().scene().marks)
            if (candidate.id == *labels().selected()) mark = &candidate;
        if (zoom > 0 && mark != nullptr) window_->canvas().restore(zoom, {mark->box.centre.x, mark->box.centre.y});
        if (zoom > 0) {
            waitFor([&] { return window_->labelling().tool().stackHere() != nullptr; });
            key(*window_, Qt::Key_BracketRight);
            waitFor([&] { return window_->labelling().tool().stackHere() != nullptr; });
        }
        QTest::qWait(700);
        if (zoom > 0) key(*window_, Qt::Key_BracketLeft);
        QTest::qWait(200);
        if (!window_->grab().save(QString::fromStdString(file.string()))) std::fprintf(stderr, "cannot write\n");
    }

    void showChips() { window_->docks().raise(DockId::object_chips); }

 private:
    std::filesystem::path clip_;
    double gsd_;
    double rate_;
    std::unique_ptr<MainWindow> window_;
};

}  // namespace
}  // namespace eyrie::ui

int main(int argc, char** argv) {
    using namespace eyrie::ui;
    if (argc < 6) return 2;
    QApplication application(argc, argv);
    const std::filesystem::path folder = argv[5];
    std::filesystem::create_directories(folder);
    Theme theme(application);
    for (const int objects : {5, 300}) {
        Photographer photographer(argv[1], std::stod(argv[3]), std::stod(argv[4]));
        if (!photographer.open()) return 1;
        photographer.label(argv[2], objects);
        for (const bool dark : {false, true}) {
            theme.choose(dark ? ThemeChoice::dark : ThemeChoice::light);
            const std::string name = std::to_string(objects) + (dark ? "_dark" : "_light");
            photographer.shoot(folder / (name + ".png"), {1600, 1000}, 0);
            photographer.shoot(folder / (name + "_zoomed.png"), {1600, 1000}, 5);
            photographer.shoot(folder / (name + "_small.png"), {1280, 720}, 0);
        }
        photographer.showChips();
        photographer.shoot(folder / (std::to_string(objects) + "_chips.png"), {1280, 720}, 0);
    }
}
