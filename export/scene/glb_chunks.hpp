#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "export/bytes/json_document.hpp"
#include "geo/result.hpp"

/// A GLB file as its parts, believing nothing.
namespace aerogram::exporter {

/// The two chunks; views of the file's bytes.
struct GlbChunks {
    std::string_view json, bin;
};

/// Errors: invalid_input naming the byte: no GLB, another version than 2, a length that is not the file's, chunks out
/// of order, a JSON chunk above 64 MiB.
Result<GlbChunks> glb_chunks(std::string_view bytes);

/// Numbers of an accessor in the binary chunk; in bounds, not sparse.
class GlbNumbers {
  public:
    /// What is wrong goes to the problem of `root`. @param type  "SCALAR" or "VEC3": floats.
    GlbNumbers(const JsonNode& root, std::string_view bin, std::size_t accessor, std::string_view type);
    [[nodiscard]] std::size_t size() const { return count_; }
    /// @param component  below 1 or 3. @returns what the file holds, finite or not.
    [[nodiscard]] double at(std::size_t element, std::size_t component) const;

  private:
    std::string_view bytes_;  ///< from the first element
    std::size_t count_ = 0, stride_ = 0;
};

/// The bytes of a buffer view; empty where it is wrong.
[[nodiscard]] std::string_view glb_view(const JsonNode& root, std::string_view bin, std::size_t view);

}  // namespace aerogram::exporter
