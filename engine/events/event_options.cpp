#include "events/event_options.h"

namespace eyrie {
namespace {

void describeMotion(EventOptions& o, const ParameterDeclarer& v) {
    v.real("events.smooth", o.smooth_s, 0.1, 10,
           {"s",
            "Speeds and directions are those over so long a time. Longer: steadier, but short stops and turns are "
            "blurred.",
            ""});
    v.real("events.noise", o.noise_px, 0, 10,
           {"px",
            "How far boxes stray from their vehicles (standard deviation). What moves no faster than this could "
            "pretend is taken to stand.",
            ""});
    v.real("events.standing_speed", o.standing_kmh, 0, 50,
           {"km/h", "A vehicle that drove stands once it is slower than this.", ""});
    v.real("events.moving_speed", o.moving_kmh, 0, 100,
           {"km/h",
            "A vehicle that stood drives once it was faster than this, from when it passed standing_speed. Between the "
            "two it goes on with what it did.",
            ""});
    v.real("events.min_standing", o.min_standing_s, 0, 60,
           {"s", "Shorter standstills are neither stops nor starts.", ""});
    v.real("events.min_way", o.min_way_m, 0, 100,
           {"m", "A vehicle that moves less than this between two standstills has stood all the time.", ""});
}

void describeBorder(EventOptions& o, const ParameterDeclarer& v) {
    v.real("events.border_time", o.border_s, 0, 10,
           {"s",
            "A track that would reach the border of the picture within this time has left, not been lost. Longer: "
            "fewer are lost.",
            ""});
    v.real("events.border_distance", o.border_m, 0, 50,
           {"m", "A box that comes as near to the border as this lies at it.", ""});
    v.real("events.edge_time", o.edge_s, 0, 60,
           {"s",
            "Tracks that begin or end in mid-picture so soon after the beginning or before the end of what could be "
            "searched neither appear nor get lost.",
            ""});
}

void describeOne(EventOptions& o, const ParameterDeclarer& v) {
    v.real("events.stands", o.stands_s, 0, 3600, {"s", "Shortest standstill that is told as such.", ""});
    v.real("events.turn_back_angle", o.turn_back_deg, 90, 180,
           {"degrees", "Directions before and after turning back differ by at least this.", ""});
    v.real("events.turn_back_time", o.turn_back_s, 1, 600,
           {"s", "Longest time from the one direction to the other; standing in between counts.", ""});
    v.real("events.turn_back_way", o.turn_back_way_m, 0, 200,
           {"m", "How far the vehicle drives in either direction at least.", ""});
    v.real("events.turn_back_offset", o.turn_back_offset_m, 0, 500,
           {"m", "How far beside its first way the vehicle comes back at most; more is a loop or a bend.", ""});
    v.real("events.over", o.over_kmh, 1, 400, {"km/h", "Speed above which a vehicle is told as fast.", ""});
    v.real("events.over_time", o.over_s, 0, 600, {"s", "For at least so long.", ""});
    v.real("events.under", o.under_kmh, 0, 400,
           {"km/h", "Speed below which a vehicle that moves is told as slow.", ""});
    v.real("events.under_time", o.under_s, 0, 600, {"s", "For at least so long.", ""});
    v.real("events.loiter_radius", o.loiter_radius_m, 1, 1000,
           {"m", "A vehicle loiters that stays within such a circle …", ""});
    v.real("events.loiter_time", o.loiter_s, 1, 3600,
           {"s", "… for at least so long, and drives at least twice the circle's diameter meanwhile.", ""});
}

void describeOthers(EventOptions& o, const ParameterDeclarer& v) {
    v.real("events.flow_radius", o.flow_radius_m, 0.5, 50,
           {"m", "Tracks that pass a place within this distance tell its direction. More than half a lane mixes lanes.",
            ""});
    v.integer("events.flow_tracks", o.flow_tracks, 1, 1000,
              {"tracks", "The direction of a place is known once so many other tracks agree on it.", ""});
    v.real(
        "events.flow_share", o.flow_share, 0, 1,
        {"", "Largest share of the tracks of a place that go the same way as one that drives against the flow.", ""});
    v.real("events.against_angle", o.against_deg, 90, 180,
           {"degrees", "Directions that differ by more than this are against each other.", ""});
    v.real("events.flow_way", o.flow_way_m, 0, 500,
           {"m", "How far a vehicle drives against the flow, or off it, at least.", ""});
    v.real("events.off_flow", o.off_flow_m, 1, 100,
           {"m", "A vehicle has left the flow where no other came as near as this.", ""});
    v.real("events.off_flow_seen", o.off_flow_s, 0, 3600,
           {"s", "Such a place must have been in the picture for at least so long.", ""});
    v.integer("events.convoy_vehicles", o.convoy_vehicles, 2, 100, {"", "Fewest vehicles of a convoy.", ""});
    v.real("events.convoy_time", o.convoy_s, 1, 3600, {"s", "Shortest time for which they follow each other.", ""});
    v.real("events.convoy_headway", o.convoy_headway_s, 0.5, 60,
           {"s", "Longest time from one vehicle passing a place to the next.", ""});
    v.real("events.convoy_lane", o.convoy_lane_m, 0.5, 50,
           {"m", "How far beside the way of the vehicle ahead the next one may drive.", ""});
    v.real(
        "events.convoy_spread", o.convoy_spread, 0, 10,
        {"", "By which share the time between two vehicles of a convoy may vary. More: traffic is a convoy, too.", ""});
    v.real("events.meeting_distance", o.meeting_distance_m, 0, 100,
           {"m", "Largest gap between two vehicles that meet.", ""});
    v.real("events.meeting_time", o.meeting_s, 0, 3600, {"s", "Shortest time for which both stand.", ""});
    v.real("events.meeting_angle", o.meeting_deg, 0, 180,
           {"degrees",
            "Directions from which they came differ by at least this. 0: whoever stands in a queue meets the next "
            "one.",
            ""});
}

}  // namespace

void EventOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer v(visitor, ChainStage::none);  // they read stored tracks
    describeMotion(*this, v);
    describeBorder(*this, v);
    describeOne(*this, v);
    describeOthers(*this, v);
    v.real("events.zone_margin", zone_margin_m, 0, 50,
           {"m",
            "How far a vehicle must come over the edge of a zone or a line to have passed it. More: standing on the "
            "edge counts less often.",
            ""});
}

}  // namespace eyrie
