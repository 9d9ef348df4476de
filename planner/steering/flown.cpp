#include "planner/steering/flown.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace aerogram::planner {
namespace {

constexpr std::size_t kMostRows = 512;

double smooth_step(double u) {
    return u * u * u * (10.0 + u * (6.0 * u - 15.0));
}

/// A row before the first or after the last: mirrored through the end, so that ends stay where they are.
Vec3 at(const std::vector<Points>& rows, std::ptrdiff_t row, std::size_t drone) {
    const auto last = static_cast<std::ptrdiff_t>(rows.size()) - 1;
    const auto of = [&](std::ptrdiff_t r) {
        return rows[static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(r, 0, last))][drone];
    };
    if (row < 0) return 2.0 * of(0) - of(-row);
    if (row > last) return 2.0 * of(last) - of(2 * last - row);
    return of(row);
}

std::vector<Points> smoothed(const std::vector<Points>& rows, double sigma) {
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma));
    std::vector<double> weight;
    double sum = 0.0;
    for (std::ptrdiff_t k = -reach; k <= reach; ++k) {
        weight.push_back(std::exp(-0.5 * std::pow(static_cast<double>(k) / sigma, 2.0)));
        sum += weight.back();
    }
    std::vector<Points> out(rows.size(), Points(rows.front().size()));
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t d = 0; d < rows.front().size(); ++d) {
            Vec3 mean{};
            for (std::ptrdiff_t k = -reach; k <= reach; ++k)
                mean += weight[static_cast<std::size_t>(k + reach)] * at(rows, static_cast<std::ptrdiff_t>(r) + k, d);
            out[r][d] = mean / sum;
        }
    }
    return out;
}

}  // namespace

FlownRows::FlownRows(const Points& start_m, double step_m) : drones_(start_m.size()), step_m_(step_m), rows_{start_m} {
}

void FlownRows::add(const Points& now_m, double furthest_m) {
    since_m_ += furthest_m;
    if (since_m_ < step_m_) return;
    since_m_ = 0.0;
    rows_.push_back(now_m);
    if (rows_.size() < kMostRows) return;
    for (std::size_t r = 1; 2 * r < rows_.size(); ++r) rows_[r] = std::move(rows_[2 * r]);
    rows_.resize((rows_.size() + 1) / 2);
    step_m_ *= 2.0;
}

Interpolation FlownRows::motion(const Points& end_m, double smooth) && {
    if (rows_.size() < 2) rows_.push_back(end_m);
    const Points start_m = rows_.front();
    auto rows = std::make_shared<std::vector<Points>>(smoothed(rows_, smooth));
    const double last = static_cast<double>(rows->size() - 1);
    for (std::size_t d = 0; d < drones_; ++d) {
        const Vec3 early = start_m[d] - rows->front()[d], late = end_m[d] - rows->back()[d];
        for (std::size_t r = 0; r < rows->size(); ++r) {
            const double s = smooth_step(static_cast<double>(r) / last);
            (*rows)[r][d] += (1.0 - s) * early + s * late;
        }
        rows->front()[d] = start_m[d];
        rows->back()[d] = end_m[d];
    }
    return [rows, last](double t, std::span<Vec3> out) {
        const double place = std::clamp(t, 0.0, 1.0) * last;
        const auto row = std::min(static_cast<std::ptrdiff_t>(place), static_cast<std::ptrdiff_t>(last) - 1);
        const double u = place - static_cast<double>(row);
        for (std::size_t d = 0; d < out.size(); ++d) {  // Catmull-Rom through the rows
            const Vec3 a = at(*rows, row - 1, d), b = at(*rows, row, d), c = at(*rows, row + 1, d),
                       e = at(*rows, row + 2, d);
            const Vec3 curved =
                b + 0.5 * u * (c - a + u * (2.0 * a - 5.0 * b + 4.0 * c - e + u * (3.0 * (b - c) + e - a)));
            out[d] = u == 0.0 ? b : u == 1.0 ? c : curved;
        }
    };
}

}  // namespace aerogram::planner
