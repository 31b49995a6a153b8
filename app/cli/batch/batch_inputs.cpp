#include "cli/batch/batch_inputs.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <set>
#include <system_error>

#include "core/error.h"
#include "io/file_kind.h"
#include "io/folder.h"
#include "io/video/image_sequence.h"
#include "io/video/parts/part_list.h"

namespace eyrie::cli {
namespace {

namespace fs = std::filesystem;

std::int64_t lastWrite(const fs::path& path) {
    std::error_code failed;
    const auto time = fs::last_write_time(path, failed);
    if (failed) return 0;
    return std::chrono::nanoseconds(fs::file_time_type::clock::to_sys(time).time_since_epoch()).count();
}

std::uintmax_t sizeOf(const fs::path& path) {
    std::error_code failed;
    const std::uintmax_t size = fs::file_size(path, failed);
    return failed ? 0 : size;
}

BatchInput ofFile(const fs::path& path, const fs::path& name) {
    BatchInput input{fs::absolute(path).lexically_normal(), name, sizeOf(path), lastWrite(path), {}};
    if (!isFile(path)) input.fault = "no such file";
    return input;
}

BatchInput ofImages(const fs::path& folder, const fs::path& name, const std::vector<fs::path>& images) {
    BatchInput input{fs::absolute(folder).lexically_normal(), name, 0, 0, {}};
    for (const fs::path& image : images) {
        input.bytes += sizeOf(image);
        input.changed_ns = std::max(input.changed_ns, lastWrite(image));
    }
    return input;
}

/// Also one that has no bytes yet, or other ones than its name says: it is told, not left out.
bool isCalledVideo(const fs::path& path) {
    const FileKind kind = kindOfFile(path);
    if (kind == FileKind::video) return true;
    if (!hasVideoName(path)) return false;
    if (kind == FileKind::empty) return true;
    // Programs and translations are called so, too.
    return kind == FileKind::text && path.extension() != ".ts" && path.extension() != ".mts";
}

class Search {
 public:
    explicit Search(KnownFiles& files) : files_(files) {}

    void look(const fs::path& folder, const fs::path& name) {
        std::error_code failed;
        if (!seen_.insert(fs::canonical(folder, failed)).second) return;
        std::vector<fs::path> entries;
        try {
            entries = entriesOf(folder);
        } catch (const Error& error) {
            found.push_back({fs::absolute(folder).lexically_normal(), name, 0, 0, error.what()});
            return;
        }
        std::sort(entries.begin(), entries.end());
        std::vector<fs::path> images;
        bool has_video = false;
        for (const fs::path& entry : entries) {
            const fs::path called = name / entry.filename();
            if (entry.filename().string().starts_with('.')) continue;
            if (isFolder(entry)) {
                look(entry, called);
            } else if (isFile(entry) && hasPartListName(entry)) {
                takeFile(entry, called);
                has_video = true;
            } else if (isFile(entry) && ImageSequence::isImageFile(entry)) {
                images.push_back(entry);
            } else if (isFile(entry)) {
                has_video = takeVideo(ofFile(entry, called)) || has_video;
            }
        }
        if (!images.empty() && !has_video) found.push_back(ofImages(folder, name, images));
    }

    /// One that was named, whatever it is.
    void takeFile(const fs::path& path, const fs::path& name) {
        BatchInput input = ofFile(path, name);
        if (input.fault.empty() && hasPartListName(path)) addParts(input);
        found.push_back(std::move(input));
    }

    /// Whether a list that was found shows it already.
    bool isPart(const fs::path& file) const { return parts_.contains(file); }

    std::vector<BatchInput> found;

 private:
    void addParts(BatchInput& list) {
        try {
            for (const ListedPart& part : readPartList(list.path)) {
                list.bytes += sizeOf(part.file);
                list.changed_ns = std::max(list.changed_ns, lastWrite(part.file));
                parts_.insert(part.file.lexically_normal());
            }
        } catch (const Error& error) {
            list.fault = error.what();
        }
    }

    bool takeVideo(const BatchInput& file) {
        const auto [known, is_new] = files_.try_emplace(file.path, file, false);
        auto& [former, is_video] = known->second;
        if (is_new || !(former == file)) {
            is_video = isCalledVideo(file.path);
            former = file;
        }
        if (is_video) found.push_back(file);
        return is_video;
    }

    KnownFiles& files_;
    std::set<fs::path> seen_;
    std::set<fs::path> parts_;
};

fs::path lastName(const fs::path& place) {
    const fs::path whole = fs::absolute(place).lexically_normal();
    return whole.has_filename() ? whole.filename() : whole.parent_path().filename();
}

}  // namespace

std::vector<BatchInput> findInputs(const std::vector<std::string>& places) {
    KnownFiles none;
    return findInputs(places, none);
}

std::vector<BatchInput> findInputs(const std::vector<std::string>& places, KnownFiles& files) {
    Search search(files);
    for (const std::string& place : places) {
        if (isFolder(place)) {
            // One folder's own name says nothing; of several it keeps apart what they hold.
            search.look(place, places.size() > 1 ? lastName(place) : fs::path());
        } else {
            search.takeFile(place, lastName(place));
        }
    }
    for (BatchInput& input : search.found) {
        if (input.name.empty()) input.name = lastName(input.path);  // the only place is a folder of images
    }
    std::sort(search.found.begin(), search.found.end(),
              [](const BatchInput& a, const BatchInput& b) { return a.name < b.name; });
    std::set<fs::path> known;
    std::erase_if(search.found, [&](const BatchInput& input) {
        return search.isPart(input.path) || !known.insert(input.path).second;
    });
    return search.found;
}

std::filesystem::path nameOf(const BatchInput& input) {
    fs::path name = input.name;
    return isFolder(input.path) ? name : name.replace_extension();
}

std::filesystem::path nameOfWork(const BatchInput& input) {
    fs::path name = nameOf(input);
    while (hasVideoName(name) || hasPartListName(name)) name.replace_extension();
    return name;
}

bool Shard::takes(const std::filesystem::path& name_of_work) const {
    // FNV-1a, with its bits mixed so that names that differ in a digit spread evenly over few parts.
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char byte : name_of_work.generic_string()) {
        hash ^= static_cast<unsigned char>(byte);
        hash *= 0x100000001b3U;
    }
    hash = (hash ^ (hash >> 33U)) * 0xff51afd7ed558ccdU;
    hash ^= hash >> 33U;
    return hash % static_cast<std::uint64_t>(parts) == static_cast<std::uint64_t>(part - 1);
}

Shard shardFrom(const std::string& text) {
    Shard shard;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, shard.part);
    const bool divided = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
    const auto second = divided ? std::from_chars(first.ptr + 1, end, shard.parts) : first;
    if (!divided || second.ec != std::errc() || second.ptr != end || shard.parts < 1 || shard.part < 1 ||
        shard.part > shard.parts) {
        throw Error(ErrorKind::parameter,
                    "--shard " + text +
                        ": expected PART/PARTS with PART from 1 to PARTS, e.g. 2/8 (in a script for Slurm write PARTS "
                        "as a number: SLURM_ARRAY_TASK_COUNT is that of one submission)");
    }
    return shard;
}

}  // namespace eyrie::cli
