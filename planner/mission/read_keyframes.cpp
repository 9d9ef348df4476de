#include <algorithm>
#include <iterator>
#include <set>

#include "geo/units.hpp"
#include "planner/mission/sections.hpp"

namespace aerogram::planner {

namespace {

// Parts that take the drones of one group must together take exactly that group.
void check_groups(TableReader& in, const Keyframe& keyframe, const Mission& mission, std::vector<TableReader>& tables) {
    for (std::size_t p = 0; p < keyframe.parts.size(); ++p) {
        const std::string& name = keyframe.parts[p].group;
        if (name.empty()) continue;
        if (keyframe.arrive.assign != Assign::groups) {
            tables[p].bad("group", "needs " + in.path() + ".arrive.assign = \"groups\"");
        }
        const auto same = [&](const Part& part) { return part.group == name; };
        const auto before = keyframe.parts.begin() + static_cast<std::ptrdiff_t>(p);
        if (std::any_of(keyframe.parts.begin(), before, same)) continue;
        std::size_t sum = 0;
        for (const Part& part : keyframe.parts) sum += same(part) ? part.drones : 0;
        const auto group =
            std::find_if(mission.groups.begin(), mission.groups.end(), [&](const Group& g) { return g.name == name; });
        if (group->drones.empty() || sum == group->drones.size()) continue;
        tables[p].bad("group", "the parts of this group take " + std::to_string(sum) + " drones; must take all " +
                                   std::to_string(group->drones.size()) + " of it");
    }
}

// Grids that say both rows and columns must have room for their drones.
void check_grid(const Part& part, TableReader& table) {
    const auto* shape = std::get_if<ShapeSource>(&part.source);
    if (!shape || !shape->rows || !shape->columns) return;
    const std::size_t places = std::size_t{*shape->rows} * *shape->columns;
    if (places < part.drones) {
        table.bad("columns",
                  "rows x columns must be >= " + std::to_string(part.drones) + " drones, is " + std::to_string(places));
    }
}

void read_parts(TableReader& in, Keyframe& keyframe, const Mission& mission) {
    for (const std::string_view key : source_keys()) {
        if (in.has(key)) in.bad(key, "stands beside [[keyframe.part]]; must be in a part");
    }
    keyframe.center_m = in.vec3("center_m").value_or(Vec3{});
    const Vec3 rotate_deg = in.vec3("rotate_deg").value_or(Vec3{});
    keyframe.rotate_rad = {radians(rotate_deg.x), radians(rotate_deg.y), radians(rotate_deg.z)};
    const std::optional<Paint> color = read_paint(in, "color");
    std::vector<TableReader> tables = in.tables("part");
    const auto* listed = std::get_if<TomlArray>(&in.find("part")->data);
    if (listed && listed->empty()) in.bad("part", "must be at least one [[keyframe.part]]");
    std::vector<CountWish> wishes;
    for (TableReader& table : tables) {
        PartWish wish = read_part(table, mission, true);
        if (!wish.part.color) wish.part.color = color;
        wishes.push_back({wish.drones, wish.share});
        keyframe.parts.push_back(std::move(wish.part));
    }
    if (mission.fleet.drones == 0 || tables.empty()) return;
    const auto counts = resolve_counts(wishes, mission.fleet.drones);
    if (!counts) {
        in.problems().add(in.line(), in.path() + ".part: " + counts.error().message);
        return;
    }
    for (std::size_t p = 0; p < counts->size(); ++p) {
        keyframe.parts[p].drones = (*counts)[p];
        check_grid(keyframe.parts[p], tables[p]);
    }
    check_groups(in, keyframe, mission, tables);
}

struct WrittenKeyframe {
    Keyframe keyframe;
    std::optional<Animation> animation;
};

WrittenKeyframe read_keyframe(TableReader& in, const Mission& mission) {
    WrittenKeyframe written;
    Keyframe& keyframe = written.keyframe;
    keyframe.line = in.line();
    in.need("name", "write a unique name = \"...\"");
    keyframe.name = in.name("name").value_or("");
    keyframe.at_s = in.number("at_s", at_least(0.0, 86400.0));
    keyframe.hold_s = in.number("hold_s", at_least(0.0, 86400.0)).value_or(keyframe.hold_s);
    keyframe.arrive = read_arrive(in, mission);
    keyframe.motion = read_motion(in);
    if (keyframe.motion.moves() && keyframe.hold_s == 0.0) in.bad("motion", "needs a hold_s > 0 to happen in");
    if (in.has("part")) {
        read_parts(in, keyframe, mission);
    } else {
        PartWish wish = read_part(in, mission, false);
        keyframe.parts.push_back(std::move(wish.part));
        written.animation = std::move(wish.animation);
        keyframe.parts[0].drones = mission.fleet.drones;
        check_grid(keyframe.parts[0], in);
        for (const std::string_view key : {"drones", "share", "group"}) {
            if (in.has(key))
                in.bad(key, "belongs to a [[keyframe.part]]; a keyframe without parts takes the whole fleet");
        }
    }
    if (written.animation && keyframe.hold_s == 0.0) in.bad("hold_s", "an animation's last frame needs a hold_s > 0");
    in.finish();
    return written;
}

std::string written_key(std::size_t index) {
    return "keyframe[" + std::to_string(index + 1) + "]";
}

// What one keyframe demands of its neighbours.
void check_order(std::vector<TableReader>& tables, const std::vector<Keyframe>& keyframes) {
    std::optional<std::size_t> timed;  // the last keyframe with a time
    for (std::size_t k = 0; k < keyframes.size(); ++k) {
        const Keyframe& keyframe = keyframes[k];
        for (std::size_t j = 0; j < k; ++j) {
            if (keyframe.name.empty() || keyframes[j].name != keyframe.name) continue;
            tables[k].bad("name", "must be unique; " + written_key(j) + " at line " +
                                      std::to_string(keyframes[j].line) + " has it too");
            break;
        }
        if (keyframe.at_s) {
            if (timed && *keyframe.at_s <= *keyframes[*timed].at_s) {
                tables[k].bad("at_s",
                              "must be > " + shown(*keyframes[*timed].at_s) + ", the time of " + written_key(*timed));
            }
            timed = k;
        }
        if (keyframe.hold_s > 0.0) continue;
        if (keyframe.at_s) {
            tables[k].bad("at_s",
                          "a time for a keyframe that a flow passes is not in this version; give it to the flow's "
                          "last keyframe, or shares of the time by duration_s");
        }
        if (k + 1 == keyframes.size()) {
            tables[k].bad("hold_s", "must be > 0 in the last keyframe");
        } else if (keyframes[k + 1].arrive.method != Method::flow) {
            tables[k].bad("hold_s", "must be > 0; 0 only where the next keyframe has arrive.method = \"flow\"");
        }
    }
}

// Frames are named after their keyframe: "bird 1", "bird 2"; no other keyframe may be called so.
void check_frame_names(std::vector<TableReader>& tables, const Mission& mission) {
    std::set<std::string> frames;
    for (const Keyframe& keyframe : mission.keyframes) {
        if (!keyframe.clip.empty()) frames.insert(keyframe.name);
    }
    for (const Keyframe& keyframe : mission.keyframes) {
        if (keyframe.clip.empty() && frames.contains(keyframe.name))
            tables[keyframe.number - 1].bad("name", "a frame of an animation is called so");
    }
}

}  // namespace

void read_keyframes(TableReader& root, Mission& mission) {
    std::vector<TableReader> tables = root.tables("keyframe");
    if (root.need("keyframe", "write at least one [[keyframe]] with a name and a text, shape or another source")) {
        const auto* listed = std::get_if<TomlArray>(&root.find("keyframe")->data);
        if (listed && listed->empty()) root.bad("keyframe", "must be at least one [[keyframe]]");
    }
    std::vector<Keyframe> written;
    std::vector<std::optional<Animation>> animations;
    for (TableReader& table : tables) {
        WrittenKeyframe one = read_keyframe(table, mission);
        written.push_back(std::move(one.keyframe));
        animations.push_back(std::move(one.animation));
    }
    check_order(tables, written);
    for (std::size_t k = 0; k < written.size(); ++k) {
        written[k].number = k + 1;
        if (!animations[k]) {
            mission.keyframes.push_back(std::move(written[k]));
        } else {
            std::ranges::move(frames_of(written[k], *animations[k]), std::back_inserter(mission.keyframes));
        }
    }
    check_frame_names(tables, mission);
}

}  // namespace aerogram::planner
