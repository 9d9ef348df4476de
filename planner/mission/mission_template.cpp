#include "planner/mission/mission_template.hpp"

#include <array>
#include <cstdio>

namespace aerogram::planner {

namespace {

// A TOML basic string.
std::string toml_string(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20U || c == 0x7F) {
            std::array<char, 8> escape{};
            std::snprintf(escape.data(), escape.size(), "\\u%04X",
                          static_cast<unsigned>(static_cast<unsigned char>(c)));
            out += escape.data();
        } else {
            out += c;
        }
    }
    return out + '"';
}

constexpr std::string_view kBody = R"(seed = 1
# Where show (0, 0, 0) is: a point on the ground. heading_deg: where show +y points (away from the audience), clockwise from
# true north. In the show frame x is right, y away from the audience, z up, all in metres.
origin = { latitude_deg = 35.65860, longitude_deg = 139.74540, height_m = 40.0, datum = "ellipsoid", heading_deg = 20 }
# geoid_undulation_m = 36.7    # ellipsoid minus sea level here; needed for datum = "amsl"

[fleet]
drones = 10                    # every drone flies the whole show
# Row by row, row 1 nearest the audience, left to right; or pads = { csv = "pads.csv" }.
pads = { rows = 2, columns = 5, spacing_m = 2.5, center_m = [0, -20] }

[limits]
preset = "standard"            # "dense", "standard", "conservative" or "indoor"; single limits may be set beside it
# min_separation_m = 1.5       # centre to centre, at every instant
# ceiling_m = 120.0            # above each drone's own pad

# Nobody leaves the fence: [latitude, longitude] corners.
# [airspace]
# geofence = [[35.6570, 139.7435], [35.6600, 139.7435], [35.6600, 139.7475], [35.6570, 139.7475]]

[[keyframe]]
name = "H"
# Or svg = "logo.svg", image = "flag.png", mesh = "cat.obj", csv = "points.csv", sketch = [...], or shape = "line", "circle",
# "spiral", "grid", "disc", "ring", "square", "polygon", "star", "heart", "wave", "helix", "sphere", "dome", "cube", "torus",
# "cylinder", "cone": docs/formations.md. `aerogram inspect` draws a formation before anything is planned.
text = "H"
size_m = [12, 16]              # width, height
center_m = [0, 0, 40]
color = "#ffc400"              # or a gradient, a palette, a picture; effects in time are [[light]]s: docs/lights.md
hold_s = 5

[[keyframe]]
name = "I"
text = "I"
size_m = { height = 20 }       # one may be left out: the aspect is kept
center_m = [0, 0, 40]
color = "#40c4ff"
hold_s = 5

[keyframe.arrive]              # how the fleet gets to "I"
method = "straight"            # or "spectral", "rigid", "flow", "steered", "auto": docs/transitions.md
assign = "shortest"            # or "bottleneck", "keep", "slots", "groups", "formation_coordinates"
)";

}  // namespace

std::string mission_template(std::string_view name) {
    std::string text =
        "# A mission of Aerogram: plan it with `aerogram plan` and this file's name. docs/mission.md has every "
        "key.\n\n[show]\n";
    text += "name = " + toml_string(name.empty() ? "new show" : name) + "\n";
    text += kBody;
    return text;
}

}  // namespace aerogram::planner
