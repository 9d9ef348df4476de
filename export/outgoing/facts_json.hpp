#pragma once
#include <string>

#include "export/bytes/json_document.hpp"
#include "export/outgoing/format.hpp"
#include "export/outgoing/outgoing_show.hpp"

/// What a show says of itself beside its drones, as one JSON object that every format with room for notes may hold:
/// title, show hash, certified mark, origin and heading, limits, airspace, endurance, keyframes, cues. Numbers are
/// exact; units are in the keys; places in the show frame.
namespace aerogram::exporter {

/// The object on one line: "title", "show_hash", "certified", "fleet", "duration_s", "endurance_s", "origin",
/// "limits", "airspace", "keyframes", "cues".
[[nodiscard]] std::string facts_json(const OutgoingFacts& facts, const Seal& seal);

/// Reads the object into the show; keys may be absent. What is wrong goes to the node's problem.
void read_facts(const JsonNode& facts, RecordedShow& show);

/// A text as JSON writes it, quotes included; what is no UTF-8 is replaced.
[[nodiscard]] std::string json_text(const std::string& text);

}  // namespace aerogram::exporter
