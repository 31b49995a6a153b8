#include "motion/vectors/shadow_owners.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/oriented_box.h"
#include "motion/vectors/vector_groups.h"

namespace eyrie {
namespace {

constexpr std::size_t kOwnerVectors = 4;
constexpr double kOwnerVelocityShare = 0.05;
constexpr double kOwnerAlike = 2.5;     ///< shadow and owner may differ by this many times what members may
constexpr double kShadowLinkage = 1.2;  ///< m, linkage distance of shadows
constexpr double kReachMargin = 1;      ///< px by which a shadow may reach farther
constexpr double kOwnMargin = 0.5;      ///< px; dark corners within the owner's box are its own

double distanceTo(const OrientedBox& box, cv::Point2d point) {
    const cv::Point2d in_box = box.toBox(point);
    return std::hypot(std::max(0.0, std::abs(in_box.x) - box.length / 2),
                      std::max(0.0, std::abs(in_box.y) - box.width / 2));
}

/// Whether lit ground parts most of what looks like a shadow from the vehicle.
bool standsApart(const VectorGroup& shadow, const VectorGroup& owner, const std::vector<MotionVector>& vectors,
                 const ShadowOwners::LitUpTo& lit_up_to) {
    const auto lit = std::count_if(shadow.members.begin(), shadow.members.end(), [&](int member) {
        return lit_up_to(owner.box, vectors[static_cast<std::size_t>(member)].position);
    });
    return 2 * static_cast<std::size_t>(lit) > shadow.members.size();
}

}  // namespace

ShadowOwners::ShadowOwners(const ShadowTestOptions& options, const SceneScale& scale)
    : options_(options), scale_(scale) {}

std::vector<char> ShadowOwners::castShadows(const std::vector<MotionVector>& vectors,
                                            const std::vector<char>& looks_like_shadow, double background_speed_sigma,
                                            const LitUpTo& lit_up_to) const {
    std::vector<char> cast(vectors.size(), 0);
    std::vector<int> lit;
    std::vector<int> dark;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        (looks_like_shadow[i] ? dark : lit).push_back(static_cast<int>(i));
    }
    if (dark.empty()) return cast;

    Linkage linkage = vehicleLinkage(scale_, background_speed_sigma, kOwnerVelocityShare);
    std::vector<VectorGroup> owners = groupVectors(vectors, lit, linkage);
    std::erase_if(owners, [&](const VectorGroup& group) {
        const SceneScale here = scale_.at(group.box.centre);
        return group.members.size() < kOwnerVectors || group.box.length < here.px(options_.shadow_owner_length_m) ||
               group.box.width < here.px(options_.shadow_owner_width_m);
    });
    linkage.reach(scale_.px(kShadowLinkage), scale_.px(kShadowLinkage), kSmallestLinkage);
    for (const VectorGroup& shadow : groupVectors(vectors, dark, linkage)) {
        for (const VectorGroup& owner : owners) {
            const cv::Point2d apart = shadow.velocity - owner.velocity;
            const double speed = std::hypot(owner.velocity.x, owner.velocity.y);
            const double allowed = std::max(linkage.velocity_floor, linkage.velocity_share * speed);
            if (std::hypot(apart.x, apart.y) > kOwnerAlike * allowed) continue;
            const double reach = scale_.at(owner.box.centre).px(options_.shadow_reach_m) + kReachMargin;
            const bool within = std::all_of(shadow.members.begin(), shadow.members.end(), [&](int member) {
                return distanceTo(owner.box, vectors[static_cast<std::size_t>(member)].position) <= reach;
            });
            if (!within || (lit_up_to && standsApart(shadow, owner, vectors, lit_up_to))) continue;
            for (const int member : shadow.members) {
                const auto at = static_cast<std::size_t>(member);
                if (distanceTo(owner.box, vectors[at].position) > kOwnMargin) cast[at] = 1;
            }
        }
    }
    return cast;
}

}  // namespace eyrie
