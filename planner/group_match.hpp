#pragma once
#include <cstddef>
#include <vector>

#include "planner/assignment/assignment.hpp"
#include "planner/formation/formation.hpp"
#include "planner/mission/mission.hpp"

namespace aerogram::planner {

/// What assign = "groups" matches at a keyframe. Whole groups are those that the arrival names, else all; of nested
/// ones the outermost, or the inner ones that the keyframe's parts call by name. Drones outside all of them form one
/// more. Slot sets are the parts, those of one group together and spare slots by themselves; where everything is one
/// part, its slots in order, dealt out in runs of the groups' sizes. Groups inside a whole take runs of its slots
/// likewise.
/// @param groups  the mission's, clusters filled.
/// Errors: infeasible when two of the whole groups share drones.
Result<GroupMatch> match_groups(const std::vector<Group>& groups, const Keyframe& keyframe, const Formation& formation,
                                std::size_t drones);

}  // namespace aerogram::planner
