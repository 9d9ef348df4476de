// trajectory.json as our own writer leaves it (export/skybrush/skyc_trajectory.cpp), read without a document of it.
#include "export/bytes/text_cursor.hpp"
#include "export/skybrush/skybrush_frame.hpp"
#include "export/skybrush/skyc_trajectory.hpp"

namespace aerogram::exporter {
namespace {

Vec3 point(TextCursor& in) {
    Vec3 p{};
    in.expect("[");
    p.x = in.number(kFarthestSkyc_m);
    in.expect(",");
    p.y = in.number(kFarthestSkyc_m);
    in.expect(",");
    p.z = in.number(kFarthestSkyc_m);
    in.expect("]");
    return from_skybrush(p);
}

/// "[end_s,[x,y,z],[]]", or with two inner control points.
void piece(TextCursor& in, double& time_s, RecordedDrone& drone) {
    in.expect("[");
    const double start_s = time_s;
    time_s = in.number(kLongestSkyc_s);
    if (!(time_s > start_s)) in.give_up();
    in.expect(",");
    const Vec3 end_m = point(in);
    const auto first = static_cast<std::uint32_t>(drone.controls_m.size() - 1);
    if (in.skip(",[]]")) {
        const bool stands = end_m == drone.controls_m.back();
        if (!stands) drone.controls_m.push_back(end_m);
        drone.pieces.push_back({start_s, time_s - start_s, first, static_cast<std::uint8_t>(stands ? 0 : 1)});
        return;
    }
    in.expect(",[");
    drone.controls_m.push_back(point(in));
    in.expect(",");
    drone.controls_m.push_back(point(in));
    in.expect("]]");
    drone.controls_m.push_back(end_m);
    drone.pieces.push_back({start_s, time_s - start_s, first, 3});
}

}  // namespace

bool read_plain_trajectory(std::string_view text, RecordedDrone& drone) {
    TextCursor in(text);
    in.expect(R"({"version":1,"points":[[0,)");
    drone.controls_m.push_back(point(in));
    in.expect(",[]]");
    double time_s = 0.0;
    while (in.ok() && in.skip(",")) piece(in, time_s, drone);
    in.expect(R"(],"takeoffTime":0,"landingTime":)");
    static_cast<void>(in.number());
    in.expect("}\n");
    if (in.ok() && in.at_end() && !drone.pieces.empty()) return true;
    drone.controls_m.clear();
    drone.pieces.clear();
    return false;
}

}  // namespace aerogram::exporter
