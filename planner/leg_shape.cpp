#include "planner/leg_shape.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

#include "planner/adjacency/adjacency.hpp"
#include "planner/adjacency/obstacle_walls.hpp"
#include "planner/motion/profile.hpp"
#include "planner/steering/steer.hpp"
#include "planner/transition/hierarchy.hpp"

namespace aerogram::planner {
namespace {

constexpr double kStandsStill_m = 1e-6;

/// Puts a group into the innermost set that holds all of it; false when it shares only some drones with one.
bool insert(GroupMotion& into, GroupMotion&& group) {
    for (GroupMotion& sibling : into.inside) {
        if (std::ranges::includes(sibling.drones, group.drones)) return insert(sibling, std::move(group));
        std::vector<DroneId> shared;
        std::ranges::set_intersection(sibling.drones, group.drones, std::back_inserter(shared));
        if (!shared.empty()) return false;
    }
    into.inside.push_back(std::move(group));
    return true;
}

/// The leg's groups as a tree under the whole fleet.
Result<GroupMotion> motion_tree(const Mission& mission, const Route& route, const Leg& leg, Method method) {
    GroupMotion fleet;
    fleet.method = method;
    fleet.spectral = leg.how.spectral;
    for (std::size_t d = 0; d < leg.from_m.size(); ++d) fleet.drones.emplace_back(d);
    std::vector<GroupMove> moves = leg.how.groups;
    std::ranges::stable_sort(moves, std::greater{},
                             [&](const GroupMove& m) { return route.groups[m.group].drones.size(); });
    for (const GroupMove& move : moves) {
        const Group& group = route.groups[move.group];
        if (group.drones.empty()) continue;
        if (!insert(fleet, {group.drones, move.method, move.spectral, move.blend, {}})) {
            return Error{
                ErrorCode::invalid_input,
                mission.at(leg.how.line, keyframe_key(mission, leg.last) + ".arrive.groups: group \"" + group.name +
                                             "\" shares some of its drones with another: groups of one "
                                             "arrival must be apart or one inside the other")};
        }
    }
    return fleet;
}

/// In which order drones start: the foremost in the direction of the fleet's mean flight first, so that there is room
/// ahead of everybody; without a mean flight from left to right.
std::vector<double> starting_order(const Points& from_m, const Points& to_m) {
    Vec3 way{};
    for (std::size_t i = 0; i < from_m.size(); ++i) way += to_m[i] - from_m[i];
    const double length = glm::length(way) / static_cast<double>(from_m.size());
    const Vec3 direction = length > kStandsStill_m ? way / glm::length(way) : Vec3{-1.0, 0.0, 0.0};
    std::vector<double> along;
    for (const Vec3& p : from_m) along.push_back(glm::dot(p, direction));
    const auto [last, first] = std::minmax_element(along.begin(), along.end());
    const double front = *first, extent = *first - *last;
    for (double& a : along) a = extent > kStandsStill_m ? (front - a) / extent : 0.0;
    return along;
}

/// The largest groups of the mission that are not the whole fleet and share no drone.
std::vector<std::vector<DroneId>> steered_groups(const Route& route, std::size_t drones) {
    std::vector<const Group*> by_size;
    for (const Group& group : route.groups)
        if (!group.drones.empty() && group.drones.size() < drones) by_size.push_back(&group);
    std::ranges::stable_sort(by_size, std::greater{}, [](const Group* group) { return group->drones.size(); });
    std::vector<bool> taken(drones, false);
    std::vector<std::vector<DroneId>> out;
    for (const Group* group : by_size) {
        if (std::ranges::any_of(group->drones, [&](DroneId d) { return taken[d.value]; })) continue;
        for (const DroneId d : group->drones) taken[d.value] = true;
        out.push_back(group->drones);
    }
    return out;
}

/// Paper 002's two-level control among the mission's obstacles. On a carrier these stand where no leg is planned.
Result<Interpolation> steered(const Mission& mission, const Route& route, const Leg& leg, const Run& run) {
    const double pads_z_m = std::ranges::max(mission.fleet.pads_m, {}, &Vec3::z).z;
    const double keep_m = required_separation_m(mission, leg);
    SteerTask task;
    task.from_m = leg.from_m;
    task.to_m = leg.to_m;
    task.groups = steered_groups(route, leg.from_m.size());
    task.metric = {mission.limits.downwash};
    if (!mission.carrier) task.space.airspace = mission.airspace;
    task.space.floor_z_m = pads_z_m + mission.limits.min_navigation_altitude_m;
    task.space.ceiling_z_m = pads_z_m + mission.limits.ceiling_m;
    task.space.keep_m = keep_m;
    task.spacing_m = std::max(mission.limits.formation_spacing_m, keep_m);
    task.options = leg.how.steer;
    return steer(task, run);
}

}  // namespace

Result<SpectralKeyframe> graph_keyframe(const Mission& mission, const Route& route, const Points& by_drone_m,
                                        const Run& run, std::span<const ObstacleVertex> obstacles) {
    Points all_m = by_drone_m, fixed_m;
    for (const ObstacleVertex& obstacle : obstacles) fixed_m.push_back(obstacle.at_m);
    all_m.insert(all_m.end(), fixed_m.begin(), fixed_m.end());
    const auto solids = mission.carrier ? std::vector<geo::Obstacle>{} : mission.airspace.obstacles;
    const auto graph = adjacency_around(by_drone_m, obstacles, solids, run);
    if (!graph) {
        if (graph.error().code == ErrorCode::stopped) return graph.error();
        return Error{graph.error().code, "neighbours around the obstacles: " + graph.error().message};
    }
    return SpectralKeyframe{by_drone_m, edited_adjacency(*graph, all_m, route.groups, mission.adjacency), fixed_m};
}

Result<LegShape> LegShape::of(const Mission& mission, const Route& route, const Leg& leg, Method method,
                              const Run& run) {
    LegShape shape;
    shape.from_m_ = leg.from_m;
    shape.to_m_ = leg.to_m;
    shape.profile_ = leg.how.profile;
    shape.delay_ = starting_order(leg.from_m, leg.to_m);
    if (method == Method::straight && leg.how.groups.empty()) return shape;
    if (method == Method::steered) {
        auto flown = steered(mission, route, leg, run);
        if (!flown) return flown.error();
        shape.interpolation_ = std::move(*flown);
        return shape;
    }
    auto tree = motion_tree(mission, route, leg, method);
    if (!tree) return tree.error();
    // Obstacles stand where they are in the ground frame; on a carrier that is not where legs are planned.
    const auto obstacles =
        mission.carrier ? std::vector<ObstacleVertex>{}
                        : obstacle_vertices(mission.airspace.obstacles, mission.obstacle_weights, leg.from_m, leg.to_m);
    const auto from = graph_keyframe(mission, route, leg.from_m, run, obstacles);
    if (!from) return from.error();
    const auto to = graph_keyframe(mission, route, leg.to_m, run, obstacles);
    if (!to) return to.error();
    auto drawn = hierarchical_interpolation(*from, *to, *tree, run);
    if (!drawn) return drawn.error();
    shape.interpolation_ = std::move(*drawn);
    return shape;
}

Lattice LegShape::straight(std::size_t rows, double stagger_share) const {
    const std::size_t n = from_m_.size();
    Lattice lattice{n, Points(rows * n)};
    const std::vector<double> together = profile_rows(profile_, rows);
    for (std::size_t k = 0; k < rows; ++k) {
        const double u = (static_cast<double>(k) - 1.0) / static_cast<double>(rows - 3);
        for (std::size_t i = 0; i < n; ++i) {
            double s = together[k];
            if (stagger_share > 0.0 && k >= 3 && k + 3 < rows)
                s = profile_value(profile_, (u - stagger_share * delay_[i]) / (1.0 - stagger_share));
            lattice.at(k, i) = (1.0 - s) * from_m_[i] + s * to_m_[i];
        }
    }
    return lattice;
}

Lattice LegShape::lattice(std::size_t rows, double stagger_share) const {
    if (!interpolation_) return straight(rows, stagger_share);
    const std::size_t n = from_m_.size(), knots = rows - 2;
    Points samples_m(knots * n);
    std::vector<double> shares;
    for (std::size_t m = 0; m < knots; ++m)
        shares.push_back(profile_value(profile_, static_cast<double>(m) / static_cast<double>(knots - 1)));
    interpolation_->sample(shares, samples_m);
    std::copy(from_m_.begin(), from_m_.end(), samples_m.begin());
    std::copy(to_m_.begin(), to_m_.end(), samples_m.end() - static_cast<std::ptrdiff_t>(n));
    return lattice_through(samples_m, n);
}

}  // namespace aerogram::planner
