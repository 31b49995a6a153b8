#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "annotation/keyframes/interpolation.h"
#include "io/tables/box_csv.h"
#include "label/canvas/box_handles.h"
#include "label/computing/label_fitting.h"
#include "ui/label/labelling.h"

/// A robot with an annotator's eyes and hands: knows the truth, works through the window by mouse and keys.
namespace eyrie::ui::test {

/// A vehicle as it is: all its boxes, and those that count.
struct Truth {
    std::map<FrameIndex, OrientedBox> boxes;
    std::map<FrameIndex, OrientedBox> counted;
};

inline std::map<int, Truth> readTruth(const std::filesystem::path& file) {
    std::map<int, Truth> truth;
    for (const auto& [frame, records] : readBoxCsv(file))
        for (const BoxRecord& record : records) {
            if (!record.id) continue;
            truth[*record.id].boxes[frame] = record.box;
            if (!record.ignore) truth[*record.id].counted[frame] = record.box;
        }
    std::erase_if(truth, [](const auto& entry) { return entry.second.counted.size() < 5; });
    return truth;
}

/// What the robot did.
struct Work {
    int clicks = 0;
    int keys = 0;
};

/// Labels a clip as people do, until every box overlaps the truth by `enough`.
class Robot : public Labelling {
 public:
    Robot(std::filesystem::path clip, double gsd, double rate, double enough, bool upright)
        : clip_(std::move(clip)), gsd_(gsd), rate_(rate), enough_(enough), upright_(upright) {
        begin();
    }
    ~Robot() { end(); }

    bool open() {
        StartOptions options;
        options.input = clip_;
        options.gsd_m_per_px = gsd_;
        options.frame_rate_hz = rate_;
        window_ = clipWindow(options);
        return window_ != nullptr;
    }

    LabelSession& labels() { return window_->labelling().labels(); }
    Work work;

    void press(Qt::Key which, Qt::KeyboardModifiers with = {}) {
        key(*window_, which, with);
        ++work.keys;
    }
    void point(cv::Point2d at, Qt::KeyboardModifiers with = {}) {
        click(*window_, at.x, at.y, with);
        ++work.clicks;
    }
    void drag(cv::Point2d from, cv::Point2d to) {
        VideoView& canvas = window_->canvas();
        const QPoint a = Labelling::at(*window_, from.x, from.y);
        const QPoint b = Labelling::at(*window_, to.x, to.y);
        QTest::mousePress(&canvas, Qt::LeftButton, {}, a);
        QTest::mouseMove(&canvas, (a + b) / 2);
        QMouseEvent half(QEvent::MouseMove, (QPointF(a) + QPointF(b)) / 2, canvas.mapToGlobal((a + b) / 2),
                         Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&canvas, &half);
        QMouseEvent whole(QEvent::MouseMove, b, canvas.mapToGlobal(b), Qt::NoButton, Qt::LeftButton, Qt::NoModifier);
        QApplication::sendEvent(&canvas, &whole);
        QTest::mouseRelease(&canvas, Qt::LeftButton, {}, b);
        ++work.clicks;
    }
    /// One click in the object's row of the timeline: it is selected and the frame shown.
    void goTo(ObjectId id, FrameIndex frame) {
        const bool there = window_->session().viewFrame().index == frame;
        if (there && labels().selected() == id) return;
        if (labels().selected() != id) labels().select(id);
        if (!there) go(*window_, frame);
        ++work.clicks;
    }

    double likeness(const OrientedBox& ours, const OrientedBox& truth) const {
        return overlap(upright_ ? ours.upright() : ours, truth);
    }
    double likeness(ObjectId id, FrameIndex frame, const OrientedBox& truth) {
        const LabelledBox box = boxAt(labels().annotations().objects.at(id), frame, labels().camera());
        return box.visible() ? likeness(box.box, truth) : 0;
    }

    /// Draws a box where the truth has it; the size of the class is not trusted.
    void drawBox(const OrientedBox& truth) {
        if (upright_) {
            const OrientedBox box = truth.upright();
            drag(box.toImage({-box.length / 2, -box.width / 2}), box.toImage({box.length / 2, box.width / 2}));
            return;
        }
        point(truth.toImage({-truth.length / 2, 0}));
        point(truth.toImage({truth.length / 2, 0}), Qt::ShiftModifier);
        point(truth.toImage({0, truth.width / 2}));
    }

    static constexpr double kGood = 0.85;    ///< overlap from which on nobody corrects
    static constexpr double kLeastDrag = 6;  ///< px on screen
    struct Drag {
        BoxHandle handle;
        cv::Point2d from;
        cv::Point2d to;
        OrientedBox box;  ///< after it
    };

    /// The handle whose dragging helps most.
    Drag bestDrag(const OrientedBox& box, const OrientedBox& truth) {
        const auto& transform = window_->canvas().transform();
        Drag best{BoxHandle::centre, box.centre, truth.centre, box};
        // Where moving it does, its size stays.
        OrientedBox moved = box;
        moved.centre = truth.centre;
        if (upright_) moved.centre += box.centre - box.upright().centre;
        const bool can_move = cv::norm(box.centre - moved.centre) * transform.scale() > kLeastDrag;
        if (can_move && likeness(moved, truth) > kGood) return {BoxHandle::centre, box.centre, moved.centre, moved};
        double most = likeness(box, truth);
        for (const auto& [handle, at] : boxHandles(box, transform)) {
            const QPointF place = transform.imageFromView(at);
            const cv::Point2d from(place.x(), place.y());
            const cv::Point2d inside = box.toBox(from);
            const auto side = [](double value, double half) {
                return value > half / 2 ? 1 : value < -half / 2 ? -1 : 0;
            };
            const int along = side(inside.x, box.length / 2);
            const int across = side(inside.y, box.width / 2);
            const OrientedBox goal = alike(truth, box);
            cv::Point2d to = from + goal.toImage({along * goal.length / 2, across * goal.width / 2}) -
                             box.toImage({along * box.length / 2, across * box.width / 2});
            if (handle == BoxHandle::turn) {
                OrientedBox turned = box;
                turned.heading = goal.heading;
                to = turned.toImage(inside);
            }
            const OrientedBox after = draggedBox(box, handle, place, {to.x, to.y});
            if (likeness(after, truth) <= most || cv::norm(to - from) * transform.scale() <= kLeastDrag) continue;
            most = likeness(after, truth);
            best = {handle, from, to, after};
        }
        return best;
    }
    /// The same box with sides named as another one's are.
    static OrientedBox alike(OrientedBox box, const OrientedBox& other) {
        for (int quarter = 0; quarter < 3 && std::cos(box.heading - other.heading) < 0.7; ++quarter) {
            box.heading += std::acos(0.0);
            std::swap(box.length, box.width);
        }
        return box;
    }

    /// Puts an object's box right in a frame: by dragging its handles where that is less work, else by drawing it anew.
    void correct(ObjectId id, FrameIndex frame, const OrientedBox& truth) {
        goTo(id, frame);
        const auto expected = LabelEditor::expectedBox(labels().annotations().objects.at(id), frame, labels().camera());
        std::vector<Drag> drags;
        // Who draws upright boxes does not drag at turned ones.
        const bool turned = expected && std::abs(std::sin(2 * expected->heading)) > 1e-6;
        const std::size_t most = !upright_ ? 3 : turned ? 0 : 1;
        OrientedBox box = expected.value_or(truth);
        while (expected && likeness(box, truth) <= kGood && drags.size() < most) {
            drags.push_back(bestDrag(box, truth));
            if (likeness(drags.back().box, truth) <= likeness(box, truth)) break;
            box = drags.back().box;
        }
        if (expected && likeness(*expected, truth) > kGood && most > 0) {
            press(Qt::Key_R);
        } else if (expected && likeness(box, truth) > kGood && most > 0) {
            for (const Drag& each : drags) drag(each.from, each.to);
        } else {
            press(Qt::Key_B, Qt::ControlModifier);
            drawBox(truth);
        }
        if (likeness(id, frame, truth) < enough_) {
            goTo(id, frame);
            press(Qt::Key_B, Qt::ControlModifier);
            drawBox(truth);
        }
    }

    /// The frame to put right next: the worst, and of those before or after its life the one at the end, where the way
    /// is longest.
    FrameIndex worstFrame(ObjectId id, const Truth& truth) {
        FrameIndex worst = -1;
        double least = enough_;
        for (const auto& [frame, box] : truth.counted) {
            const double like = likeness(id, frame, box);
            if (like >= least) continue;
            least = like;
            worst = frame;
        }
        const LabelledObject& object = labels().annotations().objects.at(id);
        if (worst > object.last_frame) return truth.counted.rbegin()->first;
        if (worst >= 0 && worst < firstFrameOf(object)) return truth.counted.begin()->first;
        return worst;
    }
    /// A frame in the middle of an object's life in which all of the vehicle is to be seen.
    FrameIndex middleOf(ObjectId id, const Truth& truth) {
        const LabelledObject& object = labels().annotations().objects.at(id);
        const auto middle = truth.counted.lower_bound((firstFrameOf(object) + object.last_frame) / 2);
        const bool lives = middle != truth.counted.end() && middle->first <= object.last_frame;
        return lives ? middle->first : truth.counted.begin()->first;
    }

    /// Corrects an object until every box is good enough; the worst first.
    void finish(ObjectId id, const Truth& truth) {
        for (int round = 0; round < 60; ++round) {
            const FrameIndex frame = worstFrame(id, truth);
            if (frame < 0) return;
            correct(id, frame, truth.counted.at(frame));
        }
    }

    /// Whether boxes lie beside the vehicle in more than a few frames of the object's life.
    bool isElsewhere(ObjectId id, const Truth& truth) {
        constexpr double kBeside = 0.3;
        constexpr double kFew = 0.1;
        const LabelledObject& object = labels().annotations().objects.at(id);
        int frames = 0;
        int beside = 0;
        for (const auto& [frame, box] : truth.counted) {
            if (frame < firstFrameOf(object) || frame > object.last_frame) continue;
            ++frames;
            beside += likeness(id, frame, box) < kBeside ? 1 : 0;
        }
        return beside > kFew * frames;
    }

    int badFrames(ObjectId id, const Truth& truth) {
        return static_cast<int>(std::count_if(truth.counted.begin(), truth.counted.end(), [&](const auto& entry) {
            return likeness(id, entry.first, entry.second) < enough_;
        }));
    }

    /// One box is put right and all others laid on the pictures by it; again where that did not do, and taken back
    /// where it did harm.
    /// What is far off even then is drawn from nothing. Answers the object that stays.
    ObjectId correctProposal(ObjectId id, const Truth& truth) {
        constexpr int kTries = 3;
        for (int round = 0; round < kTries && worst(id, truth) < enough_; ++round) {
            const FrameIndex frame = round == 0 ? middleOf(id, truth) : worstFrame(id, truth);
            correct(id, frame, truth.counted.at(frame));
            const int before = badFrames(id, truth);
            if (before == 0) return id;
            press(Qt::Key_F, Qt::ControlModifier);
            waitFor([&] { return !window_->labelling().fitting().working(); });
            if (isElsewhere(id, truth)) {
                removeObjects({id});
                return drawFromNothing(truth);
            }
            if (badFrames(id, truth) < before) continue;
            press(Qt::Key_Z, Qt::ControlModifier);
            break;
        }
        finish(id, truth);
        return id;
    }

    ObjectId drawFromNothing(const Truth& truth) {
        const auto& [frame, box] = *truth.counted.begin();
        if (window_->session().viewFrame().index != frame) {
            go(*window_, frame);
            ++work.clicks;
        }
        press(Qt::Key_B);
        drawBox(box);
        const ObjectId id = labels().selected().value_or(0);
        if (id != 0 && truth.counted.size() > 1) {
            const auto& [last, last_box] = *truth.counted.rbegin();
            correct(id, last, last_box);
        }
        if (id != 0) finish(id, truth);
        return id;
    }

    double worst(ObjectId id, const Truth& truth) {
        double least = 1;
        for (const auto& [frame, box] : truth.counted) least = std::min(least, likeness(id, frame, box));
        return least;
    }
    std::size_t keyframes(ObjectId id) { return labels().annotations().objects.at(id).keyframes.size(); }

    /// Which vehicle an object shows for at least half of its life, and in how many frames. Nobody mends what does not.
    std::pair<int, int> vehicleOf(ObjectId id, const std::map<int, Truth>& truth, bool& of_any) {
        std::pair<int, int> best{0, 0};
        of_any = false;
        for (const auto& [vehicle, known] : truth) {
            int frames = 0;
            for (const auto& [frame, box] : known.boxes) frames += likeness(id, frame, box) > 0.3 ? 1 : 0;
            of_any = of_any || frames > 0;
            if (frames > best.second) best = {vehicle, frames};
        }
        const LabelledObject& object = labels().annotations().objects.at(id);
        if (2 * best.second < object.last_frame - firstFrameOf(object) + 1) best = {0, 0};
        return best;
    }

    void takeOver() {
        press(Qt::Key_P);
        waitFor([&] { return !window_->labelling().proposals().working(); });
        press(Qt::Key_Return, Qt::ControlModifier);
    }
    /// A click each in the list, then one key.
    void removeObjects(const std::vector<ObjectId>& ids) {
        if (ids.empty()) return;
        labels().setSelection({ids.begin(), ids.end()}, ids.back());
        work.clicks += static_cast<int>(ids.size());
        press(Qt::Key_Delete, Qt::ShiftModifier);
    }
    void joinObjects(ObjectId first, ObjectId second) {
        labels().setSelection({first, second}, first);
        work.clicks += 2;
        press(Qt::Key_J, Qt::ShiftModifier);  // shows what it will do
        press(Qt::Key_J, Qt::ShiftModifier);
    }

 private:
    std::filesystem::path clip_;
    double gsd_;
    double rate_;
    double enough_;  ///< overlap with the truth that a box must have
    bool upright_;
    std::unique_ptr<MainWindow> window_;
};

}  // namespace eyrie::ui::test
