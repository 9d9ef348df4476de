#include "planner/steering/steer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "geo/contract.hpp"
#include "planner/sampling/site_grid.hpp"
#include "planner/steering/flown.hpp"
#include "planner/steering/group_state.hpp"

namespace aerogram::planner {
namespace {

constexpr double kStep = 0.25;        ///< spacings that a drone at full speed flies in one step
constexpr double kSlow = 4.0;         ///< spacings before its place from which a drone slows down
constexpr double kAhead = 6.0;        ///< spacings that a group looks ahead on its course
constexpr double kArrived = 0.3;      ///< spacings
constexpr double kNeighbour = 1.6;    ///< spacings within which drones push each other
constexpr double kInertia = 0.25;     ///< of the wished-for change of velocity a drone follows in one step
constexpr double kSmooth_rows = 5.0;  ///< of about 500
constexpr double kTurn_rad = 0.01;    ///< the most that a formation turns in one step
constexpr std::size_t kMostSteps = 20'000;
constexpr std::size_t kPatience = 100;  ///< steps without progress after which the rest is flown straight
constexpr double kProgress = 0.995;     ///< of what is still to do: less than this is progress
constexpr double kTiny_m = 1e-9;

class Flight {
  public:
    Flight(const SteerTask& task, const Run& run)
        : task_(task), run_(run), now_m_(task.from_m), velocity_(task.from_m.size()), wish_(task.from_m.size()) {
        std::vector<bool> grouped(task.from_m.size(), false);
        for (const auto& drones : task.groups) {
            std::vector<std::size_t> members;
            for (const DroneId d : drones) {
                AEROGRAM_REQUIRE(!grouped[d.value], d.value);
                grouped[d.value] = true;
                members.push_back(d.value);
            }
            if (!members.empty()) add_group(std::move(members));
        }
        std::vector<std::size_t> rest;
        for (std::size_t d = 0; d < grouped.size(); ++d)
            if (!grouped[d]) rest.push_back(d);
        if (!rest.empty()) add_group(std::move(rest));
    }

    Result<Interpolation> fly() {
        const double step_m = kStep * task_.spacing_m;
        FlownRows rows(task_.from_m, step_m);
        double least_left_m = std::numeric_limits<double>::infinity();
        std::size_t idle = 0;
        for (std::size_t step = 0; step < kMostSteps && !arrived() && idle < kPatience; ++step) {
            if (run_.stopped()) return stopped_error();
            for (std::size_t g = 0; g < groups_.size(); ++g) wish_of_group(g);
            push_neighbours();
            double furthest_m = 0.0;
            for (std::size_t d = 0; d < now_m_.size(); ++d) {
                velocity_[d] += kInertia * (wish_[d] - velocity_[d]);
                now_m_[d] += step_m * velocity_[d];
                furthest_m = std::max(furthest_m, step_m * glm::length(velocity_[d]));
            }
            for (GroupState& group : groups_) group.middle = middle_of(group.drones, now_m_);
            rows.add(now_m_, furthest_m);
            const double left_m = still_to_do_m();
            idle = left_m < kProgress * least_left_m ? 0 : idle + 1;
            if (idle == 0) least_left_m = left_m;
        }
        fly_straight(rows, step_m);
        return std::move(rows).motion(task_.to_m, kSmooth_rows);
    }

  private:
    void add_group(std::vector<std::size_t> members) {
        GroupState group;
        group.middle = middle_of(members, task_.from_m);
        group.goal = middle_of(members, task_.to_m);
        group.body = body_of(members, task_.from_m, task_.to_m);
        group.course = find_course(group.middle, group.goal, group.body, task_.space);
        for (std::size_t i = 1; i < group.course.size(); ++i)
            group.length_m += glm::distance(group.course[i - 1], group.course[i]);
        group.drones = std::move(members);
        groups_.push_back(std::move(group));
    }

    /// Ways that groups have not flown and drones are off their places, added up.
    [[nodiscard]] double still_to_do_m() const {
        double sum = 0.0;
        for (const GroupState& group : groups_) {
            sum += static_cast<double>(group.drones.size()) * (group.length_m - group.passed_m);
            for (const std::size_t d : group.drones)
                sum += glm::distance(now_m_[d] - group.middle, task_.to_m[d] - group.goal);
        }
        return sum;
    }

    /// The rest of the way in straight lines: drones that block each other sort themselves out in the separation.
    void fly_straight(FlownRows& rows, double step_m) const {
        double furthest_m = 0.0;
        for (std::size_t d = 0; d < now_m_.size(); ++d)
            furthest_m = std::max(furthest_m, glm::distance(now_m_[d], task_.to_m[d]));
        const auto steps = static_cast<std::size_t>(std::ceil(furthest_m / step_m));
        Points row(now_m_.size());
        for (std::size_t k = 1; k <= steps; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(steps);
            for (std::size_t d = 0; d < row.size(); ++d) row[d] = now_m_[d] + share * (task_.to_m[d] - now_m_[d]);
            rows.add(row, furthest_m / static_cast<double>(steps));
        }
    }

    [[nodiscard]] bool arrived() const {
        const double near_m = kArrived * task_.spacing_m;
        for (std::size_t d = 0; d < now_m_.size(); ++d)
            if (glm::distance(now_m_[d], task_.to_m[d]) > near_m) return false;
        return true;
    }

    /// The formation's turn eases towards the angle between the course here and the straight way.
    void face_course(GroupState& group, const Vec3& way) const {
        const Vec3 straight = group.goal - group.course.front();
        const double left_m = glm::distance(group.middle, group.goal);
        double wished = 0.0;
        if (std::hypot(way.x, way.y) > kTiny_m && std::hypot(straight.x, straight.y) > kTiny_m &&
            left_m > 2.0 * group.body.radius_m)
            wished = std::atan2(straight.x * way.y - straight.y * way.x, straight.x * way.x + straight.y * way.y);
        group.turned_rad += std::clamp(wished - group.turned_rad, -kTurn_rad, kTurn_rad);
    }

    /// The three velocities that need no neighbours: V_f, V_gn and V_gc of equation 4, weighted.
    void wish_of_group(std::size_t g) {
        GroupState& group = groups_[g];
        const SteerOptions& weights = task_.options;
        const double slow_m = kSlow * task_.spacing_m;
        const Vec3 way = along_course(group, kAhead * task_.spacing_m, slow_m);
        if (weights.face_course) face_course(group, way);
        const Vec3 shared = weights.w3 * way + weights.w4 * away_from_others(groups_, g, way, task_.space);
        const double c = std::cos(group.turned_rad), s = std::sin(group.turned_rad);
        for (const std::size_t d : group.drones) {
            const Vec3 arm = task_.to_m[d] - group.goal;
            const Vec3 place = group.middle + Vec3(c * arm.x - s * arm.y, s * arm.x + c * arm.y, arm.z);
            const Vec3 off = place - now_m_[d];
            const double distance = glm::length(off);
            wish_[d] = shared;
            if (distance > kTiny_m) wish_[d] += weights.w1 * std::min(1.0, distance / slow_m) / distance * off;
        }
    }

    /// V_c of equation 4: away from neighbours and obstacles, at most 1 each.
    void push_neighbours() {
        const double reach_m = kNeighbour * task_.spacing_m;
        Points scaled = now_m_;
        for (Vec3& p : scaled) p.z /= task_.metric.downwash;
        const SpaceGrid grid(scaled, reach_m);
        for (std::size_t d = 0; d < now_m_.size(); ++d) {
            Vec3 push{};
            grid.near(scaled[d], 1, [&](std::size_t other, const Vec3& p) {
                const Vec3 apart = scaled[d] - p;
                const double distance = glm::length(apart);
                if (other == d || distance >= reach_m) return;
                // Two at one place part along x, the lower number to the left.
                const Vec3 away = distance > kTiny_m ? apart / distance : Vec3(d < other ? -1.0 : 1.0, 0.0, 0.0);
                push += (1.0 - distance / reach_m) * away;
            });
            wish_[d] += task_.options.w2 * (at_most_one(push) + at_most_one(away_from_obstacles(now_m_[d])));
        }
    }

    [[nodiscard]] Vec3 away_from_obstacles(const Vec3& p) const {
        const double keep_m = task_.space.keep_m, reach_m = keep_m + 2.0 * task_.spacing_m;
        Vec3 push{};
        for (const geo::Obstacle& obstacle : task_.space.airspace.obstacles) {
            const double clear_m = geo::clearance(obstacle, p);
            if (clear_m >= reach_m) continue;
            Vec3 uphill{};
            for (int axis = 0; axis < 3; ++axis) {
                Vec3 d{};
                d[axis] = 0.1 * keep_m;
                uphill[axis] = geo::clearance(obstacle, p + d) - geo::clearance(obstacle, p - d);
            }
            const double steep = glm::length(uphill);
            if (steep > kTiny_m) push += 4.0 * (1.0 - std::max(clear_m, 0.0) / reach_m) * uphill / steep;
        }
        return push;
    }

    static Vec3 at_most_one(const Vec3& v) {
        const double length = glm::length(v);
        return length > 1.0 ? v / length : v;
    }

    const SteerTask& task_;
    const Run& run_;
    Points now_m_, velocity_, wish_;
    std::vector<GroupState> groups_;
};

}  // namespace

Result<Interpolation> steer(const SteerTask& task, const Run& run) {
    AEROGRAM_REQUIRE(task.from_m.size() == task.to_m.size() && task.spacing_m > 0.0 && task.space.keep_m > 0.0,
                     task.from_m.size(), task.to_m.size(), task.spacing_m, task.space.keep_m);
    return Flight(task, run).fly();
}

}  // namespace aerogram::planner
