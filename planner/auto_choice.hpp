#pragma once
#include "planner/leg_motion.hpp"

namespace aerogram::planner {

/// How good a way is, by the three objectives a mission may have; smaller is better in each.
struct Merits {
    double duration_s = 0.0;       ///< the shortest legal one
    double path_ratio = 1.0;       ///< flown length over straight-line length
    double edge_distortion = 0.0;  ///< mean over neighbours and time of |length - wished| / wished, where the wish goes
                                   ///< linearly from the source's length to the target's; union of both graphs
    double jerk = 0.0;  ///< mean over drones of ∫|jerk|² dt · T⁵ / L² (DESIGN.md 12), L the straight way
};
/// Errors: those of graph_keyframe.
Result<Merits> merits_of(const Mission& mission, const Route& route, const Leg& leg, const LegMotion& motion,
                         const Run& run);

/// method = "auto": plans the leg by straight, rigid and spectral, certifies each, and keeps of those that hold every
/// limit the best by the mission's objective: shortest = duration, then path; together = edge distortion; smooth =
/// jerk. Within a thousandth the earlier in that order wins. With none certified: straight. The report says why, with
/// all figures. Errors: stopped; those of plan_leg_by.
Result<LegMotion> choose_motion(const Mission& mission, const Route& route, const Leg& leg, const Run& run);

}  // namespace aerogram::planner
