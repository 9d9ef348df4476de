// Random plans through every format and back, and the same plan whatever the number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "export/bytes/files.hpp"
#include "export/exact/show_hash.hpp"
#include "export/exact/trajectories_bin.hpp"
#include "export/export_show.hpp"
#include "export/formats.hpp"
#include "fleet_sampling.hpp"
#include "random_missions.hpp"
#include "tests/unit/export/scratch_folder.hpp"

namespace aerogram::property {
namespace {

using exporter::RecordedShow;
using planner::FlightPlan;

TEST(PlanProperty, OneAndTwoThreadsGiveTheSameBytes) {
    for_each_flown_plan(5000, cases(30), [](const FlightPlan& plan, const std::string& text) {
        const auto again = plan_text(text, 2);
        ASSERT_TRUE(again);
        const auto bytes = [](const FlightPlan& p) {
            return exporter::trajectories_bytes(p, {exporter::show_hash(p), p.certificate.certified()}, 8);
        };
        EXPECT_TRUE(bytes(plan) == bytes(*again));
        EXPECT_EQ(plan.certificate.min_separation_m(), again->certificate.min_separation_m());
    });
}

RecordedShow read_back(const exporter::ExportedFormat& format, const std::filesystem::path& folder) {
    std::vector<exporter::FileBytes> files;
    for (const std::string& path : format.files) files.push_back({path, exporter::read_file(folder / path).value()});
    return exporter::find_format(format.name)->read(files).value();
}

/// Random instants, and the exact ends of acts, where curves are joined.
void expect_same_paths(const FlightPlan& plan, const RecordedShow& show, Random& random) {
    const Limits& l = plan.limits;
    const double fastest_mps = std::hypot(l.speed_horizontal_mps, std::max(l.speed_up_mps, l.speed_down_mps));
    const double stated_m =
        std::sqrt(3.0) * show.rounding.position_m + show.rounding.fit_m + show.rounding.time_s * fastest_mps + 1e-9;
    std::vector<double> times;
    for (int i = 0; i < 300; ++i) times.push_back(random.between(-1.0, seconds_from_ms(plan.duration_ms()) + 1.0));
    for (const planner::Act& act : plan.acts) times.push_back(seconds_from_ms(act.end_ms()));
    const bool in_floats = show.format == "glb" || show.format == "crazyflie";  // 24 bits of a few hundred seconds
    EXPECT_NEAR(show.duration_s, seconds_from_ms(plan.duration_ms()), in_floats ? 2e-5 : 1e-9);
    for (std::size_t d = 0; d < plan.drones(); ++d) {
        for (const double t_s : times) {
            const Vec3 flown = planner::sample(plan, DroneId(d), t_s).motion.position_m;
            EXPECT_LE(glm::distance(exporter::position_at(show.drones[d], t_s), flown), stated_m)
                << show.format << " drone " << d + 1 << " at " << t_s;
        }
    }
}

/// A waypoint mission visits every keyframe's slot, in order.
void expect_same_places(const FlightPlan& plan, const RecordedShow& show) {
    const geo::ShowFrame frame(plan.origin);
    for (std::size_t d = 0; d < plan.drones(); ++d) {
        std::size_t next = 0;
        for (const planner::PlannedKeyframe& keyframe : plan.keyframes) {
            const Vec3 slot = keyframe.formation_m[keyframe.slot_of[d].value];
            const double altitude_m = frame.altitude_above(plan.pads_m[d], slot);
            bool met = false;
            for (; next < show.drones[d].waypoints.size() && !met; ++next) {
                const exporter::Waypoint& w = show.drones[d].waypoints[next];
                const Vec3 place =
                    frame.to_show({w.place.latitude_deg, w.place.longitude_deg, frame.to_geodetic(slot).height_m});
                met = glm::distance(Vec2(place), Vec2(slot)) <= std::sqrt(2.0) * show.rounding.position_m &&
                      std::abs(w.altitude_above_home_m - altitude_m) <= show.rounding.position_m;
            }
            EXPECT_TRUE(met) << show.format << " drone " << d + 1 << ' ' << keyframe.name;
        }
    }
}

/// Verify's own separation, from the file alone, against the certificate's.
void expect_same_separation(const FlightPlan& plan, const exporter::Judgement& judgement) {
    const double resolved_m = 2.0 * plan.limits.min_separation_m;  // neither looks farther
    EXPECT_NEAR(std::min(judgement.min_separation_m, resolved_m),
                std::min(plan.certificate.min_separation_m(), resolved_m), 1e-3);
}

TEST(ExportProperty, EveryFormatReadsBackWithinItsStatedRounding) {
    const exporter::fixed::ScratchFolder scratch;
    Random random(77);
    std::map<std::string, int> written;
    const int count = std::max(1, cases(30) / 2);
    for_each_flown_plan(6000, count, [&](const FlightPlan& plan, const std::string&) {
        const auto folder = scratch.path() / "show";
        const auto exported =
            exporter::export_show(plan, folder, {.formats = {}, .best_effort = false, .drones = {}}, aerogram::Run{});
        ASSERT_TRUE(exported) << exported.error().message;
        EXPECT_EQ(exported->show_hash, exporter::show_hash(plan));
        for (const exporter::ExportedFormat& format : exported->formats) {
            if (!format.skipped.empty()) continue;
            ++written[format.name];
            const RecordedShow show = read_back(format, folder);
            EXPECT_TRUE(format.judgement.held()) << format.name;
            EXPECT_EQ(show.show_hash.value_or(exported->show_hash), exported->show_hash) << format.name;
            ASSERT_EQ(show.drones.size(), plan.drones()) << format.name;
            if (show.timed) {
                expect_same_paths(plan, show, random);
            } else {
                expect_same_places(plan, show);
            }
            if (format.name == "trajectories") expect_same_separation(plan, format.judgement);
        }
    });
    for (const exporter::Format& format : exporter::formats())
        EXPECT_GE(2 * written[std::string(format.name)], count) << format.name << " was hardly ever written";
}

}  // namespace
}  // namespace aerogram::property
