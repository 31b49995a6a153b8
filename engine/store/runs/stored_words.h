#pragma once

#include <array>
#include <string_view>

#include "core/evidence/light_finding.h"
#include "core/labels/annotation.h"
#include "core/values/corner.h"
#include "core/values/detection.h"
#include "core/values/dropped_state.h"
#include "core/values/frame_result.h"
#include "core/values/scale_basis.h"
#include "core/values/track_state.h"
#include "store/runs/run_store.h"

/// Enumerators as words in the file, apart from the words on screen: they may not change when those do.
namespace eyrie::stored {

/// The word by which a project file knows an enumerator.
template <class Enum>
struct Word {
    Enum value;
    std::string_view word;
};

inline constexpr std::array<Word<RunState>, 4> kRunStates{{{RunState::running, "running"},
                                                           {RunState::finished, "finished"},
                                                           {RunState::stopped, "stopped"},
                                                           {RunState::failed, "failed"}}};
inline constexpr std::array<Word<ScaleOrigin>, 4> kScaleOrigins{{{ScaleOrigin::given, "given"},
                                                                 {ScaleOrigin::metadata, "metadata"},
                                                                 {ScaleOrigin::estimated, "estimated"},
                                                                 {ScaleOrigin::assumed, "assumed"}}};
inline constexpr std::array<Word<RegistrationState>, 4> kRegistrationStates{
    {{RegistrationState::first, "first"},
     {RegistrationState::registered, "registered"},
     {RegistrationState::frozen, "frozen"},
     {RegistrationState::failed, "failed"}}};
inline constexpr std::array<Word<RegistrationFault>, 7> kRegistrationFaults{
    {{RegistrationFault::none, ""},
     {RegistrationFault::too_few_corners, "too few corners"},
     {RegistrationFault::no_match, "no match"},
     {RegistrationFault::cut, "cut"},
     {RegistrationFault::too_few_found_again, "too few found again"},
     {RegistrationFault::too_few_agree, "too few agree"},
     {RegistrationFault::impossible_motion, "impossible motion"}}};
inline constexpr std::array<Word<PictureQuality>, 3> kPictureQualities{
    {{PictureQuality::clear, "clear"}, {PictureQuality::blurred, "blurred"}, {PictureQuality::blank, "blank"}}};
inline constexpr std::array<Word<Rejection>, 4> kRejections{{{Rejection::none, "none"},
                                                             {Rejection::duplicate, "duplicate"},
                                                             {Rejection::outlier, "outlier"},
                                                             {Rejection::size, "size"}}};
/// Of two words for one enumerator the first is written: there are millions of states.
inline constexpr std::array<Word<TrackStatus>, 5> kTrackStatuses{{{TrackStatus::confirmed, ""},
                                                                  {TrackStatus::coasting, "c"},
                                                                  {TrackStatus::tentative, "tentative"},
                                                                  {TrackStatus::confirmed, "confirmed"},
                                                                  {TrackStatus::coasting, "coasting"}}};
inline constexpr std::array<Word<TrackDrop>, 9> kTrackDrops{{{TrackDrop::unconfirmed, "unconfirmed"},
                                                             {TrackDrop::too_small, "too small"},
                                                             {TrackDrop::wider_than_long, "wider than long"},
                                                             {TrackDrop::shares_place, "shares place"},
                                                             {TrackDrop::shadow, "shadow"},
                                                             {TrackDrop::hardly_detected, "hardly detected"},
                                                             {TrackDrop::on_graphics, "on graphics"},
                                                             {TrackDrop::could_stand, "could stand"},
                                                             {TrackDrop::unlikely, "unlikely"}}};
inline constexpr std::array<Word<LightOutcome>, 10> kLightOutcomes{{{LightOutcome::shadows, "shadows"},
                                                                    {LightOutcome::beams, "beams"},
                                                                    {LightOutcome::switched_off, "switched off"},
                                                                    {LightOutcome::no_scale, "no scale"},
                                                                    {LightOutcome::no_classifier, "no classifier"},
                                                                    {LightOutcome::no_pictures, "no pictures"},
                                                                    {LightOutcome::few_vehicles, "few vehicles"},
                                                                    {LightOutcome::short_shadows, "short shadows"},
                                                                    {LightOutcome::disagreement, "disagreement"},
                                                                    {LightOutcome::shaded_sides, "shaded sides"}}};
inline constexpr std::array<Word<StateOrigin>, 8> kStateOrigins{{{StateOrigin::detected, ""},
                                                                 {StateOrigin::reconstructed, "r"},
                                                                 {StateOrigin::predicted, "p"},
                                                                 {StateOrigin::standing, "s"},
                                                                 {StateOrigin::detected, "detected"},
                                                                 {StateOrigin::reconstructed, "reconstructed"},
                                                                 {StateOrigin::predicted, "predicted"},
                                                                 {StateOrigin::standing, "standing"}}};

inline constexpr std::array<Word<ObjectOrigin>, 4> kObjectOrigins{
    {{ObjectOrigin::hand, "hand"},
     {ObjectOrigin::proposal_accepted, "proposal accepted"},
     {ObjectOrigin::proposal_corrected, "proposal corrected"},
     {ObjectOrigin::imported, "imported"}}};
inline constexpr std::array<Word<RegionAnchor>, 2> kRegionAnchors{
    {{RegionAnchor::image, "image"}, {RegionAnchor::ground, "ground"}}};
inline constexpr std::array<Word<ReviewState>, 3> kReviewStates{
    {{ReviewState::unseen, "unseen"}, {ReviewState::checked, "checked"}, {ReviewState::questionable, "questionable"}}};

/// Columns of table `frame`, in the order of `Stage`.
inline constexpr std::array<const char*, kStageCount> kStageColumns{
    "read_ms",     "corners_ms",   "corner_tracking_ms", "homography_ms", "motion_ms", "clustering_ms",
    "stacking_ms", "detection_ms", "removal_ms",         "tracking_ms",   "store_ms"};

}  // namespace eyrie::stored
