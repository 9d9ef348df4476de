#include "export/record/bezier.hpp"

#include "geo/contract.hpp"

namespace aerogram::exporter {

Vec3 value(const Bezier& curve, double u) {
    std::array<Vec3, kMaxDegree + 1> p = curve.control;
    for (std::size_t left = curve.degree; left > 0; --left) {
        for (std::size_t i = 0; i < left; ++i) p[i] = (1.0 - u) * p[i] + u * p[i + 1];
    }
    return p[0];
}

Bezier derivative(const Bezier& curve) {
    Bezier d;
    if (curve.degree == 0) return d;
    d.degree = curve.degree - 1;
    for (std::size_t i = 0; i <= d.degree; ++i) {
        d.control[i] = static_cast<double>(curve.degree) * (curve.control[i + 1] - curve.control[i]);
    }
    return d;
}

Bezier elevated(const Bezier& curve, std::size_t degree) {
    AEROGRAM_REQUIRE(degree >= curve.degree && degree <= kMaxDegree, curve.degree, degree);
    Bezier e = curve;
    while (e.degree < degree) {
        const auto next = static_cast<double>(e.degree + 1);
        e.control[e.degree + 1] = e.control[e.degree];
        for (std::size_t i = e.degree; i > 0; --i) {
            const double w = static_cast<double>(i) / next;
            e.control[i] = w * e.control[i - 1] + (1.0 - w) * e.control[i];
        }
        ++e.degree;
    }
    return e;
}

std::pair<Bezier, Bezier> split(const Bezier& curve, double u) {
    Bezier left, right = curve;
    left.degree = curve.degree;
    for (std::size_t step = 0; step <= curve.degree; ++step) {
        left.control[step] = right.control[0];
        for (std::size_t i = 0; i + step < curve.degree; ++i) {
            right.control[i] = (1.0 - u) * right.control[i] + u * right.control[i + 1];
        }
    }
    return {left, right};
}

Bezier restricted(const Bezier& curve, double from, double to) {
    AEROGRAM_REQUIRE(to > 0.0 && to >= from, from, to);
    if (curve.degree == 0) return curve;
    Bezier part = to == 1.0 ? curve : split(curve, to).first;
    return from == 0.0 ? part : split(part, from / to).second;
}

}  // namespace aerogram::exporter
