#include "export/exact/show_hash.hpp"

#include "export/bytes/sha256.hpp"
#include "export/exact/trajectories_bin.hpp"

namespace aerogram::exporter {

std::string show_hash(const planner::FlightPlan& plan) {
    return sha256_hex(trajectories_payload(plan, 8));
}

}  // namespace aerogram::exporter
