#pragma once
#include <vector>

#include "geo/ids.hpp"
#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/mission/mission.hpp"
#include "planner/steering/course.hpp"
#include "planner/transition/interpolation.hpp"

namespace aerogram::planner {

/// A fleet that flies from one formation to another as groups that keep together.
struct SteerTask {
    Points from_m, to_m;                       ///< by drone, show frame
    std::vector<std::vector<DroneId>> groups;  ///< disjoint; drones in none of them form one more
    CourseSpace space;
    SeparationMetric metric;
    double spacing_m = 2.0;  ///< that neighbours would like to keep on the way, in the metric
    SteerOptions options;
};

/// Two-level control: every group flies its own course around what is in the way (course.hpp), every drone towards its
/// place in the formation around the group's middle, away from neighbours and obstacles; the four velocities are added
/// with the task's weights and followed with some inertia until everybody is nearly there. The motion is what was flown
/// so, smoothed, and bent in the end so that it arrives exactly.
/// Shares of the motion are such that the fastest drone is about equally fast at every share.
/// Properties: (1) ends exact (2) deterministic (3) moving the task moves the motion (4) the group's middle follows its
/// course. Nothing is promised about distances: the planner's separation comes after. Errors: stopped.
/// Source: Gu and Deng 2011, section 4.2, equation 4. Where we differ: repulsion between drones falls linearly to 0 at
/// 1.6 spacings; groups that meet head-on pass on the right; places in space, not on the ground.
Result<Interpolation> steer(const SteerTask& task, const Run& run);

}  // namespace aerogram::planner
