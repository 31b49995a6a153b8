#include "tracking/tracker_options.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

void describeAssociation(TrackerOptions& o, const ParameterDeclarer& declare) {
    declare.real("tracking.min_overlap", o.min_overlap, 0.01, 1,
                 {"",
                  "T_tov: a detection may belong to a track when their boxes overlap at least this much. Larger values "
                  "start second tracks on small boxes.",
                  "Teutsch §6.2.1, eq. 6.1"});
    declare.real("tracking.distance_gate_m", o.distance_gate_m, 0, 20,
                 {"m",
                  "A detection of similar size and motion may also belong to a track when its centre is this close to "
                  "the predicted one, even if the boxes hardly overlap. 0, with distance_gate_px 0: overlap only.",
                  ""});
    declare.real("tracking.distance_gate_px", o.distance_gate_px, 0, 50, {"px", "Pixel floor of distance_gate_m.", ""});
    declare.flag(
        "tracking.visible_overlap", o.visible_overlap,
        {"", "Overlaps of detections and tracks are taken inside the image, so that tracks survive its border.", ""});
    declare.real("tracking.max_turn", o.max_turn_deg, 1, 180,
                 {"degrees",
                  "A detection that moves in a direction further from the track's than this is another object. "
                  "180 switches the test off.",
                  ""});
    declare.choice("tracking.split_merge", o.split_merge, {"none", "overlap_matrix", "containment"},
                   {"",
                    "How split and merged detections are recognised. overlap_matrix: two ones in a row or column of "
                    "M_tov; containment: parts inside a predicted box, a large box over several predicted boxes.",
                    "Teutsch §6.2.1, §6.3"});
    declare.real(
        "tracking.part_containment", o.part_containment, 0.3, 1,
        {"",
         "Share of a detection that lies in a predicted box to be its part, and of a predicted box that a merged "
         "detection covers.",
         ""});
    declare.integer("tracking.split_patience", o.split_patience, 1, 1000,
                    {"frames",
                     "A track whose box keeps falling into separate parts for this long, and was seldom seen in one "
                     "piece, is taken for a merged one and releases the parts.",
                     ""});
    declare.real(
        "tracking.size_gate", o.size_gate, 0, 100,
        {"",
         "A detection whose area differs from the track's long-term area by more than this factor does not change "
         "the track's size. 0 switches the test off.",
         ""});
    declare.integer("tracking.size_patience", o.size_patience, 1, 1000,
                    {"frames", "After this many such detections in a row the new size is accepted.", ""});
    declare.real("tracking.car_length", o.car_length_m, 0, 50,
                 {"m", "Length of a usual car. A first box that is shorter is expected to grow.", ""});
    declare.real("tracking.car_width", o.car_width_m, 0, 20,
                 {"m", "Width of a usual car. A first box that is narrower is expected to grow.", ""});
    declare.real(
        "tracking.one_vehicle", o.one_vehicle, 0, 5,
        {"",
         "A box up to this many times a usual car holds one vehicle: it is no merged detection, and tracks that fit "
         "into it together are one. 0 switches the rule off.",
         ""});
}

void describeVectors(TrackerOptions& o, const ParameterDeclarer& declare) {
    declare.flag("tracking.use_vectors", o.use_vectors,
                 {"", "Rebuild the box from associated motion vectors when a detection is split, merged or missed.",
                  "Teutsch §6.2.2, §6.3"});
    declare.flag("tracking.vectors_first", o.vectors_first,
                 {"",
                  "Motion vectors join predicted boxes and so help in the same frame, and their places follow every "
                  "box. Otherwise they join updated boxes, only of tracks that are seen and not merged, and their "
                  "places follow detections.",
                  "Teutsch §6.2.2, fig. 6.6"});
    declare.choice(
        "tracking.rebuilt_size", o.rebuilt_size, {"predicted", "stored"},
        {"",
         "The size of a rebuilt box. stored: the median of the sizes that its vectors stored, each placed by its own "
         "vector's heading, and the box is measured like a detection; predicted: the track keeps its size, and the "
         "place is trusted more.",
         "Teutsch §6.3"});
    declare.integer("tracking.max_vectors", o.max_vectors, 1, 1000,
                    {"", "Largest number of motion vectors associated to a track.", "Teutsch §6.2.2"});
    declare.integer("tracking.min_vectors", o.min_vectors, 1, 1000,
                    {"", "Smallest number of motion vectors that may rebuild a box.", ""});
    declare.real(
        "tracking.agreement", o.agreement, 0, 10,
        {"",
         "Motion vectors agree on a box when they put its centre within this share of its shorter side (at least "
         "1.5 px); as many as min_vectors must. 0: no vote, every box is believed.",
         ""});
    declare.real(
        "tracking.vector_speed_difference", o.vector_speed_difference, 0.01, 2,
        {"",
         "A motion vector belongs to a track when its velocity differs from the track's by less than this share "
         "of the speed (or by five deviations of the background's speed).",
         "Teutsch §6.2.2"});
    declare.real(
        "tracking.relative_position_gain", o.relative_position_gain, 0.01, 1,
        {"", "How fast the stored place of a motion vector in its box follows new boxes; 1: replaced in every frame.",
         "Teutsch §6.5"});
    declare.integer("tracking.max_reconstructed", o.max_reconstructed, 0, 1000,
                    {"frames", "Longest run of rebuilt boxes without a detection of its own.", "Teutsch §6.3"});
    declare.integer("tracking.supported_hits", o.supported_hits, 1, 100000,
                    {"frames",
                     "Tracks detected at least this often may be rebuilt for max_supported instead. Motion vectors "
                     "also keep false tracks alive, which are seldom detected that often.",
                     ""});
    declare.real("tracking.max_supported", o.max_supported_s, 0, 60,
                 {"s", "Longest run of rebuilt boxes of a track with many detections.", ""});
}

void describeLife(TrackerOptions& o, const ParameterDeclarer& declare) {
    declare.integer(
        "tracking.confirm_hits", o.confirm_hits, 1, 64,
        {"frames", "A track is reliable once it was detected this often within confirm_window.", "Teutsch §6.4"});
    declare.integer("tracking.confirm_window", o.confirm_window, 1, 64,
                    {"frames", "Window for confirm_hits; at least as long.", "Teutsch §6.4"});
    declare.flag("tracking.follow_rate", o.follow_rate,
                 {"",
                  "Below 8 frames per second confirm_hits shrinks with the rate, to 4 at the least, and confirm_whole "
                  "holds: what crosses the picture is not there for longer.",
                  ""});
    declare.integer("tracking.confirm_whole", o.confirm_whole, 0, 64,
                    {"frames",
                     "Where follow_rate shortens the life that is asked for, a track is reliable, too, once a "
                     "classifier took so many of its detections for a whole vehicle. 0: never.",
                     ""});
    declare.integer("tracking.max_missing_tentative", o.max_missing_tentative, 0, 1000,
                    {"frames", "A tentative track is deleted when it was not detected for longer.", "Teutsch §6.4"});
    declare.real("tracking.max_missing", o.max_missing_s, 0, 60,
                 {"s",
                  "A confirmed track is deleted when it was predicted without any evidence for longer (at least two "
                  "frames).",
                  "Teutsch §6.4"});
    declare.real(
        "tracking.stop_speed", o.stop_speed_m_s, 0, 50,
        {"m/s", "A track that gets lost while slower than this is taken to have stopped: it stays where it is.", ""});
    declare.real("tracking.max_stopped", o.max_stopped_s, 0, 600,
                 {"s", "How long a stopped track is kept without a detection.", ""});
    declare.real(
        "tracking.max_leaving", o.max_leaving_s, 0, 60,
        {"s",
         "How long a track that is on its way out of the image is predicted without any evidence. 0: no longer than "
         "others.",
         ""});
    declare.choice(
        "tracking.appearance", o.appearance, {"none", "stopped", "lost"},
        {"",
         "Which lost tracks are searched for by their appearance when they were last detected. stopped: those "
         "that were slow; a vehicle that stands keeps its track and its id until it moves on.",
         ""});
    declare.real("tracking.appearance_agreement", o.appearance_agreement, 0.1, 1,
                 {"",
                  "Lowest normalised correlation at which a place looks like the vehicle. It does not depend on how "
                  "bright the light is.",
                  ""});
    declare.real("tracking.appearance_margin", o.appearance_margin, 0, 1,
                 {"",
                  "How much better the vehicle's look must agree with its place than with the picture half a vehicle "
                  "beside it.",
                  ""});
    declare.real("tracking.max_hidden", o.max_hidden_s, 0, 60,
                 {"s",
                  "How long the place of a standing vehicle may look different, as something passes in front of it, "
                  "before its track ends.",
                  ""});
    declare.real("tracking.max_standing", o.max_standing_s, 0, 3600,
                 {"s", "How long a track is kept by its appearance alone.", ""});
    declare.real("tracking.max_failed", o.max_failed_s, 0, 60,
                 {"s", "All tracks end when the registration failed for longer than this.", ""});
    declare.real("tracking.min_visible", o.min_visible, 0, 1,
                 {"", "A track ends when less than this share of its box lies in the image.", ""});
    declare.flag("tracking.suppress_duplicates", o.suppress_duplicates,
                 {"", "Of two tracks that lie on each other and move alike, keep the older one.", "Teutsch §8.2"});
    declare.real("tracking.duplicate_overlap", o.duplicate_overlap, 0.05, 1,
                 {"", "Lowest overlap at which two tracks that move alike are one.", ""});
    declare.real(
        "tracking.duplicate_containment", o.duplicate_containment, 0.05, 1,
        {"",
         "Lowest share of the smaller box inside the other at which two tracks that move alike are one. A detection "
         "inside a track by this share starts no track.",
         ""});
}

void describeMeasurement(TrackerOptions& o, const ParameterDeclarer& declare) {
    declare.flag("tracking.complete_at_border", o.complete_at_border,
                 {"", "Boxes that the image's border cuts off are completed to the track's size.", ""});
    declare.flag(
        "tracking.adapt_size", o.adapt_size,
        {"",
         "What a box says about size depends on how sure it is: ends are measured one by one, young tracks soon "
         "forget their first sizes, boxes of another size say less about the place.",
         ""});
    declare.flag(
        "tracking.measure_velocity", o.measure_velocity,
        {"",
         "The velocity of a detection or of the vectors that rebuild a box is measured, too. Otherwise it follows "
         "from the places alone.",
         ""});
}

void describeNoise(TrackerOptions& o, const ParameterDeclarer& declare) {
    declare.real(
        "tracking.acceleration", o.acceleration_m_s2, 0.01, 100,
        {"m/s²", "Deviation of an object's acceleration. Larger values follow manoeuvres faster and smooth less.",
         "Teutsch §6.5"});
    declare.real("tracking.turn_rate", o.turn_rate_deg, 0.1, 720,
                 {"degrees/s", "Deviation of an object's turn rate.", "Teutsch §6.5"});
    declare.real("tracking.size_rate", o.size_rate_m, 0, 10,
                 {"m",
                  "Deviation by which the size of an object changes from frame to frame. Vehicles keep theirs; small "
                  "changes come from the view.",
                  "Teutsch §6.5"});
    declare.real(
        "tracking.position_noise_m", o.position_noise_m, 0, 20,
        {"m",
         "Deviation of a detection's centre. Where adapt_size measures the ends of a box, it follows from size_noise.",
         "Teutsch §6.5"});
    declare.real(
        "tracking.position_noise_px", o.position_noise_px, 0.01, 50,
        {"px",
         "The same, the part that does not scale; and the deviation of places from motion vectors or from a vehicle's "
         "look.",
         ""});
    declare.real("tracking.size_noise_m", o.size_noise_m, 0, 20,
                 {"m", "Deviation of a detection's length and width.", "Teutsch §6.5"});
    declare.real("tracking.size_noise_px", o.size_noise_px, 0.01, 50,
                 {"px", "The same, the part that does not scale.", ""});
    declare.real("tracking.heading_noise", o.heading_noise_deg, 0.1, 90,
                 {"degrees", "Deviation of a fast detection's heading; slow ones are less certain by their speed.",
                  "Teutsch §6.5"});
    declare.real("tracking.velocity_noise", o.velocity_noise_m_s, 0, 50,
                 {"m/s", "Deviation of a detection's velocity.", ""});
    declare.real("tracking.velocity_noise_px", o.velocity_noise_px, 0.001, 10,
                 {"px/frame", "The same, the part that does not scale.", ""});
    declare.real(
        "tracking.slow_speed", o.slow_speed_sigmas, 0, 100,
        {"",
         "Below this many deviations of the background's speed a velocity tells no direction: the track keeps its "
         "heading.",
         ""});
}

}  // namespace

void TrackerOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::tracking);
    describeAssociation(*this, declare);
    describeVectors(*this, declare);
    describeLife(*this, declare);
    describeMeasurement(*this, declare);
    describeNoise(*this, declare);
}

TrackerOptions TrackerOptions::atRate(double frame_rate_hz) const {
    constexpr double kSeen_s = 0.6;  // five frames at the rate from which on the count holds
    constexpr int kFewestHits = 4;
    TrackerOptions here = *this;
    if (!follow_rate || !(frame_rate_hz * kSeen_s < 5)) {
        here.confirm_whole = 0;
        return here;
    }
    const int by_time = static_cast<int>(std::lround(confirm_hits * frame_rate_hz * kSeen_s / 5));
    here.confirm_hits = std::max(by_time, std::min(confirm_hits, kFewestHits));
    return here;
}

int TrackerOptions::fewestDetections() const {
    return std::max(1, confirm_whole > 0 ? std::min(confirm_hits, confirm_whole) : confirm_hits);
}

TrackerOptions TrackerOptions::thesis() {
    TrackerOptions options;
    options.min_overlap = 0.5;
    options.distance_gate_m = 0;
    options.distance_gate_px = 0;
    options.visible_overlap = false;
    options.max_turn_deg = 180;
    options.follow_rate = false;
    options.confirm_whole = 0;
    options.split_merge = SplitMergeRule::overlap_matrix;
    options.size_gate = 0;
    options.car_length_m = 0;
    options.car_width_m = 0;
    options.one_vehicle = 0;
    options.vectors_first = true;
    options.rebuilt_size = RebuiltSize::stored;
    options.max_vectors = 20;
    options.min_vectors = 1;
    options.agreement = 0;
    options.relative_position_gain = 1;
    options.max_reconstructed = 10;
    options.max_supported_s = 0;
    options.stop_speed_m_s = 0;
    options.max_leaving_s = 0;
    options.appearance = AppearanceUse::none;
    options.min_visible = 0;
    options.suppress_duplicates = false;
    options.complete_at_border = false;
    options.adapt_size = false;
    options.measure_velocity = false;
    options.slow_speed_sigmas = 0;
    return options;
}

}  // namespace eyrie
