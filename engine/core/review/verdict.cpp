#include "core/review/verdict.h"

#include <algorithm>
#include <array>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr std::array<const char*, 4> kJudgementNames = {"open", "relevant", "not relevant", "unsure"};

}  // namespace

const char* nameOf(Judgement judgement) {
    return kJudgementNames.at(static_cast<std::size_t>(judgement));
}

Judgement judgementOf(const std::string& name) {
    std::string wanted = name;
    std::replace_if(
        wanted.begin(), wanted.end(), [](char c) { return c == '-' || c == '_'; }, ' ');
    for (std::size_t i = 0; i < kJudgementNames.size(); ++i) {
        if (wanted == kJudgementNames.at(i)) return static_cast<Judgement>(i);
    }
    throw Error(ErrorKind::parameter,
                "there is no verdict \"" + name + "\"; there are: open, relevant, not relevant, unsure");
}

std::vector<std::string> tagsOf(const std::string& text) {
    constexpr char kBlanks[] = " \t\r\n";
    std::vector<std::string> tags;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        std::string tag = text.substr(at, end - at);
        at = end + 1;
        const std::size_t first = tag.find_first_not_of(kBlanks);
        if (first == std::string::npos) continue;
        tag = tag.substr(first, tag.find_last_not_of(kBlanks) - first + 1);
        if (std::find(tags.begin(), tags.end(), tag) == tags.end()) tags.push_back(std::move(tag));
    }
    return tags;
}

std::string tagText(const std::vector<std::string>& tags) {
    std::string text;
    for (const std::string& tag : tags) text += (text.empty() ? "" : ", ") + tag;
    return text;
}

}  // namespace eyrie
