#include "planner/sampling/contour_track.hpp"

#include <algorithm>
#include <cmath>

namespace aerogram::planner {
namespace {

constexpr double kCornerCosine = 0.8660254;  ///< of 30 degrees

}  // namespace

ContourTrack::ContourTrack(const Contour& contour) : contour_(contour), along_{0.0} {
    for (std::size_t i = 0; i < contour.size(); ++i) {
        along_.push_back(along_.back() + glm::distance(contour[i], contour[(i + 1) % contour.size()]));
    }
}

Vec2 ContourTrack::at(double distance) const {
    if (length() <= 0.0) return contour_.front();
    distance = distance - length() * std::floor(distance / length());
    const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, distance);
    const auto i = static_cast<std::size_t>(after - along_.begin()) - 1;
    const double step = along_[i + 1] - along_[i];
    const Vec2 from = contour_[i], to = contour_[(i + 1) % contour_.size()];
    return step > 0.0 ? from + (to - from) * ((distance - along_[i]) / step) : from;
}

double ContourTrack::way(double a, double b) const {
    const double d = std::abs(a - b);
    return std::min(d, length() - d);
}

std::vector<Vec2> ContourTrack::between(double from, double to) const {
    std::vector<Vec2> line{at(from)};
    const auto next = std::upper_bound(along_.begin(), along_.end() - 1, from);
    auto i = static_cast<std::size_t>(next - along_.begin());
    for (double lap = 0.0; lap < 2.0; lap += 1.0, i = 0) {
        for (; i < contour_.size() && along_[i] + lap * length() < to; ++i) {
            if (contour_[i] != line.back()) line.push_back(contour_[i]);
        }
    }
    line.push_back(at(to));
    return line;
}

std::vector<std::size_t> corners_of(const Contour& contour) {
    std::vector<std::size_t> corners;
    const std::size_t n = contour.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Vec2 in = contour[i] - contour[(i + n - 1) % n], out = contour[(i + 1) % n] - contour[i];
        const double lengths = glm::length(in) * glm::length(out);
        if (lengths > 0.0 && glm::dot(in, out) < kCornerCosine * lengths) corners.push_back(i);
    }
    return corners;
}

std::vector<double> corner_places(const Contour& contour, const ContourTrack& track, double close) {
    std::vector<double> out;
    const std::vector<std::size_t> corners = corners_of(contour);
    for (std::size_t k = 0; k < corners.size();) {
        const double first = track.of_vertex(corners[k]);
        double last = first;
        for (++k; k < corners.size(); ++k) {
            const double next = track.of_vertex(corners[k]);
            if (next - last >= close || next - first >= 1.3 * close) break;
            last = next;
        }
        out.push_back(0.5 * (first + last));
    }
    if (out.size() < 2 || out.front() + track.length() - out.back() >= close) return out;
    const double joined = 0.5 * (out.front() + track.length() + out.back());  // across the contour's start
    out.erase(out.begin());
    out.pop_back();
    if (joined < track.length()) {
        out.push_back(joined);
    } else {
        out.insert(out.begin(), joined - track.length());
    }
    return out;
}

}  // namespace aerogram::planner
