#pragma once
#include <vector>

#include "geo/result.hpp"
#include "geo/run.hpp"
#include "planner/light/light_time.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// Light keys of all drones together that one show may have.
inline constexpr std::size_t kMostLightKeys = 20'000'000;

/// The tracks with the mission's lights over them, one after another, each over the colours that those before it make.
/// While lights shine, lamps are sampled every 1 / light_rate_hz (rounded to 20 ms) and wherever the tracks have keys;
/// between samples light is linear, except where something changes by steps (a sparkle, a picture of a sequence, a
/// volume's border): that changes at a sample. What is written is within 1/512 a channel of that (key_writer.hpp).
/// Lamps stay dark outside lamp_time; spare drones stay dark. Where no light shines, the lamps' light stays as it is.
/// @param tracks  one a drone. Their keys' times are multiples of 20 ms.
/// Properties: (1) run.threads changes nothing (2) the mission's seed decides all that is random (3) without lights the
/// tracks come back as they are.
/// Errors: invalid_input at a light's line when nothing of it would be seen or its picture cannot be read, or when all
/// drones together would need more than kMostLightKeys keys; stopped.
/// Cost: about 0.1 microseconds a drone, sample and light; memory for the keys, and for one drone's samples a thread.
Result<std::vector<Tracks>> lit_tracks(const Mission& mission, const LightStage& stage, std::vector<Tracks> tracks,
                                       const Run& run);

}  // namespace aerogram::planner
