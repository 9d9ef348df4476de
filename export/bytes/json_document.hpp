#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "geo/result.hpp"
#include "geo/vec3.hpp"

/// Reading JSON of other programs without believing it: every access says what it expects; the first thing that is not
/// so is kept with file and key, and later answers are defaults, so that a reader checks once at its end.
namespace aerogram::exporter {

/// The first problem found while reading, "show.json: swarm.drones[3].settings.name: must be a text".
struct JsonProblem {
    std::string text;
    [[nodiscard]] bool found() const { return !text.empty(); }
    [[nodiscard]] Error error() const { return {ErrorCode::invalid_input, text}; }
};

/// A value inside a document and the way there. Views; the document and the problem must outlive it.
class JsonNode {
  public:
    /// A member that must be there.
    [[nodiscard]] JsonNode operator[](std::string_view key) const;
    /// A member that may be absent or null.
    [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
    /// Whether a member is there, null included; no problem where this is no object.
    [[nodiscard]] bool has(std::string_view key) const;
    /// An element; the array must be that long.
    [[nodiscard]] JsonNode at(std::size_t index) const;
    /// Elements of an array (anything else is a problem: 0).
    [[nodiscard]] std::size_t size() const;

    [[nodiscard]] bool is_object() const;
    [[nodiscard]] bool is_null() const;
    /// A number in [lowest, highest].
    [[nodiscard]] double number(double lowest, double highest) const;
    [[nodiscard]] std::int64_t whole(std::int64_t lowest, std::int64_t highest) const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] bool flag() const;
    /// [x, y, z], each within ±limit.
    [[nodiscard]] Vec3 point(double limit) const;

    /// Records "file: key: what" unless something was found before.
    void fail(const std::string& what) const;
    /// "file: swarm.drones[3].settings".
    [[nodiscard]] std::string where() const;
    /// The document's name, as given to parse.
    [[nodiscard]] const std::string& file() const { return *file_; }
    [[nodiscard]] JsonProblem& problem() const { return *problem_; }

  private:
    friend class JsonDocument;
    struct Step {
        std::string_view key;  ///< empty: an element
        std::size_t index = 0;
    };
    static constexpr std::size_t kDeepest = 12;
    [[nodiscard]] JsonNode child(const void* value, Step step) const;

    const void* value_ = nullptr;  ///< nullptr: an earlier problem; answers are defaults
    const std::string* file_ = nullptr;
    JsonProblem* problem_ = nullptr;
    std::array<Step, kDeepest> way_{};
    std::size_t depth_ = 0;
};

/// One parsed JSON text.
class JsonDocument {
  public:
    /// @param file  its name in messages. Errors: invalid_input with the byte where the text is no JSON.
    static Result<JsonDocument> parse(std::string file, std::string_view text);
    JsonDocument(JsonDocument&&) noexcept;
    JsonDocument& operator=(JsonDocument&&) noexcept;
    ~JsonDocument();

    [[nodiscard]] JsonNode root(JsonProblem& problem) const;
    /// The value at an RFC 6901 pointer ("" or "/a/0/b"); a missing one is a problem.
    [[nodiscard]] JsonNode pointed(std::string_view pointer, JsonProblem& problem) const;
    [[nodiscard]] const std::string& file() const;

  private:
    struct Impl;
    explicit JsonDocument(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace aerogram::exporter
