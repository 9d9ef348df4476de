#include "planner/replace.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "planner/gather.hpp"

namespace aerogram::planner {
namespace {

constexpr double kStill_m = 1e-6;

Error invalid(std::string message) {
    return {ErrorCode::invalid_input, std::move(message)};
}

std::optional<std::size_t> whole(std::string_view text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
    while (text.ends_with(' ')) text.remove_suffix(1);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc{} || end != text.data() + text.size() || value == 0) return std::nullopt;
    return value;
}

/// How much of the shift is gone at each row of an act that begins and ends at rest: minimum jerk.
double faded(std::size_t row, std::size_t rows) {
    if (row < 3) return 0.0;
    if (row + 3 >= rows) return 1.0;
    const double u = static_cast<double>(row - 1) / static_cast<double>(rows - 3);
    return u * u * u * (10.0 + u * (-15.0 + 6.0 * u));
}

/// Adds `from` at the act's beginning and `to` at its end.
void shift(Motion& motion, std::size_t drone, const Vec3& from, const Vec3& to) {
    if (auto* hold = std::get_if<Hold>(&motion)) {
        hold->positions_m[drone] += from;
    } else if (auto* straight = std::get_if<Straight>(&motion)) {
        straight->from_m[drone] += from;
        straight->to_m[drone] += to;
    } else {
        auto& lattice = std::get<Lattice>(motion);
        const std::size_t rows = lattice.rows();
        for (std::size_t k = 0; k < rows; ++k) lattice.at(k, drone) += from + faded(k, rows) * (to - from);
    }
}

bool rests_at_ends(const Motion& motion) {
    const auto* lattice = std::get_if<Lattice>(&motion);
    if (lattice == nullptr) return true;
    const std::size_t last = lattice->rows() - 1;
    for (std::size_t d = 0; d < lattice->drones; ++d)
        for (std::size_t k = 1; k < 3; ++k)
            if (glm::length(lattice->at(k, d) - lattice->at(0, d)) > kStill_m ||
                glm::length(lattice->at(last - k, d) - lattice->at(last, d)) > kStill_m)
                return false;
    return true;
}

/// The acts over which a shift fades and grows.
struct Transits {
    std::size_t first = 0, last = 0;
};
Result<Transits> transits_of(const FlightPlan& plan) {
    const auto is_transit = [](const Act& act) { return act.role == ActRole::transit; };
    const auto first = std::ranges::find_if(plan.acts, is_transit);
    const auto last = std::find_if(plan.acts.rbegin(), plan.acts.rend(), is_transit);
    const bool rests = std::ranges::all_of(plan.acts, [](const Act& act) { return rests_at_ends(act.motion); });
    if (plan.limits.plane || !rests)
        return invalid("a drone of a show that rides along a route cannot be replaced: plan the mission anew");
    if (first == plan.acts.end() || first == plan.acts.begin() || &*first == &*last || last == plan.acts.rbegin())
        return invalid("this show has no ways from and to the pads: plan the mission anew");
    const auto place = [&](const Act& act) { return static_cast<std::size_t>(&act - plan.acts.data()); };
    return Transits{place(*first), place(*last)};
}

/// What a drone's new pad changes.
struct Change {
    std::map<std::size_t, Act> acts;
    std::map<std::size_t, ActCertificate> certificates;

    [[nodiscard]] std::vector<std::string> violations() const {
        std::vector<std::string> all;
        for (const auto& [a, certificate] : certificates)
            all.insert(all.end(), certificate.violations.begin(), certificate.violations.end());
        return all;
    }
};

Result<Change> change_of(const FlightPlan& plan, const Transits& transits, std::size_t drone, const Vec3& pad_m,
                         const Run& run) {
    const Vec3 off_m = pad_m - plan.pads_m[drone];
    Surroundings surroundings{geo::ShowFrame(plan.origin), plan.airspace, plan.pads_m, plan.limits};
    surroundings.pads_m[drone] = pad_m;
    Change change;
    for (std::size_t a = 0; a < plan.acts.size(); ++a) {
        const bool flown_alike = a > transits.first && a < transits.last;
        if (flown_alike && off_m.z == 0.0) continue;
        Act act = plan.acts[a];
        if (!flown_alike)
            shift(act.motion, drone, a <= transits.first || a > transits.last ? off_m : Vec3{},
                  a < transits.first || a >= transits.last ? off_m : Vec3{});
        if (run.stopped()) return stopped_error();
        const ActCertificate* before = a < plan.certificate.acts.size() ? &plan.certificate.acts[a] : nullptr;
        auto certificate = certify(act, surroundings, run, before != nullptr ? before->required_separation_m : 0.0);
        if (!certificate) return certificate.error();
        if (before != nullptr) {
            certificate->method = before->method;
            certificate->chosen_because = before->chosen_because;
            certificate->separation_by = before->separation_by;
            certificate->separation_rounds = before->separation_rounds;
            certificate->assignment = before->assignment;
            certificate->path_ratio = before->path_ratio;
        }
        change.certificates.emplace(a, std::move(*certificate));
        if (!flown_alike) change.acts.emplace(a, std::move(act));
    }
    return change;
}

std::string pad_name(std::size_t spare, const FlightPlan& plan) {
    return "pad " + std::to_string(plan.drones() + spare + 1);
}

/// Which other spare pads would do for the drone, in words.
Result<std::string> others_that_would_do(const FlightPlan& plan, const Transits& transits, std::size_t drone,
                                         const std::vector<bool>& taken, std::size_t but, const Run& run) {
    const Run quiet{run.stop, nullptr, 1};
    const auto fits = gather<bool>(plan.spare_pads_m.size(), run, "spare pads", [&](std::size_t p) -> Result<bool> {
        if (taken[p] || p == but) return false;
        const auto change = change_of(plan, transits, drone, plan.spare_pads_m[p], quiet);
        if (!change) return change.error();
        return change->violations().empty();
    });
    if (!fits) return fits.error();
    std::string names;
    for (std::size_t p = 0; p < fits->size(); ++p)
        if ((*fits)[p]) names += (names.empty() ? "" : ", ") + pad_name(p, plan);
    return names.empty() ? std::string("no other spare pad would do either: plan the mission anew")
                         : "these spare pads would do: " + names;
}

Status check_named(const FlightPlan& plan, std::span<const Replacement> replacements) {
    const std::size_t drones = plan.drones(), pads = drones + plan.spare_pads_m.size();
    for (std::size_t i = 0; i < replacements.size(); ++i) {
        const auto& [drone, pad] = replacements[i];
        const std::string what = std::to_string(drone.number()) + "=pad " + std::to_string(pad.number()) + ": ";
        if (drone.value >= drones)
            return invalid(what + "there is no drone " + std::to_string(drone.number()) + ", only 1 to " +
                           std::to_string(drones));
        if (pads == drones)
            return invalid(what + "this show has no spare pads; give the mission more pads than drones");
        if (pad.value >= pads)
            return invalid(what + "there is no pad " + std::to_string(pad.number()) + "; the spare ones are " +
                           std::to_string(drones + 1) + " to " + std::to_string(pads));
        if (pad.value < drones)
            return invalid(what + "drone " + std::to_string(pad.number()) + " stands on that pad; the spare ones are " +
                           std::to_string(drones + 1) + " to " + std::to_string(pads));
        for (std::size_t j = 0; j < i; ++j) {
            if (replacements[j].drone == drone)
                return invalid(what + "drone " + std::to_string(drone.number()) + " is replaced twice");
            if (replacements[j].pad == pad)
                return invalid(what + "pad " + std::to_string(pad.number()) + " is taken by another replacement");
        }
    }
    return Done{};
}

}  // namespace

Result<Replacement> parse_replacement(std::string_view text) {
    const auto equals = text.find('=');
    const auto wrong = [&] {
        return invalid("\"" + std::string(text) + "\": must be a drone and a spare pad, such as \"17=pad 41\"");
    };
    if (equals == std::string_view::npos) return wrong();
    std::string_view pad = text.substr(equals + 1);
    while (pad.starts_with(' ')) pad.remove_prefix(1);
    if (pad.starts_with("pad")) pad.remove_prefix(3);
    const auto drone = whole(text.substr(0, equals)), number = whole(pad);
    if (!drone || !number) return wrong();
    return Replacement{DroneId::from_number(*drone), PadId::from_number(*number)};
}

Result<FlightPlan> replaced(FlightPlan plan, std::span<const Replacement> replacements, const Run& run) {
    if (const Status named = check_named(plan, replacements); !named) return named.error();
    const auto transits = transits_of(plan);
    if (!transits) return transits.error();
    std::vector<bool> taken(plan.spare_pads_m.size(), false);
    for (const auto& [drone, pad] : replacements) {
        const std::size_t spare = pad.value - plan.drones();
        auto change = change_of(plan, *transits, drone.value, plan.spare_pads_m[spare], run);
        if (!change) return change.error();
        if (const auto violations = change->violations(); !violations.empty()) {
            const auto others = others_that_would_do(plan, *transits, drone.value, taken, spare, run);
            if (!others) return others.error();
            std::string message = "drone " + std::to_string(drone.number()) + " cannot be replaced from pad " +
                                  std::to_string(pad.number());
            for (const std::string& violation : violations) message += "\n  " + violation;
            return Error{ErrorCode::infeasible, message + "\n  " + *others};
        }
        for (auto& [a, act] : change->acts) plan.acts[a] = std::move(act);
        for (auto& [a, certificate] : change->certificates)
            if (a < plan.certificate.acts.size()) plan.certificate.acts[a] = std::move(certificate);
        taken[spare] = true;
        std::swap(plan.pads_m[drone.value], plan.spare_pads_m[spare]);
        if (plan.pad_of.empty())
            for (std::size_t d = 0; d < plan.drones(); ++d) plan.pad_of.emplace_back(d);
        plan.pad_of[drone.value] = pad;
    }
    return plan;
}

}  // namespace aerogram::planner
