#include "events/review/review_options.h"

namespace eyrie {

void ReviewOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::none);  // they read stored tracks
    declare.real("review.carry_time", carry_time_s, 0, 60,
                 {"s",
                  "A verdict is taken over by an event of another run that is no farther from it in time. More: events "
                  "that follow each other are mistaken for one another.",
                  ""});
    declare.real("review.carry_distance", carry_distance_m, 0, 200,
                 {"m", "Such an event's vehicle must also be no farther from it than this on the ground.", ""});
    declare.real("review.carry_picture", carry_picture, 0, 1000,
                 {"px", "The same in the picture, where the run does not connect the two frames.", ""});
    declare.real(
        "review.join_unsearched", join_unsearched_s, 0, 60,
        {"s", "Frames that could not be registered form one stretch where less than this lies between them.", ""});
    declare.integer(
        "review.rare", rare, 0, 10000,
        {"events", "Kinds with no more events than this are put before an operator early. 0: no kind is rare.", ""});
    declare.real("review.unsure_score", unsure_score, 0, 1,
                 {"", "Events of tracks with a lower score are unsure and come before the rest. 0: none.", ""});
}

}  // namespace eyrie
