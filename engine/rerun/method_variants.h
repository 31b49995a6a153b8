#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chain/chain_options.h"
#include "peer/peer_options.h"

namespace eyrie {

/// A method as it is named in comparisons: parameters that differ from a common base, or no chain at all.
struct MethodVariant {
    std::string name;
    ChainOptions options;
    bool global_window = false;         ///< the sliding window over the whole image instead of the chain
    std::optional<PeerOptions> peer{};  ///< the peer instead of the chain, of which only `options.finishing` holds
};

/// The words that comparisons understand: every detector (clusters, gradient, …), the four gradients (gradient_lbp, …),
/// the three ways of rescaling (sliding_window_joint_11, …), the sources of motion (two_frame_difference, …, which
/// deliver their areas as detections), global_sliding_window, and three_frame_difference_sort, the peer.
std::vector<std::string> methodWords();

/// The words a group stands for: detectors (tables 7.6 and 7.7), gradients (7.3), rescaling (7.5), motion (chapter 2),
/// peer; any other word stands for itself.
std::vector<std::string> methodsNamed(const std::string& word);

/// A method over `base`, whose other parameters hold for all, or over `peer`. Throws Error(parameter) for an unknown
/// word.
MethodVariant methodVariant(const std::string& word, const ChainOptions& base, const PeerOptions& peer = {});

/// The same with stacking switched, "gradient + stacking".
MethodVariant withStacking(MethodVariant variant, bool stacking);

}  // namespace eyrie
