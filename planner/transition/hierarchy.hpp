#pragma once
#include <cstddef>
#include <vector>

#include "geo/ids.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mission/mission.hpp"
#include "planner/transition/interpolation.hpp"
#include "planner/transition/spectral.hpp"

namespace aerogram::planner {

/// How a set of drones moves: by one method for its individuals, which are the groups inside (as their barycentres) and
/// the drones that are in none; each group inside moves about its barycentre in its own way (paper 000, section 4.4).
struct GroupMotion {
    std::vector<DroneId> drones;  ///< all, ascending
    Method method = Method::straight;
    SpectralOptions spectral;
    double blend = 1.0;  ///< of this group's own way against what the parent's method alone would do with its drones
    std::vector<GroupMotion> inside;  ///< disjoint subsets
};

/// One method for the whole fleet: straight, spectral or rigid. Obstacle vertices shape spectral transitions; the other
/// methods leave them out. Errors: stopped.
Result<Interpolation> interpolation(Method method, const SpectralKeyframe& source, const SpectralKeyframe& target,
                                    const SpectralOptions& spectral, const Run& run);

/// The hierarchy's motion, from the top down. A group's individuals are neighbours as its drones are: edges between two
/// of them are added up (contracted_graph), which is the drones' Laplacian on motions that move every inner group as
/// one; a triangulation of the barycentres would forget what the designer cut, joined or weighted between drones.
/// Inner motion is relative to the barycentre and aligned by the inner group itself, as in the paper: it turns as its
/// own drones need and not with its parent, else groups that swap places on a half circle would be spun round. Where
/// both turn alike this gives the same rigid motion; only near a half turn (kNearHalfTurn_rad) "the shorter way round"
/// is chance, and there a group whose drones turn like its parent (to kSameTurn_rad) goes the parent's way round.
/// Properties: (1) ends exact to 1e-9 m (2) without groups inside it is `interpolation` (3) the barycentre of a group
/// of blend 1 moves as an individual of its parent (4) blend 0 everywhere is the flat motion (5) a rigid motion of the
/// whole fleet is flown rigidly by aligned spectral and rigid groups, half turns included, where every level has three
/// individuals off one line.
/// Errors: stopped. Source: Takahashi et al. 2009, section 4.4.
Result<Interpolation> hierarchical_interpolation(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                                 const GroupMotion& fleet, const Run& run);

/// Groups found by spectral clustering of a keyframe's graph: k-means (seeded, k-means++) on the rows of the first
/// `count` Laplacian eigenvectors. Each group is ascending, groups are ordered by their first drone, none is empty.
/// @param count  1..n. Errors: stopped.
Result<std::vector<std::vector<DroneId>>> spectral_clusters(const SpectralKeyframe& keyframe, std::size_t count,
                                                            std::uint64_t seed, const Run& run);

}  // namespace aerogram::planner
