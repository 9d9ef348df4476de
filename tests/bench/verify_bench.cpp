// Verify's separation and judgement of recorded shows. Each run's result is checked against the show's closed form.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "export/verify/judge.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kSpacing_m = 2.2;

/// A square grid that turns rigidly about its middle at a constant rate, as cubic pieces (0.5 s) or straight lines
/// (0.25 s), with a 10 s hold in every 20 s. A rigid turn keeps all distances, so the smallest is the grid's spacing,
/// less what the pieces cut off a circle.
RecordedShow turning_grid(std::size_t drones, double length_s, bool cubic) {
    const double step_s = cubic ? 0.5 : 0.25;
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(drones))));
    const double rate = 4.0 / (kSpacing_m * static_cast<double>(side));
    const auto steps = static_cast<std::size_t>(length_s / step_s);
    RecordedShow show;
    show.format = "bench";
    show.duration_s = static_cast<double>(steps) * step_s;
    const double middle = 0.5 * static_cast<double>(side - 1);
    for (std::size_t d = 0; d < drones; ++d) {
        const Vec2 place{kSpacing_m * (static_cast<double>(d % side) - middle),
                         kSpacing_m * (static_cast<double>(d / side) - middle)};
        RecordedDrone drone;
        drone.home_m = drone.land_m = Vec3{place, 0.0};
        double angle = 0.0;
        for (std::size_t k = 0; k < steps; ++k) {
            const double turned = k / (steps / 20 + 1) % 2 == 0 ? rate * step_s : 0.0;
            const auto at = [&](double a) {
                return Vec3{place.x * std::cos(a) - place.y * std::sin(a),
                            place.x * std::sin(a) + place.y * std::cos(a), 40.0};
            };
            const auto along = [&](double a) { return Vec3{-at(a).y, at(a).x, 0.0} * (turned / 3.0); };
            drone.pieces.push_back({static_cast<double>(k) * step_s, step_s,
                                    static_cast<std::uint32_t>(drone.controls_m.size()),
                                    static_cast<std::uint8_t>(cubic ? 3 : 1)});
            drone.controls_m.push_back(at(angle));
            if (cubic) {
                drone.controls_m.push_back(at(angle) + along(angle));
                drone.controls_m.push_back(at(angle + turned) - along(angle + turned));
            }
            angle += turned;
            drone.controls_m.push_back(at(angle));
        }
        show.drones.push_back(std::move(drone));
    }
    return show;
}

void separation(benchmark::State& state, bool cubic) {
    const RecordedShow show =
        turning_grid(static_cast<std::size_t>(state.range(0)), static_cast<double>(state.range(1)), cubic);
    for (auto _ : state) {
        const auto found = verify_separation(show, 1.0, 3.0, Run{});
        if (!found.ok() || std::abs(found->lower_bound_m - kSpacing_m) > 0.02 ||
            found->lower_bound_m > found->attained_m) {
            state.SkipWithError("the grid's spacing was not found");
            break;
        }
    }
}
void separation_of_cubics(benchmark::State& state) {
    separation(state, true);
}
void separation_of_lines(benchmark::State& state) {
    separation(state, false);
}

BENCHMARK(separation_of_cubics)->Args({10, 120})->Args({60, 300})->Args({300, 300})->Unit(benchmark::kMillisecond);
BENCHMARK(separation_of_lines)->Args({10, 120})->Args({60, 300})->Args({300, 300})->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aerogram::exporter
