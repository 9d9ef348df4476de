#pragma once
#include <vector>

#include "geo/airspace.hpp"
#include "geo/vec3.hpp"

namespace aerogram::planner {

/// A group as its navigator sees it: an upright cylinder around the group's middle.
struct GroupBody {
    double radius_m = 0.0;  ///< seen from above
    double half_m = 0.0;    ///< half its height
};

/// Where a group may be.
struct CourseSpace {
    geo::Airspace airspace;  ///< show frame
    double floor_z_m = 0.0, ceiling_z_m = 120.0;
    double keep_m = 1.5;  ///< no drone nearer than this to an obstacle, the fence or above the audience
};

/// The way of a group's middle among obstacles, from one place to another: A* on a grid, then its corners cut. The
/// whole body keeps clear where there is room ("as a whole if possible"); where there is not, it pays for what sticks
/// out, and only the middle itself must pass.
/// @returns at least two places, `from` first and `to` last; straight ahead where nothing is in the way, or where there
/// is no way at all.
/// Properties: (1) ends exact (2) without obstacles, fence and audience it is the straight line (3) the middle keeps
/// keep_m from every obstacle, where there is a way (4) deterministic. Cost: at most 200,000 cells.
/// Source: Gu and Deng 2011, section 5.2 (their global navigator), in space instead of on the ground.
[[nodiscard]] std::vector<Vec3> find_course(const Vec3& from, const Vec3& to, const GroupBody& body,
                                            const CourseSpace& space);

/// How far the body at `middle` reaches into what it should keep clear of, metres; 0 where it is clear.
[[nodiscard]] double intrusion_m(const Vec3& middle, const GroupBody& body, const CourseSpace& space);

}  // namespace aerogram::planner
