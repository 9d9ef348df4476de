#include "planner/transition/hierarchy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "geo/contract.hpp"
#include "geo/units.hpp"
#include "planner/adjacency/subgraph.hpp"
#include "planner/transition/alignment.hpp"
#include "planner/transition/columns.hpp"
#include "planner/transition/rigid.hpp"

namespace aerogram::planner {
namespace {

constexpr double kNearHalfTurn_rad = 150.0 * kPi / 180.0;
constexpr double kSameTurn_rad = 30.0 * kPi / 180.0;
constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

SpectralKeyframe without_fixed(const SpectralKeyframe& keyframe) {
    std::vector<std::uint32_t> drones(keyframe.positions_m.size());
    for (std::uint32_t i = 0; i < drones.size(); ++i) drones[i] = i;
    return {keyframe.positions_m, induced_subgraph(keyframe.graph, drones)};
}

Interpolation straight_lines(const Points& from_m, const Points& to_m) {
    return [from_m, to_m](double t, std::span<Vec3> out) {
        AEROGRAM_REQUIRE(out.size() == from_m.size(), out.size(), from_m.size());
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = (1.0 - t) * from_m[i] + t * to_m[i];
    };
}

/// A group made ready: where its drones are about its barycentre (the fleet: about the origin).
struct Body {
    std::size_t drones = 0;
    std::size_t individuals = 0;
    std::optional<Interpolation> individual_motion;
    std::optional<Interpolation> alone;  ///< the method on all drones; only where a group inside has blend < 1
    std::vector<Turn> frame;             ///< turns in which the keyframes are given, outermost first
    struct Loose {
        std::size_t individual, place;
    };
    std::vector<Loose> loose;
    struct Part;
    std::vector<Part> parts;
};
struct Body::Part {
    std::size_t individual = 0;
    double blend = 1.0;
    std::vector<std::uint32_t> places;  ///< in the body around it
    Body body;
};

Vec3 turned_by(const std::vector<Turn>& frame, double exponent, Vec3 p) {
    if (exponent < 0.0) {
        for (const Turn& turn : frame) p = turned(turn, exponent, p);
    } else {
        for (std::size_t k = frame.size(); k-- > 0;) p = turned(frame[k], exponent, p);
    }
    return p;
}

/// The turn that a method makes of a shape; nothing where it makes none.
std::optional<Turn> own_turn(Method method, const SpectralOptions& options, const Points& from_m, const Points& to_m) {
    const Align align = method == Method::spectral ? options.align : Align::kabsch;
    if (method == Method::straight || align == Align::none || from_m.size() < 2) return std::nullopt;
    const Points from = centred(from_m, barycentre(from_m)), to = centred(to_m, barycentre(to_m));
    return alignment_turn(from, to, align).inverse();
}

/// The angle by which `shape` still turns in the given frame.
double angle_in(const std::vector<Turn>& frame, Align align, const Points& from_m, Points to_m) {
    for (Vec3& p : to_m) p = turned_by(frame, -1.0, p);
    return alignment_turn(from_m, to_m, align).angle_rad;
}

/// The part of a keyframe that is one group's, about its barycentre.
SpectralKeyframe part_of(const SpectralKeyframe& keyframe, const std::vector<std::uint32_t>& places) {
    SpectralKeyframe out;
    for (const std::uint32_t i : places) out.positions_m.push_back(keyframe.positions_m[i]);
    out.positions_m = centred(out.positions_m, barycentre(out.positions_m));
    out.graph = induced_subgraph(keyframe.graph, places);
    return out;
}

/// The keyframe of a body's individuals. @param owner  one a drone: its individual.
SpectralKeyframe individuals_of(const SpectralKeyframe& keyframe, const std::vector<std::uint32_t>& owner,
                                std::size_t count) {
    SpectralKeyframe out{Points(count), {}, keyframe.fixed_m};
    std::vector<double> size(count, 0.0);
    for (std::size_t i = 0; i < owner.size(); ++i) {
        out.positions_m[owner[i]] += keyframe.positions_m[i];
        size[owner[i]] += 1.0;
    }
    for (std::size_t k = 0; k < count; ++k) out.positions_m[k] /= size[k];
    std::vector<std::uint32_t> vertex_owner = owner;
    for (std::size_t f = 0; f < keyframe.fixed_m.size(); ++f) {
        vertex_owner.push_back(static_cast<std::uint32_t>(count + f));
    }
    out.graph = contracted_graph(keyframe.graph, vertex_owner, count + keyframe.fixed_m.size());
    return out;
}

class Builder {
  public:
    explicit Builder(const Run& run) { quiet_.stop = run.stop; }

    /// @param ids  the drone at each place of the keyframes.
    Result<Body> build(const SpectralKeyframe& source, const SpectralKeyframe& target, const GroupMotion& group,
                       const std::vector<DroneId>& ids, std::vector<Turn> frame) const {
        if (quiet_.stopped()) return stopped_error();
        Body body;
        body.drones = ids.size();
        body.frame = std::move(frame);
        const std::vector<std::uint32_t> owner = divide(group, ids, body);
        SpectralKeyframe goal = target;
        for (Vec3& p : goal.positions_m) p = turned_by(body.frame, -1.0, p);

        const SpectralKeyframe from = body.parts.empty() ? source : individuals_of(source, owner, body.individuals);
        const SpectralKeyframe to = body.parts.empty() ? goal : individuals_of(goal, owner, body.individuals);
        auto motion = interpolation(group.method, from, to, group.spectral, quiet_);
        if (!motion) return motion.error();
        body.individual_motion = std::move(*motion);
        if (std::ranges::any_of(body.parts, [](const Body::Part& p) { return p.blend < 1.0; })) {
            auto alone = interpolation(group.method, source, goal, group.spectral, quiet_);
            if (!alone) return alone.error();
            body.alone = std::move(*alone);
        }
        std::vector<Turn> around = body.frame;
        const auto turn = own_turn(group.method, group.spectral, from.positions_m, to.positions_m);
        if (turn) around.push_back(*turn);
        for (std::size_t k = 0; k < body.parts.size(); ++k) {
            auto part =
                build_part(source, target, group.inside[k], ids, body.parts[k].places, around, turn.has_value());
            if (!part) return part.error();
            body.parts[k].body = std::move(*part);
        }
        return body;
    }

  private:
    Result<Body> build_part(const SpectralKeyframe& source, const SpectralKeyframe& target, const GroupMotion& group,
                            const std::vector<DroneId>& ids, const std::vector<std::uint32_t>& places,
                            const std::vector<Turn>& around, bool parent_turns) const {
        const SpectralKeyframe from = part_of(source, places), to = part_of(target, places);
        const auto turn = own_turn(group.method, group.spectral, from.positions_m, to.positions_m);
        const Align align = group.method == Method::spectral ? group.spectral.align : Align::kabsch;
        const bool with_parent = parent_turns && turn && turn->angle_rad >= kNearHalfTurn_rad &&
                                 angle_in(around, align, from.positions_m, to.positions_m) <= kSameTurn_rad;
        std::vector<DroneId> mine;
        for (const std::uint32_t i : places) mine.push_back(ids[i]);
        return build(from, to, group, mine, with_parent ? around : std::vector<Turn>{});
    }

    /// Sorts places into individuals, which count up by their first place. @returns each place's individual.
    static std::vector<std::uint32_t> divide(const GroupMotion& group, const std::vector<DroneId>& ids, Body& body) {
        std::vector<std::uint32_t> part_at(ids.size(), kNobody), owner(ids.size());
        body.parts.resize(group.inside.size());
        for (std::size_t k = 0; k < group.inside.size(); ++k) {
            const GroupMotion& part = group.inside[k];
            AEROGRAM_REQUIRE(!part.drones.empty() && part.blend >= 0.0 && part.blend <= 1.0, k, part.blend);
            body.parts[k].blend = part.blend;
            for (const DroneId d : part.drones) {
                const auto place = std::ranges::lower_bound(ids, d);
                AEROGRAM_REQUIRE(place != ids.end() && *place == d, d.number());
                const auto i = static_cast<std::uint32_t>(place - ids.begin());
                AEROGRAM_REQUIRE(part_at[i] == kNobody, d.number());
                part_at[i] = static_cast<std::uint32_t>(k);
                body.parts[k].places.push_back(i);
            }
        }
        for (std::uint32_t i = 0; i < ids.size(); ++i) {
            const auto next = static_cast<std::uint32_t>(body.individuals);
            if (part_at[i] == kNobody) {
                body.loose.push_back({body.individuals++, i});
                owner[i] = next;
                continue;
            }
            Body::Part& part = body.parts[part_at[i]];
            if (part.places.front() == i) part.individual = body.individuals++;
            owner[i] = static_cast<std::uint32_t>(part.individual);
        }
        return owner;
    }

    Run quiet_;
};

/// What a motion of `count` individuals does, one row an instant, out of the body's frame.
Points rows_of(const Interpolation& motion, std::size_t count, const std::vector<Turn>& frame,
               std::span<const double> shares) {
    Points rows(shares.size() * count);
    motion.sample(shares, rows);
    for (std::size_t i = 0; i < rows.size() && !frame.empty(); ++i) {
        rows[i] = turned_by(frame, shares[i / count], rows[i]);
    }
    return rows;
}

/// Places of all drones of a body, one row an instant; groups about any point.
Points places_of(const Body& body, std::span<const double> shares) {
    const std::size_t n = body.drones;
    const Points individuals = rows_of(*body.individual_motion, body.individuals, body.frame, shares);
    const Points alone = body.alone ? rows_of(*body.alone, n, body.frame, shares) : Points{};
    Points out(shares.size() * n);
    for (std::size_t s = 0; s < shares.size(); ++s) {
        for (const Body::Loose& l : body.loose) out[s * n + l.place] = individuals[s * body.individuals + l.individual];
    }
    for (const Body::Part& part : body.parts) {
        const std::size_t m = part.places.size();
        const Points inside = places_of(part.body, shares);
        for (std::size_t s = 0; s < shares.size(); ++s) {
            const std::span<const Vec3> row(inside.data() + s * m, m);
            const Vec3 shift = individuals[s * body.individuals + part.individual] - barycentre(row);
            for (std::size_t i = 0; i < m; ++i) {
                Vec3& at = out[s * n + part.places[i]];
                at = shift + row[i];
                if (part.blend < 1.0) at = part.blend * at + (1.0 - part.blend) * alone[s * n + part.places[i]];
            }
        }
    }
    return out;
}

}  // namespace

Result<Interpolation> interpolation(Method method, const SpectralKeyframe& source, const SpectralKeyframe& target,
                                    const SpectralOptions& spectral, const Run& run) {
    AEROGRAM_REQUIRE(source.positions_m.size() == target.positions_m.size(), source.positions_m.size(),
                     target.positions_m.size());
    if (run.stopped()) return stopped_error();
    if (method == Method::straight) return straight_lines(source.positions_m, target.positions_m);
    if (method == Method::rigid) return rigid_transition(without_fixed(source), without_fixed(target), run);
    AEROGRAM_REQUIRE(method == Method::spectral);  // a flow or a choice is made of these, not one of them
    auto built = SpectralTransition::between(source, target, spectral, run);
    if (!built) return built.error();
    const auto transition = std::make_shared<const SpectralTransition>(std::move(*built));
    return Interpolation(
        [transition](double t, std::span<Vec3> out) { transition->at(t, out); },
        [transition](std::span<const double> shares, std::span<Vec3> out) { transition->sample(shares, out); });
}

Result<Interpolation> hierarchical_interpolation(const SpectralKeyframe& source, const SpectralKeyframe& target,
                                                 const GroupMotion& fleet, const Run& run) {
    const std::size_t n = source.positions_m.size();
    AEROGRAM_REQUIRE(fleet.drones.size() == n && target.positions_m.size() == n, fleet.drones.size(), n);
    for (std::size_t i = 0; i < n; ++i) AEROGRAM_REQUIRE(fleet.drones[i] == DroneId(i), i);
    if (fleet.inside.empty()) return interpolation(fleet.method, source, target, fleet.spectral, run);
    auto built = Builder(run).build(source, target, fleet, fleet.drones, {});
    if (!built) return built.error();
    const auto body = std::make_shared<const Body>(std::move(*built));
    run.report("hierarchy", 1.0);
    const auto sample = [body](std::span<const double> shares, std::span<Vec3> out) {
        const Points places = places_of(*body, shares);
        AEROGRAM_REQUIRE(out.size() == places.size(), out.size(), places.size());
        std::ranges::copy(places, out.begin());
    };
    return Interpolation([sample](double t, std::span<Vec3> out) { sample(std::span(&t, 1), out); }, sample);
}

}  // namespace aerogram::planner
