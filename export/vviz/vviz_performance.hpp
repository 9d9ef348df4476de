#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "export/bytes/json_cursor.hpp"
#include "export/record/recorded_show.hpp"

namespace aerogram::exporter {

/// How long a step or a frame is where a sample does not say it.
struct VvizRates {
    std::optional<double> step_s, frame_s;
};

/// Refuses an object's known keys when they come again.
class KeysOnce {
  public:
    void check(std::string_view key, JsonCursor& cursor);

  private:
    std::vector<std::string> seen_;
};

/// Reads one performance after the other; places stay in the file's frame. Problems go to the cursor.
class VvizPerformances {
  public:
    VvizPerformances(const VvizRates& rates, JsonCursor& cursor) : rates_(rates), cursor_(cursor) {}

    /// A drone without samples gets where it starts as its only control point, and no piece. Home and landing place:
    /// where our keys state them.
    void read(RecordedDrone& drone);
    /// Of all samples that moved a drone, at most 1 s.
    [[nodiscard]] double shortest_step_s() const { return shortest_s_; }

  private:
    void agent(RecordedDrone& drone);
    [[nodiscard]] Vec3 place();
    void sample();
    void moved(const Vec3& by, double dt_s);
    void payload(RecordedDrone& drone);
    void actions();
    void lit(Millis time_ms, const Rgb& color);

    const VvizRates& rates_;
    JsonCursor& cursor_;
    double shortest_s_ = 1.0;
    std::vector<Piece> pieces_;  ///< of the drone that is read, places from its home
    std::vector<Vec3> controls_m_;
    double time_s_ = 0.0;
    std::vector<LightKey> lights_;  ///< of the payload that is read
    Millis held_until_ms_ = 0;      ///< the last sample, which a level line need not hold
};

}  // namespace aerogram::exporter
