#include "tune/inspect/stage_chips.h"

#include <QCoreApplication>
#include <QLocale>
#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "canvas/drawing/image_convert.h"
#include "removal/rejection_counts.h"

namespace eyrie::ui {

namespace {

constexpr int kHistogramBins = 64;

QString translated(const char* text) {
    return QCoreApplication::translate("StageChips", text);
}

QString numberText(double value) {
    return QLocale().toString(value, 'f', std::abs(value) < 10 ? 2 : 0);
}

/// The thesis' words for a step of a detector.
QString layerTitle(const DetectionTrace::Layer& layer) {
    switch (layer.kind) {
        case TraceLayer::raw:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Motion ROI"));
        case TraceLayer::gradient:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Gradient"));
        case TraceLayer::lbp_mask:
            return translated(QT_TRANSLATE_NOOP("StageChips", "LBP filter mask"));
        case TraceLayer::quantile_area:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Quantile area"));
        case TraceLayer::binary:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Binary image"));
        case TraceLayer::closed:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Closing"));
        case TraceLayer::components:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Components"));
        case TraceLayer::bright_lines:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Accumulator, bright"));
        case TraceLayer::bright_areas:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Bright areas"));
        case TraceLayer::dark_lines:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Accumulator, dark"));
        case TraceLayer::dark_areas:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Dark areas"));
        case TraceLayer::fused:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Fused (max)"));
        case TraceLayer::decision:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Decision ×%1"))
                .arg(QLocale().toString(layer.scale, 'f', 2));
        case TraceLayer::first_suppression:
            return translated(QT_TRANSLATE_NOOP("StageChips", "First NMS"));
        case TraceLayer::second_suppression:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Second NMS"));
        case TraceLayer::smoothed:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Smoothed"));
        case TraceLayer::white_tophat:
            return translated(QT_TRANSLATE_NOOP("StageChips", "White tophat"));
        case TraceLayer::black_tophat:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Black tophat"));
        case TraceLayer::regions:
            return translated(QT_TRANSLATE_NOOP("StageChips", "MSER regions"));
        case TraceLayer::edges:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Canny edges"));
        case TraceLayer::corners:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Harris corners"));
        case TraceLayer::clustered:
            return translated(QT_TRANSLATE_NOOP("StageChips", "Clustered"));
    }
    return {};
}

/// Whether the values of a layer are grey values, those of the picture or made of them.
bool isGrey(TraceLayer kind) {
    return kind == TraceLayer::raw || kind == TraceLayer::smoothed || kind == TraceLayer::white_tophat ||
           kind == TraceLayer::black_tophat || kind == TraceLayer::first_suppression ||
           kind == TraceLayer::second_suppression;
}

/// Labels from 1 in colours that tell neighbours apart, 0 black.
QImage labelImage(const cv::Mat& labels) {
    QImage image(labels.cols, labels.rows, QImage::Format_RGB32);
    for (int y = 0; y < labels.rows; ++y)
        for (int x = 0; x < labels.cols; ++x) {
            const int label = labels.at<uchar>(y, x);
            image.setPixelColor(x, y, label == 0 ? QColor(Qt::black) : stackColour(label));
        }
    return image;
}

/// Above zero, which speaks for a vehicle, orange; below blue; zero black.
QImage signedImage(const cv::Mat& values, double largest) {
    QImage image(values.cols, values.rows, QImage::Format_RGB32);
    for (int y = 0; y < values.rows; ++y)
        for (int x = 0; x < values.cols; ++x) {
            const double share = largest > 0 ? values.at<float>(y, x) / largest : 0;
            const int strength = std::min(255, static_cast<int>(std::abs(share) * 255));
            image.setPixel(x, y,
                           share > 0 ? qRgb(strength, strength * 6 / 10, strength / 8)
                                     : qRgb(strength / 8, strength * 4 / 10, strength));
        }
    return image;
}

Chip greyChip(const QString& title, const cv::Mat& gray) {
    Chip chip;
    chip.title = title;
    chip.values = gray;
    if (gray.empty()) return chip;
    chip.image = wrapImage(gray);
    chip.unit = translated("grey");
    return chip;
}

/// CV_32FC1 from its smallest (or 0) to its largest value.
Chip realChip(const QString& title, const cv::Mat& values) {
    Chip chip;
    chip.title = title;
    chip.values = values;
    if (values.empty()) return chip;
    double least = 0;
    double largest = 0;
    cv::minMaxLoc(values, &least, &largest);
    if (least < 0) {
        chip.image = signedImage(values, std::max(-least, largest));
    } else {
        cv::Mat gray;
        values.convertTo(gray, CV_8U, largest > 0 ? 255 / largest : 0);
        chip.image = wrapImage(gray);
    }
    chip.note = QStringLiteral("%1 … %2").arg(numberText(std::min(0.0, least)), numberText(largest));
    return chip;
}

QRectF rectangle(const cv::Rect2d& box) {
    return {box.x, box.y, box.width, box.height};
}

Chip layerChip(const DetectionTrace::Layer& layer) {
    const QString title = layerTitle(layer);
    Chip chip;
    if (layer.image.type() == CV_32FC1) {
        chip = realChip(title, layer.image);
    } else {
        chip = greyChip(title, layer.image);
        if (layer.kind == TraceLayer::components) chip.image = labelImage(layer.image);
        if (!isGrey(layer.kind)) chip.unit.clear();
    }
    for (const cv::Rect2d& box : layer.boxes) chip.boxes.push_back(rectangle(box));
    if (!layer.boxes.empty())
        chip.note = layer.boxes.size() == 1 ? translated("1 box") : translated("%1 boxes").arg(layer.boxes.size());
    if (layer.kind == TraceLayer::decision && cv::countNonZero(layer.image) == 0)
        chip.note = translated("all given up early");
    return chip;
}

const cv::Mat* imageOf(const DetectionTrace& trace, TraceLayer kind) {
    for (const auto& layer : trace.layers)
        if (layer.kind == kind) return &layer.image;
    return nullptr;
}

/// The gradients that the quantile was taken of, and the quantile.
std::optional<Chip> quantileChip(const DetectionTrace& trace) {
    const cv::Mat* gradient = imageOf(trace, TraceLayer::gradient);
    const cv::Mat* area = imageOf(trace, TraceLayer::quantile_area);
    if (gradient == nullptr || area == nullptr || gradient->empty()) return std::nullopt;
    Chip chip;
    chip.title = translated("Histogram");
    chip.values = *gradient;
    ChipHistogram histogram;
    double largest = 0;
    cv::minMaxLoc(*gradient, nullptr, &largest, nullptr, nullptr, *area);
    histogram.largest = std::max(1.0, largest);
    histogram.counts.assign(kHistogramBins, 0);
    for (int y = 0; y < gradient->rows; ++y)
        for (int x = 0; x < gradient->cols; ++x) {
            if (area->at<uchar>(y, x) == 0) continue;
            const double share = static_cast<double>(gradient->at<float>(y, x)) / histogram.largest;
            ++histogram.counts[static_cast<std::size_t>(
                std::clamp(static_cast<int>(share * kHistogramBins), 0, kHistogramBins - 1))];
        }
    const cv::Mat* binary = imageOf(trace, TraceLayer::binary);
    if (binary != nullptr && cv::countNonZero(*binary) > 0) {
        double threshold = 0;
        cv::minMaxLoc(*gradient, &threshold, nullptr, nullptr, nullptr, *binary);
        histogram.threshold = threshold;
        chip.note = translated("quantile %1").arg(numberText(threshold));
    }
    chip.histogram = std::move(histogram);
    return chip;
}

/// Boxes of the image in the coordinates of a motion ROI, upright there.
std::vector<QRectF> inRoi(const MotionRoi& roi, const std::vector<OrientedBox>& boxes) {
    cv::Matx23d roi_from_image;
    cv::invertAffineTransform(roi.image_from_roi, roi_from_image);
    std::vector<QRectF> rectangles;
    for (const OrientedBox& box : boxes) {
        QPolygonF corners;
        for (const cv::Point2d& corner : box.corners()) {
            const cv::Vec2d point = roi_from_image * cv::Vec3d(corner.x, corner.y, 1);
            corners << QPointF(point[0], point[1]);
        }
        rectangles.push_back(corners.boundingRect());
    }
    return rectangles;
}

/// Part of a whole picture, cut and turned like a motion ROI.
cv::Mat cutLike(const MotionRoi& roi, const cv::Mat& picture) {
    cv::Mat cut;
    cv::warpAffine(picture, cut, roi.image_from_roi, roi.image.size(), cv::INTER_NEAREST | cv::WARP_INVERSE_MAP);
    return cut;
}

ChipCard card(Chip chip) {
    ChipCard made;
    made.chips.push_back(std::move(chip));
    return made;
}

QString referenceTitle(MotionMethod method) {
    return method == MotionMethod::median_background ? translated("Background") : translated("Earlier frame");
}

void addDifferences(std::vector<ChipCard>& cards, const ReplayView& view, const MotionRoi* roi) {
    const DifferenceResult& result = *view.differences;
    if (result.difference.values.empty()) return;
    const auto cut = [roi](const cv::Mat& picture) { return roi != nullptr ? cutLike(*roi, picture) : picture; };
    cards.push_back(card(greyChip(referenceTitle(view.options.difference.method), cut(result.difference.reference))));
    Chip difference = realChip(translated("Difference"), cut(result.difference.values));
    difference.unit = translated("grey");
    cards.push_back(card(std::move(difference)));
    Chip moving = greyChip(translated("Moving pixels"), cut(result.moving));
    moving.unit.clear();
    moving.note = translated("difference > %1").arg(numberText(result.threshold));
    cards.push_back(card(std::move(moving)));
}

/// "1 of 3: 1 duplicate, 1 outlier".
QString removalNote(const RejectionCounts& counts) {
    QStringList removed;
    const auto add = [&](Rejection rejection, const char* one, const char* many) {
        const int count = counts[rejection];
        if (count > 0) removed << (count == 1 ? translated(one) : translated(many).arg(count));
    };
    add(Rejection::duplicate, QT_TRANSLATE_NOOP("StageChips", "1 duplicate"),
        QT_TRANSLATE_NOOP("StageChips", "%1 duplicates"));
    add(Rejection::outlier, QT_TRANSLATE_NOOP("StageChips", "1 outlier"),
        QT_TRANSLATE_NOOP("StageChips", "%1 outliers"));
    add(Rejection::size, QT_TRANSLATE_NOOP("StageChips", "1 of a wrong size"),
        QT_TRANSLATE_NOOP("StageChips", "%1 of a wrong size"));
    QString note = translated("%1 of %2").arg(counts.kept()).arg(counts.delivered());
    if (!removed.isEmpty()) note += QStringLiteral(": ") + removed.join(QStringLiteral(", "));
    return note;
}

Chip keptChip(const ReplayView& view, const SearchTrace& traced) {
    Chip chip = greyChip(translated("Kept"), traced.roi.image);
    std::vector<OrientedBox> kept;
    for (const Detection& detection : view.result.detections)
        if (detection.cluster == view.wish.cluster && detection.rejection == Rejection::none)
            kept.push_back(detection.box);
    chip.boxes = inRoi(traced.roi, kept);
    chip.note = removalNote(countRejections(view.result.detections, view.wish.cluster));
    return chip;
}

}  // namespace

std::vector<ChipCard> stageChips(const ReplayView& view, std::size_t trace) {
    std::vector<ChipCard> cards;
    if (trace >= view.traces.size()) return cards;
    const SearchTrace& traced = view.traces[trace];
    if (view.differences) addDifferences(cards, view, &traced.raw);
    const bool stacked = traced.roi.stack_layers > 0;
    if (stacked) cards.push_back(card(greyChip(translated("Raw chip"), traced.raw.image)));
    for (const auto& layer : traced.trace.layers) {
        if (layer.image.empty()) continue;
        Chip chip = layerChip(layer);
        if (stacked && layer.kind == TraceLayer::raw) {
            chip.title = translated("Stacked image");
            chip.note = translated("%1 layers").arg(traced.roi.stack_layers);
        }
        if (layer.kind == TraceLayer::binary)
            if (auto histogram = quantileChip(traced.trace)) cards.push_back(card(std::move(*histogram)));
        cards.push_back(card(std::move(chip)));
    }
    cards.push_back(card(keptChip(view, traced)));
    if (view.general && trace == 0) {
        const auto add = [&cards](const QString& title, const cv::Mat& drawn) {
            Chip chip;
            chip.title = title;
            chip.values = drawn;
            if (!drawn.empty()) chip.image = wrapImage(drawn);
            cards.push_back(card(std::move(chip)));
        };
        add(translated("SLIC superpixels"), view.general->superpixels);
        add(translated("Watershed"), view.general->watershed);
        add(translated("Graph cut"), view.general->graph_cut);
        add(translated("gPb-OWT-UCM"), view.general->contours);
    }
    return cards;
}

std::vector<ChipCard> differenceChips(const ReplayView& view) {
    std::vector<ChipCard> cards;
    if (!view.differences) return cards;
    addDifferences(cards, view, nullptr);
    if (cards.empty()) return cards;
    Chip over;
    over.title = translated("Over the frame");
    over.values = differenceView(view.frame.gray, view.differences->difference);
    over.image = wrapImage(over.values);
    cards.insert(cards.begin(), card(std::move(over)));
    return cards;
}

std::vector<ChipCard> stackChips(const ReplayView& view) {
    std::vector<ChipCard> cards;
    for (const StackView& stack : view.stacks) {
        ChipCard made;
        made.id = stack.id;
        made.colour = stackColour(stack.id);
        made.heading = translated("Stack %1").arg(stack.id);
        made.chips.push_back(greyChip(translated("Raw chip"), stack.raw));
        made.chips.back().note =
            stack.related.size() == 1 ? translated("1 vector") : translated("%1 vectors").arg(stack.related.size());
        made.chips.push_back(greyChip(translated("Stacked image"), stack.stacked));
        made.chips.back().note =
            stack.searched ? translated("height %1").arg(stack.height)
                           : translated("height %1 of %2").arg(stack.height).arg(view.options.stacking.min_height);
        cards.push_back(std::move(made));
    }
    return cards;
}

std::vector<StackMark> stackMarks(const ReplayView& view) {
    std::vector<StackMark> marks;
    for (const StackView& stack : view.stacks) {
        StackMark mark{stack.id, stack.pose.position, stack.pose.heading, stack.height, {}};
        for (const MotionVector& vector : view.result.motion.motion_vectors)
            if (std::find(stack.related.begin(), stack.related.end(), vector.id) != stack.related.end())
                mark.related.push_back(vector.position);
        marks.push_back(std::move(mark));
    }
    return marks;
}

}  // namespace eyrie::ui
