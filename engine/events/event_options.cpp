#include "events/event_options.h"

namespace eyrie {
namespace {

void describeMotion(EventOptions& options, const ParameterDeclarer& declare) {
    declare.real(
        "events.smooth", options.smooth_s, 0.1, 10,
        {"s",
         "Speeds and directions are measured over this time. Longer: steadier, but short stops and turns are blurred.",
         ""});
    declare.real("events.noise", options.noise, 0, 10,
                 {"px",
                  "How far boxes stray from their vehicles (standard deviation). What moves no faster than that alone "
                  "could make it seem counts as standing.",
                  ""});
    declare.real("events.standing_speed", options.standing_speed_kmh, 0, 50,
                 {"km/h", "A driving vehicle counts as standing once it is slower than this.", ""});
    declare.real("events.moving_speed", options.moving_speed_kmh, 0, 100,
                 {"km/h",
                  "A standing vehicle counts as driving once it is faster than this, from the moment it passed "
                  "standing_speed. Between the two it stays what it was.",
                  ""});
    declare.real("events.min_standing", options.min_standing_s, 0, 60,
                 {"s",
                  "Shorter standstills are neither stops nor starts. One in which its track is lost counts from two "
                  "fifths of this on.",
                  ""});
    declare.real(
        "events.min_way", options.min_way_m, 0, 100,
        {"m", "A vehicle that moves less than this between two standstills counts as standing all the time.", ""});
}

void describeBorder(EventOptions& options, const ParameterDeclarer& declare) {
    declare.real("events.border_time", options.border_time_s, 0, 10,
                 {"s",
                  "A track that would reach the border of the picture within this time counts as having left, not as "
                  "lost. Longer: fewer are lost.",
                  ""});
    declare.real("events.border_distance", options.border_distance_m, 0, 50,
                 {"m", "A box this close to the border of the picture counts as lying at it.", ""});
    declare.real("events.edge_time", options.edge_time_s, 0, 60,
                 {"s",
                  "A track that begins in mid-picture this soon after the start of what could be searched does not "
                  "count as appearing, and one that ends there this soon before its end does not count as lost.",
                  ""});
}

void describeOne(EventOptions& options, const ParameterDeclarer& declare) {
    declare.real("events.stands", options.stands_s, 0, 3600, {"s", "Shortest standstill that counts as an event.", ""});
    declare.real("events.turn_back_angle", options.turn_back_angle_deg, 90, 180,
                 {"degrees", "Directions before and after turning back differ by at least this.", ""});
    declare.real("events.turn_back_time", options.turn_back_time_s, 1, 600,
                 {"s", "Longest time from one direction to the other, standstills in between included.", ""});
    declare.real("events.turn_back_way", options.turn_back_way_m, 0, 200,
                 {"m", "Shortest distance that the vehicle drives in each direction.", ""});
    declare.real("events.turn_back_offset", options.turn_back_offset_m, 0, 500,
                 {"m", "Largest distance between the way out and the way back; more is a loop or a bend.", ""});
    declare.real("events.over", options.over_kmh, 1, 400, {"km/h", "Speed above which a vehicle counts as fast.", ""});
    declare.real("events.over_time", options.over_time_s, 0, 600, {"s", "For at least this long.", ""});
    declare.real("events.under", options.under_kmh, 0, 400,
                 {"km/h", "Speed below which a moving vehicle counts as slow.", ""});
    declare.real("events.under_time", options.under_time_s, 0, 600, {"s", "For at least this long.", ""});
    declare.real("events.loiter_radius", options.loiter_radius_m, 1, 1000,
                 {"m", "A vehicle that stays within a circle of this radius for events.loiter_time loiters.", ""});
    declare.real(
        "events.loiter_time", options.loiter_time_s, 1, 3600,
        {"s", "Shortest time that it stays within that circle, driving at least twice the circle's diameter meanwhile.",
         ""});
}

void describeOthers(EventOptions& options, const ParameterDeclarer& declare) {
    declare.real(
        "events.flow_radius", options.flow_radius_m, 0.5, 50,
        {"m",
         "Tracks that pass a place within this distance determine its direction. More than half a lane mixes lanes.",
         ""});
    declare.integer("events.flow_tracks", options.flow_tracks, 1, 1000,
                    {"tracks", "The direction of a place is known once this many other tracks agree on it.", ""});
    declare.real(
        "events.flow_share", options.flow_share, 0, 1,
        {"", "Largest share of the tracks of a place that go the same way as one that drives against the flow.", ""});
    declare.real("events.arrow_radius", options.arrow_radius_m, 0.5, 100,
                 {"m",
                  "So far around an arrow that a person drew its direction is the right one, whatever others do; of "
                  "several the nearest counts. More than half a lane reaches into the next one.",
                  ""});
    declare.real("events.against_angle", options.against_angle_deg, 90, 180,
                 {"degrees", "Directions that differ by more than this are against each other.", ""});
    declare.real("events.flow_way", options.flow_way_m, 0, 500,
                 {"m", "Shortest distance that a vehicle drives against the flow, or off it.", ""});
    declare.real("events.off_flow", options.off_flow_m, 1, 100,
                 {"m", "A vehicle has left the flow where no other came this close.", ""});
    declare.real("events.off_flow_seen", options.off_flow_seen_s, 0, 3600,
                 {"s", "Such a place must have been in the picture for at least this long.", ""});
    declare.integer("events.convoy_vehicles", options.convoy_vehicles, 2, 100,
                    {"", "Fewest vehicles of a convoy.", ""});
    declare.real("events.convoy_time", options.convoy_time_s, 1, 3600,
                 {"s", "Shortest time for which they follow each other.", ""});
    declare.real("events.convoy_headway", options.convoy_headway_s, 0.5, 60,
                 {"s", "Longest time from one vehicle passing a place to the next.", ""});
    declare.real("events.convoy_lane", options.convoy_lane_m, 0.5, 50,
                 {"m", "How far beside the way of the vehicle ahead the next one may drive.", ""});
    declare.real("events.convoy_spread", options.convoy_spread, 0, 10,
                 {"",
                  "Share by which the time between two vehicles of a convoy may vary. More: ordinary traffic counts as "
                  "a convoy, too.",
                  ""});
    declare.real("events.meeting_distance", options.meeting_distance_m, 0, 100,
                 {"m", "Largest gap between two vehicles that meet.", ""});
    declare.real("events.meeting_time", options.meeting_time_s, 0, 3600,
                 {"s", "Shortest time for which both stand.", ""});
    declare.real(
        "events.meeting_angle", options.meeting_angle_deg, 0, 180,
        {"degrees",
         "Directions from which they came differ by at least this. 0: each vehicle in a queue meets the next one.",
         ""});
}

}  // namespace

void EventOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::none);  // they read stored tracks
    describeMotion(*this, declare);
    describeBorder(*this, declare);
    describeOne(*this, declare);
    describeOthers(*this, declare);
    declare.real("events.zone_margin", zone_margin_m, 0, 50,
                 {"m",
                  "How far a vehicle must go beyond the edge of a zone or a line to have passed it. More: standing on "
                  "the edge counts less often.",
                  ""});
}

}  // namespace eyrie
