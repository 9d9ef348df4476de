#include "planner/steering/group_state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace aerogram::planner {
namespace {

constexpr double kTiny_m = 1e-9;
constexpr double kMeeting = 2.5;  ///< groups mind each other from this many times the sum of their radii
constexpr double kUrgency = 4.0;  ///< of groups that touch: their courses are forgotten for a while

double largest_radius(const std::vector<std::size_t>& drones, const Points& points_m, const Vec3& middle) {
    double squared = 0.0;
    for (const std::size_t d : drones) {
        const Vec2 arm(points_m[d] - middle);
        squared = std::max(squared, glm::dot(arm, arm));
    }
    return std::sqrt(squared);
}

/// The place `distance` along the course.
Vec3 place_along(const std::vector<Vec3>& course, double distance) {
    for (std::size_t i = 1; i < course.size(); ++i) {
        const double length = glm::distance(course[i - 1], course[i]);
        if (distance <= length)
            return length > kTiny_m ? course[i - 1] + distance / length * (course[i] - course[i - 1]) : course[i];
        distance -= length;
    }
    return course.back();
}

}  // namespace

Vec3 middle_of(const std::vector<std::size_t>& drones, const Points& points_m) {
    Vec3 sum{};
    for (const std::size_t d : drones) sum += points_m[d];
    return sum / static_cast<double>(drones.size());
}

GroupBody body_of(const std::vector<std::size_t>& drones, const Points& from_m, const Points& to_m) {
    GroupBody body;
    for (const Points* points_m : {&from_m, &to_m}) {
        const Vec3 middle = middle_of(drones, *points_m);
        body.radius_m = std::max(body.radius_m, largest_radius(drones, *points_m, middle));
        for (const std::size_t d : drones) body.half_m = std::max(body.half_m, std::abs((*points_m)[d].z - middle.z));
    }
    return body;
}

Vec3 along_course(GroupState& group, double ahead_m, double slow_m) {
    double before = 0.0, best = group.passed_m, nearest = 1e300;
    for (std::size_t i = 1; i < group.course.size(); ++i) {
        const Vec3 leg = group.course[i] - group.course[i - 1];
        const double length = glm::length(leg);
        if (length <= kTiny_m) continue;
        const double share =
            std::clamp(glm::dot(group.middle - group.course[i - 1], leg) / (length * length), 0.0, 1.0);
        const double along = before + share * length;
        const double away = glm::distance(group.middle, group.course[i - 1] + share * leg);
        // Only a little ahead: a course that comes near itself is not cut short.
        if (along >= group.passed_m && along <= group.passed_m + 2.0 * ahead_m && away < nearest) {
            nearest = away;
            best = along;
        }
        before += length;
    }
    group.passed_m = best;
    const Vec3 towards = place_along(group.course, group.passed_m + ahead_m) - group.middle;
    const double distance = glm::length(towards), left = glm::distance(group.middle, group.goal);
    return distance > kTiny_m ? towards / distance * std::min(1.0, left / slow_m) : Vec3{};
}

Vec3 away_from_others(const std::vector<GroupState>& groups, std::size_t which, const Vec3& way,
                      const CourseSpace& space) {
    const GroupState& own = groups[which];
    Vec3 push{};
    for (std::size_t other = 0; other < groups.size(); ++other) {
        if (other == which) continue;
        const Vec3 apart = own.middle - groups[other].middle;
        // Groups that are to stand nearer to each other than their bodies' radii may come as near.
        const Vec2 goals_apart(own.goal - groups[other].goal);
        const double room = std::min(own.body.radius_m + groups[other].body.radius_m + space.keep_m,
                                     std::max(glm::length(goals_apart), space.keep_m));
        const double height = own.body.half_m + groups[other].body.half_m + space.keep_m;
        const double distance = std::hypot(apart.x, apart.y);
        if (distance >= kMeeting * room || std::abs(apart.z) >= height) continue;
        const double nearness = kUrgency * std::min(1.0, (kMeeting * room - distance) / ((kMeeting - 1.0) * room));
        const Vec3 beside = Vec3(way.y, -way.x, 0.0);  // to the right of the way
        if (distance > kTiny_m) push += nearness * Vec3(apart.x, apart.y, 0.0) / distance;
        if (glm::dot(Vec2(way), Vec2(apart)) < 0.0) push += nearness * beside;
    }
    const double inside = intrusion_m(own.middle, own.body, space);
    if (inside > 0.0) {
        const double step = 0.1 * space.keep_m;
        Vec3 uphill{};
        for (int axis = 0; axis < 3; ++axis) {
            Vec3 d{};
            d[axis] = step;
            uphill[axis] = intrusion_m(own.middle + d, own.body, space) - intrusion_m(own.middle - d, own.body, space);
        }
        const double steep = glm::length(uphill);
        if (steep > kTiny_m) push -= std::min(1.0, inside / space.keep_m) * uphill / steep;
    }
    const double left = glm::distance(own.middle, own.goal);
    return push * std::min(1.0, left / std::max(own.body.radius_m, space.keep_m));
}

}  // namespace aerogram::planner
