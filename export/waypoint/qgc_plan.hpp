#pragma once
#include "export/outgoing/format.hpp"

/// `qgc/drone-001.plan`: QGroundControl plans, one a drone (FORMATS.md 5, docs/formats/qgc.md).
namespace aerogram::exporter {

/// Implements what the loader insists on (plan_rules.hpp): fileType "Plan", groundStation, version 1, and mission,
/// geoFence and rallyPoints, each version 2; plannedHomePosition [lat, lon, AMSL]; firmwareType 3 (ArduPilot) or 12
/// (PX4), vehicleType 2; SimpleItems with frame 3 (places) or 2 (waits and speeds), exactly seven numbers as params (0,
/// never null but for the heading of PX4), doJumpId from 1, boolean autoContinue, none of the altitude-mode keys. The
/// fence goes out as an inclusion polygon, audience areas as exclusion polygons, the home as the rally point. The key
/// "aerogram" (unknown keys are ignored) holds title, drone, show hash, certificate, how the mission keeps time and,
/// where it waits for times, the start and the model of the proof. Colours, yaw and events are lost.
[[nodiscard]] const Format& qgc_plan_format();

/// Format::read of qgc_plan_format(). Plans of ours are held to every rule of the loader; other programs' plans of
/// simple items are read more leniently; commands that move nobody are skipped. Errors: invalid_input with file and
/// key.
Result<RecordedShow> read_qgc_plan(std::span<const FileBytes> files);

}  // namespace aerogram::exporter
