#include "peer/peer_options.h"

namespace eyrie {

void PeerOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::none);
    declare.integer(
        "peer.gap", gap, 1, 100,
        {"frames", "Time between the pictures of a difference. Larger: slower vehicles, more parallax.", ""});
    declare.real("peer.blur", blur, 0, 20,
                 {"px", "Pictures are smoothed by a Gaussian of this deviation first; 0: not at all.", ""});
    declare.real(
        "peer.threshold", threshold, 0, 255,
        {"grey", "Pixels move where both differences exceed this. Larger: fewer false boxes, dull vehicles are lost.",
         ""});
    declare.real("peer.joining", joining, 0, 100,
                 {"px",
                  "Areas closer than this are one object. Larger: front and rear of a plain car become one, and so do "
                  "neighbours.",
                  ""});
    declare.integer("peer.min_area", min_area, 1, 100000, {"px²", "Objects of fewer pixels are dropped.", ""});
    sort.describe(declare);
}

}  // namespace eyrie
