#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "export/report/parts.hpp"
#include "export/verify/shapes.hpp"
#include "export/verify/worst.hpp"

/// The show turned or moved as a whole, while fence, audience and obstacles stay where they are. The same as moving
/// those the other way round, which is what is done here.
namespace aerogram::exporter {
namespace {

constexpr Tolerance kExact{1e-4, 1e-3};
constexpr std::size_t kPiecesABall = 16;

struct Change {
    std::string name;
    double turned_rad = 0.0;  ///< counter-clockwise
    Vec2 moved_m{};

    [[nodiscard]] Vec2 of(const Vec2& p) const {
        const double c = std::cos(turned_rad), s = std::sin(turned_rad);
        return Vec2{c * p.x - s * p.y, s * p.x + c * p.y} + moved_m;
    }
    [[nodiscard]] Vec2 undone(const Vec2& q) const {
        const double c = std::cos(turned_rad), s = std::sin(turned_rad);
        const Vec2 p = q - moved_m;
        return {c * p.x + s * p.y, -s * p.x + c * p.y};
    }
};

std::vector<Change> changes(const std::optional<geo::ShowOrigin>& origin) {
    std::vector<Change> all;
    for (const int degrees : {1, 3, 5, 7}) {
        for (const int sign : {1, -1}) {
            // A compass heading turns clockwise.
            all.push_back({"heading " + std::string(sign > 0 ? "+" : "-") + std::to_string(degrees) + "\u00b0",
                           -sign * degrees * std::numbers::pi / 180.0,
                           {}});
        }
    }
    const double heading = origin ? origin->heading_deg * std::numbers::pi / 180.0 : 0.0;
    const Vec2 north{-std::sin(heading), std::cos(heading)}, east{std::cos(heading), std::sin(heading)};
    const std::array<std::pair<const char*, Vec2>, 4> ways{
        {{"north", north}, {"east", east}, {"south", -north}, {"west", -east}}};
    for (const int metres : {1, 3, 5}) {
        for (const auto& [name, way] : ways)
            all.push_back({"origin " + std::to_string(metres) + " m " + name, 0.0, static_cast<double>(metres) * way});
    }
    return all;
}

geo::Airspace undone(const Change& change, geo::Airspace air) {
    const auto move = [&](geo::Polygon& outline) {
        for (Vec2& p : outline) p = change.undone(p);
    };
    move(air.geofence_m);
    for (geo::Polygon& outline : air.audience_m) move(outline);
    for (geo::Obstacle& obstacle : air.obstacles) {
        if (auto* prism = std::get_if<geo::Prism>(&obstacle.shape)) move(prism->outline_m);
        if (auto* cylinder = std::get_if<geo::Cylinder>(&obstacle.shape))
            cylinder->center_m = change.undone(cylinder->center_m);
    }
    return air;
}

struct Margins {
    Worst fence, audience, obstacle;
    double moved_m = 0.0;
};

/// Around the control points of some pieces: margins change by at most a metre a metre.
struct Ball {
    Vec3 low_m = Vec3(std::numeric_limits<double>::infinity()), high_m = -low_m;

    void include(std::span<const Vec3> controls) {
        for (const Vec3& p : controls) low_m = glm::min(low_m, p), high_m = glm::max(high_m, p);
    }
    [[nodiscard]] Vec3 middle_m() const { return 0.5 * (low_m + high_m); }
    [[nodiscard]] double radius_m() const { return 0.5 * glm::length(high_m - low_m); }
};

/// One flight, with balls around runs of its pieces.
class Way {
  public:
    explicit Way(RecordedDrone drone) : drone_(std::move(drone)) {
        for (std::size_t k = 0; k < drone_.pieces.size(); ++k) {
            if (k % kPiecesABall == 0) balls_.emplace_back();
            balls_.back().include(controls_of(drone_, drone_.pieces[k]));
        }
        for (const Ball& ball : balls_) {
            all_.low_m = glm::min(all_.low_m, ball.low_m);
            all_.high_m = glm::max(all_.high_m, ball.high_m);
        }
    }

    /// Lowers `worst` to the smallest of a margin along the way.
    template <class Of, class BoundOf>
    void lower(const Of& of, const BoundOf& bound_of, Worst& worst) const {
        const auto beyond = [&](const Ball& ball) { return of(ball.middle_m()) - ball.radius_m() >= worst.bound; };
        if (beyond(all_)) return;
        for (std::size_t b = 0; b < balls_.size(); ++b) {
            if (beyond(balls_[b])) continue;
            const std::size_t end = std::min(drone_.pieces.size(), (b + 1) * kPiecesABall);
            for (std::size_t k = b * kPiecesABall; k < end; ++k) {
                Ball own;
                own.include(controls_of(drone_, drone_.pieces[k]));
                if (!beyond(own)) minimise(timed(drone_, drone_.pieces[k]), kExact, of, bound_of, worst);
            }
        }
    }

    /// How far the change moves the point that it moves most: where the controls are, so that no point moves more.
    [[nodiscard]] double moved_m(const Change& change) const {
        if (change.turned_rad == 0.0) return glm::length(change.moved_m);
        double farthest2 = 0.0;
        for (const Vec3& p : drone_.controls_m) farthest2 = std::max(farthest2, p.x * p.x + p.y * p.y);
        return 2.0 * std::abs(std::sin(0.5 * change.turned_rad)) * std::sqrt(farthest2);
    }

  private:
    RecordedDrone drone_;
    std::vector<Ball> balls_;
    Ball all_;
};

void lower(const Way& way, const geo::Airspace& air, Margins& margins) {
    if (!air.geofence_m.empty()) {
        way.lower(
            [&](const Vec3& p) {
                return inner_margin(air.geofence_m, {p.x, p.y});
            },
            [&](const Bezier& curve) { return inner_margin_bound(air.geofence_m, curve); }, margins.fence);
    }
    for (const geo::Polygon& outline : air.audience_m) {
        way.lower(
            [&](const Vec3& p) {
                return -inner_margin(outline, {p.x, p.y});
            },
            [&](const Bezier& curve) { return outer_margin_bound(outline, curve); }, margins.audience);
    }
    for (const geo::Obstacle& solid : air.obstacles) {
        way.lower([&](const Vec3& p) { return solid_margin(solid, p); },
                  [&](const Bezier& curve) { return solid_margin_bound(solid, curve); }, margins.obstacle);
    }
}

void merge(Margins& into, const Margins& other) {
    for (const auto each : {&Margins::fence, &Margins::audience, &Margins::obstacle}) {
        if ((other.*each).bound < (into.*each).bound) into.*each = other.*each;
    }
    into.moved_m = std::max(into.moved_m, other.moved_m);
}

std::optional<double> margin(const Worst& worst) {
    if (!worst.seen()) return std::nullopt;
    return worst.bound;
}

}  // namespace

void report_sensitivity(const OutgoingShow& show, const Run& run, Report& report) {
    const std::vector<Change> all = changes(show.facts().origin);
    std::vector<geo::Airspace> airs;
    for (const Change& change : all) airs.push_back(undone(change, show.facts().airspace));
    std::vector<std::vector<Margins>> parts((show.drones() + kDronesAPart - 1) / kDronesAPart,
                                            std::vector<Margins>(all.size()));
    parallel_for(parts.size(), run, "turning and moving the show", [&](std::size_t part) {
        for (std::size_t d = part * kDronesAPart; d < std::min(show.drones(), (part + 1) * kDronesAPart); ++d) {
            Flight flight = show.flight(d);
            RecordedDrone drone;
            drone.pieces = std::move(flight.pieces);
            drone.controls_m = std::move(flight.controls_m);
            const Way way(std::move(drone));
            for (std::size_t c = 0; c < all.size(); ++c) {
                lower(way, airs[c], parts[part][c]);
                parts[part][c].moved_m = std::max(parts[part][c].moved_m, way.moved_m(all[c]));
            }
        }
    });
    for (std::size_t c = 0; c < all.size(); ++c) {
        Margins worst;
        for (const auto& part : parts) merge(worst, part[c]);
        ReportSensitivity one{all[c].name, margin(worst.fence), margin(worst.audience), margin(worst.obstacle),
                              worst.moved_m};
        const auto broken = [](const std::optional<double>& m) { return m && *m < -1e-3; };
        one.held = !broken(one.geofence_margin_m) && !broken(one.audience_margin_m) && !broken(one.obstacle_margin_m);
        report.sensitivities.push_back(std::move(one));
    }
}

}  // namespace aerogram::exporter
