#include "planner/sketch/formation_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geo/contract.hpp"
#include "planner/sketch/principal_axes.hpp"

namespace aerogram::planner {
namespace {

constexpr double kFlat = 0.02;  ///< thinnest spread over the largest

template <class Vector>
Vector center_of(std::span<const Vector> points, std::span<const double> weights) {
    AEROGRAM_REQUIRE(!points.empty() && (weights.empty() || weights.size() == points.size()), points.size());
    Vector sum{};
    double all = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double w = weights.empty() ? 1.0 : weights[i];
        sum += w * (points[i] - points[0]);
        all += w;
    }
    AEROGRAM_REQUIRE(all > 0.0, all);
    return points[0] + sum / all;
}

/// Both axes and their diagonals.
std::array<Vec2, 8> eight_directions(const Vec2& main) {
    const Vec2 other(-main.y, main.x);
    std::array<Vec2, 8> out;
    for (std::size_t k = 0; k < 8; ++k) {
        static constexpr std::array<int, 8> kAlong{1, 1, 0, -1, -1, -1, 0, 1};
        out[k] =
            glm::normalize(static_cast<double>(kAlong[k]) * main + static_cast<double>(kAlong[(k + 6) % 8]) * other);
    }
    return out;
}

template <class Vector>
std::size_t nearest(std::span<const Vector> directions, const Vector& d) {
    std::size_t best = 0;
    double most = -1e300;
    for (std::size_t k = 0; k < directions.size(); ++k) {
        const double along = glm::dot(directions[k], d);
        if (along <= most) continue;
        most = along;
        best = k;
    }
    return best;
}

template <class Vector>
void measure_radii(std::span<const Vector> points, const Vector& center, std::span<const Vector> directions,
                   std::span<double> radius) {
    for (const Vector& p : points) {
        double& r = radius[nearest(directions, p - center)];
        r = std::max(r, glm::length(p - center));
    }
    // A direction in which nobody stands has its opposite's radius, else the largest.
    const double largest = *std::max_element(radius.begin(), radius.end());
    std::vector<double> measured(radius.begin(), radius.end());
    for (std::size_t k = 0; k < directions.size(); ++k) {
        if (measured[k] > 0.0) continue;
        const double opposite = measured[nearest(directions, -directions[k])];
        radius[k] = opposite > 0.0 ? opposite : largest;
    }
}

Vec2 turned(const Vec2& reference, double x, double y) {
    return {reference.x * x + reference.y * y, reference.x * y - reference.y * x};
}

}  // namespace

PlaneFrame plane_frame(std::span<const Vec2> points, std::span<const double> weights, double reference_rad) {
    PlaneFrame frame;
    frame.center = center_of(points, weights);
    frame.reference = {std::cos(reference_rad), std::sin(reference_rad)};
    frame.direction = eight_directions(main_axis(points, frame.center, weights));
    measure_radii<Vec2>(points, frame.center, frame.direction, frame.radius);
    return frame;
}

FormationCoordinate coordinate_in(const PlaneFrame& frame, const Vec2& point) {
    const Vec2 d = point - frame.center;
    const double length = glm::length(d);
    const double radius = frame.radius[nearest<Vec2>(frame.direction, d)];
    if (!(length > 1e-12 * radius)) return {};
    const Vec2 told = turned(frame.reference, d.x / length, d.y / length);
    return {radius > 0.0 ? length / radius : 1.0, told.x, told.y, 0.0};
}

SpaceFrame space_frame(std::span<const Vec3> points, std::span<const double> weights, double reference_rad) {
    SpaceFrame frame;
    frame.center = center_of(points, weights);
    frame.reference = {std::cos(reference_rad), std::sin(reference_rad)};
    DrawingPlane plane;
    if (is_flat(points, plane)) {
        std::vector<Vec2> seen;
        for (const Vec3& p : points) seen.push_back(plane.seen(p));
        for (const Vec2& d : plane_frame(seen, weights).direction)
            frame.direction.push_back(d.x * plane.right + d.y * plane.up);
    } else {
        const SpaceAxes axes = space_axes(points, frame.center, weights);
        for (const int a : {1, 0, -1})
            for (const int b : {1, 0, -1})
                for (const int c : {1, 0, -1})
                    if (a != 0 || b != 0 || c != 0)
                        frame.direction.push_back(glm::normalize(static_cast<double>(a) * axes.axis[0] +
                                                                 static_cast<double>(b) * axes.axis[1] +
                                                                 static_cast<double>(c) * axes.axis[2]));
    }
    frame.radius.assign(frame.direction.size(), 0.0);
    measure_radii<Vec3>(points, frame.center, frame.direction, frame.radius);
    return frame;
}

FormationCoordinate coordinate_in(const SpaceFrame& frame, const Vec3& point) {
    const Vec3 d = point - frame.center;
    const double length = glm::length(d);
    const double radius = frame.radius[nearest<Vec3>(frame.direction, d)];
    if (!(length > 1e-12 * radius)) return {};
    const Vec2 told = turned(frame.reference, d.x / length, d.y / length);
    return {radius > 0.0 ? length / radius : 1.0, told.x, told.y, d.z / length};
}

std::vector<FormationCoordinate> coordinates_in(const PlaneFrame& frame, std::span<const Vec2> points) {
    std::vector<FormationCoordinate> out;
    out.reserve(points.size());
    for (const Vec2& p : points) out.push_back(coordinate_in(frame, p));
    return out;
}

std::vector<FormationCoordinate> coordinates_in(const SpaceFrame& frame, std::span<const Vec3> points) {
    std::vector<FormationCoordinate> out;
    out.reserve(points.size());
    for (const Vec3& p : points) out.push_back(coordinate_in(frame, p));
    return out;
}

bool is_flat(std::span<const Vec3> points, DrawingPlane& plane) {
    plane = {center_of(points, {}), {1, 0, 0}, {0, 0, 1}};
    const SpaceAxes axes = space_axes(points, plane.center);
    if (axes.spread[2] > kFlat * axes.spread[0]) return false;
    if (axes.spread[0] <= 0.0) return true;
    Vec3 normal = axes.axis[2];
    if (axes.spread[1] <= kFlat * axes.spread[0]) {  // a line: in the plane that holds x too
        normal = glm::cross(axes.axis[0], Vec3(1, 0, 0));
        if (glm::length(normal) < 1e-3) normal = {0, 1, 0};
        normal = glm::normalize(normal);
    }
    // Right is x as far as the plane has it; in a plane upright to x it is y.
    const auto in_plane = [&](const Vec3& v) { return v - glm::dot(v, normal) * normal; };
    Vec3 right = in_plane({1, 0, 0});
    if (glm::length(right) < 0.1) right = in_plane({0, 1, 0});
    plane.right = glm::normalize(right);
    plane.up = glm::normalize(glm::cross(plane.right, normal));
    const bool upright = std::abs(plane.up.z) > 0.1;
    if ((upright ? plane.up.z : plane.up.y) < 0.0) plane.up = -plane.up;
    return true;
}

}  // namespace aerogram::planner
