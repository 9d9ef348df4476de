#pragma once
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "export/bytes/json_document.hpp"
#include "export/outgoing/format.hpp"

namespace aerogram::exporter {

/// The .json entries of a .skyc, parsed when asked for (others are not even unpacked), with {"$ref":
/// "./other.json#/pointer"} followed from entry to entry.
class SkycArchive {
  public:
    static constexpr int kMostHops = 16;

    /// Errors: invalid_input for a damaged archive or one without show.json.
    static Result<SkycArchive> open(const FileBytes& file);

    /// The root of an entry; a missing or broken one becomes the problem.
    [[nodiscard]] JsonNode document(const std::string& entry);
    /// What a node stands for: itself, or where its $ref leads, at most kMostHops further (a cycle becomes the
    /// problem). Paths are relative to the entry that holds the reference.
    [[nodiscard]] JsonNode resolved(JsonNode node);
    /// The text of the whole entry that a node refers to, where it was not parsed yet; for readers of plain entries
    /// that need no document.
    [[nodiscard]] std::optional<std::string_view> unparsed(const JsonNode& node) const;
    /// Whether what a node refers to is in the archive, of any kind; true for a value that stands there itself.
    [[nodiscard]] bool holds_target(const JsonNode& node) const;
    /// From now on documents are forgotten at the next call, and nodes in them with them, unless an entry was parsed
    /// before: what many drones share is parsed twice and kept, what one of thousands has does not pile up.
    void next_drone();
    [[nodiscard]] JsonProblem& problem() { return *problem_; }

  private:
    SkycArchive() = default;
    [[nodiscard]] const JsonDocument* parsed(const std::string& entry);
    [[nodiscard]] bool holds(const std::string& entry) const;
    [[nodiscard]] std::string entry_of(const JsonNode& holder, std::string_view reference) const;
    [[nodiscard]] JsonNode target(const JsonNode& holder, const std::string& reference);

    std::string name_;
    std::map<std::string, std::string, std::less<>> texts_;
    std::set<std::string, std::less<>> others_;  ///< entries that are no .json
    std::map<std::string, JsonDocument, std::less<>> documents_;
    std::set<std::string, std::less<>> parsed_once_;
    std::vector<std::string> passed_;  ///< documents to forget
    bool passing_ = false;
    std::unique_ptr<JsonProblem> problem_;   ///< nodes point at it: must not move
    std::unique_ptr<JsonDocument> nothing_;  ///< stands in where a document is missing
};

}  // namespace aerogram::exporter
