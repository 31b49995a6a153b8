#include "core/review/verdict.h"

#include <gmock/gmock.h>

#include "core/error.h"

namespace eyrie::verdict_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(Verdict, WordsReadBack) {
    for (const Judgement judgement :
         {Judgement::open, Judgement::relevant, Judgement::not_relevant, Judgement::unsure}) {
        EXPECT_EQ(judgementOf(nameOf(judgement)), judgement);
    }
    EXPECT_EQ(judgementOf("not-relevant"), Judgement::not_relevant);
    EXPECT_EQ(judgementOf("not_relevant"), Judgement::not_relevant);
    EXPECT_THROW(judgementOf("good"), Error);
}

TEST(Verdict, TagsAreTrimmedAndToldOnce) {
    EXPECT_THAT(tagsOf("  gate 3,lorry , ,gate 3,\n"), ElementsAre("gate 3", "lorry"));
    EXPECT_THAT(tagsOf(""), IsEmpty());
    EXPECT_EQ(tagText({"gate 3", "lorry"}), "gate 3, lorry");
    EXPECT_THAT(tagsOf(tagText({"a", "b"})), ElementsAre("a", "b"));
}

}  // namespace
}  // namespace eyrie::verdict_test
