#include "planner/sketch/sketch_template.hpp"

#include <algorithm>
#include <cmath>

#include "geo/contract.hpp"
#include "planner/sampling/boundary_count.hpp"
#include "planner/sketch/boundary_points.hpp"
#include "planner/sketch/flood_fill.hpp"

namespace aerogram::planner {
namespace {

constexpr double kClearance = 0.7;    ///< units; how near to boundary points the inside begins
constexpr double kTrialPlaces = 4.0;  ///< places an agent in the box at the first, small unit
constexpr double kTrialAtLeast = 1000.0;
constexpr double kDensest = 1e9;  ///< brushes multiply without end
constexpr int kUnitTries = 60, kWidenings = 6;
constexpr double kOversampled = 1.1;  ///< places inside an agent inside, at most

double real(std::size_t n) {
    return static_cast<double>(n);
}

/// How many of both kinds of points there are at a unit.
struct Trial {
    std::vector<Vec2> boundary;
    Filled inside;
};

class TemplateMaker {
  public:
    TemplateMaker(const SketchRegion& region, const std::vector<SketchPath>& paths, std::size_t count,
                  const TemplateOptions& options)
        : region_(region), paths_(paths), count_(count), options_(options) {
        for (const SketchPath& path : paths_) length_ += length_of(path);
        AEROGRAM_REQUIRE(length_ > 0.0 && count_ >= 1, length_, count_);
    }

    SketchTemplate make() {
        double unit = options_.unit ? std::max(*options_.unit, length_ / (4.0 * real(count_) + 4000.0)) : automatic();
        bool too_many = false;
        for (int k = 0; k < kUnitTries; ++k) {
            std::vector<Vec2> boundary = resampled(paths_, unit);
            if (boundary.size() > count_) {
                unit *= std::max(1.02, std::min(real(boundary.size()) / real(count_), 2.0));
                too_many = true;
                continue;
            }
            Filled inside = fill(boundary, unit);
            const std::size_t places = boundary.size() + inside.points.size();
            if (places >= count_) return made(std::move(boundary), std::move(inside), unit);
            if (too_many || inside.points.empty()) break;
            unit *= std::clamp(std::sqrt(real(places) / real(count_)), 0.7, 0.98);
        }
        return made(resampled_exactly(paths_, count_), {}, length_ / real(count_));
    }

  private:
    Filled fill(const std::vector<Vec2>& boundary, double unit) const {
        if (region_.curves().empty()) return {};
        return flood_filled(region_, boundary, unit, kClearance * unit);
    }

    /// Equations 1 and 2.
    double automatic() const {
        const Vec2 box = region_.bounds().size();
        double unit = std::max(std::sqrt(box.x * box.y / std::max(kTrialPlaces * real(count_), kTrialAtLeast)),
                               1e-3 * std::max(box.x, box.y));
        for (int k = 0; k < 3; ++k) {
            const auto boundary = resampled(paths_, unit);
            const double inside = real(fill(boundary, unit).points.size());
            unit = options_.p * length_ / boundary_count(real(count_), real(boundary.size()), inside);
        }
        return unit;
    }

    SketchTemplate made(std::vector<Vec2> boundary, Filled inside, double unit) const {
        SketchTemplate out;
        out.boundary = boundary.size();
        out.unit = unit;
        out.fill_unit = unit;
        out.unit_changed = options_.unit && std::abs(unit / *options_.unit - 1.0) > 1e-6;
        out.points = std::move(boundary);
        const std::size_t needed = count_ - out.boundary;
        if (needed == 0) return out;
        if (options_.density) {
            add_by_density(out, needed);
            if (out.points.size() >= count_) return out;
            out.points.resize(out.boundary);
        }
        inside = widened(out.points, std::move(inside), needed);
        out.fill_unit = inside.lattice.unit;
        out.inside_area = real(inside.points.size()) * out.fill_unit * out.fill_unit;
        out.points.insert(out.points.end(), inside.points.begin(), inside.points.end());
        return out;
    }

    /// The inside on a lattice wide enough that it has hardly more places than needed.
    Filled widened(const std::vector<Vec2>& boundary, Filled inside, std::size_t needed) const {
        double back = 1.0;
        for (int k = 0; k < kWidenings && real(inside.points.size()) > kOversampled * real(needed); ++k) {
            const double wider = std::sqrt(real(inside.points.size()) / (0.5 * (1.0 + kOversampled) * real(needed)));
            Filled next = fill(boundary, inside.lattice.unit * (1.0 + back * (wider - 1.0)));
            if (next.points.size() >= needed && next.points.size() <= inside.points.size()) {
                inside = std::move(next);
            } else {
                back *= 0.5;
            }
        }
        return inside;
    }

    /// Adds hardly more places inside than needed, spread by the density; too few when hardly a place has any.
    void add_by_density(SketchTemplate& out, std::size_t needed) const {
        for (double finer = 4.0; finer <= 16.0; finer *= 2.0) {
            const double unit = out.unit / finer * 2.0;
            const std::vector<Vec2> boundary(out.points.begin(), out.points.begin() + std::ptrdiff_t(out.boundary));
            const Filled fine = flood_filled(region_, boundary, unit, kClearance * out.unit);
            std::vector<float> density(fine.lattice.across * fine.lattice.up, 0.0F);
            double sum = 0.0;
            for (std::size_t k = 0; k < fine.cells.size(); ++k) {
                const double d = std::min(std::max(0.0, options_.density(fine.points[k])), kDensest);
                density[fine.cells[k]] = static_cast<float>(d);
                sum += d;
            }
            if (!(sum > 0.0)) return;
            const double highest = kDensityContrast * sum / real(fine.cells.size());
            sum = 0.0;
            for (float& d : density) {
                d = std::min(d, static_cast<float>(highest));
                sum += static_cast<double>(d);
            }
            out.points.resize(out.boundary);
            diffuse(fine.lattice, density, kOversampled * real(needed) / sum, out.points);
            out.fill_unit = fine.lattice.unit;
            out.inside_area = real(fine.cells.size()) * fine.lattice.unit * fine.lattice.unit;
            out.mean_density = sum / real(fine.cells.size());
            if (out.points.size() >= count_) return;
        }
    }

    /// Keeps a place with its density times `share`, the error handed on to the places around that come later.
    static void diffuse(const Lattice& lattice, const std::vector<float>& density, double share,
                        std::vector<Vec2>& points) {
        std::vector<double> here(lattice.across + 2, 0.0), above(lattice.across + 2, 0.0);
        for (std::size_t row = 0; row < lattice.up; ++row) {
            std::fill(above.begin(), above.end(), 0.0);
            for (std::size_t k = 0; k < lattice.across; ++k) {
                const bool forth = row % 2 == 0;
                const std::size_t c = forth ? k : lattice.across - 1 - k;
                const double d = static_cast<double>(density[row * lattice.across + c]) * share;
                double& error = here[c + 1];
                if (d <= 0.0) continue;  // outside: what is left over there is dropped
                const double value = error + std::min(d, 1.0);
                const bool kept = value >= 0.5;
                if (kept) points.push_back(lattice.at(c, row));
                const double left = value - (kept ? 1.0 : 0.0);
                here[forth ? c + 2 : c] += left * 7.0 / 16.0;
                above[forth ? c : c + 2] += left * 3.0 / 16.0;
                above[c + 1] += left * 5.0 / 16.0;
                above[forth ? c + 2 : c] += left * 1.0 / 16.0;
            }
            std::swap(here, above);
        }
    }

    const SketchRegion& region_;
    const std::vector<SketchPath>& paths_;
    std::size_t count_;
    const TemplateOptions& options_;
    double length_ = 0.0;
};

}  // namespace

SketchTemplate make_template(const SketchRegion& region, const std::vector<SketchPath>& paths, std::size_t count,
                             const TemplateOptions& options) {
    return TemplateMaker(region, paths, count, options).make();
}

}  // namespace aerogram::planner
