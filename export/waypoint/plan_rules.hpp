#pragma once
#include "export/bytes/json_document.hpp"

namespace aerogram::exporter {

/// What QGroundControl's loader insists on in a `.plan` (FORMATS.md 5), checked on every plan of ours that is read, so
/// on every one that is written. What is broken first is recorded as the root's problem:
///  (1) the root is an object with all of fileType, groundStation, version, mission, geoFence and rallyPoints
///  (2) fileType is "Plan", groundStation a string, version 1
///  (3) mission: plannedHomePosition is [latitude, longitude, AMSL], items an array, firmwareType a whole number
///  (4) mission: version is 2, vehicleType a whole number, cruiseSpeed and hoverSpeed are numbers
///  (5) an item's type is "SimpleItem"; frame and command are whole numbers, autoContinue is a boolean
///  (6) params are exactly 7, each a number or null
///  (7) doJumpId is the item's place, from 1
///  (8) of AltitudeMode, Altitude and AMSLAltAboveTerrain all are there or none
///  (9) geoFence: version is 2 (1 is silently ignored), polygons and circles are arrays
///  (10) a polygon: version 1, boolean inclusion, at least three [latitude, longitude]
///  (11) a circle: version 1, boolean inclusion, circle with center [latitude, longitude] and radius
///  (12) rallyPoints: version is 2, points are [latitude, longitude, altitude above home]
///  (13) a spline's p4 is a number: ArduPilot refuses null
void check_plan_rules(const JsonNode& root);

}  // namespace aerogram::exporter
