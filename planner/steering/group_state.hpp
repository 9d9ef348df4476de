#pragma once
#include <cstddef>
#include <vector>

#include "planner/steering/course.hpp"

namespace aerogram::planner {

/// One group under way: where its middle is and how far along its course.
struct GroupState {
    std::vector<std::size_t> drones;
    Vec3 middle{}, goal{};
    GroupBody body;
    std::vector<Vec3> course;
    double length_m = 0.0;    ///< of the course
    double passed_m = 0.0;    ///< along the course; never less than before
    double turned_rad = 0.0;  ///< of the formation about its middle, to face the course
};

[[nodiscard]] Vec3 middle_of(const std::vector<std::size_t>& drones, const Points& points_m);
/// The cylinder around a group in any of two formations.
[[nodiscard]] GroupBody body_of(const std::vector<std::size_t>& drones, const Points& from_m, const Points& to_m);

/// Moves `passed_m` on to the place of the course nearest to the middle, and returns the velocity along the course: a
/// unit vector towards a place `ahead_m` further on, slower within `slow_m` of the goal.
[[nodiscard]] Vec3 along_course(GroupState& group, double ahead_m, double slow_m);

/// A group's velocity away from the other groups (up to 4 where they touch) and from what is in its way (up to 1);
/// groups that meet head-on part to the right of their ways. It fades within a radius of the goal, where formations may
/// be meant to touch.
[[nodiscard]] Vec3 away_from_others(const std::vector<GroupState>& groups, std::size_t which, const Vec3& way,
                                    const CourseSpace& space);

}  // namespace aerogram::planner
