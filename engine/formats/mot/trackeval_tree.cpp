#include <algorithm>
#include <map>

#include "core/error.h"
#include "formats/format_functions.h"
#include "formats/mot/mot_tree.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/tables/number_text.h"

/// The tree that TrackEval runs on as it is:
///   gt/mot_challenge/<benchmark>-<split>/<sequence>/gt/gt.txt     class 1 what counts, class 8 what is ignored
///   gt/mot_challenge/<benchmark>-<split>/<sequence>/seqinfo.ini
///   gt/mot_challenge/seqmaps/<benchmark>-<split>.txt               grows by one line per sequence
///   trackers/mot_challenge/<benchmark>-<split>/<tracker>/data/<sequence>.txt
namespace eyrie {
namespace {

namespace fs = std::filesystem;

void makeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        throw Error(ErrorKind::output, folder.string() + ": cannot be made (" + error.message() + "); choose another");
    }
}

/// TrackEval uses ids as indices of arrays.
bool numberDensely(LabelBoxes& boxes) {
    std::map<int, int> number;
    for (const auto& [frame, records] : boxes) {
        for (const LabelBox& record : records) number[record.id.value_or(0)] = 0;
    }
    int next = 1;
    bool changed = false;
    for (auto& [id, dense] : number) {
        dense = next++;
        changed = changed || dense != id;
    }
    for (auto& [frame, records] : boxes) {
        for (LabelBox& record : records) record.id = number.at(record.id.value_or(0));
    }
    return changed;
}

void listSequence(const fs::path& seqmap, const std::string& sequence, ExportReport& report) {
    std::vector<std::string> lines{"name"};
    if (isFile(seqmap)) lines = readTextLines(seqmap);
    std::erase_if(lines, [](const std::string& line) { return line.find_first_not_of(" \t\r") == std::string::npos; });
    if (lines.empty()) lines.emplace_back("name");  // TrackEval passes over the first line and breaks on blank ones
    if (std::find(lines.begin(), lines.end(), sequence) == lines.end()) lines.push_back(sequence);
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    writeFileAtomically(seqmap, text);
    report.files.push_back(seqmap);
}

std::string seqinfo(const LabelFile& labels, const std::string& sequence) {
    std::string text = "[Sequence]\nname=" + sequence + "\nimDir=img1\n";
    text += "frameRate=" + fixedText(labels.frame_rate_hz.value_or(kAssumedRate_hz), 6) + '\n';
    text += "seqLength=" + std::to_string(std::max(1, framesToWrite(labels))) + '\n';
    if (labels.image_size) {
        text += "imWidth=" + std::to_string(labels.image_size->width) + '\n';
        text += "imHeight=" + std::to_string(labels.image_size->height) + '\n';
    }
    return text + "imExt=.png\n";
}

/// Places in the tree that an export with these options writes.
struct TreePlaces {
    TreePlaces(const fs::path& root, const ExportOptions& options) {
        const std::string sequence = pathWord(options.sequence);
        const std::string benchmark = pathWord(options.benchmark) + '-' + pathWord(options.split);
        const fs::path all = root / "gt" / "mot_challenge";
        truth = all / benchmark / sequence / "gt" / "gt.txt";
        seqinfo = all / benchmark / sequence / "seqinfo.ini";
        seqmap = all / "seqmaps" / (benchmark + ".txt");
        result =
            root / "trackers" / "mot_challenge" / benchmark / pathWord(options.tracker) / "data" / (sequence + ".txt");
    }
    fs::path truth, seqinfo, seqmap;
    fs::path result;  ///< of a tracker
};

std::vector<ExportFile> trackEvalFiles(const fs::path& root, const ExportOptions& options) {
    const TreePlaces places(root, options);
    if (!options.tracker.empty()) return {{places.result}};
    return {{places.truth}, {orientedSidecar(places.truth)}, {places.seqinfo}, {places.seqmap, FileKind::text, true}};
}

/// TrackEval compares upright boxes, so every box is enclosed, however little it is turned.
void encloseBoxes(LabelBoxes& boxes) {
    for (auto& [frame, records] : boxes) {
        for (LabelBox& record : records) record.box = record.box.upright();
    }
}

/// TrackEval ends when a result has frames behind the end of its sequence. Answers how many boxes those were.
int cutBehindEnd(LabelBoxes& boxes, const fs::path& seqinfo) {
    if (!isFile(seqinfo)) return 0;
    const std::optional<int> frames = readMotSequence(seqinfo).frame_count;
    int cut = 0;
    for (auto entry = boxes.lower_bound(frames.value_or(kFrameLimit)); entry != boxes.end();) {
        cut += static_cast<int>(entry->second.size());
        entry = boxes.erase(entry);
    }
    return cut;
}

/// A path as one word of a command, whatever folder that is run in.
std::string pathArgument(const fs::path& path) {
    const std::string text = fs::absolute(path).lexically_normal().string();
    const bool plain =
        text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789/._-+,:@%") ==
        std::string::npos;
    if (plain) return text;
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// The command whose figures are those of `evaluate`. Preprocessing would take out results that lie on ignored objects.
std::string commandFor(const fs::path& root, const ExportOptions& options) {
    return "run_mot_challenge.py --GT_FOLDER " + pathArgument(root / "gt/mot_challenge") + " --TRACKERS_FOLDER " +
           pathArgument(root / "trackers/mot_challenge") + " --BENCHMARK " + pathWord(options.benchmark) +
           " --SPLIT_TO_EVAL " + pathWord(options.split) +
           (options.tracker.empty() ? "" : " --TRACKERS_TO_EVAL " + pathWord(options.tracker)) +
           " --METRICS HOTA CLEAR Identity --DO_PREPROC False";
}

void writeTree(const LabelFile& labels, const fs::path& root, const ExportOptions& options, ExportReport& report) {
    const TreePlaces places(root, options);
    LabelFile dense = labels;
    encloseBoxes(dense.boxes);
    MotWriteOptions write;
    write.decimals = 9;  // so that no overlap comes to lie on the other side of a threshold
    if (numberDensely(dense.boxes))
        report.notes.push_back("ids were renumbered from 1 without gaps, as TrackEval needs");
    if (!options.tracker.empty()) {
        makeFolder(places.result.parent_path());
        report.add(
            LossKind::other, cutBehindEnd(dense.boxes, places.seqinfo),
            "lie after the last frame of the sequence's ground truth and were left out, as TrackEval refuses them");
        writeMotResult(places.result, framesOf(dense.boxes), write);
        report.files.push_back(places.result);
    } else {
        makeFolder(places.truth.parent_path());
        makeFolder(places.seqmap.parent_path());
        write.every_class_one = true;
        write.ignored_distract = true;
        const MotLosses losses = writeMotTruth(places.truth, dense.boxes, write);
        report.add(LossKind::class_name, losses.classes,
                   "became class 1, the only one that TrackEval scores (ignored ones 8)");
        report.files.push_back(places.truth);
        writeOrientedSidecar(framesOf(labels.boxes), places.truth, report);
        writeFileAtomically(places.seqinfo, seqinfo(labels, pathWord(options.sequence)));
        report.files.push_back(places.seqinfo);
        listSequence(places.seqmap, pathWord(options.sequence), report);
    }
    report.notes.push_back(commandFor(root, options));
    report.notes.push_back(
        "its figures are those of eyrie-cli evaluate --convention trackeval --overlap 0.5 --upright; results on "
        "ignored boxes are false alarms there");
}

std::vector<fs::path> sequencesOf(const fs::path& root) {
    std::vector<fs::path> found;
    for (const fs::path& top : {root / "gt" / "mot_challenge", root / "data" / "gt" / "mot_challenge"}) {
        if (!isFolder(top)) continue;
        for (const fs::path& benchmark : entriesOf(top)) {
            if (!isFolder(benchmark)) continue;
            for (const fs::path& sequence : entriesOf(benchmark)) {
                if (isFile(sequence / "gt" / "gt.txt")) found.push_back(sequence);
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

LabelFile readTree(const fs::path& root, const ImportOptions& options) {
    const std::vector<fs::path> sequences = sequencesOf(root);
    if (sequences.empty()) {
        throw Error(ErrorKind::input, root.string() + ": holds no gt/mot_challenge/<benchmark>/<sequence>/gt/gt.txt");
    }
    if (sequences.size() > 1) {
        throw Error(ErrorKind::input, root.string() + ": holds " + std::to_string(sequences.size()) +
                                          " sequences; name the folder of one, such as " + sequences.front().string());
    }
    return motFormat().read(sequences.front(), options);
}

}  // namespace

std::string pathWord(const std::string& name) {
    std::string word = name;
    for (char& c : word) {
        const bool fine = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
                          c == '_' || c == '.';
        if (!fine) c = '_';
    }
    const bool only_dots = word.find_first_not_of('.') == std::string::npos;
    return only_dots ? "_" + word : word;
}

LabelFormat trackEvalFormat() {
    LabelFormat format;
    format.info = {"trackeval", "TrackEval tree (MOTChallenge)", {}, true, true, true, {}};
    format.info.carries = {.id = true, .object_class = true, .occlusion = true, .ignore = true, .score = true};
    format.needs_id = true;
    format.read = readTree;
    format.write = writeTree;
    format.files = trackEvalFiles;
    format.fits = [](const FileHead& head) { return head.folder && !sequencesOf(head.path).empty(); };
    return format;
}

}  // namespace eyrie
