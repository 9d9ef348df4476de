#include "export/vviz/vviz_performance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "geo/units.hpp"

namespace aerogram::exporter {
namespace {

constexpr double kFarthest_m = 1e6, kLongest_s = 86'400.0, kShortest_s = 1e-3;
constexpr std::size_t kLongestName = 200;

/// Which of some keys were there; the second of a kind is a problem.
template <std::size_t N>
class Seen {
  public:
    explicit Seen(const std::array<std::string_view, N>& keys) : keys_(keys) {}

    /// The key's place, N for a key that is not among them.
    std::size_t place(std::string_view key, JsonCursor& cursor) {
        const auto at = static_cast<std::size_t>(std::ranges::find(keys_, key) - keys_.begin());
        if (at == N) return N;
        if (seen_[at]) cursor.fail(std::string(key) + " appears twice");
        seen_[at] = true;
        return at;
    }
    /// The first `count` keys must be there.
    void require(std::size_t count, JsonCursor& cursor) const {
        for (std::size_t k = 0; k < count; ++k)
            if (!seen_[k]) cursor.fail(std::string(keys_[k]) + " is missing");
    }

  private:
    const std::array<std::string_view, N>& keys_;
    std::array<bool, N> seen_{};
};

}  // namespace

void KeysOnce::check(std::string_view key, JsonCursor& cursor) {
    if (std::ranges::find(seen_, key) != seen_.end()) cursor.fail("a key appears twice");
    constexpr std::size_t kMost = 64;  // more than any program writes
    if (seen_.size() < kMost) seen_.emplace_back(key.substr(0, 100));
}

void VvizPerformances::read(RecordedDrone& drone) {
    static constexpr std::array<std::string_view, 5> kKeys{"agentDescription", "payloadDescription", "name", "home",
                                                           "land"};
    Seen seen(kKeys);
    pieces_.clear();
    lights_.clear();
    controls_m_.assign(1, Vec3(0.0));
    time_s_ = 0.0;
    cursor_.object([&](std::string_view key) {
        switch (seen.place(key, cursor_)) {
            case 0:
                return agent(drone);
            case 1:
                return cursor_.array([&] { payload(drone); });
            case 2:
                drone.name = cursor_.text(kLongestName);
                return;
            case 3:
                drone.home_m = place();
                return;
            case 4:
                drone.land_m = place();
                return;
            default:
                cursor_.skipped();
        }
    });
    if (cursor_.ok()) seen.require(1, cursor_);
    drone.pieces = pieces_;  // exact in size, which matters for large fleets
}

void VvizPerformances::agent(RecordedDrone& drone) {
    static constexpr std::array<std::string_view, 5> kKeys{"homeX", "homeY", "homeZ", "agentTraversal", "homeH"};
    Seen seen(kKeys);
    std::array<double, 3> home{};
    double heading_deg = 0.0;
    cursor_.object([&](std::string_view key) {
        const std::size_t place = seen.place(key, cursor_);
        if (place < 3) {
            home[place] = cursor_.number(-kFarthest_m, kFarthest_m);
        } else if (place == 3) {
            cursor_.array([&] { sample(); });
        } else if (place == 4) {
            heading_deg = cursor_.number(-36'000.0, 36'000.0);
        } else {
            cursor_.skipped();
        }
    });
    if (cursor_.ok()) seen.require(4, cursor_);
    if (heading_deg != 0.0) drone.tracks.yaw.push_back({0, -radians(heading_deg)});
    for (Vec3& p : controls_m_) p += Vec3(home[0], home[1], home[2]);
    drone.controls_m = controls_m_;
}

Vec3 VvizPerformances::place() {
    Vec3 p{};
    int count = 0;
    cursor_.array([&] {
        const double value = cursor_.number(-kFarthest_m, kFarthest_m);
        if (count < 3) p[count] = value;
        ++count;
    });
    if (count != 3) cursor_.fail("a place must be [x, y, z]");
    return p;
}

void VvizPerformances::sample() {
    static constexpr std::array<std::string_view, 4> kKeys{"dx", "dy", "dz", "dt"};
    Seen seen(kKeys);
    Vec3 by{};
    std::optional<double> dt_s = rates_.step_s;
    cursor_.object([&](std::string_view key) {
        switch (seen.place(key, cursor_)) {
            case 0:
                by.x = cursor_.number(-2.0 * kFarthest_m, 2.0 * kFarthest_m);
                return;
            case 1:
                by.y = cursor_.number(-2.0 * kFarthest_m, 2.0 * kFarthest_m);
                return;
            case 2:
                by.z = cursor_.number(-2.0 * kFarthest_m, 2.0 * kFarthest_m);
                return;
            case 3:
                dt_s = cursor_.number(0.0, kLongest_s);
                return;
            default:
                cursor_.skipped();
        }
    });
    if (!cursor_.ok()) return;
    seen.require(3, cursor_);
    if (!dt_s) return cursor_.fail("a sample has no dt, and defaultPositionRate is missing");
    moved(by, *dt_s);
}

void VvizPerformances::moved(const Vec3& by, double dt_s) {
    const bool stands = by == Vec3(0.0);
    if (dt_s == 0.0 && stands) return;
    if (dt_s < kShortest_s * (1.0 - 1e-9)) return cursor_.fail("dt must be at least 0.001, or 0 where nothing moves");
    const auto last = static_cast<std::uint32_t>(controls_m_.size() - 1);
    const Vec3 to = controls_m_.back() + by;
    if (std::max({std::abs(to.x), std::abs(to.y), std::abs(to.z)}) > kFarthest_m)
        return cursor_.fail("leads farther than 1e6 m from home");
    if (stands && !pieces_.empty() && pieces_.back().degree == 0) {
        pieces_.back().duration_s = time_s_ + dt_s - pieces_.back().start_s;
    } else {
        pieces_.push_back({time_s_, dt_s, last, static_cast<std::uint8_t>(stands ? 0 : 1)});
    }
    time_s_ += dt_s;
    if (time_s_ > kLongest_s) return cursor_.fail("leads beyond 24 hours");
    if (stands) return;
    controls_m_.push_back(to);
    shortest_s_ = std::min(shortest_s_, dt_s);
}

void VvizPerformances::lit(Millis time_ms, const Rgb& color) {
    if (lights_.empty() || color != lights_.back().color) {
        if (!lights_.empty() && held_until_ms_ > lights_.back().time_ms)
            lights_.push_back({held_until_ms_, lights_.back().color, false});
        if (!lights_.empty()) lights_.back().fade = time_ms > lights_.back().time_ms;
        lights_.push_back({time_ms, color, false});
    }
    held_until_ms_ = time_ms;
}

void VvizPerformances::payload(RecordedDrone& drone) {
    static constexpr std::array<std::string_view, 2> kKeys{"payloadActions", "type"};
    Seen seen(kKeys);
    bool light = true;
    lights_.clear();
    cursor_.object([&](std::string_view key) {
        switch (seen.place(key, cursor_)) {
            case 0:
                return actions();
            case 1:
                light = cursor_.text(kLongestName) == "Light";
                return;
            default:
                cursor_.skipped();
        }
    });
    if (light && drone.tracks.lights.empty()) drone.tracks.lights = lights_;
}

void VvizPerformances::actions() {
    static constexpr std::array<std::string_view, 4> kKeys{"r", "g", "b", "frames"};
    std::int64_t frame = 0;
    bool first = true;
    cursor_.array([&] {
        Seen seen(kKeys);
        std::array<double, 3> rgb{};
        std::int64_t frames = first ? 0 : 1;
        cursor_.object([&](std::string_view key) {
            const std::size_t place = seen.place(key, cursor_);
            if (place < 3) {
                rgb[place] = cursor_.number(0.0, 255.0);
            } else if (place == 3) {
                frames = cursor_.whole(0, 100'000'000);
            } else {
                cursor_.skipped();
            }
        });
        if (!cursor_.ok()) return;
        seen.require(3, cursor_);
        if (!rates_.frame_s) return cursor_.fail("there are colours, and defaultColorRate is missing");
        first = false;
        frame += frames;
        const double time_s = static_cast<double>(frame) * *rates_.frame_s;
        if (time_s > kLongest_s) return cursor_.fail("colours lead beyond 24 hours");
        lit(std::llround(time_s * 1000.0), {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0});
    });
}

}  // namespace aerogram::exporter
