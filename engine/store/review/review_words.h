#pragma once

#include "core/review/verdict.h"
#include "store/runs/stored_words.h"

/// Words of reviewing in the file, apart from those on screen.
namespace eyrie::stored {

inline constexpr std::array<Word<std::optional<EventKind>>, kEventKinds + 1> kSubjectKinds{
    {{EventKind::appears, "appears"},
     {EventKind::leaves, "leaves"},
     {EventKind::lost, "lost"},
     {EventKind::starts, "starts"},
     {EventKind::stops, "stops"},
     {EventKind::stands, "stands"},
     {EventKind::turns_back, "turns back"},
     {EventKind::against_flow, "against the flow"},
     {EventKind::leaves_flow, "leaves the flow"},
     {EventKind::over_speed, "over speed"},
     {EventKind::under_speed, "under speed"},
     {EventKind::convoy, "convoy"},
     {EventKind::meeting, "meeting"},
     {EventKind::loiters, "loiters"},
     {EventKind::enters, "enters"},
     {EventKind::exits, "exits"},
     {EventKind::crosses, "crosses"},
     {std::nullopt, "not searched"}}};
inline constexpr std::array<Word<CrossingSense>, 3> kCrossingSenses{
    {{CrossingSense::none, ""}, {CrossingSense::to_right, "to the right"}, {CrossingSense::to_left, "to the left"}}};
inline constexpr std::array<Word<ZoneShape>, 3> kZoneShapes{
    {{ZoneShape::area, "area"}, {ZoneShape::line, "line"}, {ZoneShape::arrow, "arrow"}}};
inline constexpr std::array<Word<ZoneAnchor>, 2> kZoneAnchors{
    {{ZoneAnchor::image, "image"}, {ZoneAnchor::ground, "ground"}}};
inline constexpr std::array<Word<CorrectionKind>, 4> kCorrectionKinds{{{CorrectionKind::add, "add"},
                                                                       {CorrectionKind::join, "join"},
                                                                       {CorrectionKind::split, "split"},
                                                                       {CorrectionKind::reject, "reject"}}};
inline constexpr std::array<Word<Judgement>, 4> kJudgements{{{Judgement::open, "open"},
                                                             {Judgement::relevant, "relevant"},
                                                             {Judgement::not_relevant, "not relevant"},
                                                             {Judgement::unsure, "unsure"}}};

}  // namespace eyrie::stored
