#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

#include "geo/limits.hpp"
#include "geo/random.hpp"

/// Seeded random shows of any size, written as TOML so that a failure can be flown again from its text.
///
/// A show is tame or wild. A tame one can be flown by construction: formations, pads and everything between them are
/// clear of obstacles, fence and audience; every spacing is at least √2 times the planned separation, so that straight
/// flights of a matching of least squared distances keep it (twice where starts are staggered); moving holds, ceiling
/// and battery are ample; nobody is named, hurried or left unseparated. A wild one may ask for anything that the
/// mission page knows, possible or not.
namespace aerogram::property {

struct RandomShow {
    std::string text;
    std::size_t drones = 0, keyframes = 0;
    bool tame = false;
};

/// Writes one show.
class ShowWriter {
  public:
    ShowWriter(std::uint64_t seed, std::size_t most_drones) : random_(seed), seed_(seed) {
        // Sizes are log-uniform from 10 on.
        show_.drones = static_cast<std::size_t>(
            std::round(10.0 * std::pow(static_cast<double>(most_drones) / 10.0, random_.unit())));
        show_.tame = chance(0.72);
        show_.keyframes = 1 + random_.below(4);
    }

    RandomShow write() {
        choose_methods();
        write_limits();
        for (std::size_t k = 0; k < show_.keyframes; ++k) write_keyframe(k);
        const std::string top = head();  // knows how wide the pads are
        show_.text = top + limits_.str() + "ceiling_m = " + std::to_string(std::lround(top_m_ + 60.0)) + '\n' +
                     airspace() + keyframes_.str();
        return show_;
    }

  private:
    bool chance(double share) { return random_.unit() < share; }
    bool wildly(double share) { return chance(share) && !show_.tame; }
    double tenth(double low, double high) { return std::round(10.0 * random_.between(low, high)) / 10.0; }
    std::string one_of(const std::vector<std::string>& words) { return words[random_.below(words.size())]; }

    void choose_methods() {
        for (std::size_t k = 0; k < show_.keyframes; ++k)
            methods_.push_back(one_of({"straight", "straight", "straight", "spectral", "rigid", "auto", "flow"}));
        methods_.push_back("return");
        for (std::size_t k = 0; k < show_.keyframes; ++k)
            staggers_.push_back(methods_[k] == "straight" && chance(0.4) ? tenth(0.5, 5.0) : 0.0);
    }

    void write_limits() {
        const std::string preset = one_of({"dense", "standard", "standard", "conservative"});
        if (preset == "dense") {
            limit_.min_separation_m = 1.0;
            limit_.formation_spacing_m = 1.5;
        } else if (preset == "conservative") {
            limit_.min_separation_m = 2.0;
            limit_.formation_spacing_m = 3.0;
        }
        limits_ << "[limits]\npreset = \"" << preset << "\"\n";
        limit_.speed_horizontal_mps = tenth(3.0, 12.0);
        limit_.acceleration_mps2 = tenth(1.0, 4.0);
        limits_ << "speed_horizontal_mps = " << limit_.speed_horizontal_mps
                << "\nacceleration_mps2 = " << limit_.acceleration_mps2 << '\n';
        if (chance(0.3)) limits_ << "downwash = " << (limit_.downwash = tenth(1.0, 2.0)) << '\n';
        const bool staggered = *std::max_element(staggers_.begin(), staggers_.end()) > 0.0;
        if (staggered) {
            limit_.formation_spacing_m =
                std::max(limit_.formation_spacing_m, 2.0 * aerogram::planned_separation_m(limit_));
            limits_ << "formation_spacing_m = " << limit_.formation_spacing_m << '\n';
        } else if (wildly(0.3)) {
            limits_ << "min_separation_m = " << tenth(0.8, limit_.formation_spacing_m) << '\n';
        }
    }

    /// What the drones fill: a name for the keyframe's source, and a radius around its middle that surely holds it.
    struct Figure {
        std::string source;
        double radius_m = 0.0;
    };
    Figure figure(std::size_t drones) {
        const auto n = static_cast<double>(drones);
        // Upright spacings may be wider by the downwash.
        const double s = limit_.formation_spacing_m * limit_.downwash, side_m = s * std::sqrt(n) + 4.0 * s;
        std::vector<std::string> shapes{"grid", "sphere", "disc", "ring", "square", "text"};
        if (drones <= 300) shapes.insert(shapes.end(), {"circle", "helix"});
        if (drones <= 40) shapes.emplace_back("line");
        const std::string shape = one_of(shapes);
        if (shape == "text" && drones <= 300)
            return {"text = \"" + one_of({"T", "H", "E", "8", "AB", "OK"}) + '"', s * n + 4.0 * s};
        if (shape == "text")
            return {"text = \"" + one_of({"A", "OK", "WE", "2026"}) + "\"\nfont = \"DejaVu Sans Bold\"", 2.5 * side_m};
        const bool curve = shape == "line" || shape == "circle" || shape == "helix";
        return {"shape = \"" + shape + '"', curve ? 0.7 * s * n + 4.0 * s : side_m};
    }

    void write_keyframe(std::size_t k) {
        auto& out = keyframes_;
        const bool last = k + 1 == show_.keyframes;
        out << "[[keyframe]]\nname = \"k" << k + 1 << "\"\n";
        const bool spares = wildly(0.15) && show_.drones >= 20;
        const std::size_t flown = spares ? show_.drones - 1 - random_.below(show_.drones / 4) : show_.drones;
        const Figure drawn = figure(flown);
        const double reach_m = std::max(10.0, 0.1 * drawn.radius_m);
        const double x = tenth(-reach_m, reach_m), y = tenth(-reach_m, reach_m);
        const double z = std::ceil(drawn.radius_m + 10.0 + random_.between(0.0, 20.0));
        // Hold first: a flow that passes needs none.
        const bool passed = !last && methods_[k + 1] == "flow" && chance(0.5);
        const double drift_m = passed || chance(0.7) ? 0.0 : tenth(-8.0, 8.0);
        const double spin_deg = passed || chance(0.7) ? 0.0 : tenth(-120.0, 120.0);
        if (!last && !passed && wildly(0.1))
            out << "at_s = " << tenth(30.0, 200.0) * static_cast<double>(k + 1) << '\n';
        out << "center_m = [" << x << ", " << y << ", " << z << "]\n";
        if (chance(0.3))
            out << "rotate_deg = [" << tenth(-60, 60) << ", " << tenth(-30, 30) << ", " << tenth(-180, 180) << "]\n";
        out << "hold_s = " << (passed ? 0.0 : hold_s(drawn.radius_m, spin_deg, drift_m)) << '\n';
        if (drift_m != 0.0 || spin_deg != 0.0)
            out << "motion = { spin_deg = " << spin_deg << ", drift_m = [" << drift_m << ", 0, " << -0.5 * drift_m
                << "] }\n";
        if (!spares) out << drawn.source << '\n';
        if (!spares && wildly(0.1)) out << "size_m = { height = " << tenth(5.0, drawn.radius_m + 5.0) << " }\n";
        out << arrival(k);
        if (spares) out << "[[keyframe.part]]\ndrones = " << flown << '\n' << drawn.source << '\n';
        top_m_ = std::max(top_m_, z + 1.1 * drawn.radius_m);
        wide_m_ = std::max(wide_m_, std::hypot(x, y) + drawn.radius_m);
    }

    /// Long enough for the motion: minimum jerk on an arc of the rim.
    double hold_s(double radius_m, double spin_deg, double drift_m) {
        const double spin = std::abs(spin_deg) * 3.14159265358979 / 180.0, way_m = spin * radius_m + std::abs(drift_m);
        const double a = limit_.acceleration_mps2;
        const double needed_s = std::max({2.0 * way_m / limit_.speed_horizontal_mps, 1.5 * std::abs(drift_m),
                                          std::sqrt(8.0 * way_m / a), spin * std::sqrt(5.0 * radius_m / a),
                                          std::cbrt(80.0 * way_m / (4.0 * a)), spin * std::cbrt(20.0 * radius_m / a)});
        return std::ceil(10.0 * ((wildly(0.1) ? 0.7 : 1.3) * needed_s + tenth(0.5, 5.0))) / 10.0;
    }

    std::string arrival(std::size_t k) {
        std::ostringstream out;
        const std::string& method = methods_[k];
        std::string assign = "shortest";
        if (wildly(0.3)) assign = one_of({"bottleneck", "keep", "shortest"});
        if (method == "flow" && assign == "keep") assign = "shortest";
        out << "arrive = { method = \"" << method << "\", assign = \"" << assign << "\", profile = \""
            << one_of({"minimum-jerk", "minimum-jerk", "trapezoid", "s-curve"}) << '"';
        if (staggers_[k] > 0.0) out << ", stagger_s = " << staggers_[k];
        if (method == "spectral")
            out << ", spectral = { align = \"" << one_of({"kabsch", "pca", "none"}) << "\", reorder = \""
                << one_of({"optimal", "greedy", "max-min", "none"}) << "\" }";
        if (method == "flow")
            out << ", flow = { tension = " << (show_.tame ? 0.0 : tenth(0.0, 1.0))
                << ", corner = " << one_of({"false", "true"}) << " }";
        if (wildly(0.1)) out << ", separation = \"" << one_of({"none", "social_force"}) << '"';
        if (wildly(0.1)) out << ", duration_s = " << tenth(10.0, 200.0);
        if (wildly(0.1)) out << ", min_separation_m = " << tenth(0.7, 1.0) * limit_.formation_spacing_m;
        if (wildly(0.1)) out << ", pins = { 1 = " << 1 + random_.below(show_.drones) << " }";
        if (wildly(0.1)) out << ", forbid = [[2, " << 1 + random_.below(show_.drones) << "]]";
        out << " }\n";
        return out.str();
    }

    std::string head() {
        std::ostringstream out;
        const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(show_.drones))));
        const double tight_m = wildly(0.3) ? tenth(0.4, limit_.formation_spacing_m) : 0.0;
        const double spacing_m =
            tight_m > 0.0 ? tight_m : std::ceil(10.0 * limit_.formation_spacing_m + random_.between(0.0, 15.0)) / 10.0;
        pads_m_ = 0.75 * spacing_m * static_cast<double>(side);
        wide_m_ = std::max(wide_m_, pads_m_);
        out << "[show]\nname = \"random show\"\nseed = " << 1 + seed_ % 1000 << "\nobjective = \""
            << one_of({"shortest", "together", "smooth"})
            << "\"\norigin = { latitude_deg = 46.2, longitude_deg = 6.1, height_m = 420 }\n[fleet]\ndrones = "
            << show_.drones << "\npads = { rows = " << side << ", columns = " << side << ", spacing_m = " << spacing_m
            << " }\nendurance_s = " << (wildly(0.1) ? tenth(60.0, 400.0) : 86400.0) << '\n';
        if (!show_.tame) out << "spares = { where = \"" << one_of({"pads", "wings", "overflow"}) << "\" }\n";
        return out.str();
    }

    /// Fence, audience and obstacles around all that the show needs; wild ones may stand in its way.
    std::string airspace() {
        std::ostringstream out;
        const double clear_m = 1.5 * wide_m_ + 30.0, fence_m = 2.0 * clear_m + 100.0;
        out << "[airspace]\n";
        if (chance(0.5)) {
            out << "geofence = " << square(0.0, wildly(0.2) ? 0.4 * fence_m : fence_m) << '\n';
        }
        if (chance(0.4)) out << "audience = [" << square(-2.0 * clear_m, clear_m - 20.0) << "]\n";
        for (std::uint64_t left = random_.below(4); left > 0; --left) {
            const double turn = random_.between(0.0, 6.28), size_m = tenth(1.0, 8.0);
            const bool in_the_way = wildly(0.5);
            const double away_m =
                in_the_way ? random_.between(pads_m_ + 2.0 * size_m, clear_m) : clear_m + 2.0 * size_m;
            out << "[[airspace.obstacle]]\nheight_m = " << tenth(3.0, in_the_way ? top_m_ : 60.0) << "\ncenter_m = ["
                << std::fixed << std::setprecision(1) << away_m * std::cos(turn) << ", " << away_m * std::sin(turn)
                << "]\n"
                << std::defaultfloat << std::setprecision(6);
            if (chance(0.5)) {
                out << "kind = \"cylinder\"\nradius_m = " << size_m << '\n';
            } else {
                out << "kind = \"box\"\nsize_m = [" << size_m << ", " << size_m << "]\nrotate_deg = " << tenth(0, 90)
                    << '\n';
            }
        }
        return out.str();
    }
    /// A square in degrees, its middle north of the origin.
    static std::string square(double north_m, double half_m) {
        constexpr double kLatitudeMetres = 111'150.0, kLongitudeMetres = 77'180.0;  // a degree, at 46.2 north
        std::ostringstream out;
        out << std::setprecision(10) << '[';
        for (const auto& [x, y] : {std::pair{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
            out << (x == -1.0 && y == -1.0 ? "[" : ", [") << 46.2 + (north_m + y * half_m) / kLatitudeMetres << ", "
                << 6.1 + x * half_m / kLongitudeMetres << ']';
        out << ']';
        return out.str();
    }

    Random random_;
    std::uint64_t seed_;
    RandomShow show_;
    Limits limit_;
    std::vector<std::string> methods_;
    std::vector<double> staggers_;
    std::ostringstream limits_, keyframes_;
    double top_m_ = 0.0, wide_m_ = 0.0, pads_m_ = 0.0;
};

/// The show of a seed: 10 to most_drones drones, 1 to 4 keyframes.
inline RandomShow random_show(std::uint64_t seed, std::size_t most_drones) {
    return ShowWriter(seed, most_drones).write();
}

}  // namespace aerogram::property
