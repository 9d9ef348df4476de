#include "planner/mesh/solids.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "geo/contract.hpp"
#include "geo/units.hpp"

namespace aerogram::planner {
namespace {

// Round solids have this many rings from a pole to the rim, and four times as many chords round the rim: their facets
// are within 4e-4 of the width from the true surface.
constexpr std::uint32_t kRings = 40;
constexpr std::uint32_t kChords = 4 * kRings;
// Chords in a quarter of the rings near a pole, so that a cone's tip is round.
constexpr std::uint32_t kInnermost = 10;
constexpr std::uint32_t kRows = 24, kTubeChords = 80;

/// Radius and height of a ring by its share of the way from the pole to the rim.
using Profile = std::function<Vec2(double share)>;

Vec3 on_circle(double radius, double share, double height) {
    const double angle = 2.0 * kPi * share;
    return {radius * std::cos(angle), radius * std::sin(angle), height};
}

std::uint32_t add(TriangleMesh& mesh, const Vec3& p) {
    mesh.vertices.push_back(p);
    return static_cast<std::uint32_t>(mesh.vertices.size() - 1);
}

void add_triangle(TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, bool upwards) {
    if (upwards) {
        mesh.triangles.push_back({a, b, c});
    } else {
        mesh.triangles.push_back({c, b, a});
    }
}

/// The triangles of a quarter between a ring with `inner` chords in a quarter and the next one with as many or one
/// more.
template <class At, class Next>
void add_quarter(TriangleMesh& mesh, std::uint32_t inner, std::uint32_t outer, const At& in, const Next& out,
                 bool upwards) {
    for (std::uint32_t k = 0; k < outer; ++k) {
        add_triangle(mesh, in(k), out(k), out(k + 1), upwards);
        if (k < inner) add_triangle(mesh, in(k), out(k + 1), in(k + 1), upwards);
    }
}

/// A cap of rings around a pole, facing up or down; the n-th ring has 4n chords, and those near the pole more. The last
/// ring is `rim` where it is given (kChords vertices). Returns the last ring.
std::vector<std::uint32_t> add_cap(TriangleMesh& mesh, const Profile& profile, bool upwards,
                                   const std::vector<std::uint32_t>& rim = {}) {
    std::vector<std::uint32_t> inner(1, add(mesh, Vec3(0.0, 0.0, profile(0.0).y))), outer;
    for (std::uint32_t ring = 1; ring <= kRings; ++ring) {
        const std::uint32_t quarter = std::max(ring, kInnermost), chords = 4 * quarter;
        const Vec2 at = profile(static_cast<double>(ring) / kRings);
        outer = ring == kRings ? rim : std::vector<std::uint32_t>{};
        for (std::uint32_t i = 0; outer.size() < chords; ++i)
            outer.push_back(add(mesh, on_circle(at.x, static_cast<double>(i) / chords, at.y)));
        const std::uint32_t within = ring == 1 ? 0 : std::max(ring - 1, kInnermost);
        for (std::uint32_t q = 0; q < 4; ++q) {
            const auto in = [&](std::uint32_t k) { return inner[(q * within + k) % inner.size()]; };
            const auto out = [&](std::uint32_t k) { return outer[(q * quarter + k) % chords]; };
            add_quarter(mesh, within, quarter, in, out, upwards);
        }
        inner = outer;
    }
    return outer;
}

/// A wall outwards between two rings, the lower one first.
void add_wall(TriangleMesh& mesh, const std::vector<std::uint32_t>& low, const std::vector<std::uint32_t>& high) {
    for (std::size_t i = 0; i < low.size(); ++i) {
        const std::size_t next = (i + 1) % low.size();
        mesh.triangles.push_back({low[i], low[next], high[next]});
        mesh.triangles.push_back({low[i], high[next], high[i]});
    }
}

Profile flat(double height) {
    return [height](double share) { return Vec2(0.5 * share, height); };
}

/// Of a sphere one unit wide, its equator at `middle`; `up` is 1 for the upper half and -1 for the lower one.
Profile half_sphere(double middle, double up) {
    return [middle, up](double share) {
        const double angle = 0.5 * kPi * share;
        return Vec2(0.5 * std::sin(angle), share == 1.0 ? middle : middle + 0.5 * up * std::cos(angle));
    };
}

}  // namespace

TriangleMesh cube_mesh() {
    TriangleMesh mesh;
    for (const double z : {-0.5, 0.5}) {
        for (const double y : {-0.5, 0.5}) {
            for (const double x : {-0.5, 0.5}) mesh.vertices.emplace_back(x, y, z);
        }
    }
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

TriangleMesh sphere_mesh() {
    TriangleMesh mesh;
    const auto equator = add_cap(mesh, half_sphere(0.0, 1.0), true);
    add_cap(mesh, half_sphere(0.0, -1.0), false, equator);
    return mesh;
}

TriangleMesh dome_mesh(bool floor) {
    TriangleMesh mesh;
    const auto rim = add_cap(mesh, half_sphere(-0.25, 1.0), true);
    if (floor) add_cap(mesh, flat(-0.25), false, rim);
    return mesh;
}

TriangleMesh cylinder_mesh() {
    TriangleMesh mesh;
    auto low = add_cap(mesh, flat(-0.5), false);
    for (std::uint32_t row = 1; row < kRows; ++row) {
        std::vector<std::uint32_t> high;
        for (std::uint32_t i = 0; i < kChords; ++i)
            high.push_back(
                add(mesh, on_circle(0.5, static_cast<double>(i) / kChords, static_cast<double>(row) / kRows - 0.5)));
        add_wall(mesh, low, high);
        low = std::move(high);
    }
    add_wall(mesh, low, add_cap(mesh, flat(0.5), true));
    return mesh;
}

TriangleMesh cone_mesh() {
    TriangleMesh mesh;
    const auto rim = add_cap(
        mesh, [](double share) { return Vec2(0.5 * share, 0.5 - share); }, true);
    add_cap(mesh, flat(-0.5), false, rim);
    return mesh;
}

TriangleMesh torus_mesh(double tube) {
    AEROGRAM_REQUIRE(tube > 0.0 && tube < 0.5, tube);
    TriangleMesh mesh;
    const auto number = [](std::uint32_t around, std::uint32_t along) {
        return (around % kChords) * kTubeChords + along % kTubeChords;
    };
    for (std::uint32_t i = 0; i < kChords; ++i) {
        for (std::uint32_t k = 0; k < kTubeChords; ++k) {
            const Vec3 across = on_circle(0.5 * tube, static_cast<double>(k) / kTubeChords, 0.0);  // x out, y up
            add(mesh, on_circle(0.5 - 0.5 * tube + across.x, static_cast<double>(i) / kChords, across.y));
        }
    }
    for (std::uint32_t i = 0; i < kChords; ++i) {
        for (std::uint32_t k = 0; k < kTubeChords; ++k) {
            mesh.triangles.push_back({number(i, k), number(i + 1, k), number(i + 1, k + 1)});
            mesh.triangles.push_back({number(i, k), number(i + 1, k + 1), number(i, k + 1)});
        }
    }
    return mesh;
}

}  // namespace aerogram::planner
